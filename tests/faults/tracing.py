"""The pager's own trace of what it does to files, and what is left when part of it is lost."""

import os
import random
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple
from unittest.mock import patch

from vasc.timeline import creation
from vasc.timeline.redo import disk


class Change(NamedTuple):
    """One call: what was done to which file; ``n_frames`` are acknowledged by then."""

    verb: str
    file: int
    place: int
    content: bytes
    n_frames: int


@dataclass
class Trace(disk.System):
    """Does what it is asked for, and notes it."""

    changes: list[Change] = field(default_factory=list)
    n_frames: int = 0
    main: int = -1
    """Inode of the file itself; every other one is that of a log."""

    def write(self, handle: int, content: bytes | memoryview, offset: int) -> int:
        n_bytes = super().write(handle, content, offset)
        self._note("write", handle, offset, bytes(content[:n_bytes]))
        return n_bytes

    def truncate(self, handle: int, size: int) -> None:
        super().truncate(handle, size)
        self._note("truncate", handle, size)

    def sync(self, handle: int) -> None:
        super().sync(handle)
        self._note("sync", handle)

    def remove(self, path: Path) -> None:
        inode = path.stat().st_ino
        super().remove(path)
        self.changes.append(Change("remove", inode, 0, b"", self.n_frames))

    def acknowledge(self, n_frames: int) -> None:
        self.n_frames = n_frames
        self.changes.append(Change("acknowledge", -1, 0, b"", n_frames))

    def publish(self, path: Path) -> None:
        self.main = path.stat().st_ino
        self.changes.append(Change("publish", self.main, 0, b"", 0))

    @property
    def first(self) -> int:
        """The change by which the file gets its name; 0 if it had one."""
        verbs = [change.verb for change in self.changes]
        return verbs.index("publish") + 1 if "publish" in verbs else 0

    def _note(self, verb: str, handle: int, place: int = 0, content: bytes = b"") -> None:
        inode = os.fstat(handle).st_ino
        self.changes.append(Change(verb, inode, place, content, self.n_frames))


@contextmanager
def traced(path: Path) -> Iterator[Trace]:
    """Trace what is done to a file and its log."""
    trace = Trace(main=path.stat().st_ino if path.exists() else -1)
    real = creation.publish

    def publish(ready, place, *, force):
        real(ready, place, force=force)
        trace.publish(place)

    with patch.object(disk, "system", trace), patch.object(creation, "publish", publish):
        yield trace


class Files:
    """The file and its log, as they are after some changes."""

    def __init__(self, main: int, before: bytes = b"") -> None:
        self._main = main
        self._file, self._log = bytearray(before), bytearray()

    def apply(self, change: Change) -> None:
        """Do a change once more."""
        content = self._file if change.file == self._main else self._log
        if change.verb == "write":
            end = change.place + len(change.content)
            content.extend(bytes(max(0, end - len(content))))
            content[change.place : end] = change.content
        elif change.verb == "truncate":
            content.extend(bytes(max(0, change.place - len(content))))
            del content[change.place :]
        elif change.verb == "remove":
            content.clear()

    def leave(self, path: Path) -> None:
        """Write both to the disk, as a process leaves them that ends here."""
        path.write_bytes(self._file)
        log = path.with_name(path.name + "-wal")
        log.unlink(missing_ok=True)
        if self._log:
            log.write_bytes(self._log)


def torn(change: Change, chance: random.Random) -> Change:
    """Give a write of which only a part was done."""
    return change._replace(content=change.content[: chance.randrange(len(change.content))])


def without_unsynced(changes: list[Change], chance: random.Random) -> list[Change]:
    """Give what a loss of power leaves: a change that was not synced is lost by half a chance."""
    synced = dict.fromkeys({change.file for change in changes}, -1)
    for number, change in enumerate(changes):
        if change.verb == "sync":
            synced[change.file] = number
    return [
        change
        for number, change in enumerate(changes)
        if number < synced[change.file]
        or change.verb in ("sync", "publish", "acknowledge")
        or chance.random() < 0.5
    ]


def promised(changes: list[Change]) -> int:
    """Give the frames that a loss of power may not take: acknowledged before the last sync."""
    last = [c.n_frames for c in changes if c.verb == "sync"]
    return last[-1] if last else 0
