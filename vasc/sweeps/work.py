"""What a worker does: one run of a sweep, from its number to its result."""

import logging
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from vasc.config import Experiment, load_text
from vasc.config.bundled import bundled_folder
from vasc.errors import RunError, TimelineError, VascError
from vasc.sweeps.folder import DONE, FAILED, SweepFolder
from vasc.sweeps.measures import measure
from vasc.sweeps.plan import PlannedRun, as_overrides

logger = logging.getLogger(__name__)

Result = dict[str, Any]
"""``number, status, error, measures, seconds, bytes``, as in the file of a result."""

STOPPED, MISSING = "stopped", "missing"
"""What a run without a result can be; one that was stopped is missing in the table."""

PATIENCE = 600.0
"""Seconds to wait for another process that still writes the timeline."""


def never() -> bool:
    """Tell a run to go on."""
    return False


def perform(folder: str, number: int, should_stop: Callable[[], bool] = never) -> Result:
    """Make one run of a sweep, measure it and write its result.

    A timeline that is there is gone on with from its last committed frame. Whatever
    goes wrong becomes the error of this run.

    Parameters
    ----------
    folder : str
        The folder of the sweep.
    number : int
        Which run.
    should_stop : callable
        Asked after every step; when it says so, the run ends and can be gone on with.

    Returns
    -------
    dict
        Its result, which the folder holds, too, unless the run was stopped.

    Raises
    ------
    OutputError
        If the folder holds no sweep.
    OSError
        If the result cannot be written.
    """
    place = SweepFolder(Path(folder))
    description = place.description()
    run = PlannedRun(**description["runs"][number - 1])
    began = time.perf_counter()
    try:
        experiment = experiment_of(description, run)
        is_stopped = _grow(experiment, place, number, should_stop)
        if (found := place.result(number)) is not None:
            return found  # another worker that was thought lost has ended it meanwhile
        if is_stopped:
            return {"number": number, "status": STOPPED}
        values, problems = _measured(place.timeline(number), description["sweep"]["measures"])
    except Exception as error:
        values, problems = {}, [_one_line(error, place)]
        logger.debug("run %d failed", number, exc_info=True)
    result = result_of(number, values, problems)
    result["seconds"] = round(time.perf_counter() - began, 3)
    timeline = place.timeline(number)
    result["bytes"] = timeline.stat().st_size if timeline.exists() else 0
    place.write_result(result)
    return result


def result_of(number: int, measures: dict[str, Any], problems: list[str]) -> Result:
    """Give the result of a run."""
    return {
        "number": number,
        "status": FAILED if problems else DONE,
        "error": "; ".join(problems),
        "measures": measures,
    }


def experiment_of(description: dict[str, Any], run: PlannedRun) -> Experiment:
    """Give the experiment of a run: the base with its own values."""
    folder = description["folder"]
    return load_text(
        description["base"],
        name=description["base_name"],
        folder=bundled_folder() if folder is None else Path(folder),
        label=description["base_name"],
        overrides=[*as_overrides(description["sweep"]["set"]), *run.overrides],
    )


def _grow(
    experiment: Experiment, place: SweepFolder, number: int, should_stop: Callable[[], bool]
) -> bool:
    """Run or go on with a run until its timeline is complete; tell whether it was stopped."""
    from vasc.experiment import resume, run

    path = place.timeline(number)
    _wait_for_others(path)
    if path.exists() and _holds(path, experiment):
        summary = resume(path, should_stop=should_stop)
    else:
        summary = run(experiment, path, force=True, should_stop=should_stop)
    return summary.is_interrupted


def _holds(path: Path, experiment: Experiment) -> bool:
    """Tell whether a timeline is a run of this experiment that can be gone on with."""
    from vasc.timeline import Timeline

    try:
        with Timeline(path) as timeline:
            return bool(timeline.config == experiment.record)
    except TimelineError:
        return False


def _wait_for_others(path: Path) -> None:
    """Wait until no other process writes a timeline, as one that only seemed to be lost may."""
    from vasc.timeline.redo import is_being_written, log_of

    end = time.monotonic() + PATIENCE
    while is_being_written(path, log_of(path)):
        if time.monotonic() > end:
            raise RunError("another process writes its timeline")
        time.sleep(0.2)


def _measured(path: Path, names: list[str]) -> tuple[dict[str, Any], list[str]]:
    """Measure a complete timeline."""
    from vasc.timeline import Timeline

    with Timeline(path) as timeline:
        return measure(timeline, names)


def _one_line(error: Exception, place: SweepFolder) -> str:
    """Describe an error without the place of the sweep: the same failure is the same text."""
    text = " ".join(str(error).replace(f"{place.runs}{os.sep}", "").split())
    if isinstance(error, VascError):
        return text
    if isinstance(error, MemoryError):
        return "not enough memory for this"
    if isinstance(error, OSError):
        return error.strerror or text
    return f"unexpected {type(error).__name__}: {text or 'no message'}"
