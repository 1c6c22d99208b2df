"""How long a sweep takes and how large it becomes, from its first run."""

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.local import LocalWorkers
from vasc.sweeps.reading import Sweep
from vasc.sweeps.work import Result


@dataclass(frozen=True)
class Estimate:
    """What a sweep asks for, if all runs are like its first one.

    Parameters
    ----------
    run_seconds : float
        Of the first run, measures included.
    run_bytes : int
        Of its timeline.
    n_runs : int
        Runs that are missing.
    n_workers : int
        Workers that share them.
    error : str
        What went wrong with the first run; empty if nothing did.
    """

    run_seconds: float
    run_bytes: int
    n_runs: int
    n_workers: int
    error: str = ""

    @property
    def seconds(self) -> float:
        """How long all missing runs take: workers begin together."""
        return -(-self.n_runs // max(self.n_workers, 1)) * self.run_seconds

    @property
    def bytes(self) -> int:
        """How large all missing timelines are."""
        return self.n_runs * self.run_bytes

    def as_json(self) -> dict[str, Any]:
        """Give the estimate as JSON values."""
        return {
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
    """
    with TemporaryDirectory(prefix="vasc-") as name:
        folder = SweepFolder(Path(name) / "pilot")
        folder.begin(sweep.description())
        result = _made(folder)
    seconds, size = result.get("seconds", 0.0), result.get("bytes", 0)
    return Estimate(seconds, size, n_runs, n_workers, result["error"])


def _made(folder: SweepFolder) -> Result:
    """Make the first run in a worker, as all runs will be."""
    result = None
    with LocalWorkers(1) as workers:
        workers.start(folder, [1])
        while result is None:
            result = workers.next_result(1.0)
    return result
