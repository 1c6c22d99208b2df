"""``vasc render``: a picture of a recorded leaf or stem."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vasc.cli.options import AsJson, Color, Force, Output, RunFile, ScaleBar, Steps, WithSources

if TYPE_CHECKING:
    from matplotlib.figure import Figure

EXAMPLES = (
    "vasc render poplar-leaf.h5 -o young.pdf --step 500 --color age",
    "vasc render poplar-leaf.h5 -o growth.png --growth --step 0 --step 200 --step 500",
    "vasc render stem-golden-5-8.h5 -o flat.png --unroll",
    "vasc render arabidopsis-first-leaf.h5 -o tree.png --genealogy",
    "vasc render poplar-leaf.h5 -o survival.png --survival",
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
    genealogy: Annotated[
        bool, typer.Option("--genealogy", help="Draw areoles by first-order loop, and their trees.")
    ] = False,
    births: Annotated[
        bool, typer.Option("--births", help="Draw births of veins: height above the base by step.")
    ] = False,
    survival: Annotated[
        bool, typer.Option("--survival", help="Draw which share of sources outlives an age.")
    ] = False,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Draw a leaf, stem or tissue at its last step or another one, as png, svg or pdf."""
    from vasc import render as drawing
    from vasc.cli.outputs import check_picture
    from vasc.cli.printing import print_json

    check_picture(output, force=force)
    forms = {
        "--growth": growth,
        "--unroll": unroll,
        "--genealogy": genealogy,
        "--births": births,
        "--survival": survival,
    }
    chosen = [name for name, is_chosen in forms.items() if is_chosen]
    if len(chosen) > 1:
        raise typer.BadParameter(f"{chosen[0]} and {chosen[1]} exclude each other")
    if chosen and not unroll:
        ignored = [("--color", color is not None), ("--sources", sources)]
        for name in (one for one, is_given in ignored if is_given):
            raise typer.BadParameter(f"{name} is not for {chosen[0]}; leave one of them out")
    if growth:
        from vasc.cli.growing import growth_figure

        drawing.save(growth_figure(path, step or []), output)
    elif genealogy or births or survival:
        drawing.save(_lineage_figure(path, chosen[0], step or []), output)
    else:
        drawing.render(
            path,
            output,
            steps=step or [-1],
            color=color,
            sources=sources,
            scale_bar=scale_bar,
            unroll=unroll,
        )
    if as_json:
        print_json({"files": [str(output)]})
    else:
        typer.echo(f"written: {output}")


def _lineage_figure(path: Path, form: str, steps: list[int]) -> "Figure":
    """Draw what a run's lineage tells, at one step if it is of a step."""
    from vasc import render as drawing
    from vasc.timeline import Timeline

    if form == "--survival" and steps:
        raise typer.BadParameter("--survival is of the whole run, and takes no --step")
    if len(steps) > 1:
        raise typer.BadParameter(f"{form} shows one step, give --step once")
    with Timeline(path) as timeline:
        if form == "--survival":
            return drawing.draw_survival(timeline)
        draw = drawing.draw_genealogy if form == "--genealogy" else drawing.draw_births
        return draw(timeline, *steps)
