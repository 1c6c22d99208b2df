"""Who makes the runs of a sweep: processes of this machine, or of a cluster."""

import queue
from abc import ABC, abstractmethod
from collections.abc import Sequence
from types import TracebackType
from typing import Self

from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.work import Result

REPEATS = 2
"""Times that a run is made once more after the worker that made it was lost."""


class Workforce(ABC):
    """Workers that make the runs of a sweep, in any order; a context, which they leave with it."""

    def __init__(self) -> None:
        self.results: queue.SimpleQueue[Result | Exception] = queue.SimpleQueue()

    @abstractmethod
    def start(self, folder: SweepFolder, numbers: Sequence[int]) -> None:
        """Let the workers begin with these runs."""

    @abstractmethod
    def stop(self) -> None:
        """Let all workers end their runs after the step they are at, and wait for that."""

    @abstractmethod
    def close(self) -> None:
        """Let go of the workers, whatever they do."""

    @property
    @abstractmethod
    def n_running(self) -> int:
        """Runs that are being made now."""

    def next_result(self, seconds: float) -> Result | None:
        """Give the next result, None if there is none within some seconds.

        Raises
        ------
        RunError
            If there is nobody left who could work.
        """
        try:
            found = self.results.get(timeout=seconds)
        except queue.Empty:
            return None
        if isinstance(found, Exception):
            raise found
        return found

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
