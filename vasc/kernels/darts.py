"""Dart throwing for sources, thinned to the cells that no vein covers yet.

Darts are a Poisson process, uniform over the blade. A cell that lies wholly
within the exclusion radius of one node can hold no source, so that no dart
need be thrown there: the darts on the other cells are again a Poisson process
with the same density, and the sources have the same distribution.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.hash_grid import SLACK, HashGrid, any_within, cell_of, insert, squared_distance
from vasc.kernels.polygon import EdgeGrid, is_inside

CELLS_PER_RADIUS = 4.0


class DartCells(NamedTuple):
    """Square cells over the blade, and the list of those that no node covers."""

    corner: NDArray[np.float64]
    """Lower corner x, y and side of a cell, in material units, shape (3,)."""
    shape: NDArray[np.int64]
    """Columns and rows, shape (2,)."""
    uncovered: NDArray[np.int32]
    """Cells that may still hold a source: the first ``n_uncovered[0]``."""
    place: NDArray[np.int32]
    """Per cell: its place in ``uncovered``, -1 if covered or off the blade."""
    n_uncovered: NDArray[np.int64]
    """Number of uncovered cells, shape (1,)."""


def dart_cells(
    touched: NDArray[np.uint8], corner: tuple[float, float], side: float, columns: int
) -> DartCells:
    """Make the cells of a blade from a raster of the cells it touches (rows first)."""
    cells = np.flatnonzero(touched).astype(np.int32)
    place = np.full(len(touched), -1, dtype=np.int32)
    place[cells] = np.arange(len(cells), dtype=np.int32)
    return DartCells(
        corner=np.array([corner[0], corner[1], side]),
        shape=np.array([columns, len(touched) // columns], dtype=np.int64),
        uncovered=cells,
        place=place,
        n_uncovered=np.array([len(cells)], dtype=np.int64),
    )


@unowned
def cover(
    cells: DartCells, nodes: NDArray[np.float64], start: int, stop: int, radius: float
) -> None:
    """Take the cells out that lie wholly within ``radius`` of one of the nodes."""
    x0, y0, side = cells.corner[0], cells.corner[1], cells.corner[2]
    columns, rows = cells.shape[0], cells.shape[1]
    limit = radius * radius * (1.0 - SLACK)
    for v in range(start, stop):
        x, y = nodes[v, 0], nodes[v, 1]
        first_row = max(cell_of(y - radius, y0, side, rows), 0)
        last_row = cell_of(y + radius, y0, side, rows)
        first_column = cell_of(x - radius, x0, side, columns)
        last_column = cell_of(x + radius, x0, side, columns)
        for row in range(first_row, last_row + 1):
            low_y = y0 + row * side - y
            far_y = max(-low_y, low_y + side)
            for column in range(first_column, last_column + 1):
                cell = row * columns + column
                place = cells.place[cell]
                if place < 0:
                    continue
                low_x = x0 + column * side - x
                far_x = max(-low_x, low_x + side)
                if far_x * far_x + far_y * far_y < limit:
                    cells.n_uncovered[0] -= 1
                    last = cells.uncovered[cells.n_uncovered[0]]
                    cells.uncovered[place] = last
                    cells.place[last] = place
                    cells.place[cell] = -1


@compiled
def aim(cells: DartCells, uniforms: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn uniform numbers, shape (n, 3), into darts on uncovered cells, shape (n, 2)."""
    n_darts = uniforms.shape[0]
    darts = np.empty((n_darts, 2))
    side = cells.corner[2]
    for d in range(n_darts):
        cell = cells.uncovered[int(uniforms[d, 0] * cells.n_uncovered[0])]
        darts[d, 0] = cells.corner[0] + (cell % cells.shape[0] + uniforms[d, 1]) * side
        darts[d, 1] = cells.corner[1] + (cell // cells.shape[0] + uniforms[d, 2]) * side
    return darts


@unowned
def live_within(
    grid: HashGrid,
    sources: NDArray[np.float64],
    is_live: NDArray[np.uint8],
    x: float,
    y: float,
    limit: float,
) -> bool:
    """Tell whether a live source lies at a squared distance of at most ``limit``."""
    radius = np.sqrt(limit) * (1.0 + SLACK)
    columns, rows = grid.shapes[0, 0], grid.shapes[0, 1]
    x0, y0, side = grid.corner[0], grid.corner[1], grid.corner[2]
    first_column = cell_of(x - radius, x0, side, columns)
    last_column = cell_of(x + radius, x0, side, columns)
    for row in range(cell_of(y - radius, y0, side, rows), cell_of(y + radius, y0, side, rows) + 1):
        for column in range(first_column, last_column + 1):
            s = grid.head[row * columns + column]
            while s >= 0:
                if is_live[s] and squared_distance(sources[s, 0], sources[s, 1], x, y) <= limit:
                    return True
                s = grid.following[s]
    return False


@unowned
def throw(
    darts: NDArray[np.float64],
    outline: EdgeGrid,
    outline_size: float,
    node_grid: HashGrid,
    nodes: NDArray[np.float64],
    source_grid: HashGrid,
    sources: NDArray[np.float64],
    is_live: NDArray[np.uint8],
    n_sources: int,
    source_limit: float,
    node_limit: float,
) -> int:
    """Test darts one after the other; those that find room become sources.

    Parameters
    ----------
    darts : ndarray of shape (n, 2), float64
        Candidate positions, in material units.
    outline : EdgeGrid
        The initial outline.
    outline_size : float
        Size of the outline in material coordinates, 1 for the initial outline.
    node_grid, nodes, source_grid, sources, is_live
        Veins and sources there are; accepted darts are added to the last three,
        which must have room for them.
    n_sources : int
        Sources there were before.
    source_limit, node_limit : float
        Squared distances; a dart at most that far from a live source or a node is refused.

    Returns
    -------
    int
        Sources there are now.
    """
    for d in range(len(darts)):
        x, y = darts[d, 0], darts[d, 1]
        if not is_inside(outline, x / outline_size, y / outline_size):
            continue
        if live_within(source_grid, sources, is_live, x, y, source_limit):
            continue
        if any_within(node_grid, nodes, x, y, node_limit):
            continue
        sources[n_sources, 0] = x
        sources[n_sources, 1] = y
        is_live[n_sources] = 1
        insert(source_grid, sources, n_sources, n_sources + 1)
        n_sources += 1
    return n_sources


@compiled
def keep_apart(points: NDArray[np.float64], grid: HashGrid, limit: float) -> NDArray[np.int64]:
    """Go through points in order and keep each that is farther than ``limit`` (squared) from all.

    ``grid`` must be empty and have room for all points.
    """
    kept = np.empty(len(points), dtype=np.int64)
    n_kept = 0
    for d in range(len(points)):
        if not any_within(grid, points, points[d, 0], points[d, 1], limit):
            insert(grid, points, d, d + 1)
            kept[n_kept] = d
            n_kept += 1
    return kept[:n_kept]
