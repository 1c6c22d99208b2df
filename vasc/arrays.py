"""Array aliases, the one place where shapes are checked, and append-only columns."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from vasc.errors import ShapeError

Points = NDArray[np.float64]
"""Positions, shape (n, 2), or (n, 3) in space, in units of length."""
Ids = NDArray[np.int32]
"""Row numbers of a table, -1 is null."""
Steps = NDArray[np.int32]
"""Step numbers, shape (n,)."""
Codes = NDArray[np.int8]
"""Enum values, shape (n,)."""
Floats = NDArray[np.float64]
"""Real numbers, shape (n,)."""

NULL = -1

Struct = TypeVar("Struct", bound=tuple)


def filled_from(new: Struct, old: Struct) -> Struct:
    """Copy the rows of arrays into larger ones of the same names; the larger are returned."""
    pairs: Iterable[tuple[NDArray, NDArray]] = zip(new, old, strict=True)
    for target, source in pairs:
        target[: len(source)] = source
    return new


def as_points(values: ArrayLike, name: str) -> Points:
    """Give ``values`` as a contiguous float64 array of shape (n, 2).

    Raises
    ------
    ShapeError
        If the values are not n finite pairs of numbers.
    """
    try:
        points = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ShapeError(f"{name}: expected pairs of numbers, got {values!r:.80}") from error
    if points.size == 0:
        points = points.reshape(0, 2)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ShapeError(f"{name}: expected shape (n, 2), got {points.shape}")
    if not np.isfinite(points).all():
        row = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise ShapeError(f"{name}: row {row} is {points[row].tolist()}; numbers must be finite")
    return points


@dataclass(frozen=True)
class Column:
    """One typed column of a table: dtype, row shape, unit and meaning."""

    dtype: DTypeLike
    meaning: str
    unit: str = ""
    shape: tuple[int, ...] = ()


Columns = Mapping[str, Column]


class Table:
    """Append-only columns of one length; row number = id, no row is ever changed.

    A view of the first ``n`` rows stays valid for ever: when the capacity is
    spent, rows are copied into larger arrays and old views keep the old ones.

    Parameters
    ----------
    columns : mapping of str to Column
        Names and types of the columns.
    capacity : int
        Rows to make room for at first.
    """

    def __init__(self, columns: Columns, capacity: int = 256) -> None:
        self.columns = columns
        self.n_rows = 0
        self.arrays = {
            name: np.empty((capacity, *column.shape), dtype=column.dtype)
            for name, column in columns.items()
        }

    @property
    def capacity(self) -> int:
        """Rows there is room for."""
        return int(next(iter(self.arrays.values())).shape[0])

    def reserve(self, extra: int) -> bool:
        """Make room for ``extra`` rows more; true if the arrays were replaced."""
        needed = self.n_rows + extra
        if needed <= self.capacity:
            return False
        capacity = max(needed, self.capacity + self.capacity // 2)
        for name, array in self.arrays.items():
            larger = np.empty((capacity, *array.shape[1:]), dtype=array.dtype)
            larger[: self.n_rows] = array[: self.n_rows]
            self.arrays[name] = larger
        return True

    def append(self, **values: ArrayLike) -> slice:
        """Append rows (scalars are repeated); the slice they occupy is returned."""
        if set(values) != set(self.columns):
            raise ShapeError(f"columns {sorted(values)} given, {sorted(self.columns)} expected")
        n_new = max(
            (np.shape(v)[0] for name, v in values.items() if np.ndim(v) > self._depth(name)),
            default=1,
        )
        self.reserve(n_new)
        rows = slice(self.n_rows, self.n_rows + n_new)
        for name, value in values.items():
            self.arrays[name][rows] = value
        self.n_rows += n_new
        return rows

    def view(self, name: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Give rows ``start`` to ``stop`` of a column, read-only and without a copy."""
        rows = self.arrays[name][start : self.n_rows if stop is None else stop]
        rows.flags.writeable = False
        return rows

    def _depth(self, name: str) -> int:
        """Give the number of axes of one row of a column."""
        return len(self.columns[name].shape)
