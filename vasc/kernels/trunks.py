"""Trunks: the way that most of the auxin takes from a cell."""

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Ids


def trunk(walls: Ids, flux: Floats, start: int, is_end: NDArray[np.bool_]) -> tuple[Ids, Ids, bool]:
    """Follow the largest flux from cell to cell until a cell where it ends.

    Parameters
    ----------
    walls : ndarray of shape (w, 2), int32
        The two cells of each wall.
    flux : ndarray of shape (w,), float64
        Net flux of each wall, above 0 from its first cell to its second.
    start : int
        The first cell.
    is_end : ndarray of shape (n,), bool
        Cells that end a trunk.

    Returns
    -------
    tuple of ndarray of shape (k,), ndarray of shape (k - 1,), bool
        The cells, the start first; the walls between them; whether the way comes back to a
        cell that it has passed. A way that nothing leaves ends where it is. Of two equal
        fluxes the wall of lower id is followed.
    """
    away = _strongest_exits(walls, flux, len(is_end))
    cells, passed = [start], [int(away[start])]
    seen = {start}
    while not is_end[cells[-1]]:
        wall = int(away[cells[-1]])
        if wall < 0:
            return np.array(cells, np.int32), np.array(passed[:-1], np.int32), False
        here, there = walls[wall].tolist()
        following = there if here == cells[-1] else here
        if following in seen:
            return np.array(cells, np.int32), np.array(passed[:-1], np.int32), True
        seen.add(following)
        cells.append(following)
        passed.append(int(away[following]))
    return np.array(cells, np.int32), np.array(passed[:-1], np.int32), False


def _strongest_exits(walls: Ids, flux: Floats, n_cells: int) -> Ids:
    """Give the wall by which most leaves each cell, -1 if nothing leaves it, shape (n,)."""
    order = np.lexsort((-np.arange(len(flux)), np.abs(flux)))
    order = order[flux[order] != 0.0]
    leaves = np.where(flux[order] > 0.0, walls[order, 0], walls[order, 1])
    away = np.full(n_cells, -1, dtype=np.int32)
    # the last of equal indices is kept: the strongest, and of two the one of lower id
    away[leaves] = order
    return away
