"""Sides of cells: which two cells share one, and which ones are the outline of all."""

from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Ids, Points

FREE = -1
"""The partner of a side that no other cell shares."""


class CellRings(NamedTuple):
    """Cells by the corners they share.

    Parameters
    ----------
    corners : ndarray of shape (k, 2), float64
        Corners, each once.
    rows : ndarray of shape (c,), int64
        Rows of ``corners`` around each cell, counterclockwise, one cell after the other.
    starts : ndarray of shape (n + 1,), int64
        Where each cell begins in ``rows``, and the length of ``rows``.
    """

    corners: Points
    rows: NDArray[np.int64]
    starts: NDArray[np.int64]

    @property
    def n_cells(self) -> int:
        """Number of cells."""
        return len(self.starts) - 1

    @property
    def following(self) -> NDArray[np.int64]:
        """Place in ``rows`` of the corner after each, around its cell; shape (c,)."""
        after = np.arange(1, len(self.rows) + 1)
        after[self.starts[1:] - 1] = self.starts[:-1]
        return after

    def only(self, is_kept: NDArray[np.bool_]) -> "CellRings":
        """Give some of the cells."""
        counts = np.diff(self.starts)
        rows = self.rows[np.repeat(is_kept, counts)]
        return CellRings(self.corners, rows, np.cumsum([0, *counts[is_kept].tolist()]))


class Sides(NamedTuple):
    """Sides of cells, one a corner: from it to the next one around its cell.

    Parameters
    ----------
    cells : ndarray of shape (c,), int64
        The cell that each side is of.
    first, second : ndarray of shape (c,), int64
        Its corners, counterclockwise.
    partners : ndarray of shape (c,), int64
        The side of the other cell that shares it, ``FREE`` if none does.
    """

    cells: NDArray[np.int64]
    first: NDArray[np.int64]
    second: NDArray[np.int64]
    partners: NDArray[np.int64]


def rings_of(corners: Points, cells: list[list[int]]) -> CellRings:
    """Lay the corners of cells one after the other."""
    starts = np.cumsum([0, *map(len, cells)])
    rows = np.fromiter(chain.from_iterable(cells), dtype=np.int64, count=int(starts[-1]))
    return CellRings(corners, rows, starts)


def sides_of(rings: CellRings) -> Sides:
    """Find the sides of cells, and which of them two cells share.

    Raises
    ------
    ValueError
        If more than two cells share a side.
    """
    cells = np.repeat(np.arange(rings.n_cells), np.diff(rings.starts))
    first, second = rings.rows, rings.rows[rings.following]
    keys = np.minimum(first, second) * np.int64(len(rings.corners)) + np.maximum(first, second)
    order = np.argsort(keys, kind="stable")
    is_same = keys[order][1:] == keys[order][:-1]
    if (is_same[1:] & is_same[:-1]).any():
        raise ValueError("more than two cells share a side")
    one, other = order[:-1][is_same], order[1:][is_same]
    partners = np.full(len(keys), FREE, dtype=np.int64)
    partners[one], partners[other] = other, one
    return Sides(cells, first, second, partners)


def walls_of(rings: CellRings, sides: Sides) -> tuple[Ids, Floats]:
    """Give the walls between cells, lower id first and in order, and their lengths.

    Two cells have one wall, which may consist of several sides.

    Returns
    -------
    tuple of ndarray of shape (w, 2), int32, and ndarray of shape (w,), float64
        Pairs of cells, and lengths.
    """
    ends = rings.corners[sides.second] - rings.corners[sides.first]
    partner_cells = sides.cells[sides.partners]
    is_wall = (sides.partners != FREE) & (sides.cells < partner_cells)
    keys = sides.cells[is_wall] * np.int64(rings.n_cells) + partner_cells[is_wall]
    found, walls = np.unique(keys, return_inverse=True)
    lengths = np.bincount(walls, np.hypot(*ends[is_wall].T), minlength=len(found))
    pairs = np.stack(np.divmod(found, rings.n_cells), axis=1)
    return pairs.astype(np.int32), np.asarray(lengths, dtype=np.float64)


def outline_sides(sides: Sides) -> list[list[int]]:
    """Give the sides around all cells, ring by ring: the outer margin left, holes right.

    Raises
    ------
    ValueError
        If the outline touches itself at a corner.
    """
    free = np.flatnonzero(sides.partners == FREE).tolist()
    leaving = dict(zip(sides.first[free].tolist(), free, strict=True))
    if len(leaving) < len(free):
        raise ValueError("the outline of the cells touches itself at a corner")
    found = []
    while leaving:
        start = next(iter(leaving))
        ring: list[int] = []
        corner = start
        while not ring or corner != start:
            ring.append(leaving.pop(corner))
            corner = int(sides.second[ring[-1]])
        found.append(ring)
    return found


def areas_of(rings: CellRings) -> tuple[Floats, Points]:
    """Give areas, positive when corners run counterclockwise, and centroids of cells."""
    begins = rings.starts[:-1]
    # from the first corner of each cell, so that cells far from the origin keep their digits
    origins = rings.corners[rings.rows[begins]]
    xy = rings.corners[rings.rows] - np.repeat(origins, np.diff(rings.starts), axis=0)
    after = xy[rings.following]
    crosses = xy[:, 0] * after[:, 1] - after[:, 0] * xy[:, 1]
    doubled = np.add.reduceat(crosses, begins)
    sums = np.add.reduceat((xy + after) * crosses[:, None], begins, axis=0)
    return 0.5 * doubled, origins + sums / (3.0 * doubled[:, None])
