"""Distances along the surface of a stem: relative neighbours on the unrolled cylinder.

The surface is the plane of arc (x) and height (z), periodic in x; y is 0 for all. The
stem of Runions (2008, chapter 6) takes straight distances instead: those along the
surface make its patterns with small numbers impossible. A period of 0 means straight.
"""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.octree import Octree, nearest_within, squared_distance
from vasc.kernels.relative_neighbors_3d import MARGIN


@unowned
def around(dx: float, period: float) -> float:
    """Give a difference along the arc the short way round; both ends must be on the surface."""
    if period > 0.0:
        if dx > 0.5 * period:
            return dx - period
        if dx < -0.5 * period:
            return dx + period
    return dx


@unowned
def displacement(points: NDArray[np.float64], a: int, b: int, axis: int, period: float) -> float:
    """Give how far point b is from point a along an axis."""
    difference = points[b, axis] - points[a, axis]
    return around(difference, period) if axis == 0 else difference


@unowned
def separation(points: NDArray[np.float64], a: int, b: int, period: float) -> float:
    """Give the squared distance of two points; the same bytes in either order."""
    dx = around(points[a, 0] - points[b, 0], period)
    dy = points[a, 1] - points[b, 1]
    dz = points[a, 2] - points[b, 2]
    return dx * dx + dy * dy + dz * dz


@unowned
def on_surface(x: float, period: float) -> float:
    """Give a place along the arc that may be a little outside as one from 0 to the period."""
    if period > 0.0:
        if x < 0.0:
            # the sum may round up to the period itself
            x += period
        if x >= period:
            x -= period
    return x


@compiled
def relatives_on_surface(
    points: NDArray[np.float64], start: int, stop: int, period: float
) -> NDArray[np.int32]:
    """Give every pair of relative neighbours on the surface that has a new point in it.

    Every point is tried for every lune: this is slow, and plain.

    Parameters
    ----------
    points : ndarray of shape (capacity, 3), float64
        Arc, 0 and height; arcs from 0 to the period.
    start, stop : int
        Ids of the new points, the last ones there are.
    period : float
        Circumference, or 0 for points in space.

    Returns
    -------
    ndarray of shape (m, 2), int32
        Rows (newer point, older point), ascending; every pair once.
    """
    rows = np.empty((4 * (stop - start) + 16, 2), dtype=np.int32)
    squares = np.empty(stop)
    n_rows = 0
    for x in range(start, stop):
        for u in range(stop):
            squares[u] = separation(points, x, u, period)
        for v in range(x):
            limit = squares[v] * (1.0 - MARGIN)
            is_open = True
            for u in range(stop):
                if squares[u] < limit and separation(points, u, v, period) < limit:
                    is_open = False
                    break
            if not is_open:
                continue
            if n_rows == len(rows):
                longer = np.empty((2 * n_rows, 2), dtype=np.int32)
                longer[:n_rows] = rows
                rows = longer
            rows[n_rows, 0], rows[n_rows, 1] = x, v
            n_rows += 1
    return rows[:n_rows].copy()


@unowned
def nearest_on_surface(
    tree: Octree,
    points: NDArray[np.float64],
    more: NDArray[np.float64],
    n_more: int,
    first: int,
    x: float,
    y: float,
    z: float,
    limit: float,
    period: float,
) -> int:
    """Give the nearest point, of equals the lowest id, at a squared distance of at most ``limit``.

    Points are those in the tree and ``n_more`` others that are not in it yet, with ids
    from ``first`` on; -1 if none is near enough.
    """
    best, square = nearest_within(tree, points, x, y, z, limit)
    if period > 0.0:
        for turn in (-1.0, 1.0):
            v, other = nearest_within(tree, points, x + turn * period, y, z, limit)
            if v >= 0 and (best < 0 or other < square or (other == square and v < best)):
                best, square = v, other
    for k in range(n_more):
        dx = around(more[k, 0] - x, period)
        other = squared_distance(dx, more[k, 1], more[k, 2], 0.0, y, z)
        if other < square or (best < 0 and other == square):
            best, square = first + k, other
    return best
