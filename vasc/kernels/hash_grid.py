"""Points in a grid with a pyramid of occupied cells above it: insert, and search by distance.

The grid has square cells; each holds a list of the points in it. Level 0 of the
pyramid is the grid; a cell of level k + 1 covers two by two cells of level k and
is occupied when one of them is. Cells at the rim reach to infinity, so that a
point outside the box is found like any other.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import unowned

STACK_SIZE = 512
SLACK = 1e-9
"""Relative widening of cell bounds, far above rounding: a bound only ever errs to the safe side."""


class HashGrid(NamedTuple):
    """A grid over points whose coordinates are kept elsewhere."""

    corner: NDArray[np.float64]
    """Lower corner x, y and side of a cell, shape (3,)."""
    shapes: NDArray[np.int64]
    """Per level: columns, rows, first cell, shape (n_levels, 3)."""
    occupied: NDArray[np.uint8]
    """Per cell of every level: 1 if a point is in it."""
    head: NDArray[np.int32]
    """Per cell of level 0: the newest point in it, -1 if none."""
    following: NDArray[np.int32]
    """Per point: the next older point in its cell, -1 if none; has the points' capacity."""
    stack: NDArray[np.int64]
    """Room for a search, shape (STACK_SIZE, 3)."""
    stack_bounds: NDArray[np.float64]
    """Room for a search, shape (STACK_SIZE,)."""


def hash_grid(box: tuple[float, float, float, float], side: float, capacity: int) -> HashGrid:
    """Make an empty grid of cells of a given side over a box.

    Parameters
    ----------
    box : tuple of float
        Lower x, lower y, upper x, upper y.
    side : float
        Side of a cell; widened when the grid would have over four million cells.
    capacity : int
        Number of points there is room for.

    Returns
    -------
    HashGrid
        A grid without points.
    """
    width, height = max(box[2] - box[0], side), max(box[3] - box[1], side)
    while (width / side) * (height / side) > 4e6:
        side *= 1.5
    columns, rows = int(width / side) + 1, int(height / side) + 1
    shapes = [(columns, rows, 0)]
    while columns > 1 or rows > 1:
        first = shapes[-1][2] + columns * rows
        columns, rows = (columns + 1) // 2, (rows + 1) // 2
        shapes.append((columns, rows, first))
    n_cells = shapes[-1][2] + columns * rows
    return HashGrid(
        corner=np.array([box[0], box[1], side]),
        shapes=np.array(shapes, dtype=np.int64),
        occupied=np.zeros(n_cells, dtype=np.uint8),
        head=np.full(shapes[0][0] * shapes[0][1], -1, dtype=np.int32),
        following=np.full(capacity, -1, dtype=np.int32),
        stack=np.zeros((STACK_SIZE, 3), dtype=np.int64),
        stack_bounds=np.zeros(STACK_SIZE),
    )


@unowned
def cell_of(value: float, low: float, side: float, n_cells: int) -> int:
    """Give the row or column of the cell that holds a coordinate, the rim for what is outside."""
    cell = (value - low) / side
    if not cell > 0.0:
        return 0
    if cell >= n_cells:
        return n_cells - 1
    return int(cell)


@unowned
def _insert_one(grid: HashGrid, points: NDArray[np.float64], point: int) -> None:
    """Put one point into its cell and mark the cells above."""
    columns, rows = grid.shapes[0, 0], grid.shapes[0, 1]
    column = cell_of(points[point, 0], grid.corner[0], grid.corner[2], columns)
    row = cell_of(points[point, 1], grid.corner[1], grid.corner[2], rows)
    cell = row * columns + column
    grid.following[point] = grid.head[cell]
    grid.head[cell] = point
    for level in range(grid.shapes.shape[0]):
        cell = grid.shapes[level, 2] + row * grid.shapes[level, 0] + column
        if grid.occupied[cell] != 0:
            break
        grid.occupied[cell] = 1
        row >>= 1
        column >>= 1


@unowned
def insert(grid: HashGrid, points: NDArray[np.float64], start: int, stop: int) -> None:
    """Put the points ``start`` to ``stop`` into the grid."""
    for point in range(start, stop):
        _insert_one(grid, points, point)


@unowned
def insert_chosen(grid: HashGrid, points: NDArray[np.float64], chosen: NDArray[np.int32]) -> None:
    """Put some points into the grid, given by their ids."""
    for point in chosen:
        _insert_one(grid, points, point)


