"""How long a sweep takes and how large it becomes, from the run expected to be largest."""

import math
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from vasc.config.foreseen import foreseen
from vasc.errors import VascError
from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.local import WorkerProcess
from vasc.sweeps.plan import PlannedRun
from vasc.sweeps.reading import MOST_CHECKED, Sweep
from vasc.sweeps.work import Result, experiment_of, result_of

SECONDS_OF_SHORT_RUN = 30.0
"""Of a run that takes this long, what a worker does at its start is a small part."""

Expected = tuple[float, float, float]
"""Bytes of file and memory that a run may reach, and the kill distance below 0."""

UNKNOWN = (-math.inf, -math.inf, -math.inf)
"""Of a run whose config is wrong."""


@dataclass(frozen=True)
class Estimate:
    """What a sweep asks for, if all runs are like the one that was tried.

    Parameters
    ----------
    number : int
        Of the run that was tried.
    start_seconds : float
        Of that run in a new worker, which loads and may compile what all need.
    run_seconds : float
        Of that run, measures included, in a worker that has done one before.
    run_bytes : int
        Of its timeline.
    n_runs : int
        Runs that are missing.
    n_workers : int
        Workers that share them.
    error : str
        What went wrong with that run; empty if nothing did.
    """

    number: int
    start_seconds: float
    run_seconds: float
    run_bytes: int
    n_runs: int
    n_workers: int
    error: str = ""

    @property
    def seconds(self) -> float:
        """How long all missing runs take: workers begin together."""
        rounds = -(-self.n_runs // max(self.n_workers, 1))
        return self.start_seconds + (rounds - 1) * self.run_seconds if rounds else 0.0

    @property
    def bytes(self) -> int:
        """How large all missing timelines are."""
        return self.n_runs * self.run_bytes

    def as_json(self) -> dict[str, Any]:
        """Give the estimate as JSON values."""
        return {
            "run": self.number,
            "start_seconds": self.start_seconds,
            "run_seconds": self.run_seconds,
            "run_bytes": self.run_bytes,
            "runs": self.n_runs,
            "workers": self.n_workers,
            "seconds": self.seconds,
            "bytes": self.bytes,
            "error": self.error,
        }


def estimate(sweep: Sweep, missing: list[int], n_workers: int) -> Estimate:
    """Make one run of a sweep in a folder that is removed afterwards, and time it.

    It is the one that is expected to be largest, so that the rest takes hardly longer.

    Parameters
    ----------
    sweep : Sweep
        The sweep.
    missing : list of int
        Numbers of the runs that are missing.
    n_workers : int
        Workers that will share them.

    Returns
    -------
    Estimate
        Without times if the first run fails; ``error`` says how.
    """
    number = largest_run(sweep, missing)
    with TemporaryDirectory(prefix="vasc-") as name:
        folder = SweepFolder(Path(name) / "pilot")
        folder.begin(sweep.description())
        first, again = _made_twice(folder, number)
    return Estimate(
        number=number,
        start_seconds=first.get("seconds", 0.0),
        run_seconds=again.get("seconds", 0.0),
        run_bytes=first.get("bytes", 0),
        n_runs=len(missing),
        n_workers=n_workers,
        error=first["error"],
    )


def largest_run(sweep: Sweep, missing: list[int]) -> int:
    """Give the run that is expected to be largest, from configs alone; the first of equals.

    Parameters
    ----------
    sweep : Sweep
        The sweep.
    missing : list of int
        Numbers of the runs to choose from; of very many, an even sample is looked at.
    """
    numbers = missing or [1]
    description = sweep.description()
    sizes: dict[str, Expected] = {}
    found, largest = numbers[0], UNKNOWN
    for number in numbers[:: -(-len(numbers) // MOST_CHECKED)]:
        run = sweep.runs[number - 1]
        # replicates differ by seed alone
        values = repr(run.values)
        if values not in sizes:
            sizes[values] = _expected(description, run)
        if sizes[values] > largest:
            found, largest = number, sizes[values]
    return found


def _expected(description: dict[str, Any], run: PlannedRun) -> Expected:
    """Give how large a run may become; less than any for one that cannot be made."""
    try:
        experiment = experiment_of(description, run)
        size = foreseen(experiment.parameters, experiment.model())
    except VascError:
        return UNKNOWN
    # below the spacing of sources the bound does not know it, but nearer veins are longer
    arrival = getattr(experiment.parameters, "arrival", None)
    return size.file, size.memory, -float(getattr(arrival, "kill_distance", 0.0))


def _made_twice(folder: SweepFolder, number: int) -> tuple[Result, Result]:
    """Make a run in a worker, as all runs will be, and a short one once more there."""
    process = WorkerProcess(folder)
    try:
        first = again = process.make(number)
        if first is not None and not first["error"] and first["seconds"] < SECONDS_OF_SHORT_RUN:
            folder.timeline(number).unlink()
            folder.result_file(number).unlink()
            again = process.make(number)
    except BaseException:
        process.kill()
        raise
    finally:
        said = process.end()
    lost = result_of(number, {}, [f"its worker {said}"])
    return first or lost, again or lost
