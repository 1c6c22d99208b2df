"""Arguments and options that several verbs share."""

from pathlib import Path
from typing import Annotated

import typer

RunFile = Annotated[Path, typer.Argument(metavar="RUN.h5", help="A recorded run.")]

AsJson = Annotated[bool, typer.Option("--json", help="Write JSON, for scripts.")]

Step = Annotated[int, typer.Option("--step", min=-1, help="A recorded step; -1 is the last one.")]

Steps = Annotated[
    list[int] | None,
    typer.Option("--step", min=-1, help="A recorded step, -1 for the last one; may be repeated."),
]

Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Write nothing but errors.")]

Figure = Annotated[
    Path | None,
    typer.Option("--figure", metavar="FILE", help="png, svg or pdf; by default beside RUN.h5."),
]

NoFigure = Annotated[bool, typer.Option("--no-figure", help="Draw no picture.")]

Force = Annotated[bool, typer.Option("--force", help="Replace files that exist.")]

Output = Annotated[
    Path, typer.Option("--output", "-o", metavar="FILE", help="Where to write; see above.")
]

MoreSteps = Annotated[
    int | None,
    typer.Option("--steps", min=1, help="Make that many steps at most; `vasc resume` goes on."),
]

Color = Annotated[
    str | None,
    typer.Option(
        "--color",
        help="One of width, order, age, source, kind, state. Of a run on a tissue also"
        " concentration, its default, flux, carriers, role.",
    ),
]

WithSources = Annotated[bool, typer.Option("--sources", help="Draw the live sources, too.")]

ScaleBar = Annotated[bool, typer.Option("--scale-bar/--no-scale-bar", help="Draw a scale bar.")]
