"""A line on the terminal that says how far a sweep is."""

import time
from typing import TYPE_CHECKING

from vasc.cli.terminal_line import TerminalLine

if TYPE_CHECKING:
    from vasc.sweeps import Progress

SECONDS_PER_LINE = 0.5


class SweepProgress(TerminalLine):
    """Keeps one line of the terminal up to date, and removes it at the end.

    Parameters
    ----------
    quiet : bool
        Write nothing, even on a terminal.
    """

    def __init__(self, *, quiet: bool = False) -> None:
        super().__init__(SECONDS_PER_LINE, quiet=quiet)
        self._began = time.perf_counter()

    def show(self, progress: "Progress") -> None:
        """Write the line anew if it is old enough."""
        now = self.due()
        if now is not None:
            self.write(line_of(progress, now - self._began))


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
