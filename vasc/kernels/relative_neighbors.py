"""Exact relative neighbourhoods of sources among vein nodes, kept up to date as nodes are added.

A node v is a relative neighbour of a source s when no other node u excludes it:
u comes before v in the order of (distance to s, id), and is nearer to v than s
is (Runions 2008, equation 4.1, with ties broken by id). Of nodes at one place
only the first counts. Nodes are only ever added, so that a neighbourhood can
lose members to new nodes and gain new nodes, but never regain an old one.
"""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.blocks import Blocks, blocks_of
from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.hash_grid import (
    SLACK,
    HashGrid,
    cell_bounds,
    push_children,
    push_root,
    squared_distance,
)
from vasc.kernels.lune import lune_witness
from vasc.kernels.offers import (
    Offers,
    admit,
    candidates_of,
    keep_members,
    note_change,
    offer_to_block,
    offers,
    survey_block,
)
from vasc.kernels.perceived import MAX_MEMBERS, OTHER_VEINS, Perceived

ROUNDING = 4e-15
"""Above the relative error of a squared distance."""

MAX_VISITED = 64
"""Above the number of nodes that can be visited: any two are at least 60 degrees apart."""


@unowned
def _cell_is_behind(
    grid: HashGrid, level: int, column: int, row: int, x: float, y: float, wx: float, wy: float
) -> bool:
    """Tell whether every point of a cell is surely nearer to (wx, wy) than to (x, y)."""
    low_x, low_y, high_x, high_y = cell_bounds(grid, level, column, row)
    dx, dy = wx - x, wy - y
    square = dx * dx + dy * dy
    least = -square * (1.0 + SLACK)
    if dx > 0.0:
        least += 2.0 * dx * (low_x - x)
    elif dx < 0.0:
        least += 2.0 * dx * (high_x - x)
    if dy > 0.0:
        least += 2.0 * dy * (low_y - y)
    elif dy < 0.0:
        least += 2.0 * dy * (high_y - y)
    # The plain test compares rounded squared distances: where these are large, a small
    # lead is lost in them, and what is pruned here must be excluded there.
    side = grid.corner[2] * (1 << level)
    far_x = abs(grid.corner[0] + (column + 0.5) * side - x) + 0.5 * side
    far_y = abs(grid.corner[1] + (row + 0.5) * side - y) + 0.5 * side
    return least > ROUNDING * (far_x * far_x + far_y * far_y)


@unowned
def _is_open(
    nodes: NDArray[np.float64], v: int, distance: float, visited: NDArray[np.int32], n_visited: int
) -> bool:
    """Tell whether no visited node, all of them no farther, excludes node v."""
    for k in range(n_visited):
        w = visited[k]
        between = squared_distance(nodes[w, 0], nodes[w, 1], nodes[v, 0], nodes[v, 1])
        if between < distance or between == 0.0:
            return False
    return True


@unowned
def _next_candidate(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    x: float,
    y: float,
    visited: NDArray[np.int32],
    n_visited: int,
) -> tuple[int, float]:
    """Give the nearest node that no visited node excludes, and its squared distance, or -1."""
    best = -1
    best_distance = np.inf
    top = push_root(grid)
    while top > 0:
        top -= 1
        if grid.stack_bounds[top] > best_distance:
            continue
        level, column, row = grid.stack[top, 0], grid.stack[top, 1], grid.stack[top, 2]
        is_behind = False
        for k in range(n_visited):
            w = visited[k]
            if _cell_is_behind(grid, level, column, row, x, y, nodes[w, 0], nodes[w, 1]):
                is_behind = True
                break
        if is_behind:
            continue
        if level > 0:
            top = push_children(grid, level, column, row, x, y, top)
            continue
        v = grid.head[row * grid.shapes[0, 0] + column]
        while v >= 0:
            distance = squared_distance(nodes[v, 0], nodes[v, 1], x, y)
            is_better = distance < best_distance or (distance == best_distance and v < best)
            if is_better and _is_open(nodes, v, distance, visited, n_visited):
                best = v
                best_distance = distance
            v = grid.following[v]
    return best, best_distance


@compiled
def perceive_new(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    sources: NDArray[np.float64],
    chosen: NDArray[np.int32],
    perceived: Perceived,
) -> None:
    """Find the relative neighbourhoods of the chosen sources from nothing."""
    visited = np.empty(MAX_VISITED, dtype=np.int32)
    for s in chosen:
        x, y = sources[s, 0], sources[s, 1]
        n_members = 0
        n_visited = 0
        while n_members < MAX_MEMBERS and n_visited < MAX_VISITED:
            v, distance = _next_candidate(grid, nodes, x, y, visited, n_visited)
            if v < 0:
                break
            visited[n_visited] = v
            n_visited += 1
            if lune_witness(grid, nodes, x, y, v, distance) < 0:
                perceived.members[s, n_members] = v
                perceived.distances[s, n_members] = distance
                n_members += 1
        perceived.n_members[s] = n_members
        perceived.change[s] = OTHER_VEINS


@unowned
def _serve_blocks(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    start: int,
    stop: int,
    sources: NDArray[np.float64],
    blocks: Blocks,
    perceived: Perceived,
    room: Offers,
) -> None:
    """Offer the new nodes to every block, and to the sources of those they may matter to."""
    order, starts, boxes = blocks.order, blocks.starts, blocks.boxes
    witnesses, far, offered, points = room.witnesses, room.far, room.offered, room.points
    fresh, squares = room.candidates, room.distances
    kept, kept_squares = room.kept, room.kept_distances
    for b in range(len(starts) - 1):
        first, last = starts[b], starts[b + 1]
        if first == last:
            continue
        reach, n_near = survey_block(order, first, last, perceived, witnesses)
        n = offer_to_block(
            nodes, start, stop, boxes, b, reach, n_near, witnesses, far, offered, points
        )
        for k in range(first if n > 0 else last, last):
            s = order[k]
            x, y = sources[s, 0], sources[s, 1]
            m = candidates_of(
                nodes, parents, x, y, s, perceived, n, offered, points, fresh, squares
            )
            if m > 0:
                n_old = keep_members(nodes, s, perceived, m, fresh, squares, kept, kept_squares)
                n_all = admit(
                    grid, nodes, x, y, s, perceived, m, n_old, fresh, squares, kept, kept_squares
                )
                note_change(parents, s, perceived, n_old, n_all, kept, kept_squares)


@compiled
def update(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    start: int,
    stop: int,
    sources: NDArray[np.float64],
    live: NDArray[np.int32],
    perceived: Perceived,
) -> None:
    """Bring the neighbourhoods of all live sources up to date with nodes ``start`` to ``stop``.

    The new nodes must be in the grid already.
    """
    if len(live) == 0 or stop == start:
        return
    blocks = blocks_of(sources, live)
    room = offers(stop - start)
    _serve_blocks(grid, nodes, parents, start, stop, sources, blocks, perceived, room)
