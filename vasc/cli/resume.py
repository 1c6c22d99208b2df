"""``vasc resume``: go on with a run."""

from pathlib import Path
from tempfile import TemporaryDirectory

import typer

from vasc.cli.options import AsJson, Figure, Force, MoreSteps, NoFigure, Quiet, RunFile

EXAMPLES = ("vasc resume poplar-leaf.h5 --steps 500",)


def resume(
    path: RunFile,
    steps: MoreSteps = None,
    figure: Figure = None,
    no_figure: NoFigure = False,
    force: Force = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Go on with a run from its last recorded step, to the same bytes, and draw the last one.

    The picture that was drawn of the step the run goes on from is replaced by the new one. Another
    file of that name is left as it is, but with --force.
    """
    from vasc import experiment
    from vasc.cli.failures import complain
    from vasc.cli.interrupts import Interrupts
    from vasc.cli.progress import ProgressLine
    from vasc.cli.run import drawn
    from vasc.cli.start import load_numba
    from vasc.cli.summary import end_if_interrupted, print_summary, warn_of_veins_outside
    from vasc.timeline import Timeline
    from vasc.timeline.left_behind import concerns
    from vasc.timeline.redo import settle

    if figure is not None and no_figure:
        raise typer.BadParameter("--figure and --no-figure exclude each other")
    with Timeline(path) as timeline:
        was_complete, last_step = timeline.is_complete, timeline.last_step
        is_stem = timeline.dimensions == 3
    for concern in concerns(path):
        complain(f"warning: {concern}")
    if was_complete and not (quiet or as_json):
        settle(path)
        typer.echo(f"{path} is complete: its {last_step:,} steps are all there are")
        return
    picture = None if no_figure or was_complete else _picture(path, figure, is_stem, force=force)
    with Interrupts() as interrupts, ProgressLine(quiet=quiet) as progress:
        load_numba()
        summary = experiment.resume(
            path, steps=steps, observers=[progress], should_stop=interrupts.should_stop
        )
    end_if_interrupted(summary, interrupts)
    files = [path, *drawn(path, picture, unroll=is_stem)]
    if as_json or not quiet:
        print_summary(summary, files, as_json=as_json)
        warn_of_veins_outside(summary)


def _picture(path: Path, figure: Path | None, is_stem: bool, *, force: bool) -> Path | None:
    """Give the picture to draw; None where a file of its name is none of this run.

    Raises
    ------
    OutputError
        If the picture that is asked for cannot be written, or the config refers to the file.
    """
    from vasc.cli.failures import complain
    from vasc.cli.outputs import check_not_needed, check_picture
    from vasc.cli.run import OTHER_FIGURE

    picture = path.with_suffix(".png") if figure is None else figure
    check_not_needed(path, picture, OTHER_FIGURE)
    if figure is None and picture.is_file() and not force:
        if not _is_of_last_step(path, picture, is_stem):
            complain(
                f"warning: {picture} is left as it is, for it is no picture of the step the run"
                " goes on from; --force replaces it"
            )
            return None
        force = True
    check_picture(picture, force=force)
    return picture


def _is_of_last_step(path: Path, picture: Path, is_stem: bool) -> bool:
    """Tell whether a picture is what is drawn of a run as it is, byte for byte."""
    from vasc.render import render
    from vasc.timeline import Timeline

    with Timeline(path) as timeline:
        if not timeline.n_frames:
            return False
    with TemporaryDirectory(prefix="vasc-") as folder:
        again = render(path, Path(folder) / picture.name, unroll=is_stem)
        return again.read_bytes() == picture.read_bytes()
