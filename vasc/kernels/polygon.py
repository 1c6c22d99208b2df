"""Polygons under the even-odd rule: which points are inside, which cells are touched.

A polygon is a list of rings, one after the other in ``xy``; ring ``r`` holds the
rows ``starts[r]`` to ``starts[r + 1]`` and is closed implicitly. Parts and holes
are rings alike. A point is inside when a ray toward positive x crosses an odd
number of edges; an edge counts from its lower end (included) to its upper end.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

CELLS_PER_SIDE = 256.0
"""Cells of an edge grid along the side of a square blade: few cells hold a piece of the margin."""
MOST_CELLS_PER_SIDE = 4096.0
MOST_ROW_EDGES = 8_000_000
SLACK = 1e-9
"""Widening of edges in units of cells, far above rounding, so that no touched cell is missed."""

OUTSIDE, INSIDE, BOUNDARY = 0, 1, 2


class EdgeGrid(NamedTuple):
    """The edges of a polygon sorted into rows, and a cell grid that answers most questions."""

    corner: NDArray[np.float64]
    """Lower corner x, y and side of a cell, shape (3,)."""
    shape: NDArray[np.int64]
    """Columns and rows, shape (2,)."""
    cells: NDArray[np.uint8]
    """Per cell, rows first: 0 outside, 1 inside, 2 crossed by the margin."""
    row_starts: NDArray[np.int64]
    """First edge of every row in ``edges``, shape (rows + 1,)."""
    edges: NDArray[np.float64]
    """Lower x, lower y, upper x, upper y of the edges of each row, shape (e, 4)."""


@njit(cache=True)
def is_left_of_edge(x: float, y: float, x1: float, y1: float, x2: float, y2: float) -> bool:
    """Tell whether the ray from a point toward positive x crosses an edge with ``y1 < y2``."""
    if y < y1 or y >= y2:
        return False
    return (x - x1) * (y2 - y1) < (x2 - x1) * (y - y1)


@njit(cache=True)
def is_inside(edge_grid: EdgeGrid, x: float, y: float) -> bool:
    """Tell whether a point is inside the polygon of an edge grid.

    The answer is that of the crossing rule over all edges, bit for bit.
    """
    side = edge_grid.corner[2]
    column = (x - edge_grid.corner[0]) / side
    row = (y - edge_grid.corner[1]) / side
    columns, rows = edge_grid.shape[0], edge_grid.shape[1]
    # written so that nan is outside, too
    if not (column >= 0.0 and row >= 0.0 and column < columns and row < rows):
        return False
    r = int(row)
    cell = edge_grid.cells[r * columns + int(column)]
    if cell != BOUNDARY:
        return cell == INSIDE
    inside = False
    edges = edge_grid.edges
    for e in range(edge_grid.row_starts[r], edge_grid.row_starts[r + 1]):
        if is_left_of_edge(x, y, edges[e, 0], edges[e, 1], edges[e, 2], edges[e, 3]):
            inside = not inside
    return inside


@njit(cache=True)
def are_inside(edge_grid: EdgeGrid, points: NDArray[np.float64], scale: float) -> NDArray[np.bool_]:
    """Tell which points, divided by ``scale``, are inside the polygon of an edge grid."""
    inside = np.empty(len(points), dtype=np.bool_)
    for i in range(len(points)):
        inside[i] = is_inside(edge_grid, points[i, 0] / scale, points[i, 1] / scale)
    return inside


def contains(
    xy: NDArray[np.float64], starts: NDArray[np.int32], points: NDArray[np.float64], scale: float
) -> NDArray[np.bool_]:
    """Tell which points are inside a polygon scaled about the origin.

    Parameters
    ----------
    xy : ndarray of shape (n, 2), float64
        Corners of the rings, one ring after the other.
    starts : ndarray of shape (r + 1,), int32
        First row of every ring, and ``n``.
    points : ndarray of shape (k, 2), float64
        Points to be tested, in the units of the scaled polygon.
    scale : float
        Factor from ``xy`` to the polygon that is meant.

    Returns
    -------
    ndarray of shape (k,), bool
        True inside. A point exactly on the margin is inside on left and lower
        margins, outside on right and upper ones.
    """
    return are_inside(edge_grid(xy, starts), points, scale)


def edge_grid(xy: NDArray[np.float64], starts: NDArray[np.int32]) -> EdgeGrid:
    """Sort the edges of a polygon into a grid.

    Parameters
    ----------
    xy : ndarray of shape (n, 2), float64
        Corners of the rings, one ring after the other; n >= 1.
    starts : ndarray of shape (r + 1,), int32
        First row of every ring, and ``n``.

    Returns
    -------
    EdgeGrid
        For :func:`is_inside`.
    """
    low, high = xy.min(axis=0), xy.max(axis=0)
    width, height = (float(d) for d in high - low)
    longest = max(width, height, 1e-300)
    side = max(np.sqrt(width * height) / CELLS_PER_SIDE, longest / MOST_CELLS_PER_SIDE)
    edges = upward_edges(xy, starts)
    while True:
        # a rim of one cell, so that slack never reaches past the grid
        x0, y0 = float(low[0]) - side, float(low[1]) - side
        columns, rows = int(width / side) + 3, int(height / side) + 3
        counts = _edges_per_row(edges, y0, side, rows)
        if counts.sum() <= max(MOST_ROW_EDGES, 2 * len(edges)) or rows <= 4:
            break
        side *= 2.0
    cells = np.zeros(columns * rows, dtype=np.uint8)
    fill_centres(xy, starts, 1.0, x0, y0, side, columns, rows, cells)
    mark_edges(xy, starts, 1.0, x0, y0, side, columns, rows, cells, BOUNDARY)
    row_starts = np.zeros(rows + 1, dtype=np.int64)
    np.cumsum(counts, out=row_starts[1:])
    return EdgeGrid(
        corner=np.array([x0, y0, side]),
        shape=np.array([columns, rows], dtype=np.int64),
        cells=cells,
        row_starts=row_starts,
        edges=_edges_by_row(edges, y0, side, rows, row_starts),
    )


@njit(cache=True)
def upward_edges(xy: NDArray[np.float64], starts: NDArray[np.int32]) -> NDArray[np.float64]:
    """List the edges that are not horizontal, lower end first, shape (e, 4)."""
    edges = np.empty((len(xy), 4))
    n_edges = 0
    for ring in range(len(starts) - 1):
        previous = starts[ring + 1] - 1
        for i in range(starts[ring], starts[ring + 1]):
            low, high = previous, i
            previous = i
            if xy[low, 1] == xy[high, 1]:
                continue
            if xy[low, 1] > xy[high, 1]:
                low, high = high, low
            edges[n_edges, 0], edges[n_edges, 1] = xy[low, 0], xy[low, 1]
            edges[n_edges, 2], edges[n_edges, 3] = xy[high, 0], xy[high, 1]
            n_edges += 1
    return edges[:n_edges]


@njit(cache=True)
def _band(low: float, high: float, origin: float, side: float, n_bands: int) -> tuple[int, int]:
    """Give the first and last row (or column) that an interval touches, with slack."""
    first = (low - origin) / side - SLACK
    last = (high - origin) / side + SLACK
    if last < 0.0 or first >= n_bands:
        return 0, -1
    return int(max(first, 0.0)), int(min(last, n_bands - 1.0))


@njit(cache=True)
def _edges_per_row(
    edges: NDArray[np.float64], y0: float, side: float, rows: int
) -> NDArray[np.int64]:
    """Count the edges that touch every row."""
    counts = np.zeros(rows, dtype=np.int64)
    for e in range(len(edges)):
        first, last = _band(edges[e, 1], edges[e, 3], y0, side, rows)
        for row in range(first, last + 1):
            counts[row] += 1
    return counts


@njit(cache=True)
def _edges_by_row(
    edges: NDArray[np.float64], y0: float, side: float, rows: int, row_starts: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Copy every edge to every row it touches."""
    copies = np.empty((row_starts[-1], 4))
    filled = row_starts[:-1].copy()
    for e in range(len(edges)):
        first, last = _band(edges[e, 1], edges[e, 3], y0, side, rows)
        for row in range(first, last + 1):
            copies[filled[row]] = edges[e]
            filled[row] += 1
    return copies


