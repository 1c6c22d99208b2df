"""``vasc run``: grow a leaf and record it."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vasc.cli.options import AsJson, Figure, Force, MoreSteps, NoFigure, Quiet

if TYPE_CHECKING:
    from vasc.config import Experiment

OTHER_FIGURE = "; choose another name with --figure, or --no-figure"
"""What to do where the picture would replace a file that is needed."""

EXAMPLES = (
    "vasc run poplar-leaf",
    "vasc run my-leaf.toml -o my.h5 --seed 2 --set growth.final_length=2000",
)


def run(
    config: Annotated[
        str,
        typer.Argument(metavar="CONFIG", help="A TOML file, or a name that `vasc configs` lists."),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="RUN.h5", help="The timeline; by default CONFIG.h5."
        ),
    ] = None,
    seed: Annotated[
        int | None, typer.Option("--seed", help="Instead of the config's seed.")
    ] = None,
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="KEY=VALUE", help="Instead of a value of the config; repeat."
        ),
    ] = None,
    steps: MoreSteps = None,
    figure: Figure = None,
    no_figure: NoFigure = False,
    force: Force = False,
    large: Annotated[
        bool,
        typer.Option("--large", help="Run even what memory or disk are not expected to hold."),
    ] = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Run an experiment: record every step, and draw the last one."""
    from vasc.cli.announcement import Announcement
    from vasc.cli.interrupts import Interrupts
    from vasc.cli.progress import ProgressLine
    from vasc.cli.start import load_numba
    from vasc.cli.summary import end_if_interrupted, print_summary, warn_of_veins_outside
    from vasc.timeline.storage import check_output

    if figure is not None and no_figure:
        raise typer.BadParameter("--figure and --no-figure exclude each other")
    experiment = changed(config, changes or (), seed)
    output = Path(f"{experiment.name}.h5") if output is None else output
    check_folder(output)
    check_output(output, force=force)
    figure = None if no_figure else figure or output.with_suffix(".png")
    check_outputs(config, output, figure, force=force)
    experiment.refuse_own_file(output, "; choose another name with --output")
    if figure is not None:
        experiment.refuse_own_file(figure, OTHER_FIGURE)

    from vasc import experiment as experiments

    with Interrupts() as interrupts, ProgressLine(quiet=quiet) as progress:
        load_numba()
        announcement = Announcement(experiment, progress, is_made=quiet or as_json)
        summary = experiments.run(
            experiment,
            output,
            force=force,
            large=large,
            steps=steps,
            observers=[announcement, progress],
            should_stop=interrupts.should_stop,
            on_size=announcement.expect,
        )
    end_if_interrupted(summary, interrupts)
    files = [output, *drawn(output, figure, unroll=experiment.kind == "stem")]
    if as_json or not quiet:
        print_summary(summary, files, as_json=as_json)
        warn_of_veins_outside(summary)


def drawn(output: Path, figure: Path | None, *, unroll: bool) -> list[Path]:
    """Draw the last step, if asked for; give the picture."""
    if figure is None:
        return []
    from vasc.render import render

    return [render(output, figure, unroll=unroll)]


def changed(config: str, changes: Sequence[str], seed: int | None) -> "Experiment":
    """Read a config with some values, and maybe the seed, replaced.

    Raises
    ------
    ConfigError
        If the config or a change is wrong.
    """
    from vasc.config import load, parse_override

    overrides = [parse_override(change) for change in changes]
    return load(config, [*overrides, *([] if seed is None else [(("seed",), seed)])])


def check_outputs(config: str, output: Path, figure: Path | None, *, force: bool) -> None:
    """Refuse files that are one, and a picture that cannot be written.

    Raises
    ------
    OutputError
        If two of the files are one, or the picture exists and ``force`` is not
        set, its folder does not exist, or it is of no known kind.
    """
    from vasc.errors import OutputError

    named = [("config", Path(config)), ("timeline", output)]
    if figure is not None:
        check_folder(figure)
        named.append(("picture", figure))
    for index, (kind, path) in enumerate(named[1:], start=1):
        for other_kind, other in named[:index]:
            if path.absolute() == other.absolute() or (path.exists() and _is_same(path, other)):
                raise OutputError(f"{path}: cannot be {other_kind} and {kind} at once")
    if figure is not None:
        check_figure(figure, force=force)


def check_figure(figure: Path, *, force: bool) -> None:
    """Refuse a picture of a run that is of no known kind, or cannot be written.

    Raises
    ------
    OutputError
        If it is one.
    """
    from vasc.errors import OutputError
    from vasc.render import PICTURE_SUFFIXES

    if figure.suffix.lower() not in PICTURE_SUFFIXES:
        known = ", ".join(PICTURE_SUFFIXES)
        raise OutputError(f"{figure}: suffix {figure.suffix!r} is not one of {known}")
    check_picture(figure, force=force)


def check_picture(figure: Path, *, force: bool) -> None:
    """Refuse a picture that exists, or whose folder does not.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    from vasc.errors import OutputError

    check_folder(figure)
    if figure.is_dir():
        raise OutputError(f"{figure}: is a folder")
    if figure.exists() and not force:
        raise OutputError(f"{figure}: exists already; use --force to replace it")


def check_not_needed(
    run: Path, output: Path, hint: str = "; choose another name with --output"
) -> None:
    """Refuse to write over a file that the config of a recorded run refers to.

    Raises
    ------
    OutputError
        If it is one of these, by its name or its content.
    TimelineError
        If the run is no timeline.
    """
    from vasc.config.attachments import refuse_recorded
    from vasc.timeline import Timeline

    if output.is_file():
        with Timeline(run) as timeline:
            refuse_recorded(timeline.config, output, hint)


def check_folder(path: Path) -> None:
    """Refuse a file whose folder does not exist, or into which nothing can be written.

    Raises
    ------
    OutputError
        If no file of that name can be made there.
    """
    from vasc.errors import OutputError

    if not path.parent.is_dir():
        raise OutputError(f"{path}: the folder {str(path.parent)!r} does not exist")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise OutputError(f"{path}: the folder {str(path.parent)!r} cannot be written to")
    try:
        path.exists()
    except (OSError, ValueError) as error:
        raise OutputError(f"{str(path)[:80]!r}: is not the name of a file: {error}") from error


def _is_same(path: Path, other: Path) -> bool:
    """Tell whether two names lead to one file."""
    return other.exists() and path.samefile(other)
