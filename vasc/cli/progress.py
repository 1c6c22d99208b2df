"""A line on the terminal that says how far a run is."""

import shutil
import sys
import time
from types import TracebackType
from typing import Self

from vasc.state import State
from vasc.streams import Streams

SECONDS_PER_LINE = 0.1
"""The line is written ten times a second at most: the rest of the time, a step costs a look at
the clock."""

SECONDS_OF_RATE = 1.0
"""Time over which steps per second are counted."""


class ProgressLine:
    """An observer that keeps one line of the terminal up to date, and removes it at the end.

    It writes nothing when the error output is not a terminal.

    Parameters
    ----------
    quiet : bool
        Write nothing in any case.
    """

    def __init__(self, *, quiet: bool = False) -> None:
        self.is_shown = not quiet and sys.stderr.isatty()
        self._next = 0.0
        self._rate = 0.0
        self._mark: tuple[float, int] | None = None

    def __enter__(self) -> Self:
        if self.is_shown:
            self._write("preparing (a first run compiles kernels; outlines need a fit)")
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
            self._write("")

    def observe(self, state: State, streams: Streams) -> None:
        """Write the line anew if it is old enough."""
        if not self.is_shown:
            return
        now = time.perf_counter()
        if now < self._next:
            return
        self._next = now + SECONDS_PER_LINE
        if self._mark is None:
            self._mark = (now, state.step)
        began, step = self._mark
        if now - began >= SECONDS_OF_RATE or not self._rate:
            self._rate = (state.step - step) / (now - began) if now > began else 0.0
            self._mark = (now, state.step)
        blade = f"  blade {state.blade.length:.4g} D" if state.blade is not None else ""
        self._write(
            f"step {state.step:,}  time {state.time:g}{blade}"
            f"  nodes {state.n_rows('nodes'):,}  sources {len(state.live):,}"
            f"  {self._rate:,.0f} steps/s"
        )

    @staticmethod
    def _write(line: str) -> None:
        """Replace what stands on the line."""
        width = shutil.get_terminal_size().columns
        sys.stderr.write(f"\r\x1b[K{line[: max(width - 1, 0)]}")
        sys.stderr.flush()
