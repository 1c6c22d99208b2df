"""How long a sweep takes and how large it becomes, from its first run."""

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.local import WorkerProcess
from vasc.sweeps.reading import Sweep
from vasc.sweeps.work import Result, result_of

SECONDS_OF_SHORT_RUN = 30.0
"""Of a run that takes this long, what a worker does at its start is a small part."""


@dataclass(frozen=True)
class Estimate:
    """What a sweep asks for, if all runs are like its first one.

    Parameters
    ----------
    start_seconds : float
        Of the first run in a new worker, which loads and may compile what all need.
    run_seconds : float
        Of the first run, measures included, in a worker that has done one before.
    run_bytes : int
        Of its timeline.
    n_runs : int
        Runs that are missing.
    n_workers : int
        Workers that share them.
    error : str
        What went wrong with the first run; empty if nothing did.
    """

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
            "start_seconds": self.start_seconds,
            "run_seconds": self.run_seconds,
            "run_bytes": self.run_bytes,
            "runs": self.n_runs,
            "workers": self.n_workers,
            "seconds": self.seconds,
            "bytes": self.bytes,
            "error": self.error,
        }


def estimate(sweep: Sweep, n_runs: int, n_workers: int) -> Estimate:
    """Make the first run of a sweep in a folder that is removed afterwards, and time it.

    Parameters
    ----------
    sweep : Sweep
        The sweep.
    n_runs : int
        Runs that are missing.
    n_workers : int
        Workers that will share them.

    Returns
    -------
    Estimate
        Without times if the first run fails; ``error`` says how.
    """
    with TemporaryDirectory(prefix="vasc-") as name:
        folder = SweepFolder(Path(name) / "pilot")
        folder.begin(sweep.description())
        first, again = _made_twice(folder)
    return Estimate(
        start_seconds=first.get("seconds", 0.0),
        run_seconds=again.get("seconds", 0.0),
        run_bytes=first.get("bytes", 0),
        n_runs=n_runs,
        n_workers=n_workers,
        error=first["error"],
    )


def _made_twice(folder: SweepFolder) -> tuple[Result, Result]:
    """Make the first run in a worker, as all runs will be, and a short one once more there."""
    process = WorkerProcess(folder)
    try:
        first = again = process.make(1)
        if first is not None and not first["error"] and first["seconds"] < SECONDS_OF_SHORT_RUN:
            folder.timeline(1).unlink()
            folder.result_file(1).unlink()
            again = process.make(1)
    except BaseException:
        process.kill()
        raise
    finally:
        said = process.end()
    lost = result_of(1, {}, [f"its worker {said}"])
    return first or lost, again or lost
