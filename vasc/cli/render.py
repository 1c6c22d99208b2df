"""``vasc render``: a picture of a recorded leaf or stem."""

from typing import Annotated

import typer

from vasc.cli.options import AsJson, Color, Force, Output, RunFile, ScaleBar, Steps, WithSources

EXAMPLES = (
    "vasc render poplar-leaf.h5 -o young.pdf --step 500 --color age",
    "vasc render poplar-leaf.h5 -o growth.png --growth --step 0 --step 200 --step 500",
    "vasc render stem-golden-5-8.h5 -o flat.png --unroll",
)


def render(
    path: RunFile,
    output: Output,
    step: Steps = None,
    color: Color = None,
    sources: WithSources = False,
    scale_bar: ScaleBar = True,
    growth: Annotated[
        bool, typer.Option("--growth", help="Draw how tissue grows between steps, not the veins.")
    ] = False,
    unroll: Annotated[
        bool, typer.Option("--unroll", help="Draw a stem split along a line and laid flat.")
    ] = False,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Draw a leaf, stem or tissue at its last step or another one, as png, svg or pdf."""
    from vasc import render as drawing
    from vasc.cli.printing import print_json
    from vasc.cli.run import check_picture

    check_picture(output, force=force)
    if growth and unroll:
        raise typer.BadParameter("--growth and --unroll exclude each other")
    if growth:
        from vasc.cli.growing import growth_figure
        from vasc.render.saving import PICTURE_SUFFIXES, checked_output

        file = checked_output(output, PICTURE_SUFFIXES)
        drawing.save(growth_figure(path, step or []), file)
    else:
        file = drawing.render(
            path,
            output,
            steps=step or [-1],
            color=color,
            sources=sources,
            scale_bar=scale_bar,
            unroll=unroll,
        )
    if as_json:
        print_json({"files": [str(file)]})
    else:
        typer.echo(f"written: {file}")
