"""Urquhart neighbourhoods of sources: relative neighbours tested among Delaunay neighbours only.

The Voronoi cell of a source among the vein nodes is kept as a convex polygon;
its edges name the Delaunay neighbours (Runions 2008, section 4.4.2). Nodes that
are not Delaunay neighbours exclude nobody, which is the approximation (Figure 4.13).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.hash_grid import (
    SLACK,
    HashGrid,
    box_distance,
    cell_bounds,
    nearest,
    push_children,
    push_root,
)
from vasc.kernels.lune import excludes
from vasc.kernels.perceived import MAX_MEMBERS, OTHER_VEINS, SAME_VEINS, Perceived

ROOM = 48
"""Corners there is room for at first; beside a long smooth vein a cell has hundreds."""

FAR = 1000.0
"""Half the side of the box that bounds every cell, in sizes of the blade."""
CUT_SLACK = 1e-12


class VoronoiCells(NamedTuple):
    """Per source (row = source id): its Voronoi cell among the nodes, counter-clockwise."""

    corners: NDArray[np.float64]
    """Corners relative to the source, shape (capacity, room, 2)."""
    neighbors: NDArray[np.int32]
    """The node beyond the edge from each corner to the next, -1 for the box."""
    n_corners: NDArray[np.int32]
    """Number of corners, shape (capacity,)."""
    here: NDArray[np.int32]
    """The oldest node exactly on the source, -1 if none, shape (capacity,)."""


def voronoi_cells(capacity: int, room: int = ROOM) -> VoronoiCells:
    """Make room for the cells of ``capacity`` sources, with ``room`` corners each."""
    return VoronoiCells(
        corners=np.zeros((capacity, room, 2)),
        neighbors=np.full((capacity, room), -1, dtype=np.int32),
        n_corners=np.zeros(capacity, dtype=np.int32),
        here=np.full(capacity, -1, dtype=np.int32),
    )


def enlarged(old: VoronoiCells, capacity: int, room: int = ROOM) -> VoronoiCells:
    """Give a copy with room for more sources, or for more corners."""
    n_old, old_room = old.neighbors.shape
    new = voronoi_cells(capacity, max(room, old_room))
    new.corners[:n_old, :old_room] = old.corners
    new.neighbors[:n_old, :old_room] = old.neighbors
    new.n_corners[:n_old] = old.n_corners
    new.here[:n_old] = old.here
    return new


@unowned
def _cuts(cells: VoronoiCells, s: int, k: int, wx: float, wy: float) -> float:
    """Tell by its sign whether a corner is nearer to the node at (wx, wy) than to the source."""
    x, y = cells.corners[s, k, 0], cells.corners[s, k, 1]
    square = wx * wx + wy * wy
    value = 2.0 * (x * wx + y * wy) - square
    if value < CUT_SLACK * (square + (abs(x) + abs(y)) * (abs(wx) + abs(wy))):
        return -1.0
    return value


@unowned
def _is_cut(cells: VoronoiCells, s: int, wx: float, wy: float) -> bool:
    """Tell whether a node at (wx, wy) from the source takes a part of its cell."""
    for k in range(cells.n_corners[s]):
        if _cuts(cells, s, k, wx, wy) > 0.0:
            return True
    return False


@unowned
def _is_neighbor(cells: VoronoiCells, s: int, v: int) -> bool:
    """Tell whether a node has cut the cell already and still bounds it."""
    for k in range(cells.n_corners[s]):
        if cells.neighbors[s, k] == v:
            return True
    return False


@unowned
def _cut(
    cells: VoronoiCells,
    s: int,
    node: int,
    wx: float,
    wy: float,
    corners: NDArray[np.float64],
    neighbors: NDArray[np.int32],
) -> bool:
    """Take from a cell what is nearer to a node at (wx, wy) from the source.

    Gives false, and leaves the cell as it is, if it has no room for its corners.
    """
    n_old = cells.n_corners[s]
    square = wx * wx + wy * wy
    n_new = 0
    for k in range(n_old):
        following = k + 1 if k + 1 < n_old else 0
        x, y = cells.corners[s, k, 0], cells.corners[s, k, 1]
        is_out = _cuts(cells, s, k, wx, wy) > 0.0
        is_next_out = _cuts(cells, s, following, wx, wy) > 0.0
        if not is_out:
            corners[n_new, 0], corners[n_new, 1] = x, y
            neighbors[n_new] = cells.neighbors[s, k]
            n_new += 1
        if is_out != is_next_out:
            dx, dy = cells.corners[s, following, 0] - x, cells.corners[s, following, 1] - y
            at = (0.5 * square - (x * wx + y * wy)) / (dx * wx + dy * wy)
            at = min(1.0, max(0.0, at))
            corners[n_new, 0], corners[n_new, 1] = x + at * dx, y + at * dy
            neighbors[n_new] = node if is_next_out else cells.neighbors[s, k]
            n_new += 1
    if n_new > cells.neighbors.shape[1]:
        return False
    for k in range(n_new):
        cells.corners[s, k, 0], cells.corners[s, k, 1] = corners[k, 0], corners[k, 1]
        cells.neighbors[s, k] = neighbors[k]
    cells.n_corners[s] = n_new
    return True


@unowned
def _next_cutter(
    grid: HashGrid, nodes: NDArray[np.float64], x: float, y: float, s: int, cells: VoronoiCells
) -> int:
    """Give the nearest node that takes a part of a source's cell, or -1."""
    best = -1
    best_distance = np.inf
    top = push_root(grid)
    while top > 0:
        top -= 1
        if grid.stack_bounds[top] > best_distance:
            continue
        level, column, row = grid.stack[top, 0], grid.stack[top, 1], grid.stack[top, 2]
        low_x, low_y, high_x, high_y = cell_bounds(grid, level, column, row)
        is_far = True
        for k in range(cells.n_corners[s]):
            dx, dy = cells.corners[s, k, 0], cells.corners[s, k, 1]
            bound = box_distance(low_x, low_y, high_x, high_y, x + dx, y + dy)
            # a node cuts a corner only from within the circle about it through the source
            if bound <= (dx * dx + dy * dy) * (1.0 + SLACK):
                is_far = False
                break
        if is_far:
            continue
        if level > 0:
            top = push_children(grid, level, column, row, x, y, top)
            continue
        v = grid.head[row * grid.shapes[0, 0] + column]
        while v >= 0:
            wx, wy = nodes[v, 0] - x, nodes[v, 1] - y
            distance = wx * wx + wy * wy
            is_better = distance < best_distance or (distance == best_distance and v < best)
            is_better = is_better and distance > 0.0 and not _is_neighbor(cells, s, v)
            if is_better and _is_cut(cells, s, wx, wy):
                best = v
                best_distance = distance
            v = grid.following[v]
    return best


