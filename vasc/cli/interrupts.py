"""Ctrl-C during a run, or the end of its terminal: the step is finished, what was made is kept."""

import os
import signal
import threading
from types import FrameType, TracebackType
from typing import Any, Self

SIGNALS = tuple(
    signal.Signals[name]
    for name in ("SIGINT", "SIGTERM", "SIGHUP")
    if name in signal.Signals.__members__
)


class StopAtOnceError(KeyboardInterrupt):
    """A second signal, which no step is waited for.

    Parameters
    ----------
    number : int
        The signal.
    """

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number


class Interrupts:
    """While this context lasts, a signal is a wish to stop; a second one stops at once.

    Attributes
    ----------
    number : int or None
        The signal that came, None if none did.
    """

    def __init__(self) -> None:
        self.number: int | None = None
        self._before: dict[signal.Signals, Any] = {}

    def __enter__(self) -> Self:
        # Python lets only the main thread ask for signals
        if threading.current_thread() is threading.main_thread():
            # what is ignored stays so: `nohup` asks for it
            wanted = [one for one in SIGNALS if signal.getsignal(one) != signal.SIG_IGN]
            self._before = {number: signal.signal(number, self._note) for number in wanted}
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def should_stop(self) -> bool:
        """Tell whether a signal came."""
        return self.number is not None

    @property
    def exit_code(self) -> int:
        """The exit code that says which signal it was."""
        return 0 if self.number is None else 128 + self.number

    def _note(self, number: int, frame: FrameType | None) -> None:
        """Note the first signal, give way to the second."""
        if self.number is not None:
            raise StopAtOnceError(number)
        self.number = number
        # not through sys.stderr, which may be in the middle of a line just now
        os.write(2, b"\nstopping after this step; once more stops at once\n")
