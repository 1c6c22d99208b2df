"""How a command must end on what it cannot use: soon, in little memory, by one clear line."""

import io
import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from types import FrameType

from vasc.cli import main

SECONDS = 60
"""That a single case may take at most; only what never ends takes so long."""

N_BYTES = 3 << 30
"""Of memory that a single case may ask for, beyond what the tests hold already."""

LONGEST_LINE = 600
"""Characters of a line that somebody has to read."""


class EndlessError(BaseException):
    """A case that took too long; nothing in vasc catches it by its class."""


@contextmanager
def bounded() -> Iterator[None]:
    """Let a case take neither much time nor much memory."""

    def give_up(number: int, frame: FrameType | None) -> None:
        raise EndlessError(f"not at its end after {SECONDS} s")

    before = signal.signal(signal.SIGALRM, give_up)
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    with open("/proc/self/statm") as file:
        held = int(file.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (held + N_BYTES, hard))
    signal.setitimer(signal.ITIMER_REAL, SECONDS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def ending(*arguments: object) -> tuple[int, list[str], str]:
    """Run the program; give its exit code, the lines of its error output, and its output."""
    said, complained = io.StringIO(), io.StringIO()
    with bounded(), redirect_stdout(said), redirect_stderr(complained):
        code = main([str(argument) for argument in arguments])
    return code, complained.getvalue().splitlines(), said.getvalue()


def assert_clear(lines: list[str]) -> None:
    """Make sure that lines can be read by people and name no inner part of the program."""
    assert lines
    for line in lines:
        assert line.isprintable(), line
        assert len(line) <= LONGEST_LINE, line
        assert "Traceback" not in line
        assert "unexpected" not in line.split(":")[0], line


def refused(*arguments: object) -> list[str]:
    """Run the program on what it must refuse; give the lines it says."""
    code, lines, said = ending(*arguments)
    assert (code, said) == (2, ""), (code, lines)
    assert_clear(lines)
    return lines