@unowned
def _put(perceived: Perceived, s: int, n_members: int, v: int, distance: float) -> None:
    """Put a node at its place in the order of a source's set."""
    members, distances = perceived.members, perceived.distances
    place = n_members
    while place > 0 and (
        distances[s, place - 1] > distance
        or (distances[s, place - 1] == distance and members[s, place - 1] > v)
    ):
        distances[s, place] = distances[s, place - 1]
        members[s, place] = members[s, place - 1]
        place -= 1
    distances[s, place] = distance
    members[s, place] = v


@unowned
def _perceive(
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    x: float,
    y: float,
    s: int,
    cells: VoronoiCells,
    perceived: Perceived,
) -> None:
    """Test the Delaunay neighbours of a source against each other, and note what changed."""
    n_old = perceived.n_members[s]
    for k in range(n_old):
        perceived.previous[s, k] = perceived.members[s, k]
    perceived.n_previous[s] = n_old
    n_members = 0
    if cells.here[s] >= 0:
        perceived.members[s, 0] = cells.here[s]
        perceived.distances[s, 0] = 0.0
        n_members = 1
    for k in range(cells.n_corners[s]):
        v = cells.neighbors[s, k]
        if v < 0:
            continue
        distance = _squared(nodes, v, x, y)
        is_excluded = False
        for j in range(cells.n_corners[s]):
            u = cells.neighbors[s, j]
            if u < 0 or u == v:
                continue
            between = _squared(nodes, u, nodes[v, 0], nodes[v, 1])
            if excludes(u, _squared(nodes, u, x, y), v, distance, between):
                is_excluded = True
                break
        if is_excluded or n_members == MAX_MEMBERS:
            continue
        _put(perceived, s, n_members, v, distance)
        n_members += 1
    perceived.n_members[s] = n_members
    perceived.change[s] = max(perceived.change[s], _change(parents, s, perceived))


@unowned
def _change(parents: NDArray[np.int32], s: int, perceived: Perceived) -> int:
    """Tell how a set differs from the previous one."""
    n_previous, n_members = perceived.n_previous[s], perceived.n_members[s]
    n_same = n_inherited = 0
    for k in range(n_members):
        v = perceived.members[s, k]
        for j in range(n_previous):
            n_same += perceived.previous[s, j] == v
            n_inherited += perceived.previous[s, j] == parents[v]
    if n_same == n_members and n_same == n_previous:
        return 0
    if n_members == n_previous and n_same + n_inherited == n_members:
        return SAME_VEINS
    return OTHER_VEINS


