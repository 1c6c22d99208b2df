"""Relative neighbours in one order, and segments in the way: what canals need."""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned


@compiled
def ordered_neighbors(
    points: NDArray[np.float64], distances: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Give the relative neighbours of a source among nodes that are in order.

    A node is none when an earlier one is nearer to it than the source is. Equation
    4.1 asks for nodes nearer to the source; an order decides also where several
    are equally near, as they are around the centre of an empty circle.

    Parameters
    ----------
    points : ndarray of shape (n, 2), float64
        Places of the nodes, in the order of distance from the source, ties resolved.
    distances : ndarray of shape (n,), float64
        Their distances from the source.

    Returns
    -------
    ndarray of shape (k,), int64
        Rows of the relative neighbours, ascending.
    """
    found = np.empty(len(points), dtype=np.int64)
    n_found = 0
    for i in range(len(points)):
        limit = distances[i] * distances[i]
        is_neighbor = True
        for j in range(i):
            dx = points[i, 0] - points[j, 0]
            dy = points[i, 1] - points[j, 1]
            if dx * dx + dy * dy < limit:
                is_neighbor = False
                break
        if is_neighbor:
            found[n_found] = i
            n_found += 1
    return found[:n_found].copy()


@unowned
def side(ax: float, ay: float, bx: float, by: float, px: float, py: float) -> float:
    """Give a number that is positive left of the line from a to b, negative right of it."""
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax)


@unowned
def first_crossed(
    places: NDArray[np.float64],
    segments: NDArray[np.int32],
    refined: NDArray[np.bool_],
    n_segments: int,
    tip: int,
    x: float,
    y: float,
) -> int:
    """Give the first live segment that a step from a node to (x, y) would cross, or -1.

    Segments that end in the node are not crossed.
    """
    ax, ay = places[tip, 0], places[tip, 1]
    for row in range(n_segments):
        if refined[row]:
            continue
        p, q = segments[row, 0], segments[row, 1]
        if p == tip or q == tip:
            continue
        px, py, qx, qy = places[p, 0], places[p, 1], places[q, 0], places[q, 1]
        if max(px, qx) < min(ax, x) or min(px, qx) > max(ax, x):
            continue
        if max(py, qy) < min(ay, y) or min(py, qy) > max(ay, y):
            continue
        if side(ax, ay, x, y, px, py) * side(ax, ay, x, y, qx, qy) >= 0.0:
            continue
        if side(px, py, qx, qy, ax, ay) * side(px, py, qx, qy, x, y) < 0.0:
            return row
    return -1
