"""One line of the terminal that is kept up to date, and removed at the end."""

import shutil
import sys
import time
from types import TracebackType
from typing import Self


class TerminalLine:
    """A line of the error output, written anew now and then.

    It writes nothing when the error output is not a terminal.

    Parameters
    ----------
    seconds : float
        Time from one writing to the next, at least.
    quiet : bool
        Write nothing in any case.
    """

    def __init__(self, seconds: float, *, quiet: bool = False) -> None:
        self.is_shown = not quiet and sys.stderr.isatty()
        self._seconds = seconds
        self._next = 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.clear()

    def clear(self) -> None:
        """Take the line away, until there is something new to write."""
        if self.is_shown:
            self.write("")

    def due(self) -> float | None:
        """Give the time in seconds if the line is old enough to be written anew."""
        if not self.is_shown:
            return None
        now = time.perf_counter()
        if now < self._next:
            return None
        self._next = now + self._seconds
        return now

    @staticmethod
    def write(line: str) -> None:
        """Replace what stands on the line."""
        width = shutil.get_terminal_size().columns
        sys.stderr.write(f"\r\x1b[K{line[: max(width - 1, 0)]}")
        sys.stderr.flush()
