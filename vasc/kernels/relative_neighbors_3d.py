"""Exact relative neighbours in space of points among points, each asked for once at its birth.

Two points x and v are relative neighbours when no third point u lies in their open
lune: nearer to x, and nearer to v, than they are to each other. A lead of less than
``MARGIN`` of the squared distance is a tie, and ties keep a pair. Pairs are only born
with a new point and only lost to one, so that old points are never asked again.

References
----------
.. [1] A. Runions, "Modeling biological patterns using the space colonization
   algorithm", MSc thesis, University of Calgary, 2008, sections 4.3 and 6.2.1.
"""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.octree import (
    Octree,
    box_distance,
    push_children,
    push_root,
    squared_distance,
)

MARGIN = 1e-9
"""What a point must be nearer by, in squared distances and relative to them, to be in a lune."""

PRUNED = 4.0 * MARGIN
"""The same for whole cells: more than the margin and rounding together, so that none is missed."""

MAX_BLOCKERS = 32
"""Points that a search tries first; more would cost more than they save."""


@unowned
def between(points: NDArray[np.float64], a: int, b: int) -> float:
    """Give the squared distance of two of the points."""
    return squared_distance(
        points[a, 0], points[a, 1], points[a, 2], points[b, 0], points[b, 1], points[b, 2]
    )


@unowned
def _is_behind(
    tree: Octree,
    cell: int,
    bound: float,
    x: float,
    y: float,
    z: float,
    blockers: NDArray[np.float64],
    k: int,
) -> bool:
    """Tell whether blocker k surely lies in the lune of (x, y, z) and any point of a cell.

    ``bound`` is the squared distance to the cell's box; a row of ``blockers`` is a
    displacement and its square.
    """
    if blockers[k, 3] >= bound * (1.0 - PRUNED):
        return False
    # the lead of the blocker is linear in the place: |q|^2 - |q - e|^2 = 2 q e - |e|^2
    least = -blockers[k, 3]
    far = 0.0
    for axis in range(3):
        here = x if axis == 0 else (y if axis == 1 else z)
        low = tree.boxes[cell, axis] - here
        high = tree.boxes[cell, axis + 3] - here
        least += 2.0 * blockers[k, axis] * (low if blockers[k, axis] > 0.0 else high)
        far += max(low * low, high * high)
    return least > PRUNED * far


@unowned
def _is_blocked(
    points: NDArray[np.float64],
    v: int,
    limit: float,
    blockers: NDArray[np.float64],
    blocker_ids: NDArray[np.int32],
    n_blockers: int,
) -> bool:
    """Tell whether a blocker lies in the lune of point v, ``limit`` its size less the margin."""
    for k in range(n_blockers):
        if blockers[k, 3] < limit and between(points, blocker_ids[k], v) < limit:
            return True
    return False


@unowned
def _add_blocker(
    points: NDArray[np.float64],
    x: int,
    w: int,
    blockers: NDArray[np.float64],
    blocker_ids: NDArray[np.int32],
    n_blockers: int,
) -> int:
    """Let searches for x try point w first; gives the number of such points."""
    if n_blockers == MAX_BLOCKERS or w == x:
        return n_blockers
    for k in range(n_blockers):
        if blocker_ids[k] == w:
            return n_blockers
    for axis in range(3):
        blockers[n_blockers, axis] = points[w, axis] - points[x, axis]
    blockers[n_blockers, 3] = between(points, w, x)
    blocker_ids[n_blockers] = w
    return n_blockers + 1


@unowned
def has_open_lune(tree: Octree, points: NDArray[np.float64], x: int, v: int, limit: float) -> bool:
    """Tell whether no point at all lies in the lune of two, ``limit`` its size less the margin."""
    ax, ay, az = points[x, 0], points[x, 1], points[x, 2]
    bx, by, bz = points[v, 0], points[v, 1], points[v, 2]
    # what excludes v is most often near v: what is near x has been tried
    top = push_root(tree, bx, by, bz)
    while top > 0:
        top -= 1
        if tree.stack_bounds[top] >= limit:
            continue
        cell, level = tree.stack[top, 0], tree.stack[top, 1]
        if box_distance(tree, cell, ax, ay, az) >= limit:
            continue
        if level > 0:
            top = push_children(tree, cell, level, bx, by, bz, top)
            continue
        u = tree.heads[cell]
        while u >= 0:
            # x and v are as far from each other as they are: neither is in the lune
            if between(points, u, x) < limit and between(points, u, v) < limit:
                return False
            u = tree.following[u]
    return True


@unowned
def _survivors(
    tree: Octree,
    points: NDArray[np.float64],
    x: int,
    blockers: NDArray[np.float64],
    blocker_ids: NDArray[np.int32],
    n_blockers: int,
    found: NDArray[np.int32],
) -> tuple[int, int]:
    """Find all points that no blocker excludes, and more blockers on the way.

    Gives the number of points, and that of blockers; the search ends early when
    ``found`` has no room for more.
    """
    n_found = 0
    px, py, pz = points[x, 0], points[x, 1], points[x, 2]
    top = push_root(tree, px, py, pz)
    while top > 0:
        top -= 1
        cell, level, bound = tree.stack[top, 0], tree.stack[top, 1], tree.stack_bounds[top]
        is_behind = False
        for k in range(n_blockers):
            if _is_behind(tree, cell, bound, px, py, pz, blockers, k):
                is_behind = True
                break
        if is_behind:
            continue
        if level > 0:
            top = push_children(tree, cell, level, px, py, pz, top)
            continue
        v = tree.heads[cell]
        while v >= 0:
            limit = between(points, x, v) * (1.0 - MARGIN)
            if v != x and not _is_blocked(points, v, limit, blockers, blocker_ids, n_blockers):
                if n_found == len(found):
                    return n_found, n_blockers
                found[n_found] = v
                n_found += 1
                n_blockers = _add_blocker(points, x, v, blockers, blocker_ids, n_blockers)
            v = tree.following[v]
    return n_found, n_blockers


