"""Lunes: which node keeps another out of a source's relative neighbourhood."""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import inlined, unowned
from vasc.kernels.hash_grid import (
    SLACK,
    HashGrid,
    box_distance,
    cell_bounds,
    cell_of,
    push_children,
    squared_distance,
)


@unowned
def excludes(u: int, u_distance: float, v: int, v_distance: float, between: float) -> bool:
    """Tell whether node u excludes node v from a source's neighbourhood.

    ``u_distance`` and ``v_distance`` are squared distances to the source,
    ``between`` the squared distance of the two nodes.
    """
    if u_distance > v_distance or (u_distance == v_distance and u >= v):
        return False
    return between < v_distance or between == 0.0


@inlined
def _witness_below(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    level: int,
    column: int,
    row: int,
    x: float,
    y: float,
    v: int,
    v_distance: float,
) -> int:
    """Look for a node in the lune in one cell of the pyramid and all below it."""
    vx, vy = nodes[v, 0], nodes[v, 1]
    limit = v_distance * (1.0 + SLACK) * (1.0 + SLACK)
    grid.stack[0, 0], grid.stack[0, 1], grid.stack[0, 2] = level, column, row
    top = 1
    while top > 0:
        top -= 1
        level, column, row = grid.stack[top, 0], grid.stack[top, 1], grid.stack[top, 2]
        low_x, low_y, high_x, high_y = cell_bounds(grid, level, column, row)
        if box_distance(low_x, low_y, high_x, high_y, x, y) > limit:
            continue
        if box_distance(low_x, low_y, high_x, high_y, vx, vy) > limit:
            continue
        if level > 0:
            # the witness is most often near v, so that is where to look first
            top = push_children(grid, level, column, row, vx, vy, top)
            continue
        u = grid.head[row * grid.shapes[0, 0] + column]
        while u >= 0:
            if u != v:
                ux, uy = nodes[u, 0], nodes[u, 1]
                u_distance = squared_distance(ux, uy, x, y)
                between = squared_distance(ux, uy, vx, vy)
                if excludes(u, u_distance, v, v_distance, between):
                    return u
            u = grid.following[u]
    return -1


@unowned
def lune_witness(
    grid: HashGrid, nodes: NDArray[np.float64], x: float, y: float, v: int, v_distance: float
) -> int:
    """Give a node that excludes node v from the neighbourhood of the source at (x, y), or -1.

    Such a node lies in the lune: nearer to the source than v, and nearer to v than
    the source is. The search begins in the few cells as large as the lune.
    """
    vx, vy = nodes[v, 0], nodes[v, 1]
    radius = np.sqrt(v_distance) * (1.0 + SLACK)
    level = 0
    side = grid.corner[2]
    while side < radius and level < grid.shapes.shape[0] - 1:
        side *= 2.0
        level += 1
    columns, rows, first = grid.shapes[level, 0], grid.shapes[level, 1], grid.shapes[level, 2]
    x0, y0 = grid.corner[0], grid.corner[1]
    first_column = cell_of(max(x, vx) - radius, x0, side, columns)
    last_column = cell_of(min(x, vx) + radius, x0, side, columns)
    first_row = cell_of(max(y, vy) - radius, y0, side, rows)
    last_row = cell_of(min(y, vy) + radius, y0, side, rows)
    for row in range(first_row, last_row + 1):
        for column in range(first_column, last_column + 1):
            if grid.occupied[first + row * columns + column] != 0:
                u = _witness_below(grid, nodes, level, column, row, x, y, v, v_distance)
                if u >= 0:
                    return u
    return -1
