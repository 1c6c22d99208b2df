"""Exact relative neighbourhoods of sources among vein nodes, kept up to date as nodes are added.

A node v is a relative neighbour of a source s when no other node u excludes it:
u comes before v in the order of (distance to s, id), and is nearer to v than s
is (Runions 2008, equation 4.1, with ties broken by id). Of nodes at one place
only the first counts. Nodes are only ever added, so that a neighbourhood can
lose members to new nodes and gain new nodes, but never regain an old one.
"""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.blocks import blocks_of, box_far_distance
from vasc.kernels.compiled import compiled, inlined
from vasc.kernels.hash_grid import (
    HashGrid,
    _push_children,
    box_distance,
    cell_bounds,
    cell_of,
    push_root,
    squared_distance,
)
from vasc.kernels.perceived import MAX_MEMBERS, OTHER_VEINS, SAME_VEINS, Perceived

MAX_CANDIDATES = 4096
MAX_VISITED = 64
PRUNE_SLACK = 1e-9


@compiled
def excludes(u: int, u_distance: float, v: int, v_distance: float, between: float) -> bool:
    """Tell whether node u excludes node v from a source's neighbourhood.

    ``u_distance`` and ``v_distance`` are squared distances to the source,
    ``between`` the squared distance of the two nodes.
    """
    if u_distance > v_distance or (u_distance == v_distance and u >= v):
        return False
    return between < v_distance or between == 0.0


@compiled
def lune_witness(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    x: float,
    y: float,
    v: int,
    v_distance: float,
) -> int:
    """Give a node that excludes node v from the neighbourhood of the source at (x, y), or -1."""
    vx, vy = nodes[v, 0], nodes[v, 1]
    radius = np.sqrt(v_distance) * (1.0 + PRUNE_SLACK)
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
    limit = radius * radius
    for start_row in range(first_row, last_row + 1):
        for start_column in range(first_column, last_column + 1):
            if grid.occupied[first + start_row * columns + start_column] == 0:
                continue
            grid.stack[0, 0] = level
            grid.stack[0, 1] = start_column
            grid.stack[0, 2] = start_row
            grid.stack_bounds[0] = 0.0
            top = 1
            while top > 0:
                top -= 1
                at, column, row = grid.stack[top, 0], grid.stack[top, 1], grid.stack[top, 2]
                low_x, low_y, high_x, high_y = cell_bounds(grid, at, column, row)
                if box_distance(low_x, low_y, high_x, high_y, x, y) > limit:
                    continue
                if box_distance(low_x, low_y, high_x, high_y, vx, vy) > limit:
                    continue
                if at > 0:
                    # the witness is most often near v, so that is where to look first
                    top = _push_children(grid, at, column, row, vx, vy, top)
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


@compiled
def _cell_is_behind(
    grid: HashGrid, level: int, column: int, row: int, x: float, y: float, wx: float, wy: float
) -> bool:
    """Tell whether every point of a cell is surely nearer to (wx, wy) than to (x, y)."""
    low_x, low_y, high_x, high_y = cell_bounds(grid, level, column, row)
    dx, dy = wx - x, wy - y
    square = dx * dx + dy * dy
    least = -square * (1.0 + PRUNE_SLACK)
    if dx > 0.0:
        least += 2.0 * dx * (low_x - x)
    elif dx < 0.0:
        least += 2.0 * dx * (high_x - x)
    if dy > 0.0:
        least += 2.0 * dy * (low_y - y)
    elif dy < 0.0:
        least += 2.0 * dy * (high_y - y)
    return least > 0.0


@compiled
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
            top = _push_children(grid, level, column, row, x, y, top)
            continue
        v = grid.head[row * grid.shapes[0, 0] + column]
        while v >= 0:
            distance = squared_distance(nodes[v, 0], nodes[v, 1], x, y)
            if distance < best_distance or (distance == best_distance and v < best):
                is_open = True
                for k in range(n_visited):
                    w = visited[k]
                    between = squared_distance(nodes[w, 0], nodes[w, 1], nodes[v, 0], nodes[v, 1])
                    if between < distance or between == 0.0:
                        # w was visited before, hence is no farther than v
                        is_open = False
                        break
                if is_open:
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


