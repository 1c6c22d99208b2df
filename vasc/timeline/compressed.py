"""A compressed column that never pulls a chunk away from under a reader: none is moved.

HDF5 moves a compressed chunk that is rewritten in another size, and uses its old place
for something else; whoever has the file open still looks for it there. Here a chunk is
compressed if all its rows come in one call, and is then final. One that is filled bit by
bit is stored as it is, its filters left out, so that it has its full size from the start
and stays in its place.
"""

from typing import Any

import numpy as np
from h5py import h5d, h5s, h5t
from numpy.typing import NDArray

from vasc.timeline.layout import fill_value


class CompressedColumn:
    """One dataset with filters that grows along its first axis.

    Parameters
    ----------
    dataset : h5py.h5d.DatasetID
        The open dataset.
    """

    def __init__(self, dataset: h5d.DatasetID) -> None:
        creation = dataset.get_create_plist()
        self._dataset = dataset
        self._chunk_rows: int = creation.get_chunk()[0]
        # one bit a filter: set where a chunk was stored without it
        self._no_filters = (1 << creation.get_nfilters()) - 1
        self._row_shape = dataset.shape[1:]
        self.dtype: np.dtype[Any] = dataset.dtype
        self._memory_type = h5t.py_create(self.dtype)
        self.n_rows: int = dataset.shape[0]

    @classmethod
    def begin(cls, dataset: h5d.DatasetID) -> None:
        """Make the first chunk of an empty column, filled bit by bit from then on."""
        column = cls(dataset)
        dataset.set_extent((1, *column._row_shape))
        column._write_part(0, np.empty((0, *column._row_shape), dtype=column.dtype))

    def write(self, start: int, rows: NDArray) -> None:
        """Write ``rows`` (contiguous, of the column's dtype) from row ``start`` on."""
        stop, size = start + len(rows), self._chunk_rows
        if stop > self.n_rows:
            self._dataset.set_extent((stop, *self._row_shape))
            self.n_rows = stop
        # the rest of the chunk begun, whole chunks, and the beginning of one more; the first
        # chunk is there from the beginning, as it is, and stays so
        head = min(stop, max(size, -(-start // size) * size))
        tail = max(head, stop // size * size)
        if head > start:
            self._write_part(start, rows[: head - start])
        for first in range(head, tail, size):
            self._transfer(first, rows[first - start : first - start + size], is_read=False)
        if stop > tail:
            self._write_part(tail, rows[tail - start :])

    def cut(self, n_rows: int) -> None:
        """Drop the chunks that begin at row ``n_rows`` or later, but not the first.

        Rows beyond ``n_rows`` in the chunk before stay until others overwrite them: to
        clear them, HDF5 would compress that chunk, and move it.
        """
        n_kept = max(1, -(-n_rows // self._chunk_rows)) * self._chunk_rows
        if n_kept < self.n_rows:
            self._dataset.set_extent((n_kept, *self._row_shape))
            self.n_rows = n_kept

    def _write_part(self, start: int, rows: NDArray) -> None:
        """Write rows of one chunk from ``start`` on, keeping the rows before them."""
        first = start // self._chunk_rows * self._chunk_rows
        shape = (self._chunk_rows, *self._row_shape)
        chunk = np.full(shape, fill_value(self.dtype), dtype=self.dtype)
        if start > first:
            self._transfer(first, chunk[: start - first], is_read=True)
        chunk[start - first : start - first + len(rows)] = rows
        offset = (first, *(0 for _ in self._row_shape))
        self._dataset.write_direct_chunk(offset, chunk.tobytes(), self._no_filters)
        if start == first > 0:
            # HDF5 remembers the chunk it saw last, and of a new one not that it has no
            # filters: it is made to see another, or nobody in this process could read it
            self._transfer(first - 1, np.empty((1, *self._row_shape), self.dtype), is_read=True)

    def _transfer(self, start: int, rows: NDArray, *, is_read: bool) -> None:
        """Read or write rows through the filters."""
        target = self._dataset.get_space()
        target.select_hyperslab((start, *(0 for _ in self._row_shape)), rows.shape)
        memory = h5s.create_simple(rows.shape)
        move = self._dataset.read if is_read else self._dataset.write
        move(memory, target, rows, self._memory_type)
