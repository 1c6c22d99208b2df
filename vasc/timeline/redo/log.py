"""The log beside a file: a header that says whose log it is, and a frame a commit.

Header: magic, pid, host, salt, identity of the file, checksum. Frame: magic, number of runs,
sequence number, sizes of the file before and after, bytes of all runs; offset and length of
every run; the runs; a checksum over all of it and the salt. All numbers are little-endian.
"""

import hashlib
import os
import platform
import secrets
import stat
import struct
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from vasc.errors import OutputError
from vasc.timeline.redo import disk, locks
from vasc.timeline.redo.pages import Run

SUFFIX = "-wal"
"""What the name of a log has more than that of its file."""
MAGIC = b"VASCWAL1"
FRAME_MAGIC = b"FRAM"
HEADER = struct.Struct("<8sQ64s8sQQ32s")
FRAME = struct.Struct("<4sIQQQQ")
RUN = struct.Struct("<QQ")
SUM = struct.Struct("<I")
HEADER_BYTES = HEADER.size + SUM.size
KEPT_BYTES = 8 << 20
"""Bytes of a log that are kept although the file holds them."""


class Identity(NamedTuple):
    """Bytes of a file that are its own and never change: where they are, and their digest."""

    offset: int
    n_bytes: int
    digest: bytes

    @classmethod
    def of(cls, handle: int, offset: int, n_bytes: int) -> "Identity":
        """Take note of the bytes of an open file."""
        content = disk.read(handle, n_bytes, offset)
        return cls(offset, n_bytes, hashlib.sha256(content).digest())

    def is_of(self, handle: int) -> bool:
        """Tell whether an open file has these bytes."""
        return self == Identity.of(handle, self.offset, min(self.n_bytes, 1 << 20))


class Frame(NamedTuple):
    """What one commit changes: the sizes of the file around it, and runs of bytes."""

    sequence: int
    before: int
    after: int
    runs: tuple[Run, ...]


def log_of(path: Path) -> Path:
    """Give the log of a file; a link to a file has that of the file."""
    place = path.resolve()
    return place.with_name(place.name + SUFFIX)


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

    def take_over(self, file: int) -> list[Frame]:
        """Read the frames that a killed writer left for a file, and go on after them."""
        header, frames, self.size = _read(self.handle, file)
        if header is not None and frames:
            self._salt, self._identity = header.salt, header.identity
            self._sequence = frames[-1].sequence
        return frames

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
                disk.system.remove(self.path)
        finally:
            os.close(self.handle)


class Header(NamedTuple):
    """Who writes a log, and of which file it is."""

    pid: int
    host: str
    salt: bytes
    identity: Identity


def read_header(handle: int) -> Header | None:
    """Read who writes a log; None if its header is not whole."""
    raw = disk.read(handle, HEADER_BYTES, 0)
    if len(raw) < HEADER_BYTES or raw[HEADER.size :] != SUM.pack(zlib.crc32(raw[: HEADER.size])):
        return None
    magic, pid, host, salt, *identity = HEADER.unpack_from(raw)
    if magic != MAGIC:
        return None
    return Header(pid, host.rstrip(b"\0").decode(errors="replace"), salt, Identity(*identity))


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


def frames_of(log: int, file: int) -> list[Frame]:
    """Read the whole frames of an open log, if it is that of an open file; else none."""
    return _read(log, file)[1]


def _read(log: int, file: int) -> tuple[Header | None, list[Frame], int]:
    """Read the header of a log, its frames for a file, and where the last of them ends."""
    header = read_header(log)
    if header is None or not header.identity.is_of(file):
        return None, [], 0
    raw = disk.read(log, os.fstat(log).st_size - HEADER_BYTES, HEADER_BYTES)
    frames, end = [], HEADER_BYTES
    for frame, stop in _frames(raw, zlib.crc32(header.salt)):
        frames.append(frame)
        end = HEADER_BYTES + stop
    sizes = [size for frame in frames for size in (frame.before, frame.after)]
    # an older or newer copy of the same file: these frames do not follow on what it holds
    if frames and not min(sizes) <= os.fstat(file).st_size <= max(sizes):
        return None, [], 0
    return header, frames, end


def _frames(raw: bytes, salted: int) -> Iterator[tuple[Frame, int]]:
    """Give the frames that are whole and follow one another, and where each ends."""
    start, view, last = 0, memoryview(raw), None
    while start + FRAME.size <= len(raw):
        magic, n_runs, sequence, before, after, n_bytes = FRAME.unpack_from(raw, start)
        first = start + FRAME.size + n_runs * RUN.size
        stop = first + n_bytes
        is_next = last is None or sequence == last + 1
        if magic != FRAME_MAGIC or not is_next or stop + SUM.size > len(raw):
            return
        if SUM.unpack_from(raw, stop)[0] != zlib.crc32(view[start:stop], salted):
            return
        runs = []
        for number in range(n_runs):
            offset, length = RUN.unpack_from(raw, start + FRAME.size + number * RUN.size)
            runs.append((offset, raw[first : first + length]))
            first += length
        last, start = sequence, stop + SUM.size
        yield Frame(sequence, before, after, tuple(runs)), start
