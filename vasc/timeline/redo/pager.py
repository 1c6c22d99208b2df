"""A file that HDF5 writes in memory, and that reaches the disk commit by commit."""

import contextlib
import os
import time
from collections.abc import Iterable
from pathlib import Path

from vasc.errors import DiskError
from vasc.timeline.redo import disk, locks
from vasc.timeline.redo.contents import Identity, log_of
from vasc.timeline.redo.disk import BINARY
from vasc.timeline.redo.durability import BATCH_COMMITS, BATCH_SECONDS, Durability
from vasc.timeline.redo.log import Log
from vasc.timeline.redo.pages import Pages, Run
from vasc.timeline.redo.view import View

MOST_LOG_BYTES = 64 << 20
"""Bytes of a log at which it is applied even while others read the file under a lock."""
PATIENCE = 1.0
"""Seconds to wait at the end for those who read the file under a lock."""


class Pager(View):
    """A binary file for h5py, whose changes become part of the real one by :meth:`commit`.

    Without a log a commit is written to the file at once: for one that nobody knows yet.

    Parameters
    ----------
    path : Path
        The file; it exists.
    is_logged : bool
        Keep a log.
    durability : Durability
        When commits are brought to the disk.

    Raises
    ------
    BusyError
        If another process writes the file.
    OutputError
        If its log is that of another file.
    OSError
        If it cannot be opened.
    """

    def __init__(
        self, path: Path, *, is_logged: bool = True, durability: Durability = Durability.BATCH
    ) -> None:
        self._is_durable = durability != Durability.PROCESS
        self._most_commits = 1 if durability != Durability.BATCH else BATCH_COMMITS
        self._log = Log(log_of(path)) if is_logged else None
        self._path = path
        try:
            self._file = os.open(path, os.O_RDWR | BINARY)
        except BaseException:
            self._let_go(remove=False)
            raise
        try:
            locks.hold(self._file)
            left = [] if self._log is None else self._log.take_over(self._file)
        except BaseException:
            os.close(self._file)
            self._let_go(remove=self._log is not None and not self._log.is_used)
            raise
        super().__init__(Pages(self._file))
        # runs since the last commit; those of commits that are not in the file yet
        self._fresh: list[Run] = []
        self._waiting: dict[tuple[int, int], bytes] = {}
        # runs that are not in the pages: what is written is seldom read before it is applied
        self._unseen: list[Run] = []
        self._n_waiting = 0
        self._oldest = 0.0
        self._is_released = self._is_broken = False
        self._has_log = False
        self._committed_size = self._pages.size
        if self._log is not None:
            for frame in left:
                self._pages.write_runs(frame.runs)
                self._pages.size = self._committed_size = frame.after
                self._await(frame.runs)
            self._has_log = self._n_waiting > 0 or not self._log.is_used

    # what h5py calls

    def writable(self) -> bool:
        """Say that it can be written."""
        return True

    def write(self, content: memoryview) -> int:  # type: ignore[override]
        """Write to memory."""
        run = (self._position, bytes(content))
        self._fresh.append(run)
        self._unseen.append(run)
        self._position += len(run[1])
        self._pages.size = max(self._pages.size, self._position)
        return len(run[1])

    def readinto(self, target: memoryview) -> int:  # type: ignore[override]
        """Fill a buffer from the position on."""
        self._see()
        return super().readinto(target)

    def truncate(self, size: int | None = None) -> int:
        """Give the file in memory a length."""
        size = self._position if size is None else size
        if size < self._pages.size:
            self._see()
        self._pages.truncate(size)
        return size

    def flush(self) -> None:
        """Do nothing: what HDF5 flushes counts once it is committed."""

    # what vasc calls

    def identify(self, offset: int, n_bytes: int) -> None:
        """Make the log that of this file, by bytes of it that never change.

        Raises
        ------
        OSError
            If the log cannot be written.
        """
        if self._log is None:
            return
        if self._n_waiting:
            # frames of a killed run: they go to the file first, whoever reads it
            self._apply(force=True)
        self._has_log = True
        self._log.begin(Identity.of(self._file, offset, n_bytes), durable=self._is_durable)

    def commit(self) -> None:
        """Let everything that was written be part of the file, whatever happens from now on.

        Raises
        ------
        OSError
            If it cannot be; nothing can be committed any more then.
        """
        if self._is_broken:
            raise OSError("an earlier write has failed")
        runs, self._fresh = _joined(self._fresh), []
        size = self._pages.size
        if not runs and size == self._committed_size:
            return
        self._is_broken = True
        if self._log is not None:
            self._log.append(self._committed_size, size, runs)
        self._committed_size = size
        now = time.monotonic()
        if not self._n_waiting:
            self._oldest = now
        self._await(runs)
        if (
            self._log is None
            or self._n_waiting >= self._most_commits
            or now - self._oldest >= BATCH_SECONDS
        ):
            self._apply(force=self._log is None or self._log.size > MOST_LOG_BYTES)
        self._is_broken = False

    def release(self) -> None:
        """Bring the file to its last commit, remove the log, and close both.

        Raises
        ------
        OSError
            If the file cannot be written; the log then holds what it lacks.
        """
        if self._is_released:
            return
        self._is_released = True
        is_whole = False
        try:
            if self._n_waiting:
                self._apply_at_last()
            is_whole = True
        finally:
            self._pages.forget()
            os.close(self._file)
            self._let_go(remove=is_whole and self._has_log)

    def abandon(self) -> None:
        """Close the file and its log as they are on the disk."""
        if not self._is_released:
            self._is_released = True
            os.close(self._file)
            self._let_go(remove=self._log is not None and not self._log.is_used)

    def _await(self, runs: Iterable[Run]) -> None:
        """Keep what a commit changes for the file; HDF5 writes some places at every commit."""
        for offset, content in runs:
            place = (offset, len(content))
            # behind all others, as those in between may overlap it
            self._waiting.pop(place, None)
            self._waiting[place] = content
        self._n_waiting += 1

    def _apply_at_last(self) -> None:
        """Apply all commits, after a while also under the eyes of those who read."""
        until = time.monotonic() + PATIENCE
        while not self._apply(force=time.monotonic() >= until):
            time.sleep(0.01)

    def _apply(self, *, force: bool) -> bool:
        """Write all commits to the file, if nobody reads it under a lock, or by force."""
        try:
            locks.lock(self._file)
        except locks.BusyError:
            if not force:
                if self._is_durable and self._log is not None:
                    self._log.sync()
                return False
        try:
            if self._is_durable and self._log is not None:
                self._log.sync()
            for (offset, _), content in self._waiting.items():
                disk.write(self._file, content, offset)
            if os.fstat(self._file).st_size != self._committed_size:
                disk.truncate(self._file, self._committed_size)
            if self._is_durable:
                disk.sync(self._file)
            if self._log is not None and self._log.size:
                self._log.clear(durable=self._is_durable)
        finally:
            locks.unlock(self._file)
        self._waiting, self._n_waiting = {}, 0
        if not self._fresh:
            self._pages.forget()
            self._unseen = []
        if self._log is not None and not disk.is_named(self._file, self._path):
            raise disk.MovedError(self._path)
        return True

    def _see(self) -> None:
        """Bring what was written to the pages, where it is read."""
        if self._unseen:
            self._pages.write_runs(self._unseen)
            self._unseen = []

    def _let_go(self, *, remove: bool) -> None:
        """Close the log."""
        if self._log is not None:
            log, self._log = self._log, None
            with contextlib.suppress(FileNotFoundError):
                log.close(remove=remove)


def settle(path: Path) -> None:
    """Bring a file to what a killed run left in its log; do nothing if a run still writes it.

    Raises
    ------
    DiskError
        If the file cannot be written.
    """
    if not log_of(path).exists():
        return
    try:
        pager = Pager(path)
        pager.release()
    except locks.BusyError:
        return
    except OSError as error:
        raise DiskError(f"{path}: its log cannot be replayed: {error.strerror or error}") from error


def _joined(runs: list[Run]) -> list[Run]:
    """Put runs that follow one another without a gap together, keeping their order."""
    joined: list[Run] = []
    parts: list[bytes] = []
    first = stop = 0
    for offset, content in runs:
        if parts and offset == stop:
            parts.append(content)
        else:
            if parts:
                joined.append((first, b"".join(parts)))
            first, parts = offset, [content]
        stop = offset + len(content)
    if parts:
        joined.append((first, b"".join(parts)))
    return joined
