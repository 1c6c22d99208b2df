"""``vasc configs``: the experiments and sweeps that come with vasc."""

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
    """List the experiments and sweeps that come with vasc, or copy one to edit it."""
    from vasc.cli.printing import print_json, print_pairs
    from vasc.config.bundled import bundled_configs, bundled_sweeps, copy_bundled

    if copy is not None:
        files = [str(file) for file in copy_bundled(copy, folder)]
        if as_json:
            print_json({"files": files})
        else:
            typer.echo(f"written: {', '.join(files)}")
        return
    found = {"run": bundled_configs(), "sweep": bundled_sweeps()}
    if as_json:
        print_json(
            [
                {"name": one.name, "title": one.title, "verb": verb}
                for verb, listed in found.items()
                for one in listed
            ]
        )
        return
    print_pairs({one.name: one.title for one in found["run"]})
    typer.echo("\nsweeps, for `vasc sweep`")
    print_pairs({one.name: one.title for one in found["sweep"]})
