"""``vasc animate``: a film of a growing leaf."""

import sys
from typing import Annotated

import typer

from vasc.cli.options import Color, Force, Output, Quiet, RunFile, ScaleBar, WithSources

EXAMPLES = ("vasc animate poplar-leaf.h5 -o poplar.gif --every 20",)


def animate(
    path: RunFile,
    output: Output,
    every: Annotated[
        int | None, typer.Option("--every", min=1, help="Draw every so many steps.")
    ] = None,
    color: Color = None,
    sources: WithSources = False,
    scale_bar: ScaleBar = True,
    force: Force = False,
    quiet: Quiet = False,
) -> None:
    """Make a film of a run, as mp4 or gif."""
    from vasc import render as drawing
    from vasc.cli.run import check_not_needed, check_picture

    check_picture(output, force=force)
    check_not_needed(path, output)
    is_shown = not quiet and sys.stderr.isatty()

    def progress(count: int, total: int) -> None:
        sys.stderr.write(f"\r\x1b[Kpicture {count} of {total}")
        sys.stderr.flush()

    file = drawing.animate(
        path,
        output,
        every=every,
        color=color,
        sources=sources,
        scale_bar=scale_bar,
        progress=progress if is_shown else None,
    )
    if is_shown:
        sys.stderr.write("\r\x1b[K")
    if not quiet:
        typer.echo(f"written: {file}")
