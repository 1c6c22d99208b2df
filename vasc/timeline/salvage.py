"""Killed runs whose files read well as far as they are committed, and cannot be continued.

HDF5 writes the pages of a flush one by one. A process killed in between may leave an
index that leads to pages which are not there yet, or beyond the end that the file states.
No committed row is reached that way, but no column can be cut or grow. What is
committed is then copied to a new file, which takes the place of the old one.
"""

import contextlib
import math
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from vasc.errors import TimelineError
from vasc.timeline import guard, layout
from vasc.timeline.access import OpenFile
from vasc.timeline.layout import MARKS, PROVENANCE, TEXTS, VERSION
from vasc.timeline.opening import find_places
from vasc.timeline.storage import Store, beside, publish, reason, stated_end

SLICE_BYTES = 4 << 20
"""About how much is copied at once."""


def mend(path: Path) -> str | None:
    """Make sure that a killed run's file can be continued, as a copy if need be.

    Parameters
    ----------
    path : Path
        A timeline, or what was taken for one. Nobody else can write it meanwhile.

    Returns
    -------
    str or None
        What was wrong with the file that was replaced; None if none was, be it that it
        can be continued or that its committed part cannot be read.

    Raises
    ------
    TimelineError
        If the file is being written by another run.
    OutputError
        If the copy cannot be written.
    """
    with guard.locked(path):
        try:
            old = OpenFile(path)
        except TimelineError:
            return None
        try:
            problem = None if old.found.version > VERSION else _problem(old)
            if problem is not None:
                _replace(old)
            return problem
        except (TimelineError, *guard.TRANSIENT):
            # its committed part cannot be read; whoever opens it next says so
            return None
        finally:
            old.close()


def _problem(old: OpenFile) -> str | None:
    """Say why a column can be neither cut nor extended, None if all can."""
    end = stated_end(old.path)
    for name in (*old.found.growing_columns, PROVENANCE):
        dataset = guard.open_dataset(old.path, old.file, name)
        if dataset.chunks is None:
            continue
        ends = [0]
        try:
            dataset.id.chunk_iter(_noting(ends))
        except guard.TRANSIENT as error:
            return f"{name}: {reason(error)}"
        if end is not None and ends[0] > end:
            return f"{name}: rows lie beyond the end that the file states"
    return None


def _noting(ends: list[int]) -> Callable[..., None]:
    """Give a function that keeps the greatest end of the chunks that it is shown."""

    def note(chunk: Any) -> None:
        ends[0] = max(ends[0], chunk.byte_offset + chunk.size)

    return note


def _replace(old: OpenFile) -> None:
    """Put a copy of what is committed in the place of the file."""
    # a symbolic link stays one
    place = old.path.resolve()
    unready = beside(place)
    try:
        store = Store.create(unready)
        try:
            with store.writing():
                _copy(old, store)
                store.flush()
        finally:
            store.close()
        shutil.copymode(place, unready)
        _sync(unready)
        publish(unready, place, force=True)
        _sync(place.parent)
    finally:
        with contextlib.suppress(OSError):
            unready.unlink(missing_ok=True)


def _copy(old: OpenFile, store: Store) -> None:
    """Write what is committed in the old file into a new one."""
    path, file, found = old.path, old.file, old.found
    for group in ("/", *layout.groups(*found.form)):
        store.add_group_like(group, guard.open_item(path, file, group))
    for name in (*TEXTS, *layout.static_columns(found.dimensions, found.has_tissue), *MARKS):
        store.copy(name, guard.open_dataset(path, file, name))
    starts = find_places(path, file, found, old.read)
    for name, n_rows in found.committed_rows(starts).items():
        _copy_rows(old, store, name, n_rows)
    _copy_records(old, store)


def _copy_rows(old: OpenFile, store: Store, name: str, n_rows: int) -> None:
    """Copy the first rows of a growing column, whole chunks at a time."""
    dataset = guard.open_dataset(old.path, old.file, name)
    store.add_column_like(name, dataset)
    column = store.column(name)
    chunk_rows = dataset.chunks[0]
    chunk_bytes = dataset.dtype.itemsize * math.prod(dataset.chunks)
    size = chunk_rows * max(1, SLICE_BYTES // chunk_bytes)
    for start in range(0, n_rows, size):
        column.write(start, old.read(name, start, min(start + size, n_rows)))


def _copy_records(old: OpenFile, store: Store) -> None:
    """Copy the provenance records that can be read."""
    dataset = guard.open_dataset(old.path, old.file, PROVENANCE)
    store.add_column_like(PROVENANCE, dataset)
    column = store.column(PROVENANCE)
    for row in range(dataset.shape[0]):
        with contextlib.suppress(*guard.TRANSIENT):
            record = dataset[row : row + 1]
            if record[0]:
                column.write(column.n_rows, record)


def _sync(path: Path) -> None:
    """Bring a file or folder to the disk, where the system can."""
    with contextlib.suppress(OSError):
        handle = os.open(path, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
