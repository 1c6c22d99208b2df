"""New nodes offered to the sources: ruled out by block, then by source, then admitted or not."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.blocks import box_far_distance
from vasc.kernels.compiled import compiled, inlined
from vasc.kernels.hash_grid import SLACK, HashGrid, box_distance, squared_distance
from vasc.kernels.lune import excludes, lune_witness
from vasc.kernels.perceived import MAX_MEMBERS, OTHER_VEINS, SAME_VEINS, Perceived

N_WITNESSES = 3


class Offers(NamedTuple):
    """Room for the new nodes that may matter, to a block and then to one source of it."""

    witnesses: NDArray[np.int32]
    """Nodes near the block that rule others out, shape (3,)."""
    far: NDArray[np.float64]
    """Their squared distances from the farthest corner of the block, shape (3,)."""
    offered: NDArray[np.int32]
    """New nodes that may matter to the block."""
    points: NDArray[np.float64]
    """Where these are, shape (capacity, 2)."""
    candidates: NDArray[np.int32]
    """New nodes that may matter to a source."""
    distances: NDArray[np.float64]
    """Their squared distances from it."""
    kept: NDArray[np.int32]
    """The source's new set, nearest first, shape (8,)."""
    kept_distances: NDArray[np.float64]
    """Their squared distances from it, shape (8,)."""


@compiled
def offers(capacity: int) -> Offers:
    """Make room for ``capacity`` new nodes."""
    return Offers(
        np.empty(N_WITNESSES, dtype=np.int32),
        np.empty(N_WITNESSES),
        np.empty(capacity, dtype=np.int32),
        np.empty((capacity, 2)),
        np.empty(capacity, dtype=np.int32),
        np.empty(capacity),
        np.empty(MAX_MEMBERS, dtype=np.int32),
        np.empty(MAX_MEMBERS),
    )


@inlined
def survey_block(
    order: NDArray[np.int32],
    first: int,
    last: int,
    perceived: Perceived,
    witnesses: NDArray[np.int32],
) -> tuple[float, int]:
    """Give the reach of a block (its farthest member, squared) and the number of its witnesses."""
    reach = 0.0
    n_witnesses = 0
    for k in range(first, last):
        s = order[k]
        n_members = perceived.n_members[s]
        if n_members == 0:
            reach = np.inf
            continue
        reach = max(reach, perceived.distances[s, n_members - 1])
        is_chosen = k == first or k == last - 1 or k == (first + last) // 2
        if n_witnesses < N_WITNESSES and is_chosen:
            witnesses[n_witnesses] = perceived.members[s, 0]
            n_witnesses += 1
    return reach, n_witnesses


@inlined
def offer_to_block(
    nodes: NDArray[np.float64],
    start: int,
    stop: int,
    boxes: NDArray[np.float64],
    b: int,
    reach: float,
    n_witnesses: int,
    witnesses: NDArray[np.int32],
    far: NDArray[np.float64],
    offered: NDArray[np.int32],
    points: NDArray[np.float64],
) -> int:
    """List the new nodes that may matter to a source in the block; gives their number.

    A node beyond the reach of every source there matters only as a new member,
    and not even so when a witness excludes it wherever in the block the source is.
    """
    low_x, low_y, high_x, high_y = boxes[b, 0], boxes[b, 1], boxes[b, 2], boxes[b, 3]
    for k in range(n_witnesses):
        u = witnesses[k]
        corner = box_far_distance(low_x, low_y, high_x, high_y, nodes[u, 0], nodes[u, 1])
        far[k] = corner * (1.0 + SLACK)
    n_offered = 0
    for c in range(start, stop):
        cx, cy = nodes[c, 0], nodes[c, 1]
        bound = box_distance(low_x, low_y, high_x, high_y, cx, cy) * (1.0 - SLACK)
        is_excluded = False
        if bound > reach:
            for k in range(n_witnesses):
                u = witnesses[k]
                between = squared_distance(nodes[u, 0], nodes[u, 1], cx, cy)
                if far[k] < bound and between < bound:
                    is_excluded = True
                    break
        if not is_excluded:
            offered[n_offered] = c
            points[n_offered, 0] = cx
            points[n_offered, 1] = cy
            n_offered += 1
    return n_offered


@inlined
def candidates_of(
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    x: float,
    y: float,
    s: int,
    perceived: Perceived,
    n_offered: int,
    offered: NDArray[np.int32],
    points: NDArray[np.float64],
    candidates: NDArray[np.int32],
    new_distances: NDArray[np.float64],
) -> int:
    """List the offered nodes that no cheap test rules out for one source; gives their number."""
    n_members = perceived.n_members[s]
    reach = first_distance = np.inf
    first_x = first_y = np.inf
    if n_members > 0:
        reach = perceived.distances[s, n_members - 1]
        first_distance = perceived.distances[s, 0]
        first = perceived.members[s, 0]
        first_x, first_y = nodes[first, 0], nodes[first, 1]
    # Written without branches, for this is where most of the time goes. Beyond the
    # reach a node matters only if nothing excludes it; the nearest member often does.
    n_free = 0
    for k in range(n_offered):
        cx, cy = points[k, 0], points[k, 1]
        distance = squared_distance(cx, cy, x, y)
        to_first = squared_distance(first_x, first_y, cx, cy)
        candidates[n_free] = offered[k]
        new_distances[n_free] = distance
        n_free += (distance <= reach) | (to_first >= distance) | (first_distance >= distance)
    n_candidates = 0
    for k in range(n_free):
        c, distance = candidates[k], new_distances[k]
        p = parents[c]
        if distance > reach and p >= 0:
            px, py = nodes[p, 0], nodes[p, 1]
            between = squared_distance(px, py, nodes[c, 0], nodes[c, 1])
            if squared_distance(px, py, x, y) < distance and between < distance:
                continue
        candidates[n_candidates] = c
        new_distances[n_candidates] = distance
        n_candidates += 1
    return n_candidates


