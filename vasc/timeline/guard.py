"""Opening files that may be foreign, damaged, hostile or still being written.

HDF5 follows soft and external links, external raw files and virtual datasets
without asking, and allocates what a file declares. Here only names of the
layout are opened, component by component, and only plain data are accepted.
"""

import contextlib
import math
import os
import time
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from h5py import h5f

from vasc.arrays import Column
from vasc.errors import TimelineError
from vasc.timeline.layout import FIELDS, FORMAT, MOTION, VERSION
from vasc.timeline.redo import BusyError, Durability, Snapshot, log_of, steady, writer_of
from vasc.timeline.storage import Store, reason

SIGNATURE = b"\x89HDF\r\n\x1a\n"
PAUSES = (0.01, 0.02, 0.05, 0.1, 0.2)
"""Seconds to wait before each further attempt to read a file that is being written."""

TRANSIENT = (OSError, RuntimeError, KeyError, ValueError)
"""What HDF5 raises on a file caught in the middle of a write."""

ALLOWED_FILTERS = frozenset({1, 2, 3})
"""deflate, shuffle, fletcher32."""
MAX_BYTES = 4 << 30
"""The most that one dataset may declare, if it is one that is read whole."""
MAX_RATIO = 1000
"""The most that filters may have saved."""
SLACK = 1 << 20
"""Bytes that may be declared beyond what the file holds: chunks that are begun."""


def open_for_reading(path: Path) -> h5py.File:
    """Open a file, with what waits in its log, and keep no lock: no writer is ever disturbed.

    Raises
    ------
    TimelineError
        If the file cannot be opened; in one line, with the reason.
    """
    _check_signature(path)
    for pause in (*PAUSES, None):
        try:
            with steady(path):
                return _open(path)
        except TRANSIENT as error:
            if pause is None:
                raise TimelineError(f"{path}: {_explain(error)}") from error
        time.sleep(pause)
    raise AssertionError("unreachable")


def open_for_writing(path: Path, durability: Durability) -> Store:
    """Open a file to continue it; it is locked against other writers.

    Raises
    ------
    TimelineError
        If another run is writing the file, or it cannot be opened.
    """
    _check_signature(path)
    if _is_open_here(path):
        raise TimelineError(
            f"{path}: is open for reading in this process; close it before it is continued"
        )
    try:
        return Store.open(path, durability)
    except BusyError as error:
        raise TimelineError(f"{path}: is being written by {writer_of(log_of(path))}") from error
    except TRANSIENT as error:
        raise TimelineError(f"{path}: {_explain(error)}") from error


def _open(path: Path) -> h5py.File:
    """Open without a lock, as the log has it."""
    snapshot = Snapshot.of(path)
    if snapshot is not None:
        return h5py.File(snapshot, "r")
    try:
        return h5py.File(path, "r", locking=False)
    except OSError as error:
        # one process must open a file alike each time, and whoever uses h5py locks
        if "locking" not in str(error):
            raise
        return h5py.File(path, "r", locking="best-effort")


def _is_open_here(path: Path) -> bool:
    """Tell whether this process reads a file: HDF5 would show it as it was, also if opened anew."""
    for file in h5f.get_obj_ids(h5f.OBJ_ALL, h5f.OBJ_FILE):
        # a name of a file in memory is none
        with contextlib.suppress(OSError, ValueError):
            if path.samefile(os.fsdecode(h5f.get_name(file))):
                return True
    return False


def _check_signature(path: Path) -> None:
    """Refuse what is no file or no HDF5 file."""
    try:
        with path.open("rb") as file:
            head = file.read(len(SIGNATURE))
    except FileNotFoundError as error:
        raise TimelineError(f"{path}: no such file") from error
    except OSError as error:
        raise TimelineError(f"{path}: cannot be opened: {error.strerror}") from error
    if head != SIGNATURE:
        raise TimelineError(f"{path}: is not an HDF5 file, so it is no timeline")


def _explain(error: Exception) -> str:
    """Say in a few words why HDF5 could not open a file."""
    if "truncated" in str(error):
        return "is truncated: its end is missing"
    return f"cannot be opened: {reason(error)}"


def check_header(path: Path, file: h5py.File) -> tuple[int, int]:
    """Make sure a file is a timeline this version can read; its version is returned.

    Raises
    ------
    TimelineError
        If the file is no timeline, or its major version is another one.
    """
    if attribute(file, "format") != FORMAT:
        raise TimelineError(f"{path}: is an HDF5 file, but not a timeline (format {FORMAT!r})")
    text = str(attribute(file, "version"))
    major, dot, minor = text.partition(".")
    if not (dot and major.isdigit() and minor.isdigit()):
        raise TimelineError(f"{path}: version {text!r} is not of the form 'major.minor'")
    if int(major) != VERSION[0]:
        raise TimelineError(
            f"{path}: is a timeline of version {text}, this vasc reads {VERSION[0]}.x; "
            "use a version of vasc that is as new as the file"
        )
    return int(major), int(minor)


