"""Growing columns in an HDF5 file: every write of vasc to HDF5 is made here.

Nothing that exists is rewritten, except two marks of one number each. Columns
carry no filters: a compressed chunk is moved when it grows, and a process that
is killed then loses the file. Those that do, for being large, are written by
:mod:`vasc.timeline.compressed`, which moves none.

HDF5 writes where a page is before it writes the page, and last of all how long the file
is. So that a process may be killed in between, every column has its index from the
start, and the file states its length before each flush.
"""

import contextlib
import os
import secrets
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import numpy as np
from h5py import h5d, h5f, h5o, h5p, h5s, h5t
from numpy.typing import NDArray

from vasc.arrays import Column
from vasc.errors import OutputError
from vasc.timeline.compressed import CompressedColumn
from vasc.timeline.layout import fill_value

COMPRESSION = 4
"""Level of deflate, from 0 to 9."""
HEAD_BYTES = 52
"""Bytes at the beginning of a file that tell how long it is."""


class GrowingColumn:
    """One dataset that grows along its first axis.

    Parameters
    ----------
    dataset : h5py.h5d.DatasetID
        The open dataset.
    """

    __slots__ = ("_dataset", "_memory_type", "_row_shape", "_zeros", "dtype", "n_rows")

    def __init__(self, dataset: h5d.DatasetID) -> None:
        self._dataset = dataset
        self._row_shape = dataset.shape[1:]
        self._zeros = (0,) * len(self._row_shape)
        self.dtype: np.dtype[Any] = dataset.dtype
        self._memory_type = h5t.py_create(self.dtype)
        self.n_rows: int = dataset.shape[0]

    @classmethod
    def begin(cls, dataset: h5d.DatasetID) -> None:
        """Make the index of an empty column, by a row that is dropped again."""
        column = cls(dataset)
        column.write(0, np.zeros((1, *dataset.shape[1:]), dtype=column.dtype))
        column.cut(0)

    def write(self, start: int, rows: NDArray) -> None:
        """Write ``rows`` (contiguous, of the column's dtype) from row ``start`` on."""
        n_new = len(rows)
        stop = start + n_new
        if stop > self.n_rows:
            self._dataset.set_extent((stop, *self._row_shape))
            self.n_rows = stop
        block = (n_new, *self._row_shape)
        target = self._dataset.get_space()
        target.select_hyperslab((start, *self._zeros), block)
        self._dataset.write(h5s.create_simple(block), target, rows, self._memory_type)

    def cut(self, n_rows: int) -> None:
        """Drop the rows from ``n_rows`` on."""
        if n_rows < self.n_rows:
            self._dataset.set_extent((n_rows, *self._row_shape))
            self.n_rows = n_rows