@inlined
def _absorb(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    x: float,
    y: float,
    s: int,
    perceived: Perceived,
    candidates: NDArray[np.int32],
    distances: NDArray[np.float64],
    n_candidates: int,
    kept: NDArray[np.int32],
    kept_distances: NDArray[np.float64],
) -> None:
    """Bring one neighbourhood up to date with the new nodes that may matter to it."""
    n_old = perceived.n_members[s]
    n_kept = 0
    n_inherited = 0
    for k in range(n_old):
        v = perceived.members[s, k]
        v_distance = perceived.distances[s, k]
        is_excluded = False
        for j in range(n_candidates):
            c = candidates[j]
            if distances[j] < v_distance:
                between = squared_distance(nodes[c, 0], nodes[c, 1], nodes[v, 0], nodes[v, 1])
                if excludes(c, distances[j], v, v_distance, between):
                    is_excluded = True
                    break
        if not is_excluded:
            kept[n_kept] = v
            kept_distances[n_kept] = v_distance
            n_kept += 1
    n_staying = n_kept
    for j in range(n_candidates):
        c = candidates[j]
        c_distance = distances[j]
        is_excluded = False
        is_nearest = True
        for k in range(n_old):
            u_distance = perceived.distances[s, k]
            if u_distance <= c_distance:
                is_nearest = False
                u = perceived.members[s, k]
                between = squared_distance(nodes[u, 0], nodes[u, 1], nodes[c, 0], nodes[c, 1])
                if excludes(u, u_distance, c, c_distance, between):
                    is_excluded = True
                    break
        if is_excluded:
            continue
        for i in range(n_candidates):
            if i == j or distances[i] > c_distance:
                continue
            is_nearest = False
            u = candidates[i]
            between = squared_distance(nodes[u, 0], nodes[u, 1], nodes[c, 0], nodes[c, 1])
            if excludes(u, distances[i], c, c_distance, between):
                is_excluded = True
                break
        if is_excluded:
            continue
        # nothing at all is nearer than the nearest, hence nothing can exclude it
        if not is_nearest and lune_witness(grid, nodes, x, y, c, c_distance) >= 0:
            continue
        for k in range(n_old):
            n_inherited += perceived.members[s, k] == parents[c]
        place = n_kept
        while place > 0 and kept_distances[place - 1] > c_distance:
            kept[place] = kept[place - 1]
            kept_distances[place] = kept_distances[place - 1]
            place -= 1
        kept[place] = c
        kept_distances[place] = c_distance
        n_kept += 1
    if n_kept == n_staying and n_staying == n_old:
        return
    n_new = n_kept - n_staying
    if n_new == n_old - n_staying and n_inherited == n_new:
        change = SAME_VEINS
    else:
        change = OTHER_VEINS
    perceived.change[s] = max(perceived.change[s], change)
    for k in range(n_old):
        perceived.previous[s, k] = perceived.members[s, k]
    perceived.n_previous[s] = n_old
    for k in range(n_kept):
        perceived.members[s, k] = kept[k]
        perceived.distances[s, k] = kept_distances[k]
    perceived.n_members[s] = n_kept


@inlined
def _nodes_for_block(
    nodes: NDArray[np.float64],
    start: int,
    stop: int,
    boxes: NDArray[np.float64],
    b: int,
    reach: float,
    witnesses: NDArray[np.int32],
    n_witnesses: int,
    far: NDArray[np.float64],
    offered: NDArray[np.int32],
) -> int:
    """List the new nodes that may matter to a source in the box; gives their number.

    A node beyond the reach of every source there matters only as a new member,
    and not even so when a witness excludes it wherever in the box the source is.
    """
    low_x, low_y, high_x, high_y = boxes[b, 0], boxes[b, 1], boxes[b, 2], boxes[b, 3]
    for k in range(n_witnesses):
        u = witnesses[k]
        far[k] = box_far_distance(low_x, low_y, high_x, high_y, nodes[u, 0], nodes[u, 1])
        far[k] *= 1.0 + PRUNE_SLACK
    n_offered = 0
    for c in range(start, stop):
        cx, cy = nodes[c, 0], nodes[c, 1]
        bound = box_distance(low_x, low_y, high_x, high_y, cx, cy) * (1.0 - PRUNE_SLACK)
        if bound > reach:
            is_excluded = False
            for k in range(n_witnesses):
                u = witnesses[k]
                if far[k] < bound and squared_distance(nodes[u, 0], nodes[u, 1], cx, cy) < bound:
                    is_excluded = True
                    break
            if is_excluded:
                continue
        offered[n_offered] = c
        n_offered += 1
    return n_offered


