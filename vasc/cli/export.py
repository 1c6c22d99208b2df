"""``vasc export``: a solid model of a recorded stem, or a tissue cut from a recorded leaf."""

from typing import Annotated

import typer

from vasc.cli.options import AsJson, Force, Output, RunFile, Step

EXAMPLES = (
    "vasc export stem-golden-5-8.h5 -o stem.ply",
    "vasc export stem-golden-5-8.h5 -o young.glb --step 100",
    "vasc export poplar-leaf.h5 -o tissue.toml --step 60 --cell 2",
)


def export(
    path: RunFile,
    output: Output,
    step: Step = -1,
    cell: Annotated[
        float | None,
        typer.Option("--cell", metavar="D", help="Width of a cell of a tissue in D; by default 2."),
    ] = None,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Write a stem as a solid model (ply, obj, glb), or the tissue of a leaf as a config (toml).

    The config holds outline, veins and live sources of that step, for `vasc run`.
    """
    from vasc import export as exports
    from vasc.cli.printing import print_json
    from vasc.cli.run import check_picture
    from vasc.errors import OutputError

    check_picture(output, force=force)
    if output.suffix.lower() == exports.TISSUE_SUFFIX:
        width = exports.CELL if cell is None else cell
        file = exports.export_tissue(path, output, step, cell=width)
    elif cell is not None:
        raise OutputError(f"{output}: --cell is for a tissue, {exports.TISSUE_SUFFIX}")
    else:
        file = exports.export(path, output, step)
    if as_json:
        print_json({"files": [str(file)]})
    else:
        typer.echo(f"written: {file}")