class Store:
    """An open HDF5 file, its growing columns and its marks.

    Parameters
    ----------
    path : Path
        Where the file is; named in errors.
    file : h5py.File
        The file, open for writing.
    """

    def __init__(self, path: Path, file: h5py.File) -> None:
        self.path = path
        self._file = file
        self._marks: dict[str, GrowingColumn | CompressedColumn] = {}
        # what a killed run left beyond the end of the file goes away first, so that HDF5
        # tells its length right from now on
        h5f.flush(file.id)

    @classmethod
    def create(cls, path: Path) -> "Store":
        """Make a new file; one that exists is an error.

        Raises
        ------
        OutputError
            If the file exists or cannot be made.
        """
        try:
            # h5py's default file structures: with the newest, no killed run is readable
            return cls(path, h5py.File(path, "x"))
        except OSError as error:
            raise OutputError(f"{path}: cannot be created: {reason(error)}") from error

    def add_group(self, name: str, attributes: Mapping[str, Any]) -> None:
        """Make a group with attributes."""
        self._describe(self._file.create_group(name), attributes)

    def describe(self, attributes: Mapping[str, Any]) -> None:
        """Set attributes of the file itself."""
        self._describe(self._file, attributes)

    def add_text(self, name: str, text: str, attributes: Mapping[str, Any]) -> None:
        """Make a text: one string of fixed length, so that every tool can read it."""
        raw = text.encode()
        dtype = h5py.string_dtype("utf-8", max(1, len(raw)))
        self._describe(self._file.create_dataset(name, data=raw, dtype=dtype), attributes)

    def add_array(self, name: str, values: NDArray, attributes: Mapping[str, Any]) -> None:
        """Make an array that never grows."""
        early = h5p.create(h5p.DATASET_CREATE)
        # its place in the file is fixed now, so that a later write moves nothing
        early.set_alloc_time(h5d.ALLOC_TIME_EARLY)
        space = h5s.create_simple(values.shape)
        dataset = h5d.create(
            self._file.id, name.encode(), h5t.py_create(values.dtype), space, dcpl=early
        )
        if values.size:
            dataset.write(h5s.ALL, h5s.ALL, np.ascontiguousarray(values))
        self._describe(h5py.Dataset(dataset), attributes)

    def add_column(
        self,
        name: str,
        column: Column,
        chunk_rows: int,
        attributes: Mapping[str, Any],
        *,
        is_compressed: bool = False,
    ) -> None:
        """Make an empty column that can grow."""
        dtype = np.dtype(column.dtype)
        creation = h5p.create(h5p.DATASET_CREATE)
        creation.set_chunk((chunk_rows, *(max(1, n) for n in column.shape)))
        if dtype.kind != "S":
            creation.set_fill_value(np.array(fill_value(dtype)))
        if is_compressed:
            creation.set_shuffle()
            creation.set_deflate(COMPRESSION)
            creation.set_fletcher32()
        dataset = self._make_column(name, h5t.py_create(dtype), column.shape, creation)
        self._describe(dataset, attributes)

    def add_column_like(self, name: str, other: h5py.Dataset) -> None:
        """Make an empty column like that of another file, with its attributes."""
        creation = other.id.get_create_plist()
        dataset = self._make_column(name, other.id.get_type(), other.shape[1:], creation)
        self._describe_like(dataset, other)

    def add_group_like(self, name: str, other: h5py.Group) -> None:
        """Make a group like that of another file, with its attributes and no members."""
        self._describe_like(self._file.require_group(name), other)

    def copy(self, name: str, other: h5py.Dataset) -> None:
        """Copy a dataset of another file, with its attributes."""
        h5o.copy(other.id, b".", self._file.id, name.encode())

    def column(self, name: str) -> GrowingColumn | CompressedColumn:
        """Open a column for appending, without a cache: rows go straight to the file."""
        access = h5p.create(h5p.DATASET_ACCESS)
        access.set_chunk_cache(0, 0, 0.0)
        dataset = h5d.open(self._file.id, name.encode(), access)
        return CompressedColumn(dataset) if _has_filters(dataset) else GrowingColumn(dataset)

    def mark(self, name: str, value: int) -> None:
        """Set a mark, the only kind of value that is rewritten, and bring it to the file."""
        column = self._marks.get(name) or self._marks.setdefault(name, self.column(name))
        column.write(0, np.array([value], dtype=column.dtype))
        self.flush()

    def flush(self) -> None:
        """Hand everything written so far to the operating system."""
        self._state_end()
        h5f.flush(self._file.id)

    def close(self) -> None:
        """Close the file; closing twice is fine."""
        self._file.close()

    @contextlib.contextmanager
    def writing(self) -> Iterator[None]:
        """Turn what goes wrong while writing into one clear error."""
        try:
            yield
        except (OSError, RuntimeError) as error:
            raise OutputError(f"{self.path}: cannot be written: {reason(error)}") from error

    def _state_end(self) -> None:
        """Let the file be as long, and say so, as it is after the next flush."""
        if sys.platform == "win32":
            return
        handle: int = self._file.id.get_vfd_handle()
        stated = _stated_end(os.pread(handle, HEAD_BYTES, 0))
        end = self._file.id.get_filesize()
        if stated is None or stated.end >= end:
            return
        if os.fstat(handle).st_size < end:
            os.ftruncate(handle, end)
        os.pwrite(handle, end.to_bytes(8, "little"), stated.offset)

    def _make_column(
        self, name: str, kind: h5t.TypeID, row_shape: tuple[int, ...], creation: h5p.PropDCID
    ) -> h5py.Dataset:
        """Make an empty column that has its index already."""
        space = h5s.create_simple((0, *row_shape), (h5s.UNLIMITED, *row_shape))
        dataset = h5d.create(self._file.id, name.encode(), kind, space, dcpl=creation)
        (CompressedColumn if _has_filters(dataset) else GrowingColumn).begin(dataset)
        return h5py.Dataset(dataset)

    @staticmethod
    def _describe_like(target: h5py.HLObject, other: h5py.HLObject) -> None:
        """Set the attributes that another object has."""
        for key, value in other.attrs.items():
            kept = other.attrs.get_id(key)
            target.attrs.create(key, value, shape=kept.shape, dtype=kept.dtype)

    @staticmethod
    def _describe(target: h5py.HLObject, attributes: Mapping[str, Any]) -> None:
        """Set attributes, texts as strings of fixed length."""
        for key, value in attributes.items():
            if isinstance(value, str):
                value = np.array(value.encode(), dtype=f"S{max(1, len(value.encode()))}")
            target.attrs.create(key, value)


