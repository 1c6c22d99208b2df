"""Checksums of what a session has recorded: they tell damage from what merely looks odd."""

import math
import re
import zlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from vasc.errors import TimelineError
from vasc.timeline import guard, layout
from vasc.timeline.layout import TABLES, TEXTS, count_column
from vasc.timeline.opening import Found, read_records
from vasc.timeline.provenance import sessions
from vasc.timeline.storage import reason

SLICE_BYTES = 4 << 20
"""About how much is read at once."""
ATTRIBUTES = "attributes"
"""Under which name the attributes of the file and of its units are summed."""

HEXADECIMAL = re.compile(r"[0-9a-f]{8}")

Read = Callable[[str, int, int], NDArray]
"""Reads rows of a growing column, from one row to another."""


def of_rows(rows: NDArray, before: int = 0) -> int:
    """Give the CRC-32 of rows that follow on others."""
    return zlib.crc32(np.ascontiguousarray(rows).view(np.uint8).reshape(-1).data, before)


def of_value(value: Any, before: int = 0) -> int:
    """Give the CRC-32 of an array or of a single value."""
    return of_rows(np.atleast_1d(np.asarray(value)), before)


def of_columns(found: Found, starts: Mapping[str, NDArray[np.int64]], read: Read) -> dict[str, int]:
    """Give the CRC-32 of the committed rows of every growing column."""
    sums = {}
    for name, n_rows in found.committed_rows(starts).items():
        column = found.growing_columns[name]
        row_bytes = np.dtype(column.dtype).itemsize * math.prod(column.shape)
        size, total = max(1, SLICE_BYTES // max(1, row_bytes)), 0
        for first in range(0, n_rows, size):
            total = of_rows(read(name, first, min(first + size, n_rows)), total)
        sums[name] = total
    return sums


def of_fixed(path: Path, file: h5py.File, found: Found) -> dict[str, int]:
    """Give the CRC-32 of everything that never changes: arrays, texts, attributes.

    Raises
    ------
    TimelineError
        If a part is missing.
    """
    sums = {}
    for name in (*TEXTS, *layout.static_columns(found.dimensions, found.has_tissue)):
        sums[name] = of_value(guard.open_dataset(path, file, name)[()])
    return sums | {ATTRIBUTES: of_header(path, file)}


def written(sums: Mapping[str, int]) -> dict[str, str]:
    """Give sums as a provenance record holds them."""
    return {name: f"{total:08x}" for name, total in sums.items()}


def noted(path: Path, file: h5py.File, found: Found) -> dict[str, tuple[int, int]]:
    """Give the rows and the CRC-32 of what the last session has noted; 0 rows of what has none.

    Empty where no session that came to its end has noted them, or steps were recorded since.
    Explicit positions and fields, which are read step by step, are left out.
    """
    known = [one for one in sessions(read_records(path, file)) if "checksums" in one]
    if not known or known[-1].get("last_step") != found.n_frames - 1:
        return {}
    n_rows = found.committed_rows({})
    sums = known[-1]["checksums"]
    return {
        name: (n_rows.get(name, 0), int(total, 16))
        for name, total in (sums.items() if isinstance(sums, Mapping) else ())
        if isinstance(total, str) and HEXADECIMAL.fullmatch(total)
    }


def of_header(path: Path, file: h5py.File) -> int:
    """Give the CRC-32 of the attributes of the file and of its units; others may add their own.

    Raises
    ------
    TimelineError
        If the units are missing.
    """
    total = 0
    for item, known in (
        (file, layout.HEADER),
        (guard.open_item(path, file, layout.UNITS), layout.UNIT_NAMES),
    ):
        for name in sorted(known & item.attrs.keys()):
            total = zlib.crc32(name.encode(), total)
            total = of_value(item.attrs[name], total)
    return total


def check_session(path: Path, file: h5py.File, found: Found) -> None:
    """Hold attributes and marks against what the sessions have noted.

    Raises
    ------
    TimelineError
        If they differ.
    """
    check_header(path, file, found)
    check_marks(path, file, found)


def check_header(path: Path, file: h5py.File, found: Found) -> None:
    """Hold the attributes of the file and of its units against what a session has noted.

    Those of a newer version are not all known here, and are not compared.

    Raises
    ------
    TimelineError
        If they differ.
    """
    if found.version > layout.VERSION:
        return
    for one in sessions(read_records(path, file))[::-1]:
        if isinstance(one.get("checksums"), Mapping):
            expected = one["checksums"].get(ATTRIBUTES)
            if expected is not None and expected != f"{of_header(path, file):08x}":
                raise not_as_recorded(path, ATTRIBUTES)
            return


def check_marks(path: Path, file: h5py.File, found: Found) -> None:
    """Hold the two marks, how many steps there are and whether the run ended, against provenance.

    Raises
    ------
    TimelineError
        If a session that came to its end has noted more steps, or of all steps that the run
        had not ended.
    """
    known = sessions(read_records(path, file))
    steps = [one["last_step"] for one in known if isinstance(one.get("last_step"), int)]
    if max(steps, default=-1) >= found.n_frames:
        raise not_as_recorded(path, layout.COMMITTED)
    last = known[-1] if known else {}
    is_noted = "ended" in last and last.get("last_step") == found.n_frames - 1
    # the mark is set after the record: a run may be killed between them, and is not complete
    if is_noted and found.is_complete and last.get("outcome") != "complete":
        raise not_as_recorded(path, layout.COMPLETE)


def damaged(
    path: Path,
    file: h5py.File,
    found: Found,
    starts: Mapping[str, NDArray[np.int64]],
    read: Read,
    known: Iterable[Mapping[str, Any]],
) -> list[str]:
    """Name what differs from what the last session that came to its end has noted.

    Parameters
    ----------
    path, file : Path, h5py.File
        The open file.
    found, starts : Found, mapping
        What is committed, and where steps begin in the columns of an explicit motion.
    read : callable
        Reads rows.
    known : iterable of mapping
        The sessions that the provenance tells of.

    Returns
    -------
    list of str
        Names of columns, arrays and texts; empty if nothing differs, or nothing was noted.
    """
    noted = [one for one in known if isinstance(one.get("checksums"), Mapping)]
    if not noted:
        return []
    expected, last_step = noted[-1]["checksums"], noted[-1].get("last_step")
    if not isinstance(last_step, int) or not -1 <= last_step < found.n_frames:
        return ["frames"]
    then, begun = _at(found, starts, last_step, read)
    sums = written(of_columns(then, begun, read) | of_fixed(path, file, found))
    return sorted(name for name in {*sums, *expected} if sums.get(name) != expected.get(name))


def _at(
    found: Found, starts: Mapping[str, NDArray[np.int64]], last_step: int, read: Read
) -> tuple[Found, dict[str, NDArray[np.int64]]]:
    """Give what was committed once a step was."""
    counts = found.counts
    if last_step + 1 < found.n_frames:
        counts = tuple(
            int(read(f"frames/{count_column(table)}", last_step, last_step + 1)[0])
            if last_step >= 0
            else 0
            for table in TABLES
        )
    begun = {name: rows[: last_step + 2] for name, rows in starts.items()}
    return replace(found, n_frames=last_step + 1, counts=counts), begun


def to_continue(
    path: Path, file: h5py.File, found: Found, starts: Mapping[str, NDArray[np.int64]]
) -> dict[str, int]:
    """Give the checksums of what is committed in a file, if that is what was recorded.

    Raises
    ------
    TimelineError
        If it is not.
    """

    def read(name: str, start: int, stop: int) -> NDArray:
        return file[name][start:stop]

    try:
        known = sessions(read_records(path, file))
        names = damaged(path, file, found, starts, read, known)
        if not names:
            return of_columns(found, starts, read)
    except guard.TRANSIENT as error:
        raise TimelineError(f"{path}: is damaged: {reason(error)}") from error
    raise not_as_recorded(path, names[0])


def not_as_recorded(path: Path, name: str) -> TimelineError:
    """Give the error for a part of a file that differs from its checksum."""
    return TimelineError(
        f"{path}: is damaged: {name} is not what was recorded; `vasc show --check` tells more"
    )
