"""Points in space in a tree of cells that grows with them: insert, and search by distance.

A cell of level 0 is a cube of a given side; a cell of level k + 1 covers two by two
by two cells of level k. Only cells that hold points exist. The root is raised when a
point falls outside of it, so that nothing need be known of a stem's final height.
Every cell keeps the tight box of its points: what lies outside of all boxes is not
there, and bounds by boxes hold exactly, wherever the walls of the cells are.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import unowned

MAX_LEVEL = 31
MIDDLE = 1 << (MAX_LEVEL - 1)
"""The column, row and layer of the cell at the origin: none of a cell is ever negative."""

STACK_SIZE = 8 * (MAX_LEVEL + 1)
"""A search that goes down leaves at most seven siblings on every level."""

MOST_NEW = 2 * MAX_LEVEL + 2
"""Cells that one point can need: a path down, and a root raised to the top."""


class Octree(NamedTuple):
    """Cells over points whose coordinates are kept elsewhere."""

    side: float
    """Side of a cell of level 0."""
    root: NDArray[np.int64]
    """The root (-1 if there is none), its level, column, row and layer, and the number of cells."""
    children: NDArray[np.int32]
    """Per cell above level 0: the cells below it, -1 where none is, shape (capacity, 8)."""
    boxes: NDArray[np.float64]
    """Per cell: lowest x, y, z and highest x, y, z of its points, shape (capacity, 6)."""
    heads: NDArray[np.int32]
    """Per cell of level 0: the newest point in it, -1 if none."""
    following: NDArray[np.int32]
    """Per point: the next older point in its cell, -1 if none."""
    stack: NDArray[np.int64]
    """Room for a search, cells and their levels, shape (STACK_SIZE, 2)."""
    stack_bounds: NDArray[np.float64]
    """Room for a search, shape (STACK_SIZE,)."""


def octree(side: float, n_points: int = 64, n_cells: int = 2 * MOST_NEW) -> Octree:
    """Make a tree without points, with cells of a given side and room for points and cells."""
    return Octree(
        side=float(side),
        root=np.array([-1, 0, 0, 0, 0, 0], dtype=np.int64),
        children=np.full((n_cells, 8), -1, dtype=np.int32),
        boxes=np.empty((n_cells, 6)),
        heads=np.full(n_cells, -1, dtype=np.int32),
        following=np.full(n_points, -1, dtype=np.int32),
        stack=np.zeros((STACK_SIZE, 2), dtype=np.int64),
        stack_bounds=np.zeros(STACK_SIZE),
    )


def enlarged(old: Octree, n_points: int, n_cells: int) -> Octree:
    """Give a copy with room for so many points and cells, at least."""
    n_old, n_old_points = len(old.heads), len(old.following)
    new = octree(old.side, max(n_points, n_old_points), max(n_cells, n_old))
    new.root[:] = old.root
    new.children[:n_old] = old.children
    new.boxes[:n_old] = old.boxes
    new.heads[:n_old] = old.heads
    new.following[:n_old_points] = old.following
    return new


@unowned
def _number(value: float, side: float) -> int:
    """Give the column, row or layer of a coordinate; the last one for what is too far."""
    cell = value / side + MIDDLE
    if not cell > 0.0:
        return 0
    if cell >= 2.0 * MIDDLE:
        return 2 * MIDDLE - 1
    return int(cell)


@unowned
def _new_cell(tree: Octree) -> int:
    """Make a cell without points."""
    cell = tree.root[5]
    tree.root[5] += 1
    for axis in range(3):
        tree.boxes[cell, axis] = np.inf
        tree.boxes[cell, axis + 3] = -np.inf
    return cell


@unowned
def _raise_root(tree: Octree) -> None:
    """Put a cell above the root."""
    old, level, column, row, layer = (
        tree.root[0],
        tree.root[1],
        tree.root[2],
        tree.root[3],
        tree.root[4],
    )
    cell = _new_cell(tree)
    tree.children[cell, (column & 1) + 2 * (row & 1) + 4 * (layer & 1)] = old
    for side in range(6):
        tree.boxes[cell, side] = tree.boxes[old, side]
    tree.root[0], tree.root[1] = cell, level + 1
    tree.root[2], tree.root[3], tree.root[4] = column >> 1, row >> 1, layer >> 1


@unowned
def _widen(tree: Octree, cell: int, points: NDArray[np.float64], point: int) -> None:
    """Stretch the box of a cell to a point."""
    for axis in range(3):
        value = points[point, axis]
        tree.boxes[cell, axis] = min(tree.boxes[cell, axis], value)
        tree.boxes[cell, axis + 3] = max(tree.boxes[cell, axis + 3], value)


@unowned
def _insert_one(tree: Octree, points: NDArray[np.float64], point: int) -> None:
    """Put one point into its cell, and make that and those above it if need be."""
    column = _number(points[point, 0], tree.side)
    row = _number(points[point, 1], tree.side)
    layer = _number(points[point, 2], tree.side)
    if tree.root[0] < 0:
        tree.root[0] = _new_cell(tree)
        tree.root[2], tree.root[3], tree.root[4] = column, row, layer
    while (
        column >> tree.root[1] != tree.root[2]
        or row >> tree.root[1] != tree.root[3]
        or layer >> tree.root[1] != tree.root[4]
    ):
        _raise_root(tree)
    cell = tree.root[0]
    for level in range(tree.root[1] - 1, -1, -1):
        _widen(tree, cell, points, point)
        octant = ((column >> level) & 1) + 2 * ((row >> level) & 1) + 4 * ((layer >> level) & 1)
        child = tree.children[cell, octant]
        if child < 0:
            child = _new_cell(tree)
            tree.children[cell, octant] = child
        cell = child
    _widen(tree, cell, points, point)
    tree.following[point] = tree.heads[cell]
    tree.heads[cell] = point


@unowned
def _insert_from(tree: Octree, points: NDArray[np.float64], start: int, stop: int) -> int:
    """Put points into the tree as long as it has room; gives the first one left."""
    for point in range(start, stop):
        if tree.root[5] + MOST_NEW > len(tree.heads):
            return point
        _insert_one(tree, points, point)
    return stop


def insert(tree: Octree, points: NDArray[np.float64], start: int, stop: int) -> Octree:
    """Put the points ``start`` to ``stop`` into the tree, and give it back.

    The tree is changed in place, and replaced by a larger one when it has no room.
    """
    if stop > len(tree.following):
        tree = enlarged(tree, max(stop, 2 * len(tree.following)), 0)
    while True:
        start = _insert_from(tree, points, start, stop)
        if start == stop:
            return tree
        tree = enlarged(tree, 0, 2 * len(tree.heads))


@unowned
def squared_distance(ax: float, ay: float, az: float, bx: float, by: float, bz: float) -> float:
    """Give the squared distance of two points; the same bytes in either order."""
    dx = ax - bx
    dy = ay - by
    dz = az - bz
    return dx * dx + dy * dy + dz * dz


@unowned
def box_distance(tree: Octree, cell: int, x: float, y: float, z: float) -> float:
    """Give the squared distance from a point to the box of a cell, 0 inside.

    Rounding is monotone and the terms are those of ``squared_distance``, so that this
    never exceeds the computed squared distance of a point in the cell.
    """
    boxes = tree.boxes
    dx = max(boxes[cell, 0] - x, x - boxes[cell, 3], 0.0)
    dy = max(boxes[cell, 1] - y, y - boxes[cell, 4], 0.0)
    dz = max(boxes[cell, 2] - z, z - boxes[cell, 5], 0.0)
    return dx * dx + dy * dy + dz * dz


@unowned
def push_root(tree: Octree, x: float, y: float, z: float) -> int:
    """Begin a search at the root; gives the height of the stack."""
    if tree.root[0] < 0:
        return 0
    tree.stack[0, 0], tree.stack[0, 1] = tree.root[0], tree.root[1]
    tree.stack_bounds[0] = box_distance(tree, tree.root[0], x, y, z)
    return 1


@unowned
def push_children(
    tree: Octree, cell: int, level: int, x: float, y: float, z: float, top: int
) -> int:
    """Put the cells below a cell on the stack, the nearest to a point last."""
    base = top
    for octant in range(8):
        child = tree.children[cell, octant]
        if child < 0:
            continue
        bound = box_distance(tree, child, x, y, z)
        place = top
        while place > base and tree.stack_bounds[place - 1] < bound:
            tree.stack_bounds[place] = tree.stack_bounds[place - 1]
            tree.stack[place, 0] = tree.stack[place - 1, 0]
            tree.stack[place, 1] = tree.stack[place - 1, 1]
            place -= 1
        tree.stack_bounds[place] = bound
        tree.stack[place, 0], tree.stack[place, 1] = child, level - 1
        top += 1
    return top


@unowned
def nearest_within(
    tree: Octree, points: NDArray[np.float64], x: float, y: float, z: float, limit: float
) -> tuple[int, float]:
    """Give the nearest point (of equals the lowest id) and its squared distance.

    Only points at a squared distance of at most ``limit`` count; -1 if there is none.
    """
    best = -1
    top = push_root(tree, x, y, z)
    while top > 0:
        top -= 1
        if tree.stack_bounds[top] > limit:
            continue
        cell, level = tree.stack[top, 0], tree.stack[top, 1]
        if level > 0:
            top = push_children(tree, cell, level, x, y, z, top)
            continue
        point = tree.heads[cell]
        while point >= 0:
            distance = squared_distance(
                points[point, 0], points[point, 1], points[point, 2], x, y, z
            )
            if distance < limit or (distance == limit and (best < 0 or point < best)):
                best = point
                limit = distance
            point = tree.following[point]
    return best, limit
