"""Where the largest empty circle can be: cells with room, and the sites around them."""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.hash_grid import SLACK, HashGrid, any_within, cell_of, nearest
from vasc.kernels.polygon import EdgeGrid, is_inside

HALVINGS = 3
"""How often a cell is quartered before it is taken for open."""


@unowned
def cover(
    cells: NDArray[np.uint8],
    corner: NDArray[np.float64],
    columns: int,
    sites: NDArray[np.float64],
    radius: float,
) -> None:
    """Clear the marks of all cells that lie wholly within ``radius`` of a site.

    Parameters
    ----------
    cells : ndarray of shape (rows * columns,), uint8
        Marks, rows first.
    corner : ndarray of shape (3,), float64
        Lower corner x, y and side of a cell.
    columns : int
        Cells in a row.
    sites : ndarray of shape (n, 2), float64
        Nodes and sources.
    radius : float
        In the unit of the sites.
    """
    rows = len(cells) // columns
    x0, y0, side = corner[0], corner[1], corner[2]
    reach = radius - side * np.sqrt(0.5) * (1.0 + SLACK)
    if reach <= 0.0:
        return
    for i in range(len(sites)):
        x, y = sites[i, 0], sites[i, 1]
        first = cell_of(y - reach, y0, side, rows)
        last = cell_of(y + reach, y0, side, rows)
        for row in range(first, last + 1):
            dy = y0 + (row + 0.5) * side - y
            square = reach * reach - dy * dy
            if square <= 0.0:
                continue
            half = np.sqrt(square)
            begin = int(np.ceil((x - half - x0) / side - 0.5))
            end = int(np.floor((x + half - x0) / side - 0.5))
            for column in range(max(0, begin), min(columns - 1, end) + 1):
                cells[row * columns + column] = 0


@compiled
def clearances(
    grid: HashGrid, sites: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Give the distance of every point to the nearest site, infinite without sites, shape (k,)."""
    found = np.empty(len(points))
    for k in range(len(points)):
        _, square = nearest(grid, sites, points[k, 0], points[k, 1])
        found[k] = np.sqrt(square)
    return found


@compiled
def open_cells(
    centres: NDArray[np.float64],
    side: float,
    grid: HashGrid,
    sites: NDArray[np.float64],
    outline: EdgeGrid,
    outline_size: float,
    margin_grid: HashGrid,
    margin: NDArray[np.float64],
    spacing: float,
    limit: float,
) -> NDArray[np.float64]:
    """Give an upper bound of the clearance in each cell where it may exceed a limit, else 0.

    A cell is quartered again and again; parts that lie within the limit of a site,
    or off the blade, are left out.

    Parameters
    ----------
    centres : ndarray of shape (k, 2), float64
        Centres of the cells.
    side : float
        Their side.
    grid, sites : HashGrid, ndarray of shape (n, 2)
        The sites, indexed.
    outline, outline_size : EdgeGrid, float
        The blade.
    margin_grid, margin : HashGrid, ndarray of shape (m, 2)
        Points of the margin, indexed, at most ``spacing`` apart.
    spacing, limit : float
        In the unit of the sites.

    Returns
    -------
    ndarray of shape (k,), float64
    """
    bounds = np.zeros(len(centres))
    stack = np.empty((4 * HALVINGS + 4, 3))
    for k in range(len(centres)):
        stack[0] = centres[k, 0], centres[k, 1], 0.0
        top = 1
        while top > 0:
            top -= 1
            x, y, depth = stack[top, 0], stack[top, 1], stack[top, 2]
            half = 0.5 * side / (1 << int(depth))
            reach = half * np.sqrt(2.0) * (1.0 + SLACK)
            _, square = nearest(grid, sites, x, y)
            bound = np.sqrt(square) + reach
            if bound <= limit:
                continue
            near = reach + 0.5 * spacing
            if not is_inside(outline, x / outline_size, y / outline_size) and not any_within(
                margin_grid, margin, x, y, near * near
            ):
                continue
            if depth == HALVINGS:
                bounds[k] = max(bounds[k], bound)
                continue
            for i in range(4):
                stack[top, 0] = x + (half if i % 2 else -half) * 0.5
                stack[top, 1] = y + (half if i // 2 else -half) * 0.5
                stack[top, 2] = depth + 1.0
                top += 1
    return bounds


@compiled
def are_near(
    grid: HashGrid, centres: NDArray[np.float64], sites: NDArray[np.float64], radius: float
) -> NDArray[np.bool_]:
    """Tell which sites are within ``radius`` of one of the centres in the grid, shape (n,)."""
    found = np.empty(len(sites), dtype=np.bool_)
    for i in range(len(sites)):
        found[i] = any_within(grid, centres, sites[i, 0], sites[i, 1], radius * radius)
    return found
