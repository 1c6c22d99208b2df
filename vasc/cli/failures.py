"""What a user sees when something goes wrong: a line, and an exit code."""

import difflib
import errno
import functools
import os
import signal
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any, TextIO

import typer

from vasc.cli.printing import printable
from vasc.errors import ConfigError, VascError

BAD_INPUT = 2
FAILED_RUN = 3
NO_NAMES = (errno.ENAMETOOLONG, errno.ELOOP)
"""Errors of the system by which a name is none of a file."""


class InterruptedRunError(Exception):
    """Ctrl-C, under a name that the library that reads the command line leaves alone.

    Parameters
    ----------
    number : int
        The signal that came.
    """

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number


def interruptible(verb: Callable[..., None]) -> Callable[..., None]:
    """Let an interrupt of a verb reach the end of the program as one.

    Parameters
    ----------
    verb : callable
        The function of a verb.

    Returns
    -------
    callable
        The same, with the same signature.

    Raises
    ------
    InterruptedRunError
        If Ctrl-C is pressed.
    """

    @functools.wraps(verb)
    def called(*arguments: Any, **options: Any) -> None:
        try:
            verb(*arguments, **options)
        except KeyboardInterrupt as error:
            raise InterruptedRunError(getattr(error, "number", signal.SIGINT)) from error

    return called


def end_of(error: BaseException, *, with_traceback: bool, arguments: Sequence[str] = ()) -> int:
    """Write what went wrong to the terminal.

    Parameters
    ----------
    error : BaseException
        What ended a verb.
    with_traceback : bool
        Show where it came from, too.
    arguments : sequence of str
        The command line, to quote what is wrong in it.

    Returns
    -------
    int
        The exit code that belongs to it.
    """
    if isinstance(error, BrokenPipeError):
        # whoever reads the output has seen enough, as `head` does
        silence_output()
        return 0
    if isinstance(error, SystemExit):
        return error.code if isinstance(error.code, int) else FAILED_RUN
    if with_traceback:
        traceback.print_exception(error)
    lines, code = _described(error, arguments)
    for line in lines:
        complain(line)
    return code


def complain(line: str) -> None:
    """Write one line to the error output, whatever characters it holds."""
    with suppress(OSError, ValueError):
        encoding = getattr(sys.stderr, "encoding", None) or "utf-8"
        said = printable(line).encode(encoding, "backslashreplace").decode(encoding)
        sys.stderr.write(f"{said}\n")
        sys.stderr.flush()


def provide_outputs() -> None:
    """Let a program whose outputs were closed before it began write to nowhere."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115


def silence_output() -> None:
    """Let Python close an output nobody reads without a complaint."""
    with suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


@contextmanager
def without_lines_of_code() -> Iterator[None]:
    """Show warnings as one line each, without the code they came from."""

    def shown(
        message: Warning | str,
        category: type[Warning],
        filename: str,
        lineno: int,
        file: TextIO | None = None,
        line: str | None = None,
    ) -> None:
        complain(f"warning: {_one_line(str(message))}")

    before = warnings.showwarning
    warnings.showwarning = shown
    try:
        yield
    finally:
        warnings.showwarning = before


def _described(error: BaseException, arguments: Sequence[str]) -> tuple[list[str], int]:
    """Give the lines and the exit code of an error."""
    if isinstance(error, ConfigError):
        return error.problems, error.exit_code
    if isinstance(error, VascError):
        return [_one_line(str(error))], error.exit_code
    if isinstance(error, InterruptedRunError | KeyboardInterrupt | typer.Abort):
        return ["interrupted"], 128 + getattr(error, "number", signal.SIGINT)
    # usage errors of the library that reads the command line know how to say it
    say = getattr(error, "format_message", None)
    if say is not None:
        return [_usage(error, say(), arguments)], int(getattr(error, "exit_code", BAD_INPUT))
    if isinstance(error, MemoryError):
        return ["not enough memory for this"], FAILED_RUN
    if isinstance(error, OSError):
        from vasc.config.values import shortened

        where = f"{shortened(str(error.filename))}: " if error.filename else ""
        if error.errno in NO_NAMES:
            return [f"{where}is not the name of a file: {error.strerror}"], BAD_INPUT
        return [_one_line(f"{where}{error.strerror or error}")], FAILED_RUN
    name = type(error).__name__
    return [
        f"unexpected {name}: {_one_line(str(error)) or 'no message'}"
        " (once more with --debug shows where; please report it)"
    ], FAILED_RUN


def _usage(error: BaseException, message: str, arguments: Sequence[str]) -> str:
    """Describe a wrong command line."""
    from vasc.config.values import shortened

    context = getattr(error, "ctx", None)
    path = getattr(context, "command_path", "vasc")
    line = _one_line(message).rstrip(".")
    if given := _given(error, arguments):
        # some versions of the library quote the value in full, others not at all
        line = line.replace(given, shortened(given))
        line += "" if shortened(given) in line else f", but {shortened(given)} is given"
    command = getattr(context, "command", None)
    verbs = list(getattr(command, "commands", {}) or {})
    word = line.partition("'")[2].partition("'")[0]
    if "No such command" in line and verbs and "Did you mean" not in line:
        close = difflib.get_close_matches(word, verbs, n=1)
        line += f"; did you mean '{close[0]}'?" if close else f"; verbs: {', '.join(verbs)}"
    return f"{path}: {line} (`{path} --help` shows an example)"


def _given(error: BaseException, arguments: Sequence[str]) -> str:
    """Give what the command line has for the option that is wrong; empty if that is unknown."""
    names = getattr(getattr(error, "param", None), "opts", ())
    found = ""
    for word, following in zip(arguments, [*arguments[1:], ""], strict=True):
        name, _, value = word.partition("=")
        if name in names:
            found = following if name == word else value
    return _one_line(found)


def _one_line(text: str) -> str:
    """Put a text on one line."""
    return " ".join(text.split())
