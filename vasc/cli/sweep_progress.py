"""A line on the terminal that says how far a sweep is."""

import shutil
import sys
import time
from types import TracebackType
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from vasc.sweeps import Progress

SECONDS_PER_LINE = 0.5


class SweepProgress:
    """Keeps one line of the terminal up to date, and removes it at the end.

    It writes nothing when the error output is not a terminal.

    Parameters
    ----------
    quiet : bool
        Write nothing in any case.
    """

    def __init__(self, *, quiet: bool = False) -> None:
        self.is_shown = not quiet and sys.stderr.isatty()
        self._began = time.monotonic()
        self._next = 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self.is_shown:
            self._write("")

    def show(self, progress: "Progress") -> None:
        """Write the line anew if it is old enough."""
        now = time.monotonic()
        if self.is_shown and now >= self._next:
            self._next = now + SECONDS_PER_LINE
            self._write(line_of(progress, now - self._began))

    @staticmethod
    def _write(line: str) -> None:
        """Replace what stands on the line."""
        width = shutil.get_terminal_size().columns
        sys.stderr.write(f"\r\x1b[K{line[: max(width - 1, 0)]}")
        sys.stderr.flush()


def line_of(progress: "Progress", seconds: float) -> str:
    """Say how far a sweep is after some seconds."""
    parts = [
        f"{progress.done:,} done",
        f"{progress.running:,} running",
        f"{len(progress.failed):,} failed",
        f"{progress.left:,} left",
    ]
    if progress.made and progress.left:
        parts.append(f"about {duration(seconds / progress.made * progress.left)} to go")
    return "  ".join(parts)


def duration(seconds: float) -> str:
    """Give a time in units that leave few digits.

    Examples
    --------
    >>> duration(0.25), duration(75), duration(7260)
    ('0.2 s', '1 min 15 s', '2 h 1 min')
    """
    if seconds < 10:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    minutes, rest = divmod(whole, 60)
    if minutes < 60:
        return f"{minutes} min {rest} s"
    hours, minutes = divmod(minutes, 60)
    return f"{hours:,} h {minutes} min"
