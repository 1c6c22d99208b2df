"""Pairs of segments that meet elsewhere than in a node they share."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ids = NDArray[np.int32]


@njit(cache=True)
def _side(ax: float, ay: float, bx: float, by: float, px: float, py: float) -> float:
    """Give twice the signed area of the triangle a, b, p: positive with p on the left."""
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax)


@njit(cache=True)
def _do_meet(points: Floats, a: int, b: int, c: int, d: int) -> bool:
    """Tell whether segments a-b and c-d have a point in common other than a shared node."""
    ax, ay, bx, by = points[a, 0], points[a, 1], points[b, 0], points[b, 1]
    cx, cy, dx, dy = points[c, 0], points[c, 1], points[d, 0], points[d, 1]
    if max(ax, bx) < min(cx, dx) or max(cx, dx) < min(ax, bx):
        return False
    if max(ay, by) < min(cy, dy) or max(cy, dy) < min(ay, by):
        return False
    to_c, to_d = _side(ax, ay, bx, by, cx, cy), _side(ax, ay, bx, by, dx, dy)
    to_a, to_b = _side(cx, cy, dx, dy, ax, ay), _side(cx, cy, dx, dy, bx, by)
    if a in (c, d) or b in (c, d):
        if to_c != 0.0 or to_d != 0.0:
            return False
        # on one line: they overlap unless they leave the shared node opposite ways
        sign = 1.0 if (a == c or b == d) else -1.0
        return sign * ((bx - ax) * (dx - cx) + (by - ay) * (dy - cy)) > 0.0
    if (to_c > 0.0 and to_d > 0.0) or (to_c < 0.0 and to_d < 0.0):
        return False
    return not ((to_a > 0.0 and to_b > 0.0) or (to_a < 0.0 and to_b < 0.0))


@njit(cache=True)
def _cell_ranges(points: Floats, segments: Ids, x0: float, y0: float, side: float) -> Ids:
    """Give first and last column, first and last row of the cells each segment may touch."""
    ranges = np.empty((len(segments), 4), dtype=np.int32)
    for row in range(len(segments)):
        a, b = segments[row, 0], segments[row, 1]
        ranges[row, 0] = int((min(points[a, 0], points[b, 0]) - x0) / side)
        ranges[row, 1] = int((max(points[a, 0], points[b, 0]) - x0) / side)
        ranges[row, 2] = int((min(points[a, 1], points[b, 1]) - y0) / side)
        ranges[row, 3] = int((max(points[a, 1], points[b, 1]) - y0) / side)
    return ranges


@njit(cache=True)
def _cell_lists(ranges: Ids, n_columns: int, n_rows: int) -> tuple[NDArray[np.int64], Ids]:
    """Give the segments of every cell as one list with the starts of the cells in it."""
    starts = np.zeros(n_columns * n_rows + 1, dtype=np.int64)
    for first, last, low, high in ranges:
        for row in range(low, high + 1):
            for column in range(first, last + 1):
                starts[row * n_columns + column + 1] += 1
    starts = np.cumsum(starts)
    filled = starts[:-1].copy()
    members = np.empty(starts[-1], dtype=np.int32)
    for segment in range(len(ranges)):
        first, last, low, high = ranges[segment]
        for row in range(low, high + 1):
            for column in range(first, last + 1):
                cell = row * n_columns + column
                members[filled[cell]] = segment
                filled[cell] += 1
    return starts, members


@njit(cache=True)
def segment_contacts(points: Floats, segments: Ids, side: float) -> Ids:
    """List the pairs of segments that cross, touch or overlap.

    Parameters
    ----------
    points : ndarray of shape (n, 2), float64
        Node positions; at least one.
    segments : ndarray of shape (m, 2), int32
        Rows of the two nodes of each segment.
    side : float
        Side of the search cells, above 0: about the length of a segment.

    Returns
    -------
    ndarray of shape (k, 2), int32
        Rows of segments, the lower first, each pair once. Segments with a
        common node are listed only if they overlap.
    """
    x0, y0 = points[:, 0].min(), points[:, 1].min()
    n_columns = int((points[:, 0].max() - x0) / side) + 1
    n_rows = int((points[:, 1].max() - y0) / side) + 1
    ranges = _cell_ranges(points, segments, x0, y0, side)
    starts, members = _cell_lists(ranges, n_columns, n_rows)
    found = [(np.int32(0), np.int32(0)) for _ in range(0)]
    for cell in range(n_columns * n_rows):
        for one in range(starts[cell], starts[cell + 1]):
            i = members[one]
            for other in range(one + 1, starts[cell + 1]):
                j = members[other]
                # pairs that share several cells are met once: in the first common cell
                column = max(ranges[i, 0], ranges[j, 0])
                row = max(ranges[i, 2], ranges[j, 2])
                if row * n_columns + column == cell and _do_meet(
                    points, segments[i, 0], segments[i, 1], segments[j, 0], segments[j, 1]
                ):
                    found.append((i, j))
    pairs = np.empty((len(found), 2), dtype=np.int32)
    for k in range(len(found)):
        pairs[k, 0], pairs[k, 1] = found[k]
    return pairs
