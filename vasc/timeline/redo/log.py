"""The log beside a file, as its one writer holds it; what stands in it is in ``contents``."""

import contextlib
import os
import platform
import secrets
import stat
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path

from vasc.errors import OutputError
from vasc.timeline.redo import disk, locks
from vasc.timeline.redo.contents import (
    FRAME,
    FRAME_MAGIC,
    HEADER,
    HEADER_BYTES,
    MAGIC,
    RUN,
    SUM,
    Contents,
    Frame,
    Identity,
    contents_of,
    log_of,
    read_header,
)
from vasc.timeline.redo.pages import Run

KEPT_BYTES = 8 << 20
"""Bytes of a log that are kept although the file holds them."""


class Log:
    """An open log, held by its one writer.

    Parameters
    ----------
    path : Path
        The log; made if there is none.

    Attributes
    ----------
    size : int
        Bytes up to the end of the last whole frame.
    is_used : bool
        Whether anything was ever written to it.

    Raises
    ------
    BusyError
        If another process writes it.
    OutputError
        If what is there is no log.
    OSError
        If it cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        refuse_foreign(path)
        self.handle = locks.open_locked(path)
        self.size = 0
        self.is_used = os.fstat(self.handle).st_size > 0
        self._salt = b""
        self._sequence = 0
        self._identity = Identity(0, 0, bytes(32))

    def take_over(self, file: int) -> Sequence[Frame]:
        """Read the frames that a killed writer left for a file, and go on after them.

        Raises
        ------
        OutputError
            If there are frames that do not belong to the file.
        """
        found = contents_of(self.handle, file)
        if found.is_strange:
            raise OutputError(_strange(self.path, found))
        if found.header is not None and found.frames:
            self._salt, self._identity = found.header.salt, found.header.identity
            self._sequence, self.size = found.frames[-1].sequence, found.end
        return found.frames

    def begin(self, identity: Identity, *, durable: bool) -> None:
        """Start anew, as the log of a file."""
        self._identity, self.is_used = identity, True
        disk.truncate(self.handle, 0)
        self._write_header()
        if durable:
            disk.sync(self.handle)
            disk.sync_folder(self.path.parent)

    def append(self, before: int, after: int, runs: Sequence[Run]) -> None:
        """Append a frame; one that does not fit is taken away again.

        Raises
        ------
        OSError
            If it cannot be written.
        """
        sequence = self._sequence + 1
        n_bytes = sum(len(content) for _, content in runs)
        parts = [FRAME.pack(FRAME_MAGIC, len(runs), sequence, before, after, n_bytes)]
        parts += [RUN.pack(offset, len(content)) for offset, content in runs]
        parts += [content for _, content in runs]
        frame = b"".join(parts)
        frame += SUM.pack(zlib.crc32(frame, zlib.crc32(self._salt)))
        try:
            disk.write(self.handle, frame, self.size)
        except BaseException:
            disk.truncate(self.handle, self.size)
            raise
        self._sequence, self.size = sequence, self.size + len(frame)

    def sync(self) -> None:
        """Bring the log to the disk."""
        disk.sync(self.handle)

    def clear(self, *, durable: bool) -> None:
        """Let go of the frames, which the file holds: once they are many, or at once.

        A loss of power may undo this and still keep frames that are written over old ones;
        what is left of the old ones would take the file back. So a log that is to outlive it
        grows for a while, and is then begun anew on the disk.
        """
        if durable and self.size <= KEPT_BYTES:
            return
        if self.size > KEPT_BYTES:
            disk.truncate(self.handle, HEADER_BYTES)
        self._write_header()
        if durable:
            disk.sync(self.handle)

    def _write_header(self) -> None:
        """Say who writes the log from now on, and of which file it is."""
        self._salt, self._sequence, self.size = secrets.token_bytes(8), 0, HEADER_BYTES
        host = platform.node().encode()[:64]
        head = HEADER.pack(MAGIC, os.getpid(), host, self._salt, *self._identity)
        disk.write(self.handle, head + SUM.pack(zlib.crc32(head)), 0)

    def close(self, *, remove: bool) -> None:
        """Let the log go."""
        try:
            if remove and disk.is_named(self.handle, self.path):
                disk.remove(self.path)
        finally:
            os.close(self.handle)


def refuse_foreign(path: Path) -> None:
    """Refuse to write a log where something else is.

    Raises
    ------
    OutputError
        If there is a file that no log begins like, a link, a folder or a pipe.
    """
    try:
        kind = os.lstat(path).st_mode
        begin = _first_bytes(path) if stat.S_ISREG(kind) else b"another kind"
    except FileNotFoundError:
        return
    except OSError as error:
        raise OutputError(f"{path}: is no place for a log: {error.strerror or error}") from error
    # a process may have been killed as it wrote the beginning
    if begin.rstrip(b"\0") and not MAGIC.startswith(begin):
        raise OutputError(
            f"{path}: is no log of vasc, and a log would be written there; move it away"
        )


def _first_bytes(path: Path) -> bytes:
    """Read as many bytes as tell a log."""
    with path.open("rb") as file:
        return file.read(len(MAGIC))


def writer_of(path: Path) -> str:
    """Say who writes a log, as far as it tells."""
    try:
        handle = os.open(path, os.O_RDONLY | locks.LOG_FLAGS)
    except OSError:
        return "another run"
    try:
        header = read_header(handle) if locks.is_plain(handle) else None
    finally:
        os.close(handle)
    if header is None:
        return "another run"
    return f"another run (process {header.pid} on {header.host})"


def problem_of(path: Path) -> str:
    """Say what is wrong with the log of a file; nothing if nothing is, or there is none."""
    with _opened(path) as found:
        return f"{log_of(path)}: {found.problem}" if found.problem else ""


def refuse_strange(path: Path) -> None:
    """Refuse to begin the log of a file where another one holds commits.

    Raises
    ------
    OutputError
        If one does.
    """
    with _opened(path) as found:
        if found.is_strange:
            hint = "" if path.exists() else ", or use --force to begin anew"
            raise OutputError(_strange(log_of(path), found) + hint)


def _strange(log: Path, found: Contents) -> str:
    """Say that a log does not belong to its file, and what to do."""
    return f"{log}: {found.problem}; move it away, or give back the file that it belongs to"


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[Contents]:
    """Read the log of a file, where there is one; neither need exist."""
    with contextlib.ExitStack() as handles:
        log = _handle(log_of(path), handles)
        if log is None or not locks.is_plain(log):
            is_there = os.path.lexists(log_of(path))
            yield Contents(problem="cannot be read, or is no file" if is_there else "")
        else:
            yield contents_of(log, _handle(path, handles))


def _handle(path: Path, handles: contextlib.ExitStack) -> int | None:
    """Open a file to read it; None if that cannot be done."""
    try:
        handle = os.open(path, os.O_RDONLY | locks.LOG_FLAGS)
    except OSError:
        return None
    handles.callback(os.close, handle)
    return handle