@njit(cache=True)
def fill_centres(
    xy: NDArray[np.float64],
    starts: NDArray[np.int32],
    scale: float,
    x0: float,
    y0: float,
    side: float,
    nx: int,
    ny: int,
    cells: NDArray[np.uint8],
) -> None:
    """Set the cells (0 before) to 1 whose centres are inside the scaled polygon.

    Every crossing of a row's centre line flips all cells right of it; the flips
    are summed from left to right at the end, so that nothing needs sorting.
    """
    edges = upward_edges(xy, starts)
    for e in range(len(edges)):
        x1 = (edges[e, 0] * scale - x0) / side
        y1 = (edges[e, 1] * scale - y0) / side
        x2 = (edges[e, 2] * scale - x0) / side
        y2 = (edges[e, 3] * scale - y0) / side
        first = int(min(max(np.ceil(y1 - 0.5), 0.0), ny))
        # the row's centre line y = row + 0.5 must lie in [y1, y2)
        last = int(min(max(np.ceil(y2 - 0.5), 0.0), ny))
        for row in range(first, last):
            x = x1 + (x2 - x1) * ((row + 0.5 - y1) / (y2 - y1))
            column = np.ceil(x - 0.5)
            if column < nx:
                cells[row * nx + int(max(column, 0.0))] ^= 1
    for row in range(ny):
        parity = 0
        for cell in range(row * nx, row * nx + nx):
            parity ^= cells[cell]
            cells[cell] = parity


