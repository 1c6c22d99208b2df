"""Who may write a file: one process, which holds the lock of its log; readers share the file's."""

import contextlib
import os
import stat
import struct
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from vasc.timeline.redo.disk import BINARY

if sys.platform != "win32":
    import fcntl


WRITERS_PLACE = 1 << 62
"""A byte that no file has: the writer of a file locks it, under whatever name it opened it."""
LOG_FLAGS: int = BINARY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
"""A log is a file of its own: no link is followed, and no pipe waited for."""


class BusyError(Exception):
    """Somebody else holds a lock."""


def lock(handle: int, *, shared: bool = False) -> None:
    """Lock an open file, without waiting; on a system without locks, do nothing.

    Raises
    ------
    BusyError
        If another has locked it.
    """
    if sys.platform == "win32":
        return
    try:
        fcntl.flock(handle, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise BusyError from error
    except OSError:
        # a file system without locks
        return


def unlock(handle: int) -> None:
    """Give a lock back."""
    if sys.platform != "win32":
        with contextlib.suppress(OSError):
            fcntl.flock(handle, fcntl.LOCK_UN)


def hold(handle: int) -> None:
    """Lock an open file against other writers until it is closed; readers do not notice.

    Raises
    ------
    BusyError
        If another writes it.
    """
    command = getattr(fcntl, "F_OFD_SETLK", None) if sys.platform == "linux" else None
    if command is None:
        return
    place = struct.pack("@hhqqi0q", fcntl.F_WRLCK, os.SEEK_SET, WRITERS_PLACE, 1, 0)
    try:
        fcntl.fcntl(handle, command, place)
    except (BlockingIOError, PermissionError) as error:
        raise BusyError from error
    except OSError:
        # a file system without such locks
        return


def is_plain(handle: int) -> bool:
    """Tell whether an open file is one with content, no folder or pipe."""
    return stat.S_ISREG(os.fstat(handle).st_mode)


@contextlib.contextmanager
def sharing(handle: int, patience: float) -> Iterator[None]:
    """Hold the lock of a reader, if it can be had within some seconds."""
    is_locked = False
    until = time.monotonic() + patience
    while not is_locked:
        try:
            lock(handle, shared=True)
            is_locked = True
        except BusyError:
            if time.monotonic() > until:
                break
            time.sleep(0.002)
    try:
        yield
    finally:
        if is_locked:
            unlock(handle)


def open_locked(path: Path) -> int:
    """Open a log, made if there is none, as the only one who writes it.

    Raises
    ------
    BusyError
        If another holds it.
    OSError
        If it cannot be opened.
    """
    while True:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | LOG_FLAGS, 0o666)
        try:
            lock(handle)
            # whoever held it before may have removed it, and another made a new one
            if os.path.samestat(os.fstat(handle), os.stat(path)):
                return handle
        except FileNotFoundError:
            pass
        except BaseException:
            os.close(handle)
            raise
        os.close(handle)


def is_being_written(path: Path, log: Path) -> bool:
    """Tell whether a run, or another program, holds a file to write it."""
    return _is_held(log, patience=0.0) or _is_held(path, patience=0.2)


def _is_held(path: Path, patience: float) -> bool:
    """Tell whether another has locked a file for itself, and longer than to apply a commit."""
    try:
        handle = os.open(path, os.O_RDONLY | LOG_FLAGS)
    except OSError:
        return False
    try:
        until = time.monotonic() + patience
        while True:
            try:
                lock(handle, shared=True)
            except BusyError:
                if time.monotonic() >= until:
                    return True
                time.sleep(0.01)
            else:
                return False
    finally:
        os.close(handle)
