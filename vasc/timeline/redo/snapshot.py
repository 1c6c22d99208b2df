"""A file as its last commit left it, for those who only read: the log laid over it in memory."""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Self

from vasc.timeline.redo import locks
from vasc.timeline.redo.contents import contents_of, log_of
from vasc.timeline.redo.disk import BINARY
from vasc.timeline.redo.pages import Pages
from vasc.timeline.redo.view import View

PATIENCE = 0.5
"""Seconds to wait for a writer that is applying commits."""


class Snapshot(View):
    """A binary file for h5py that is only read; made by :meth:`of`.

    Parameters
    ----------
    handle : int
        The open file on the disk; closed with this one.
    pages : Pages
        What the log lays over it.
    """

    def __init__(self, handle: int, pages: Pages) -> None:
        super().__init__(pages)
        self._handle = handle

    @classmethod
    def of(cls, path: Path) -> Self | None:
        """Give a file with what waits in its log; None if it has no log.

        Raises
        ------
        OSError
            If the file cannot be read.
        """
        try:
            log = os.open(log_of(path), os.O_RDONLY | locks.LOG_FLAGS)
        except OSError:
            return None
        if not locks.is_plain(log):
            os.close(log)
            return None
        try:
            handle = os.open(path, os.O_RDONLY | BINARY)
        except BaseException:
            os.close(log)
            raise
        try:
            with locks.sharing(handle, PATIENCE):
                pages = Pages(handle)
                for frame in contents_of(log, handle).frames:
                    pages.write_runs(frame.runs)
                    pages.size = frame.after
        except BaseException:
            os.close(handle)
            raise
        finally:
            os.close(log)
        return cls(handle, pages)

    def close(self) -> None:
        """Close the file; closing twice is fine."""
        if not self.closed:
            os.close(self._handle)
        super().close()


@contextlib.contextmanager
def steady(path: Path) -> Iterator[None]:
    """Keep a writer from applying commits to a file, if it has no log that is too long."""
    try:
        handle = os.open(path, os.O_RDONLY | BINARY)
    except OSError:
        yield
        return
    try:
        with locks.sharing(handle, PATIENCE):
            yield
    finally:
        os.close(handle)
