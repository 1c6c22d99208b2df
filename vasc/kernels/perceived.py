"""What each source perceives: the few nodes it attracts, as rows of plain arrays."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

MAX_MEMBERS = 8
"""A relative neighbourhood in the plane has at most six members, seven with a node on the source."""


class Perceived(NamedTuple):
    """Per source (row = source id): the perceiving nodes, nearest first."""

    members: NDArray[np.int32]
    """Node ids, shape (capacity, 8)."""
    distances: NDArray[np.float64]
    """Their squared distances, in material units, shape (capacity, 8)."""
    n_members: NDArray[np.int8]
    """How many there are, shape (capacity,)."""
    is_changed: NDArray[np.uint8]
    """1 if the set differs from the one last recorded, shape (capacity,)."""
    previous: NDArray[np.int32]
    """The set before the latest change, valid where ``is_changed``, shape (capacity, 8)."""
    n_previous: NDArray[np.int8]
    """How many were in it, shape (capacity,)."""


def perceived(capacity: int) -> Perceived:
    """Make room for what ``capacity`` sources perceive."""
    return Perceived(
        members=np.full((capacity, MAX_MEMBERS), -1, dtype=np.int32),
        distances=np.full((capacity, MAX_MEMBERS), np.inf),
        n_members=np.zeros(capacity, dtype=np.int8),
        is_changed=np.zeros(capacity, dtype=np.uint8),
        previous=np.full((capacity, MAX_MEMBERS), -1, dtype=np.int32),
        n_previous=np.zeros(capacity, dtype=np.int8),
    )


def enlarged(old: Perceived, capacity: int) -> Perceived:
    """Give a copy with room for more sources."""
    new = perceived(capacity)
    for source, target in zip(old, new, strict=True):
        target[: len(source)] = source
    return new


@njit(cache=True)
def count_changed(live: NDArray[np.int32], perceived: Perceived) -> int:
    """Count the pairs that :func:`take_changed` will write."""
    n_pairs = 0
    for s in live:
        if perceived.is_changed[s]:
            n_pairs += perceived.n_members[s]
    return n_pairs


@njit(cache=True)
def take_changed(
    live: NDArray[np.int32],
    perceived: Perceived,
    sources: NDArray[np.int32],
    nodes: NDArray[np.int32],
    start: int,
) -> None:
    """Write the sets that changed as (source, node) rows from ``start`` on; they count as taken."""
    row = start
    for s in live:
        if perceived.is_changed[s]:
            perceived.is_changed[s] = 0
            for k in range(perceived.n_members[s]):
                sources[row] = s
                nodes[row] = perceived.members[s, k]
                row += 1