@njit(cache=True)
def mark_edges(
    xy: NDArray[np.float64],
    starts: NDArray[np.int32],
    scale: float,
    x0: float,
    y0: float,
    side: float,
    nx: int,
    ny: int,
    cells: NDArray[np.uint8],
    mark: int,
) -> None:
    """Set all cells to ``mark`` that an edge of the scaled polygon touches, at least those."""
    for ring in range(len(starts) - 1):
        previous = starts[ring + 1] - 1
        for i in range(starts[ring], starts[ring + 1]):
            x1 = (xy[previous, 0] * scale - x0) / side
            y1 = (xy[previous, 1] * scale - y0) / side
            x2 = (xy[i, 0] * scale - x0) / side
            y2 = (xy[i, 1] * scale - y0) / side
            previous = i
            if y1 > y2:
                x1, y1, x2, y2 = x2, y2, x1, y1
            first, last = _band(y1, y2, 0.0, 1.0, ny)
            for row in range(first, last + 1):
                # the part of the edge between the lower and the upper line of the row
                begin, end = 0.0, 1.0
                if y2 > y1:
                    begin = max(0.0, (row - SLACK - y1) / (y2 - y1))
                    end = min(1.0, (row + 1.0 + SLACK - y1) / (y2 - y1))
                xa = x1 + (x2 - x1) * begin
                xb = x1 + (x2 - x1) * end
                left, right = _band(min(xa, xb), max(xa, xb), 0.0, 1.0, nx)
                for column in range(left, right + 1):
                    cells[row * nx + column] = mark


@njit(cache=True)
def raster(
    xy: NDArray[np.float64],
    starts: NDArray[np.int32],
    scale: float,
    x0: float,
    y0: float,
    side: float,
    nx: int,
    ny: int,
) -> NDArray[np.uint8]:
    """Mark the square cells that a scaled polygon touches.

    Parameters
    ----------
    xy : ndarray of shape (n, 2), float64
        Corners of the rings, one ring after the other.
    starts : ndarray of shape (r + 1,), int32
        First row of every ring, and ``n``.
    scale : float
        Factor from ``xy`` to the polygon that is meant.
    x0, y0, side : float
        Lower corner of the grid and side of a cell, in scaled units.
    nx, ny : int
        Columns and rows.

    Returns
    -------
    ndarray of shape (ny * nx,), uint8
        Rows first; 1 for every cell that shares a point with the polygon, and for
        few others within a billionth of a cell of it.
    """
    cells = np.zeros(ny * nx, dtype=np.uint8)
    fill_centres(xy, starts, scale, x0, y0, side, nx, ny, cells)
    mark_edges(xy, starts, scale, x0, y0, side, nx, ny, cells, 1)
    return cells


@njit(cache=True)
def margin_distances(
    xy: NDArray[np.float64], starts: NDArray[np.int32], points: NDArray[np.float64], scale: float
) -> NDArray[np.float64]:
    """Give the distance of every point to the nearest edge of the scaled polygon, shape (k,)."""
    distances = np.empty(len(points))
    for k in range(len(points)):
        px, py = points[k, 0], points[k, 1]
        nearest = np.inf
        for ring in range(len(starts) - 1):
            previous = starts[ring + 1] - 1
            for i in range(starts[ring], starts[ring + 1]):
                x1, y1 = xy[previous, 0] * scale, xy[previous, 1] * scale
                dx, dy = xy[i, 0] * scale - x1, xy[i, 1] * scale - y1
                previous = i
                squared = dx * dx + dy * dy
                along = 0.0
                if squared > 0.0:
                    along = ((px - x1) * dx + (py - y1) * dy) / squared
                    along = min(1.0, max(0.0, along))
                ox, oy = px - (x1 + along * dx), py - (y1 + along * dy)
                nearest = min(nearest, ox * ox + oy * oy)
        distances[k] = np.sqrt(nearest)
    return distances


@njit(cache=True)
def free_lengths(
    ring: NDArray[np.float64], directions: NDArray[np.float64], most: float
) -> NDArray[np.float64]:
    """Give how far one can go from each corner of a ring before meeting the ring again.

    Parameters
    ----------
    ring : ndarray of shape (n, 2), float64
        Corners.
    directions : ndarray of shape (n, 2), float64
        Unit vectors, one for each corner.
    most : float
        Longest way that matters.

    Returns
    -------
    ndarray of shape (n,), float64
        At most ``most``. The two edges that meet in a corner are not in its way.
    """
    n = len(ring)
    lengths = np.empty(n)
    for k in range(n):
        x, y, dx, dy = ring[k, 0], ring[k, 1], directions[k, 0], directions[k, 1]
        nearest = most
        for j in range(n):
            following = j + 1 if j + 1 < n else 0
            if j == k or following == k:
                continue
            ax, ay = ring[j, 0] - x, ring[j, 1] - y
            bx, by = ring[following, 0] - x, ring[following, 1] - y
            # signed distances of the ends from the line of the way
            a_side, b_side = dx * ay - dy * ax, dx * by - dy * bx
            if (a_side > 0.0) == (b_side > 0.0):
                continue
            share = a_side / (a_side - b_side)
            along = dx * (ax + share * (bx - ax)) + dy * (ay + share * (by - ay))
            if 0.0 < along < nearest:
                nearest = along
        lengths[k] = nearest
    return lengths
