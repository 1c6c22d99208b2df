"""A line on the terminal that says how far a run is."""

from typing import Self

from vasc.cli.terminal_line import TerminalLine
from vasc.state import State
from vasc.streams import Streams

SECONDS_PER_LINE = 0.1
"""The line is written ten times a second at most: the rest of the time, a step costs a look at
the clock."""

SECONDS_OF_RATE = 1.0
"""Time over which steps per second are counted."""


class ProgressLine(TerminalLine):
    """An observer that keeps one line of the terminal up to date, and removes it at the end.

    Parameters
    ----------
    quiet : bool
        Write nothing, even on a terminal.
    """

    def __init__(self, *, quiet: bool = False) -> None:
        super().__init__(SECONDS_PER_LINE, quiet=quiet)
        self._rate = 0.0
        self._mark: tuple[float, int] | None = None

    def __enter__(self) -> Self:
        if self.is_shown:
            self.write("preparing (a first run compiles kernels; outlines need a fit)")
        return self

    def observe(self, state: State, streams: Streams) -> None:
        """Write the line anew if it is old enough."""
        now = self.due()
        if now is None:
            return
        if self._mark is None:
            self._mark = (now, state.step)
        began, step = self._mark
        if now - began >= SECONDS_OF_RATE or not self._rate:
            self._rate = (state.step - step) / (now - began) if now > began else 0.0
            self._mark = (now, state.step)
        blade = f"  blade {state.blade.length:.4g} D" if state.blade is not None else ""
        self.write(
            f"step {state.step:,}  time {state.time:g}{blade}"
            f"  nodes {state.n_vein_nodes:,}  sources {len(state.live):,}"
            f"  {self._rate:,.0f} steps/s"
        )
