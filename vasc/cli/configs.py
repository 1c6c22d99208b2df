"""``vasc configs``: the experiments that come with vasc."""

from pathlib import Path
from typing import Annotated

import typer

from vasc.cli.options import AsJson

EXAMPLES = (
    "vasc configs",
    "vasc configs --copy poplar-leaf",
)


def configs(
    copy: Annotated[
        str | None, typer.Option("--copy", metavar="NAME", help="Write this one, to edit.")
    ] = None,
    folder: Annotated[
        Path, typer.Option("--to", metavar="FOLDER", help="Where --copy writes to.")
    ] = Path(),
    as_json: AsJson = False,
) -> None:
    """List the experiments that come with vasc, or copy one to edit it."""
    from vasc.cli.printing import print_json, print_pairs
    from vasc.config.bundled import bundled_configs, copy_bundled

    if copy is not None:
        files = [str(file) for file in copy_bundled(copy, folder)]
        if as_json:
            print_json({"files": files})
        else:
            typer.echo(f"written: {', '.join(files)}")
        return
    found = bundled_configs()
    if as_json:
        print_json([{"name": one.name, "title": one.title} for one in found])
    else:
        print_pairs({one.name: one.title for one in found})