@unowned
def _relatives(
    tree: Octree,
    points: NDArray[np.float64],
    x: int,
    below: int,
    blockers: NDArray[np.float64],
    blocker_ids: NDArray[np.int32],
    n_blockers: int,
    found: NDArray[np.int32],
) -> int:
    """Find the relative neighbours of x with ids less than ``below``; gives their number.

    Gives -1 when ``found`` may have been too small.
    """
    n_found, n_blockers = _survivors(tree, points, x, blockers, blocker_ids, n_blockers, found)
    if n_found == len(found):
        return -1
    n_kept = 0
    for k in range(n_found):
        v = found[k]
        if v >= below:
            continue
        limit = between(points, x, v) * (1.0 - MARGIN)
        if _is_blocked(points, v, limit, blockers, blocker_ids, n_blockers):
            continue
        if not has_open_lune(tree, points, x, v, limit):
            continue
        place = n_kept
        while place > 0 and found[place - 1] > v:
            found[place] = found[place - 1]
            place -= 1
        found[place] = v
        n_kept += 1
    return n_kept


@compiled
def relatives(tree: Octree, points: NDArray[np.float64], x: int) -> NDArray[np.int32]:
    """Give all relative neighbours of a point.

    Parameters
    ----------
    tree : Octree
        Over all points, x among them.
    points : ndarray of shape (capacity, 3), float64
        Coordinates.
    x : int
        Id of the point.

    Returns
    -------
    ndarray of shape (n,), int32
        Ids, ascending; empty for a point alone.
    """
    blockers = np.empty((MAX_BLOCKERS, 4))
    blocker_ids = np.empty(MAX_BLOCKERS, dtype=np.int32)
    found = np.empty(64, dtype=np.int32)
    n_found = _relatives(tree, points, x, len(points), blockers, blocker_ids, 0, found)
    while n_found < 0:
        found = np.empty(2 * len(found), dtype=np.int32)
        n_found = _relatives(tree, points, x, len(points), blockers, blocker_ids, 0, found)
    return found[:n_found].copy()


@unowned
def _seed(
    points: NDArray[np.float64],
    x: int,
    parent: int,
    pairs: NDArray[np.int32],
    blockers: NDArray[np.float64],
    blocker_ids: NDArray[np.int32],
) -> int:
    """Let the search for x begin with its parent and what that grew toward."""
    if parent < 0:
        return 0
    n_blockers = _add_blocker(points, x, parent, blockers, blocker_ids, 0)
    for row in range(len(pairs)):
        if pairs[row, 0] == parent:
            n_blockers = _add_blocker(points, x, pairs[row, 1], blockers, blocker_ids, n_blockers)
        elif pairs[row, 1] == parent:
            n_blockers = _add_blocker(points, x, pairs[row, 0], blockers, blocker_ids, n_blockers)
    return n_blockers


@compiled
def relatives_of_new(
    tree: Octree,
    points: NDArray[np.float64],
    parents: NDArray[np.int32],
    pairs: NDArray[np.int32],
    start: int,
    stop: int,
) -> NDArray[np.int32]:
    """Give every pair of relative neighbours that has one of the newest points in it.

    Parameters
    ----------
    tree : Octree
        Over the points up to ``stop``, and no others.
    points : ndarray of shape (capacity, 3), float64
        Coordinates.
    parents : ndarray of shape (capacity,), int32
        Per point another one to begin the search with, -1 for none.
    pairs : ndarray of shape (n, 2), int32
        Pairs whose ends to begin with, too, where one of them is a parent. Neither
        has an influence on the result.
    start, stop : int
        Ids of the new points, the last ones there are.

    Returns
    -------
    ndarray of shape (m, 2), int32
        Rows (newer point, older point), ascending; every pair once.
    """
    blockers = np.empty((MAX_BLOCKERS, 4))
    blocker_ids = np.empty(MAX_BLOCKERS, dtype=np.int32)
    found = np.empty(64, dtype=np.int32)
    rows = np.empty((4 * (stop - start) + 16, 2), dtype=np.int32)
    n_rows = 0
    for x in range(start, stop):
        n_found = -1
        while n_found < 0:
            n_blockers = _seed(points, x, parents[x], pairs, blockers, blocker_ids)
            n_found = _relatives(tree, points, x, x, blockers, blocker_ids, n_blockers, found)
            if n_found < 0:
                found = np.empty(2 * len(found), dtype=np.int32)
        if n_rows + n_found > len(rows):
            longer = np.empty((2 * (n_rows + n_found), 2), dtype=np.int32)
            longer[:n_rows] = rows[:n_rows]
            rows = longer
        for k in range(n_found):
            rows[n_rows, 0], rows[n_rows, 1] = x, found[k]
            n_rows += 1
    return rows[:n_rows].copy()
