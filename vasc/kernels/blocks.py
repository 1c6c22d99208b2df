"""Sources in square blocks, so that a new node is offered to a block before its sources."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned

SOURCES_PER_BLOCK = 16


class Blocks(NamedTuple):
    """Live sources sorted by block, in ascending id within a block."""

    order: NDArray[np.int32]
    """Source ids, shape (n_live,)."""
    starts: NDArray[np.int32]
    """First row of every block in ``order``, shape (n_blocks + 1,)."""
    boxes: NDArray[np.float64]
    """Tight box of each block's sources: low x, low y, high x, high y, shape (n_blocks, 4)."""


@compiled
def blocks_of(sources: NDArray[np.float64], live: NDArray[np.int32]) -> Blocks:
    """Sort the live sources into blocks of about sixteen.

    Parameters
    ----------
    sources : ndarray of shape (capacity, 2), float64
        Positions; row = source id.
    live : ndarray of shape (n_live,), int32
        Ids of the live sources, ascending, at least one.

    Returns
    -------
    Blocks
        Every live source in exactly one block; empty blocks have an inverted box.
    """
    n_live = len(live)
    low_x = low_y = np.inf
    high_x = high_y = -np.inf
    for s in live:
        low_x = min(low_x, sources[s, 0])
        low_y = min(low_y, sources[s, 1])
        high_x = max(high_x, sources[s, 0])
        high_y = max(high_y, sources[s, 1])
    extent = max(high_x - low_x, high_y - low_y)
    n_wanted = max(1.0, n_live / SOURCES_PER_BLOCK)
    side = np.sqrt((high_x - low_x) * (high_y - low_y) / n_wanted)
    side = max(side, extent / (4.0 * n_wanted), 1e-300)
    columns = int((high_x - low_x) / side) + 1
    rows = int((high_y - low_y) / side) + 1
    n_blocks = columns * rows
    starts = np.zeros(n_blocks + 1, dtype=np.int32)
    block_of = np.empty(n_live, dtype=np.int32)
    boxes = np.empty((n_blocks, 4))
    for b in range(n_blocks):
        boxes[b, 0] = boxes[b, 1] = np.inf
        boxes[b, 2] = boxes[b, 3] = -np.inf
    for k in range(n_live):
        x, y = sources[live[k], 0], sources[live[k], 1]
        b = int((y - low_y) / side) * columns + int((x - low_x) / side)
        block_of[k] = b
        starts[b + 1] += 1
        boxes[b, 0] = min(boxes[b, 0], x)
        boxes[b, 1] = min(boxes[b, 1], y)
        boxes[b, 2] = max(boxes[b, 2], x)
        boxes[b, 3] = max(boxes[b, 3], y)
    for b in range(n_blocks):
        starts[b + 1] += starts[b]
    order = np.empty(n_live, dtype=np.int32)
    filled = starts[:-1].copy()
    for k in range(n_live):
        b = block_of[k]
        order[filled[b]] = live[k]
        filled[b] += 1
    return Blocks(order, starts, boxes)


@unowned
def box_far_distance(
    low_x: float, low_y: float, high_x: float, high_y: float, x: float, y: float
) -> float:
    """Give the squared distance from a point to the farthest corner of a box."""
    dx = max(high_x - x, x - low_x)
    dy = max(high_y - y, y - low_y)
    return dx * dx + dy * dy
