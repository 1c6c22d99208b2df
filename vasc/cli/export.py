"""``vasc export``: a solid model of a recorded stem."""

import typer

from vasc.cli.options import AsJson, Force, Output, RunFile, Step

EXAMPLES = (
    "vasc export stem-golden-5-8.h5 -o stem.ply",
    "vasc export stem-golden-5-8.h5 -o young.glb --step 100",
)


def export(
    path: RunFile,
    output: Output,
    step: Step = -1,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Write strands and primordia of a stem as a solid model: ply, obj or glb."""
    from vasc import export as solids
    from vasc.cli.printing import print_json
    from vasc.cli.run import check_picture

    check_picture(output, force=force)
    file = solids.export(path, output, step)
    if as_json:
        print_json({"files": [str(file)]})
    else:
        typer.echo(f"written: {file}")