@unowned
def _squared(nodes: NDArray[np.float64], v: int, x: float, y: float) -> float:
    """Give the squared distance from a node to a point."""
    dx = nodes[v, 0] - x
    dy = nodes[v, 1] - y
    return dx * dx + dy * dy


@compiled
def _perceive_from(
    first: int,
    grid: HashGrid,
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    sources: NDArray[np.float64],
    chosen: NDArray[np.int32],
    perceived: Perceived,
    cells: VoronoiCells,
    extent: float,
) -> int:
    """Serve the chosen sources from the first on; gives the row of one whose cell is full."""
    # a cut leaves at most one corner more, and these are counted before they are refused
    room = cells.neighbors.shape[1] + 2
    corners, neighbors = np.empty((room, 2)), np.empty(room, dtype=np.int32)
    far = FAR * extent
    for row in range(first, len(chosen)):
        s = chosen[row]
        x, y = sources[s, 0], sources[s, 1]
        for k in range(4):
            cells.corners[s, k, 0] = far if k == 1 or k == 2 else -far
            cells.corners[s, k, 1] = far if k >= 2 else -far
            cells.neighbors[s, k] = -1
        cells.n_corners[s] = 4
        v, distance = nearest(grid, nodes, x, y)
        cells.here[s] = v if distance == 0.0 else -1
        perceived.n_members[s] = 0
        while True:
            v = _next_cutter(grid, nodes, x, y, s, cells)
            if v < 0:
                break
            if not _cut(cells, s, v, nodes[v, 0] - x, nodes[v, 1] - y, corners, neighbors):
                return row
        _perceive(nodes, parents, x, y, s, cells, perceived)
        perceived.change[s] = OTHER_VEINS
    return len(chosen)


def perceive_new(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    sources: NDArray[np.float64],
    chosen: NDArray[np.int32],
    perceived: Perceived,
    cells: VoronoiCells,
    extent: float,
) -> VoronoiCells:
    """Find cells and Urquhart neighbourhoods of the chosen sources from nothing.

    ``extent`` is the size of the blade; a cell reaches ``FAR`` times that far. The
    cells are given back, with more room if they needed it.
    """
    row = 0
    while True:
        row = _perceive_from(row, grid, nodes, parents, sources, chosen, perceived, cells, extent)
        if row == len(chosen):
            return cells
        cells = enlarged(cells, len(cells.n_corners), 2 * cells.neighbors.shape[1])


@compiled
def _update_from(
    first: int,
    is_resumed: bool,
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    start: int,
    stop: int,
    sources: NDArray[np.float64],
    live: NDArray[np.int32],
    perceived: Perceived,
    cells: VoronoiCells,
) -> int:
    """Serve the live sources from the first on; gives the row of one whose cell is full."""
    room = cells.neighbors.shape[1] + 2
    corners, neighbors = np.empty((room, 2)), np.empty(room, dtype=np.int32)
    for row in range(first, len(live)):
        s = live[row]
        x, y = sources[s, 0], sources[s, 1]
        reach = 0.0
        for k in range(cells.n_corners[s]):
            dx, dy = cells.corners[s, k, 0], cells.corners[s, k, 1]
            reach = max(reach, dx * dx + dy * dy)
        # a cell that was full has been cut by some of the nodes already
        is_changed = is_resumed and row == first
        for c in range(start, stop):
            wx, wy = nodes[c, 0] - x, nodes[c, 1] - y
            square = wx * wx + wy * wy
            if square == 0.0:
                if cells.here[s] < 0:
                    cells.here[s] = c
                    is_changed = True
            elif square <= 4.0 * reach and _is_cut(cells, s, wx, wy):
                if not _cut(cells, s, c, wx, wy, corners, neighbors):
                    return row
                is_changed = True
        if is_changed:
            _perceive(nodes, parents, x, y, s, cells, perceived)
    return len(live)


def update(
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    start: int,
    stop: int,
    sources: NDArray[np.float64],
    live: NDArray[np.int32],
    perceived: Perceived,
    cells: VoronoiCells,
) -> VoronoiCells:
    """Bring cells and neighbourhoods up to date with nodes ``start`` to ``stop``.

    The cells are given back, with more room if they needed it.
    """
    row, is_resumed = 0, False
    while True:
        row = _update_from(
            row, is_resumed, nodes, parents, start, stop, sources, live, perceived, cells
        )
        if row == len(live):
            return cells
        is_resumed = True
        cells = enlarged(cells, len(cells.n_corners), 2 * cells.neighbors.shape[1])