@inlined
def keep_members(
    nodes: NDArray[np.float64],
    s: int,
    perceived: Perceived,
    n_candidates: int,
    candidates: NDArray[np.int32],
    new_distances: NDArray[np.float64],
    kept: NDArray[np.int32],
    kept_distances: NDArray[np.float64],
) -> int:
    """Keep the members of a set that no candidate excludes; gives their number."""
    n_kept = 0
    for k in range(perceived.n_members[s]):
        v, v_distance = perceived.members[s, k], perceived.distances[s, k]
        is_excluded = False
        for j in range(n_candidates):
            c = candidates[j]
            if new_distances[j] < v_distance:
                between = squared_distance(nodes[c, 0], nodes[c, 1], nodes[v, 0], nodes[v, 1])
                if excludes(c, new_distances[j], v, v_distance, between):
                    is_excluded = True
                    break
        if not is_excluded:
            kept[n_kept] = v
            kept_distances[n_kept] = v_distance
            n_kept += 1
    return n_kept


@inlined
def excluded_at_hand(
    nodes: NDArray[np.float64],
    s: int,
    j: int,
    perceived: Perceived,
    n_candidates: int,
    candidates: NDArray[np.int32],
    new_distances: NDArray[np.float64],
) -> tuple[bool, bool]:
    """Tell whether what is at hand excludes candidate j, and whether nothing is nearer."""
    c, c_distance = candidates[j], new_distances[j]
    is_nearest = True
    for k in range(perceived.n_members[s]):
        u_distance = perceived.distances[s, k]
        if u_distance > c_distance:
            break
        is_nearest = False
        u = perceived.members[s, k]
        between = squared_distance(nodes[u, 0], nodes[u, 1], nodes[c, 0], nodes[c, 1])
        if excludes(u, u_distance, c, c_distance, between):
            return True, False
    for i in range(n_candidates):
        if i == j or new_distances[i] > c_distance:
            continue
        is_nearest = False
        u = candidates[i]
        between = squared_distance(nodes[u, 0], nodes[u, 1], nodes[c, 0], nodes[c, 1])
        if excludes(u, new_distances[i], c, c_distance, between):
            return True, False
    return False, is_nearest


@inlined
def admit(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    x: float,
    y: float,
    s: int,
    perceived: Perceived,
    n_candidates: int,
    n_staying: int,
    candidates: NDArray[np.int32],
    new_distances: NDArray[np.float64],
    kept: NDArray[np.int32],
    kept_distances: NDArray[np.float64],
) -> int:
    """Add the candidates that nothing excludes to the members that stay; gives the new number."""
    n_kept = n_staying
    for j in range(n_candidates):
        c, c_distance = candidates[j], new_distances[j]
        is_excluded, is_nearest = excluded_at_hand(
            nodes, s, j, perceived, n_candidates, candidates, new_distances
        )
        if is_excluded:
            continue
        # nothing at all is nearer than the nearest, hence nothing can exclude it
        if not is_nearest and lune_witness(grid, nodes, x, y, c, c_distance) >= 0:
            continue
        place = n_kept
        while place > 0 and kept_distances[place - 1] > c_distance:
            kept[place] = kept[place - 1]
            kept_distances[place] = kept_distances[place - 1]
            place -= 1
        kept[place] = c
        kept_distances[place] = c_distance
        n_kept += 1
    return n_kept


@inlined
def note_change(
    parents: NDArray[np.int32],
    s: int,
    perceived: Perceived,
    n_staying: int,
    n_kept: int,
    kept: NDArray[np.int32],
    kept_distances: NDArray[np.float64],
) -> None:
    """Put the new set in the place of the old one, and note how they differ."""
    n_old = perceived.n_members[s]
    if n_kept == n_staying and n_staying == n_old:
        return
    n_inherited = 0
    for k in range(n_kept):
        is_new = True
        is_child = False
        for j in range(n_old):
            is_new = is_new and perceived.members[s, j] != kept[k]
            is_child = is_child or perceived.members[s, j] == parents[kept[k]]
        n_inherited += is_new and is_child
    n_new = n_kept - n_staying
    is_same = n_new == n_old - n_staying and n_inherited == n_new
    change = SAME_VEINS if is_same else OTHER_VEINS
    perceived.change[s] = max(perceived.change[s], change)
    for k in range(n_old):
        perceived.previous[s, k] = perceived.members[s, k]
    perceived.n_previous[s] = n_old
    for k in range(n_kept):
        perceived.members[s, k] = kept[k]
        perceived.distances[s, k] = kept_distances[k]
    perceived.n_members[s] = n_kept