@unowned
def cell_bounds(
    grid: HashGrid, level: int, column: int, row: int
) -> tuple[float, float, float, float]:
    """Give a cell's box, a little widened; infinite at the rim."""
    side = grid.corner[2] * (1 << level)
    slack = SLACK * side
    low_x = grid.corner[0] + column * side - slack
    low_y = grid.corner[1] + row * side - slack
    high_x = low_x + side + 2.0 * slack
    high_y = low_y + side + 2.0 * slack
    if column == 0:
        low_x = -np.inf
    if row == 0:
        low_y = -np.inf
    if column == grid.shapes[level, 0] - 1:
        high_x = np.inf
    if row == grid.shapes[level, 1] - 1:
        high_y = np.inf
    return low_x, low_y, high_x, high_y


@unowned
def box_distance(
    low_x: float, low_y: float, high_x: float, high_y: float, x: float, y: float
) -> float:
    """Give the squared distance from a point to a box, 0 inside."""
    dx = 0.0
    if x < low_x:
        dx = low_x - x
    elif x > high_x:
        dx = x - high_x
    dy = 0.0
    if y < low_y:
        dy = low_y - y
    elif y > high_y:
        dy = y - high_y
    return dx * dx + dy * dy


@unowned
def squared_distance(ax: float, ay: float, bx: float, by: float) -> float:
    """Give the squared distance of two points; the same bytes in either order."""
    dx = ax - bx
    dy = ay - by
    return dx * dx + dy * dy


@unowned
def push_children(
    grid: HashGrid, level: int, column: int, row: int, x: float, y: float, top: int
) -> int:
    """Put the occupied cells below a cell on the stack, the nearest to a point last."""
    below = level - 1
    columns, rows, first = grid.shapes[below, 0], grid.shapes[below, 1], grid.shapes[below, 2]
    base = top
    for child_row in range(2 * row, min(2 * row + 2, rows)):
        for child_column in range(2 * column, min(2 * column + 2, columns)):
            if grid.occupied[first + child_row * columns + child_column] == 0:
                continue
            low_x, low_y, high_x, high_y = cell_bounds(grid, below, child_column, child_row)
            bound = box_distance(low_x, low_y, high_x, high_y, x, y)
            place = top
            while place > base and grid.stack_bounds[place - 1] < bound:
                grid.stack_bounds[place] = grid.stack_bounds[place - 1]
                grid.stack[place, 0] = grid.stack[place - 1, 0]
                grid.stack[place, 1] = grid.stack[place - 1, 1]
                grid.stack[place, 2] = grid.stack[place - 1, 2]
                place -= 1
            grid.stack_bounds[place] = bound
            grid.stack[place, 0] = below
            grid.stack[place, 1] = child_column
            grid.stack[place, 2] = child_row
            top += 1
    return top


@unowned
def push_root(grid: HashGrid) -> int:
    """Begin a search at the top of the pyramid; gives the height of the stack."""
    level = grid.shapes.shape[0] - 1
    if grid.occupied[grid.shapes[level, 2]] == 0:
        return 0
    grid.stack[0, 0] = level
    grid.stack[0, 1] = 0
    grid.stack[0, 2] = 0
    grid.stack_bounds[0] = 0.0
    return 1


@unowned
def nearest(grid: HashGrid, points: NDArray[np.float64], x: float, y: float) -> tuple[int, float]:
    """Give the nearest point (of equals the lowest id) and its squared distance, or -1."""
    best = -1
    best_distance = np.inf
    top = push_root(grid)
    while top > 0:
        top -= 1
        if grid.stack_bounds[top] > best_distance:
            continue
        level, column, row = grid.stack[top, 0], grid.stack[top, 1], grid.stack[top, 2]
        if level > 0:
            top = push_children(grid, level, column, row, x, y, top)
            continue
        point = grid.head[row * grid.shapes[0, 0] + column]
        while point >= 0:
            distance = squared_distance(points[point, 0], points[point, 1], x, y)
            if distance < best_distance or (distance == best_distance and point < best):
                best = point
                best_distance = distance
            point = grid.following[point]
    return best, best_distance


@unowned
def any_within(
    grid: HashGrid, points: NDArray[np.float64], x: float, y: float, limit: float
) -> bool:
    """Tell whether a point lies at a squared distance of at most ``limit``."""
    radius = np.sqrt(limit) * (1.0 + SLACK)
    columns, rows = grid.shapes[0, 0], grid.shapes[0, 1]
    x0, y0, side = grid.corner[0], grid.corner[1], grid.corner[2]
    first_column = cell_of(x - radius, x0, side, columns)
    last_column = cell_of(x + radius, x0, side, columns)
    first_row = cell_of(y - radius, y0, side, rows)
    last_row = cell_of(y + radius, y0, side, rows)
    for row in range(first_row, last_row + 1):
        for column in range(first_column, last_column + 1):
            point = grid.head[row * columns + column]
            while point >= 0:
                if squared_distance(points[point, 0], points[point, 1], x, y) <= limit:
                    return True
                point = grid.following[point]
    return False
