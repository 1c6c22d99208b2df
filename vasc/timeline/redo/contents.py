"""What stands in a log: a header that says whose log it is, and a frame a commit.

Header: magic, pid, host, salt, identity of the file, checksum. Frame: magic, number of runs,
sequence number, sizes of the file before and after, bytes of all runs; offset and length of
every run; the runs; a checksum over all of it and the salt. All numbers are little-endian.

A frame that is not whole ends what can be read: a killed writer leaves such a tail. Whole
frames behind it tell that the log is damaged.
"""

import hashlib
import os
import struct
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from vasc.timeline.redo import disk
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
    place = path.resolve() if path.is_symlink() else path
    return place.with_name(place.name + SUFFIX)


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


class Contents(NamedTuple):
    """What a log holds for a file.

    Parameters
    ----------
    header : Header or None
        Whose log it is; None if no frame of it can be used.
    frames : list of Frame
        What follows on the file, or is in it already.
    end : int
        Where the last of them ends.
    problem : str
        What is wrong with the log, beyond a tail that is not whole; empty if nothing is.
    is_strange : bool
        Whether it holds frames that do not belong to the file as it is.
    """

    header: Header | None = None
    frames: Sequence[Frame] = ()
    end: int = 0
    problem: str = ""
    is_strange: bool = False


def contents_of(log: int, file: int | None) -> Contents:
    """Read an open log as that of an open file; None stands for one that is gone."""
    header, n_bytes = read_header(log), os.fstat(log).st_size
    if header is None:
        is_lost = n_bytes > HEADER_BYTES and any(disk.read(log, HEADER_BYTES, 0))
        return Contents(problem="its header is damaged: nothing in it can be read" * is_lost)
    raw = disk.read(log, n_bytes - HEADER_BYTES, HEADER_BYTES)
    salted = zlib.crc32(header.salt)
    read = list(_frames(raw, salted))
    frames, end = [frame for frame, _ in read], read[-1][1] if read else 0
    if file is None or not header.identity.is_of(file):
        whose = "a file that is gone" if file is None else "another file"
        problem = f"is the log of {whose}, and holds {_commits(len(frames))} of it"
        return Contents(problem=problem, is_strange=True) if frames else Contents()
    size = os.fstat(file).st_size
    behind = _behind(raw, end, salted, frames)
    n_lost, problem = _n_lost(file, behind), ""
    if n_lost:
        problem = f"is damaged: {_commits(n_lost)} behind the damage cannot be used"
    sizes = [size for frame in frames for size in (frame.before, frame.after)]
    if frames and size < min(sizes):
        problem = "goes on from a later state of the file: this is an older copy of it"
        return Contents(problem=problem, is_strange=True)
    if n_lost < len(behind) or (frames and size > max(sizes)):
        # the file is further than what can be read: damage or a loss of power took the rest
        return Contents(problem=problem)
    return Contents(header, frames, HEADER_BYTES + end, problem)


def _n_lost(file: int, behind: Sequence[Frame]) -> int:
    """Count the last frames that an open file does not hold already."""
    for count, frame in enumerate(reversed(behind)):
        if all(disk.read(file, len(run), offset) == run for offset, run in frame.runs):
            return count
    return len(behind)


def _commits(count: int) -> str:
    """Write a number of commits."""
    return "1 commit" if count == 1 else f"{count:,} commits"


def _behind(raw: bytes, end: int, salted: int, frames: Sequence[Frame]) -> list[Frame]:
    """Give whole frames of the same log behind bytes that are none."""
    last = frames[-1].sequence if frames else 0
    at = raw.find(FRAME_MAGIC, end + 1)
    while at >= 0:
        found = [frame for frame, _ in _frames(raw, salted, at)]
        if found and found[0].sequence > last:
            return found
        at = raw.find(FRAME_MAGIC, at + 1)
    return []


def _frames(raw: bytes, salted: int, start: int = 0) -> Iterator[tuple[Frame, int]]:
    """Give the frames that are whole and follow one another, and where each ends."""
    view, last = memoryview(raw), None
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
