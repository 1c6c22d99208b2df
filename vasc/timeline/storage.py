"""Growing columns in an HDF5 file, and the one door through which vasc writes such files.

HDF5 writes into the memory of a :mod:`vasc.timeline.redo` pager, and what it has written
becomes part of the file commit by commit. Nothing that exists is rewritten all the same,
except two marks of one number each: a reader that has the file open keeps what it found.
"""

import contextlib
import os
import secrets
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from h5py import h5d, h5f, h5p, h5s, h5t
from numpy.typing import NDArray

from vasc.arrays import Column
from vasc.errors import DiskError, OutputError
from vasc.timeline.compressed import CompressedColumn
from vasc.timeline.layout import PROVENANCE, fill_value
from vasc.timeline.redo import (
    Durability,
    Pager,
    is_being_written,
    log_of,
    refuse_foreign,
    refuse_strange,
    writer_of,
)
from vasc.whole_files import refuse_special

COMPRESSION = 4
"""Level of deflate, from 0 to 9."""
IDENTITY_BYTES = 65536
"""Bytes of the first provenance record by which a log knows its file."""


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

    def __init__(self, path: Path, file: h5py.File, pager: Pager) -> None:
        self.path = path
        self._file = file
        self._pager = pager
        self._marks: dict[str, GrowingColumn | CompressedColumn] = {}

    @classmethod
    def create(cls, path: Path, durability: Durability) -> "Store":
        """Make a new file; one that exists is an error.

        Raises
        ------
        OutputError
            If the file exists or cannot be made.
        """
        try:
            os.close(os.open(path, os.O_CREAT | os.O_EXCL, 0o666))
            pager = Pager(path, is_logged=False, durability=durability)
            # h5py's default file structures, which every version of HDF5 can read
            return cls(path, h5py.File(pager, "w"), pager)
        except OSError as error:
            raise OutputError(f"{path}: cannot be created: {reason(error)}") from error

    @classmethod
    def open(cls, path: Path, durability: Durability) -> "Store":
        """Open a file to continue it, with what waits in its log; nobody else can write it.

        Raises
        ------
        BusyError
            If another process writes it.
        OSError
            If it cannot be opened.
        """
        pager = Pager(path, durability=durability)
        try:
            return cls(path, h5py.File(pager, "r+"), pager)
        except BaseException:
            pager.abandon()
            raise

    @property
    def file(self) -> h5py.File:
        """The open file, to read it."""
        return self._file

    def begin(self) -> None:
        """Make the log that of this file: from now on it may be written.

        Raises
        ------
        OSError
            If the log cannot be written.
        """
        first = self._file[PROVENANCE].id.get_chunk_info(0)
        self._pager.identify(first.byte_offset, min(first.size, IDENTITY_BYTES))

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
        space = h5s.create_simple((0, *column.shape), (h5s.UNLIMITED, *column.shape))
        kind = h5t.py_create(dtype)
        dataset = h5d.create(self._file.id, name.encode(), kind, space, dcpl=creation)
        if is_compressed:
            CompressedColumn.begin(dataset)
        self._describe(h5py.Dataset(dataset), attributes)

    def column(self, name: str) -> GrowingColumn | CompressedColumn:
        """Open a column for appending, without a cache: rows go straight to the file."""
        access = h5p.create(h5p.DATASET_ACCESS)
        access.set_chunk_cache(0, 0, 0.0)
        dataset = h5d.open(self._file.id, name.encode(), access)
        return CompressedColumn(dataset) if _has_filters(dataset) else GrowingColumn(dataset)

    def mark(self, name: str, value: int) -> None:
        """Set a mark, the only kind of value that is rewritten."""
        column = self._marks.get(name) or self._marks.setdefault(name, self.column(name))
        column.write(0, np.array([value], dtype=column.dtype))

    def commit(self) -> None:
        """Let all that was written so far be part of the file, whatever happens from now on.

        Raises
        ------
        OSError
            If it cannot be; the file stays as it was.
        """
        h5f.flush(self._file.id)
        self._pager.commit()

    def close(self) -> None:
        """Commit what is left and close the file; closing twice is fine.

        Raises
        ------
        OSError
            If the file cannot be written; its log then holds what it lacks.
        """
        try:
            if self._file:
                self._file.close()
                self._pager.commit()
        finally:
            self._pager.release()

    def give_up(self) -> None:
        """Close the file as its last commit left it; closing twice is fine."""
        # into memory, which is dropped
        with contextlib.suppress(OSError, RuntimeError):
            self._file.close()
        with contextlib.suppress(OSError):
            self._pager.release()

    def abandon(self) -> None:
        """Close the file as it is on the disk: it is none that may be written."""
        with contextlib.suppress(OSError, RuntimeError):
            self._file.close()
        self._pager.abandon()

    @contextlib.contextmanager
    def writing(self, kept: str = "") -> Iterator[None]:
        """Turn what goes wrong while writing into one clear error, which ends in ``kept``."""
        try:
            yield
        except (OSError, RuntimeError) as error:
            raise DiskError(f"{self.path}: {_refusal(self.path, error)}{kept}") from error

    @staticmethod
    def _describe(target: h5py.HLObject, attributes: Mapping[str, Any]) -> None:
        """Set attributes, texts as strings of fixed length."""
        for key, value in attributes.items():
            if isinstance(value, str):
                value = np.array(value.encode(), dtype=f"S{max(1, len(value.encode()))}")
            target.attrs.create(key, value)


def _has_filters(dataset: h5d.DatasetID) -> bool:
    """Tell whether the chunks of a dataset pass through filters."""
    return dataset.get_create_plist().get_nfilters() > 0


def reason(error: BaseException) -> str:
    """Give the first line of an error's message, or its name."""
    return (str(error).splitlines() or [type(error).__name__])[0]


def kept(path: Path, n_frames: int) -> str:
    """Say what is kept of a run when the disk takes no more, and how to go on."""
    if not n_frames:
        return "; no step is kept"
    return f"; all steps up to {n_frames - 1} are kept, and `vasc resume {path}` goes on from there"


def _refusal(path: Path, error: BaseException) -> str:
    """Say why a file cannot be written, and how much room its disk has."""
    with contextlib.suppress(OSError):
        free = shutil.disk_usage(path.absolute().parent)[2]
        return f"cannot be written: {reason(error)} ({free / 1e6:,.1f} MB are free on its disk)"
    return f"cannot be written: {reason(error)}"


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
    refuse_special(path)
    if path.is_dir():
        raise OutputError(f"{path}: is a folder")
    refuse_foreign(log_of(path))
    if path.exists() and not force:
        raise OutputError(f"{path}: exists already; use --force to replace it")
    # also where a run's file was moved away
    if is_being_written(path, log_of(path)):
        raise OutputError(f"{path}: is being written by {writer_of(log_of(path))}")
    if path.exists() or not force:
        refuse_strange(path)


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