def attribute(item: h5py.HLObject, name: str) -> Any:
    """Give an attribute as a Python value or an array, None if it is missing."""
    if name not in item.attrs:
        return None
    value = item.attrs[name]
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    return value.item() if isinstance(value, np.generic) else value


def units(path: Path, group: h5py.Group) -> dict[str, str | float]:
    """Give what a length and a time mean.

    Raises
    ------
    TimelineError
        If a segment or a step is no number above 0 of its unit.
    """
    found = {name: attribute(group, name) for name in group.attrs if name != "meaning"}
    for name in ("segment", "step"):
        value = found.get(name, 1.0)
        if not isinstance(value, int | float) or not 0.0 < value < math.inf:
            raise TimelineError(f"{path}: units: {name} is {value!r}, must be a number above 0")
    return found


def names(item: h5py.HLObject, prefix: str = "") -> dict[int, str]:
    """Give the names of codes that an object's attributes declare; empty if none."""
    codes, words = attribute(item, f"{prefix}codes"), attribute(item, f"{prefix}names")
    if not isinstance(codes, np.ndarray) or not isinstance(words, np.ndarray):
        return {}
    return {
        int(code): word.decode(errors="replace")
        for code, word in zip(codes, words, strict=False)
        if isinstance(word, bytes)
    }


def open_item(path: Path, file: h5py.File, name: str) -> Any:
    """Open a group or dataset by its path in the file, following no link to elsewhere.

    Raises
    ------
    TimelineError
        If it is missing or reached by a link.
    """
    item: Any = file
    for part in name.strip("/").split("/") if name != "/" else ():
        if not isinstance(item, h5py.Group):
            raise TimelineError(f"{path}: {name}: a part of this name is not a group")
        link = item.get(part, getlink=True, default=None)
        if link is None:
            raise TimelineError(f"{path}: {name} is missing")
        if not isinstance(link, h5py.HardLink):
            raise TimelineError(f"{path}: {name}: {part!r} is a link to elsewhere; refused")
        item = item[part]
    return item


def open_dataset(path: Path, file: h5py.File, name: str) -> h5py.Dataset:
    """Open a dataset by its path in the file, if it holds plain data of a sane size.

    Raises
    ------
    TimelineError
        If the dataset is missing, is reached by a link or holds data elsewhere.
    """
    item = open_item(path, file, name)
    if not isinstance(item, h5py.Dataset):
        raise TimelineError(f"{path}: {name} is not a dataset")
    _check_plain(path, name, item)
    return item


def _check_plain(path: Path, name: str, dataset: h5py.Dataset) -> None:
    """Refuse data kept elsewhere, unknown filters, and more data than the file can hold."""
    creation = dataset.id.get_create_plist()
    if creation.get_external_count():
        raise TimelineError(f"{path}: {name} keeps its data in another file; refused")
    if dataset.is_virtual:
        raise TimelineError(f"{path}: {name} is a virtual dataset; refused")
    if dataset.dtype.kind not in "iufS":
        raise TimelineError(f"{path}: {name} has the unexpected type {dataset.dtype}; refused")
    filters = {creation.get_filter(i)[0] for i in range(creation.get_nfilters())}
    if not filters <= ALLOWED_FILTERS:
        unknown = sorted(filters - ALLOWED_FILTERS)
        raise TimelineError(f"{path}: {name} uses the unknown filters {unknown}; refused")
    if dataset.shape is None:
        raise TimelineError(f"{path}: {name} holds no value")
    declared = int(dataset.size or 0) * dataset.dtype.itemsize
    limit = _n_bytes(path) * (MAX_RATIO if filters else 1) + SLACK
    # explicit positions and fields are read step by step
    is_sliced = name.startswith((f"{MOTION}/", f"{FIELDS}/"))
    most = limit if is_sliced else min(limit, MAX_BYTES)
    if declared > most:
        raise TimelineError(f"{path}: {name} declares {declared} bytes, more than the file holds")


def _n_bytes(path: Path) -> int:
    """Give the bytes of a file and its log."""
    log = log_of(path)
    return os.path.getsize(path) + (os.path.getsize(log) if log.exists() else 0)


def check_column(path: Path, name: str, dataset: h5py.Dataset, column: Column) -> None:
    """Make sure a dataset has the dtype and the row shape of a column.

    Raises
    ------
    TimelineError
        If it differs.
    """
    if not dataset.shape:
        raise TimelineError(f"{path}: {name} is a single value, expected rows")
    if dataset.dtype != np.dtype(column.dtype) or dataset.shape[1:] != column.shape:
        raise TimelineError(
            f"{path}: {name} is {dataset.dtype}{list(dataset.shape[1:])} a row, "
            f"expected {np.dtype(column.dtype)}{list(column.shape)}"
        )