class _StatedEnd(NamedTuple):
    """How long a file says it is, and where it says so."""

    end: int
    offset: int


def stated_end(path: Path) -> int | None:
    """Give how long a file says it is, None if it does not say so in the way vasc knows.

    Raises
    ------
    OSError
        If the file cannot be read.
    """
    with path.open("rb") as file:
        stated = _stated_end(file.read(HEAD_BYTES))
    return None if stated is None else stated.end


def _stated_end(head: bytes) -> _StatedEnd | None:
    """Read the end that the first bytes of a file state, in the superblocks without a sum."""
    # version 1 has four bytes more than version 0 before the addresses; both begin at 0
    if len(head) < HEAD_BYTES or head[8] > 1 or head[13] != 8:
        return None
    offset = 40 + 4 * head[8]
    return _StatedEnd(int.from_bytes(head[offset : offset + 8], "little"), offset)


def _has_filters(dataset: h5d.DatasetID) -> bool:
    """Tell whether the chunks of a dataset pass through filters."""
    return dataset.get_create_plist().get_nfilters() > 0


def reason(error: BaseException) -> str:
    """Give the first line of an error's message, or its name."""
    return (str(error).splitlines() or [type(error).__name__])[0]


def check_output(path: Path, *, force: bool) -> None:
    """Make sure that a file may be written there.

    Raises
    ------
    OutputError
        If the file exists and ``force`` is not set, is a folder or is being
        written by another run, or if its folder does not exist.
    """
    if not path.parent.is_dir():
        raise OutputError(f"{path}: the folder {str(path.parent)!r} does not exist")
    if path.is_dir():
        raise OutputError(f"{path}: is a folder")
    if not path.exists():
        return
    if not force:
        raise OutputError(f"{path}: exists already; use --force to replace it")
    if _is_locked(path):
        raise OutputError(f"{path}: is being written by another run")


def beside(path: Path) -> Path:
    """Give an unused name in the same folder, for a file that is not yet ready."""
    return path.with_name(f".{path.name}.{secrets.token_hex(4)}.new")


def publish(ready: Path, path: Path, *, force: bool) -> None:
    """Give a finished file its name in one step, replacing nothing unless forced.

    Raises
    ------
    OutputError
        If a file of that name exists by now and ``force`` is not set.
    """
    try:
        if force:
            os.replace(ready, path)
            return
        try:
            os.link(ready, path)
        except FileExistsError:
            raise
        except OSError:
            # a file system without hard links: the name is taken exclusively first
            os.close(os.open(path, os.O_CREAT | os.O_EXCL))
            os.replace(ready, path)
            return
        ready.unlink()
    except FileExistsError as error:
        raise OutputError(f"{path}: exists already; use --force to replace it") from error
    except OSError as error:
        raise OutputError(f"{path}: cannot be created: {reason(error)}") from error


def _is_locked(path: Path) -> bool:
    """Tell whether a running writer holds the file."""
    try:
        h5py.File(path, "r+", locking=True).close()
    except BlockingIOError:
        return True
    except OSError:
        # not HDF5, or damaged: nobody writes it
        return False
    return False