@inlined
def _candidates_of_source(
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    x: float,
    y: float,
    s: int,
    perceived: Perceived,
    offered: NDArray[np.int32],
    offered_points: NDArray[np.float64],
    n_offered: int,
    candidates: NDArray[np.int32],
    distances: NDArray[np.float64],
) -> int:
    """List the offered nodes that no cheap test rules out for one source; gives their number."""
    n_members = perceived.n_members[s]
    reach = np.inf
    first_x = first_y = first_distance = np.inf
    if n_members > 0:
        reach = perceived.distances[s, n_members - 1]
        first = perceived.members[s, 0]
        first_distance = perceived.distances[s, 0]
        first_x, first_y = nodes[first, 0], nodes[first, 1]
    # Written without branches, for this is where most of the time goes. Beyond the
    # reach a node matters only if nothing excludes it; the nearest member often does.
    n_free = 0
    for k in range(n_offered):
        cx, cy = offered_points[k, 0], offered_points[k, 1]
        distance = squared_distance(cx, cy, x, y)
        to_first = squared_distance(first_x, first_y, cx, cy)
        candidates[n_free] = offered[k]
        distances[n_free] = distance
        n_free += (distance <= reach) | (to_first >= distance) | (first_distance >= distance)
    n_candidates = 0
    for k in range(n_free):
        c = candidates[k]
        distance = distances[k]
        if distance > reach:
            p = parents[c]
            if p >= 0:
                px, py = nodes[p, 0], nodes[p, 1]
                between = squared_distance(px, py, nodes[c, 0], nodes[c, 1])
                if squared_distance(px, py, x, y) < distance and between < distance:
                    continue
        candidates[n_candidates] = c
        distances[n_candidates] = distance
        n_candidates += 1
    return n_candidates


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
    order, starts, boxes = blocks_of(sources, live)
    far = np.empty(3)
    offered = np.empty(stop - start, dtype=np.int32)
    offered_points = np.empty((stop - start, 2))
    candidates = np.empty(stop - start, dtype=np.int32)
    distances = np.empty(stop - start)
    kept = np.empty(MAX_MEMBERS, dtype=np.int32)
    kept_distances = np.empty(MAX_MEMBERS)
    witnesses = np.empty(3, dtype=np.int32)
    for b in range(len(starts) - 1):
        first, last = starts[b], starts[b + 1]
        if first == last:
            continue
        reach = 0.0
        n_witnesses = 0
        for k in range(first, last):
            s = order[k]
            n_members = perceived.n_members[s]
            if n_members == 0:
                reach = np.inf
                continue
            reach = max(reach, perceived.distances[s, n_members - 1])
            if n_witnesses < 3 and (k == first or k == last - 1 or k == (first + last) // 2):
                witnesses[n_witnesses] = perceived.members[s, 0]
                n_witnesses += 1
        n_offered = _nodes_for_block(
            nodes, start, stop, boxes, b, reach, witnesses, n_witnesses, far, offered
        )
        if n_offered == 0:
            continue
        for k in range(n_offered):
            offered_points[k, 0] = nodes[offered[k], 0]
            offered_points[k, 1] = nodes[offered[k], 1]
        for k in range(first, last):
            s = order[k]
            x, y = sources[s, 0], sources[s, 1]
            n_candidates = _candidates_of_source(
                nodes,
                parents,
                x,
                y,
                s,
                perceived,
                offered,
                offered_points,
                n_offered,
                candidates,
                distances,
            )
            if n_candidates > 0:
                _absorb(
                    grid,
                    nodes,
                    parents,
                    x,
                    y,
                    s,
                    perceived,
                    candidates,
                    distances,
                    n_candidates,
                    kept,
                    kept_distances,
                )
