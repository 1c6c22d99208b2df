"""The errors vasc raises on purpose: each names a thing, its value and what is allowed."""

import errno
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


class VascError(Exception):
    """Base of all errors a user can cause or meet; ``exit_code`` is the program's."""

    exit_code = 2


class ConfigError(VascError):
    """A config is wrong: an unknown key, a bad value, a missing file."""

    def __init__(self, problems: str | list[str]) -> None:
        self.problems = [problems] if isinstance(problems, str) else list(problems)
        super().__init__("\n".join(self.problems))


class OutlineError(VascError):
    """A blade outline cannot be used; the message names the place."""


class TimelineError(VascError):
    """A file is not a timeline, is damaged, or holds what this version cannot read."""


class NetworkError(VascError):
    """A file of a real vein network cannot be read; the message names the row."""


class OutputError(VascError):
    """A file cannot be written: it exists, or its folder does not."""


class DiskError(OutputError):
    """The disk does not take what is written; what was written before is kept."""

    exit_code = 3


class ShapeError(VascError):
    """An array has the wrong shape or dtype for the door it came through."""


class RunError(VascError):
    """A run could not go on; what was recorded so far is kept."""

    exit_code = 3


DISK_FAULTS = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO})
"""Errors of the system that are the disk's, whatever was asked for."""


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Tell an error of the system by the name of what is written, not by that of a part of it.

    Raises
    ------
    DiskError
        If the disk is full or fails.
    OutputError
        If the system refuses for another reason.
    """
    try:
        yield
    except OSError as error:
        kind = DiskError if error.errno in DISK_FAULTS else OutputError
        raise kind(f"{path}: cannot be written: {error.strerror or error}") from error
