"""The calls that change files, each of which may fail or do less than it was asked for."""

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TypeVar

from vasc.errors import OutputError

T = TypeVar("T")

BINARY: int = getattr(os, "O_BINARY", 0)
"""What Windows needs to be told."""


class MovedError(OutputError):
    """A file was moved, replaced or removed while it was written."""

    exit_code = 3

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"{path}: was moved, replaced or removed while the run wrote it; what was recorded is"
            " in the file that was moved"
        )


class System:
    """The calls of the operating system; tests put others in their place."""

    def write(self, handle: int, content: bytes | memoryview, offset: int) -> int:
        """Write at an offset; give the number of bytes that were written."""
        os.lseek(handle, offset, os.SEEK_SET)
        return os.write(handle, content)

    def truncate(self, handle: int, size: int) -> None:
        """Give a file a length."""
        os.ftruncate(handle, size)

    def sync(self, handle: int) -> None:
        """Bring a file to the disk."""
        os.fsync(handle)

    def remove(self, path: Path) -> None:
        """Remove a file."""
        path.unlink()


system = System()
"""What all writing of this package goes through."""


def write(handle: int, content: bytes | memoryview, offset: int) -> None:
    """Write all of it, however little the system takes at a time.

    Raises
    ------
    OSError
        If the system takes no more.
    """
    left = memoryview(content)
    while left:
        n_written = _patiently(partial(system.write, handle, left, offset))
        if n_written <= 0:
            raise OSError(f"only {len(content) - len(left)} of {len(content)} bytes were written")
        left, offset = left[n_written:], offset + n_written


def truncate(handle: int, size: int) -> None:
    """Give a file a length."""
    _patiently(partial(system.truncate, handle, size))


def sync(handle: int) -> None:
    """Bring a file to the disk."""
    _patiently(partial(system.sync, handle))


def remove(path: Path) -> None:
    """Remove a file."""
    _patiently(partial(system.remove, path))


def sync_folder(folder: Path) -> None:
    """Bring the names in a folder to the disk, where the system can."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:
        return
    try:
        sync(handle)
    except OSError:
        # some file systems refuse it for folders
        return
    finally:
        os.close(handle)


def is_named(handle: int, path: Path) -> bool:
    """Tell whether an open file still is the one of that name."""
    try:
        return os.path.samestat(os.fstat(handle), os.stat(path))
    except FileNotFoundError:
        return False


def read(handle: int, n_bytes: int, offset: int) -> bytes:
    """Read up to so many bytes from an offset on; fewer at the end of the file."""
    os.lseek(handle, offset, os.SEEK_SET)
    parts = []
    while n_bytes > 0 and (part := os.read(handle, n_bytes)):
        parts.append(part)
        n_bytes -= len(part)
    return parts[0] if len(parts) == 1 else b"".join(parts)


def _patiently(call: Callable[[], T]) -> T:
    """Repeat a call that a signal has ended before it did anything."""
    while True:
        try:
            return call()
        except InterruptedError:
            continue
