"""Where the largest empty circle can be: cells with room, and the sites around them."""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.hash_grid import SLACK, HashGrid, any_within, cell_of, nearest


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
def are_near(
    grid: HashGrid, centres: NDArray[np.float64], sites: NDArray[np.float64], radius: float
) -> NDArray[np.bool_]:
    """Tell which sites are within ``radius`` of one of the centres in the grid, shape (n,)."""
    found = np.empty(len(sites), dtype=np.bool_)
    for i in range(len(sites)):
        found[i] = any_within(grid, centres, sites[i, 0], sites[i, 1], radius * radius)
    return found
