"""The few nodes that perceive each source, which it attracts, as rows of plain arrays."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import unowned

MAX_MEMBERS = 8
"""A relative neighbourhood has at most six members, seven with a node on the source."""

NO_CHANGE = 0
SAME_VEINS = 1
"""Members gave way to their own children: the veins are the same, one segment longer."""
OTHER_VEINS = 2
"""A vein came or went."""
NEVER = 3
"""Above every change."""


class Perceived(NamedTuple):
    """Per source (row = source id): the perceiving nodes, nearest first."""

    members: NDArray[np.int32]
    """Node ids, shape (capacity, 8)."""
    distances: NDArray[np.float64]
    """Their squared distances, in material units, shape (capacity, 8)."""
    n_members: NDArray[np.int8]
    """How many there are, shape (capacity,)."""
    change: NDArray[np.uint8]
    """How the set differs from what it was when last taken, shape (capacity,)."""
    previous: NDArray[np.int32]
    """The set before the latest change, valid where ``change`` is not 0, shape (capacity, 8)."""
    n_previous: NDArray[np.int8]
    """How many were in it, shape (capacity,)."""


def perceived(capacity: int) -> Perceived:
    """Make room for ``capacity`` sources."""
    return Perceived(
        members=np.full((capacity, MAX_MEMBERS), -1, dtype=np.int32),
        distances=np.full((capacity, MAX_MEMBERS), np.inf),
        n_members=np.zeros(capacity, dtype=np.int8),
        change=np.zeros(capacity, dtype=np.uint8),
        previous=np.full((capacity, MAX_MEMBERS), -1, dtype=np.int32),
        n_previous=np.zeros(capacity, dtype=np.int8),
    )


@unowned
def count_changed(live: NDArray[np.int32], perceived: Perceived, least: int) -> int:
    """Count the pairs that :func:`take_changed` will write."""
    n_pairs = 0
    for s in live:
        if perceived.change[s] >= least:
            n_pairs += perceived.n_members[s]
    return n_pairs


@unowned
def take_changed(
    live: NDArray[np.int32],
    perceived: Perceived,
    least: int,
    sources: NDArray[np.int32],
    nodes: NDArray[np.int32],
    start: int,
) -> None:
    """Write the sets with at least that change as (source, node) rows; all count as taken."""
    row = start
    for s in live:
        if perceived.change[s] >= least:
            for k in range(perceived.n_members[s]):
                sources[row] = s
                nodes[row] = perceived.members[s, k]
                row += 1
        perceived.change[s] = NO_CHANGE
