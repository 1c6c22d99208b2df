"""``vasc animate``: a film of a growing leaf."""

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
    from vasc.cli.outputs import check_file
    from vasc.cli.terminal_line import TerminalLine

    check_file(output, force=force)
    with TerminalLine(0.0, quiet=quiet) as line:

        def progress(count: int, total: int) -> None:
            line.write(f"picture {count} of {total}")

        file = drawing.animate(
            path,
            output,
            every=every,
            color=color,
            sources=sources,
            scale_bar=scale_bar,
            progress=progress if line.is_shown else None,
        )
    if not quiet:
        typer.echo(f"written: {file}")
