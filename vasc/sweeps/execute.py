"""A sweep from what is missing of it to its table and figure."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from vasc.errors import writing
from vasc.sweeps.folder import DONE, FAILED, SweepFolder
from vasc.sweeps.reading import Sweep
from vasc.sweeps.table import write_table
from vasc.sweeps.work import STOPPED, Result, never
from vasc.sweeps.workforce import Workforce

SECONDS_BETWEEN_LOOKS = 0.2
"""Time after which the wish to stop is noticed."""


class Watcher(Protocol):
    """Whoever is told how far a sweep is."""

    def show(self, progress: "Progress") -> None:
        """Take note of it, several times a second."""


@dataclass
class Progress:
    """How far a sweep is.

    Parameters
    ----------
    total : int
        All runs.
    done : int
        Runs with a result and without an error.
    failed : dict
        From the numbers of the runs that failed to their errors.
    running : int
        Runs that are being made now.
    made : int
        Runs with a result that was made here and now.
    is_interrupted : bool
        True when the caller stopped it.
    """

    total: int
    done: int = 0
    failed: dict[int, str] = field(default_factory=dict)
    running: int = 0
    made: int = 0
    is_interrupted: bool = False

    @property
    def left(self) -> int:
        """Runs without a result."""
        return self.total - self.done - len(self.failed)

    def count(self, number: int, result: Result) -> None:
        """Count a result."""
        if result["status"] == DONE:
            self.done += 1
        else:
            self.failed[number] = result["error"]


@dataclass(frozen=True)
class Outcome:
    """What came of a sweep.

    Parameters
    ----------
    progress : Progress
        How far it is.
    files : tuple of Path
        The table, and the figure if there is one.
    no_figure : str
        Why there is none; empty if there is, or none is wanted or can be yet.
    """

    progress: Progress
    files: tuple[Path, ...]
    no_figure: str = ""


def begun(sweep: Sweep, folder: SweepFolder, *, retry: bool = False) -> tuple[Progress, list[int]]:
    """Tell how far a sweep is, and which runs are missing.

    Parameters
    ----------
    sweep : Sweep
        The sweep.
    folder : SweepFolder
        Its folder, which need not be there.
    retry : bool
        Count runs that failed as missing, too.

    Returns
    -------
    progress : Progress
        Results that are there, counted.
    missing : list of int
        Numbers of the runs without one, or whose timeline is no longer what was measured,
        ascending.
    """
    progress, missing = Progress(len(sweep.runs)), []
    for run in sweep.runs:
        result = folder.result(run.number)
        if (
            result is None
            or (retry and result["status"] == FAILED)
            or folder.is_replaced(run.number, result)
        ):
            missing.append(run.number)
        else:
            progress.count(run.number, result)
    return progress, missing


def run_sweep(
    sweep: Sweep,
    output: str | Path,
    workforce: Callable[[], Workforce],
    *,
    retry: bool = False,
    watcher: Watcher | None = None,
    should_stop: Callable[[], bool] = never,
) -> Outcome:
    """Make the runs of a sweep that are missing, and write its table and figure.

    Parameters
    ----------
    sweep : Sweep
        The sweep.
    output : str or Path
        Its folder; one that exists must belong to it.
    workforce : callable
        Gives the workers; called if there is anything to do.
    retry : bool
        Make runs that failed once more.
    watcher : Watcher, optional
        Told how far the sweep is.
    should_stop : callable
        Asked several times a second; when it says so, the workers stop, and the
        same sweep can be gone on with.

    Returns
    -------
    Outcome
        What came of it. A run that fails does not stop the others.

    Raises
    ------
    OutputError
        If the folder belongs to another sweep, another is at work in it, or it
        cannot be written.
    RunError
        If there is nobody left who could work.
    """
    folder = SweepFolder(Path(output))
    folder.check(sweep.description())
    # a scheduler that cannot be reached is told before a folder is made
    crew = workforce() if begun(sweep, folder, retry=retry)[1] else None
    folder.begin(sweep.description())
    with folder.locked():
        progress, missing = begun(sweep, folder, retry=retry)
        for number in missing:
            folder.result_file(number).unlink(missing_ok=True)
        try:
            if missing:
                with crew or workforce() as workers:
                    workers.start(folder, missing)
                    _follow(workers, progress, watcher, should_stop)
        finally:
            with suppress(OSError):
                write_table(folder)
        return _ended(sweep, folder, progress)


def _follow(
    workers: Workforce,
    progress: Progress,
    watcher: Watcher | None,
    should_stop: Callable[[], bool],
) -> None:
    """Count results as they come, until there is none left to wait for."""
    while progress.left:
        if should_stop():
            progress.is_interrupted = True
            workers.stop()
        # what was ended while the workers stopped counts, too
        result = workers.next_result(0.0 if progress.is_interrupted else SECONDS_BETWEEN_LOOKS)
        if result is not None and result["status"] != STOPPED:
            progress.made += 1
            progress.count(result["number"], result)
        elif result is None and progress.is_interrupted:
            break
        progress.running = workers.n_running
        if watcher is not None:
            watcher.show(progress)


def _ended(sweep: Sweep, folder: SweepFolder, progress: Progress) -> Outcome:
    """Write table and figure."""
    from vasc.sweeps.picture import FIGURE, draw_sweep

    with writing(folder.path):
        files = [write_table(folder)]
        reason = ""
        if sweep.parameters.figure != "none" and not progress.left:
            figure = folder.path / FIGURE
            reason = draw_sweep(folder, figure)
            files += [] if reason else [figure]
    return Outcome(progress, tuple(files), reason)
