"""The nearest vein node of every source, kept up to date as nodes are added."""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.blocks import Blocks, blocks_of
from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.hash_grid import HashGrid, box_distance, nearest, squared_distance
from vasc.kernels.perceived import OTHER_VEINS, SAME_VEINS, Perceived


@compiled
def perceive_new(
    grid: HashGrid,
    nodes: NDArray[np.float64],
    sources: NDArray[np.float64],
    chosen: NDArray[np.int32],
    perceived: Perceived,
) -> None:
    """Find the nearest nodes of the chosen sources from nothing."""
    for s in chosen:
        v, distance = nearest(grid, nodes, sources[s, 0], sources[s, 1])
        perceived.n_members[s] = 0
        perceived.change[s] = OTHER_VEINS
        if v >= 0:
            perceived.members[s, 0] = v
            perceived.distances[s, 0] = distance
            perceived.n_members[s] = 1


@unowned
def _serve_blocks(
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    start: int,
    stop: int,
    sources: NDArray[np.float64],
    blocks: Blocks,
    perceived: Perceived,
) -> None:
    """Offer the new nodes to every block, and to the sources of those they may be nearest to."""
    order, starts, boxes = blocks.order, blocks.starts, blocks.boxes
    for b in range(len(starts) - 1):
        first, last = starts[b], starts[b + 1]
        if first == last:
            continue
        reach = 0.0
        for k in range(first, last):
            s = order[k]
            reach = max(reach, perceived.distances[s, 0])
        low_x, low_y, high_x, high_y = boxes[b, 0], boxes[b, 1], boxes[b, 2], boxes[b, 3]
        for c in range(start, stop):
            cx, cy = nodes[c, 0], nodes[c, 1]
            if box_distance(low_x, low_y, high_x, high_y, cx, cy) > reach:
                continue
            for k in range(first, last):
                s = order[k]
                distance = squared_distance(cx, cy, sources[s, 0], sources[s, 1])
                if distance < perceived.distances[s, 0]:
                    if parents[c] == perceived.members[s, 0]:
                        change = SAME_VEINS
                    else:
                        change = OTHER_VEINS
                    perceived.change[s] = max(perceived.change[s], change)
                    perceived.distances[s, 0] = distance
                    perceived.members[s, 0] = c
                    perceived.n_members[s] = 1


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
    """Bring the nearest nodes of all live sources up to date with nodes ``start`` to ``stop``.

    A new node takes over only where it is nearer: of equals the older stays.
    """
    if len(live) == 0 or stop == start:
        return
    blocks = blocks_of(sources, live)
    _serve_blocks(nodes, parents, start, stop, sources, blocks, perceived)
