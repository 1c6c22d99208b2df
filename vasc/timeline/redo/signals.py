"""A commit is not interrupted: what a signal asks for is done after it."""

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from types import FrameType

NUMBERS = tuple(
    signal.Signals[name]
    for name in ("SIGINT", "SIGTERM", "SIGHUP")
    if name in signal.Signals.__members__
)
"""Signals that end a program, where the system has them."""


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """Put off the handlers of signals that end a program; HDF5 knows no halves of a call."""
    # Python lets only the main thread ask for signals, and runs their handlers there
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[tuple[int, FrameType | None]] = []
    before: dict[int, Callable[[int, FrameType | None], object]] = {}
    for number in NUMBERS:
        handler = signal.getsignal(number)
        if callable(handler):
            before[number] = handler
            signal.signal(number, lambda *arrived: came.append(arrived))
    try:
        yield
    finally:
        for one, handler in before.items():
            signal.signal(one, handler)
        for one, frame in came:
            before[one](one, frame)
