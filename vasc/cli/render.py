"""``vasc render``: a picture of a recorded leaf."""

import typer

from vasc.cli.options import AsJson, Color, Force, Output, RunFile, ScaleBar, Step, WithSources

EXAMPLES = ("vasc render poplar-leaf.h5 -o young.pdf --step 500 --color age",)


def render(
    path: RunFile,
    output: Output,
    step: Step = -1,
    color: Color = "width",
    sources: WithSources = False,
    scale_bar: ScaleBar = True,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Draw a run at its last step or another, as png, svg or pdf."""
    from vasc import render as drawing
    from vasc.cli.printing import print_json
    from vasc.cli.run import check_picture

    check_picture(output, force=force)
    file = drawing.render(path, output, step, color=color, sources=sources, scale_bar=scale_bar)
    if as_json:
        print_json({"files": [str(file)]})
    else:
        typer.echo(f"written: {file}")
