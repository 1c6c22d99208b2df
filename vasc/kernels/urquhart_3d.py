"""Urquhart's approximation of relative neighbours in space: only common Delaunay neighbours count.

All points are triangulated anew at every call. The stem of Runions (2008, section
6.2.1) does without: it loses connections between primordia.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay, QhullError

from vasc.kernels.compiled import compiled
from vasc.kernels.relative_neighbors_3d import MARGIN, between
from vasc.kernels.stem import Stem, divide, join


def delaunay_pairs(points: NDArray[np.float64]) -> NDArray[np.int32]:
    """Give all pairs of Delaunay neighbours; of points in a plane or at one place, all pairs.

    Rows are ascending, the lower id first.
    """
    n_points = len(points)
    try:
        triangulation = Delaunay(points)
    except (QhullError, ValueError):
        return np.stack(np.triu_indices(n_points, 1), axis=1).astype(np.int32)
    corners = triangulation.simplices
    sides = [corners[:, [i, j]] for i in range(4) for j in range(i + 1, 4)]
    # a point at the place of another is left out of the triangulation
    sides.append(triangulation.coplanar[:, [0, 2]])
    rows = np.sort(np.concatenate(sides), axis=1).astype(np.int64)
    keys = np.unique(rows[:, 0] * n_points + rows[:, 1])
    return np.stack((keys // n_points, keys % n_points), axis=1).astype(np.int32)


@compiled
def _without_common(
    points: NDArray[np.float64],
    rows: NDArray[np.int32],
    starts: NDArray[np.int64],
    neighbors: NDArray[np.int32],
) -> NDArray[np.bool_]:
    """Tell for every pair whether no common neighbour lies in its open lune."""
    is_kept = np.ones(len(rows), dtype=np.bool_)
    for row in range(len(rows)):
        a, b = rows[row, 0], rows[row, 1]
        limit = between(points, a, b) * (1.0 - MARGIN)
        for k in range(starts[a], starts[a + 1]):
            u = neighbors[k]
            if between(points, u, a) >= limit or between(points, u, b) >= limit:
                continue
            for j in range(starts[b], starts[b + 1]):
                if neighbors[j] == u:
                    is_kept[row] = False
                    break
            if not is_kept[row]:
                break
    return is_kept


def urquhart_pairs(points: NDArray[np.float64]) -> NDArray[np.int32]:
    """Give all pairs of Delaunay neighbours without a common one in their open lune.

    Parameters
    ----------
    points : ndarray of shape (n, 3), float64
        Coordinates.

    Returns
    -------
    ndarray of shape (m, 2), int32
        Rows (lower id, higher id), ascending; empty for less than two points. All
        relative neighbours are among them, and some more pairs.
    """
    rows = delaunay_pairs(points)
    both = np.concatenate((rows, rows[:, ::-1]))
    order = np.argsort(both[:, 0], kind="stable")
    starts = np.searchsorted(both[order, 0], np.arange(len(points) + 1)).astype(np.int64)
    neighbors = np.ascontiguousarray(both[order, 1])
    return rows[_without_common(points, rows, starts, neighbors)]


def insert(old: Stem, start: int, length: float) -> Stem:
    """Bring pairs and segments up to date as ``stem.insert`` does, by Urquhart's approximation.

    All pairs are found anew: by common Delaunay neighbours a pair that was lost can
    come back. Here, too, only the nodes from ``start`` on are joined to others.
    """
    rows = urquhart_pairs(old.positions[: old.n_nodes])
    is_new = rows[:, 1] >= start
    links = (old.edges, old.newest, old.following)
    near, far = divide(old.positions, rows[is_new], *links, length, 0.0)
    nearer, farther = divide(old.positions, rows[~is_new], *links, length, 0.0)
    return join(old._replace(pairs=np.concatenate((nearer, farther, far))), near)
