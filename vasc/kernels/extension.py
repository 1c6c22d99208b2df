"""Vein extension: the pulls of the sources on each node, and the new nodes they cause."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned
from vasc.kernels.perceived import Perceived
from vasc.kernels.tags import Tags, is_pulled


class Pulls(NamedTuple):
    """Per pulled node (row = rank among the pulled): what its sources sum up to."""

    nodes: NDArray[np.int32]
    """Node ids, shape (capacity,)."""
    sums: NDArray[np.float64]
    """Sum of the unit vectors toward the sources, shape (capacity, 2)."""
    n_sources: NDArray[np.int32]
    """Number of sources that pull, shape (capacity,)."""
    nearest: NDArray[np.int32]
    """The nearest of them, of equals the lowest id, shape (capacity,)."""
    distances: NDArray[np.float64]
    """Its squared distance, shape (capacity,)."""


def pulls(capacity: int) -> Pulls:
    """Make room for ``capacity`` pulled nodes."""
    return Pulls(
        nodes=np.empty(capacity, dtype=np.int32),
        sums=np.empty((capacity, 2)),
        n_sources=np.empty(capacity, dtype=np.int32),
        nearest=np.empty(capacity, dtype=np.int32),
        distances=np.empty(capacity),
    )


@unowned
def sum_pulls(
    live: NDArray[np.int32],
    sources: NDArray[np.float64],
    nodes: NDArray[np.float64],
    parents: NDArray[np.int32],
    births: NDArray[np.int32],
    perceived: Perceived,
    tags: Tags,
    kill: float,
    influence: float,
    rank: NDArray[np.int32],
    pulls: Pulls,
) -> int:
    """Sum the pulls on every node, sources in ascending id (equation 3.1).

    Parameters
    ----------
    live : ndarray of shape (n_live,), int32
        Live sources, ascending.
    sources, nodes : ndarray of shape (capacity, 2), float64
        Material coordinates.
    parents, births : ndarray of shape (capacity,), int32
        Of the nodes.
    perceived, tags : Perceived, Tags
        Of the sources.
    kill, influence : float
        Squared kill distance and influence radius, in material units.
    rank : ndarray of shape (capacity,), int32
        Scratch, -1 everywhere before and after.
    pulls : Pulls
        Filled here; must have room for all pairs.

    Returns
    -------
    int
        Number of pulled nodes, in the order in which they were first met.
    """
    n_pulled = 0
    for s in live:
        x, y = sources[s, 0], sources[s, 1]
        for k in range(perceived.n_members[s]):
            if not is_pulled(tags, perceived, s, k, parents, births, kill, influence):
                continue
            v = perceived.members[s, k]
            square = perceived.distances[s, k]
            if square == 0.0:
                continue
            row = rank[v]
            if row < 0:
                row = n_pulled
                n_pulled += 1
                rank[v] = row
                pulls.nodes[row] = v
                pulls.sums[row, 0] = 0.0
                pulls.sums[row, 1] = 0.0
                pulls.n_sources[row] = 0
                pulls.distances[row] = np.inf
            distance = np.sqrt(square)
            pulls.sums[row, 0] += (x - nodes[v, 0]) / distance
            pulls.sums[row, 1] += (y - nodes[v, 1]) / distance
            pulls.n_sources[row] += 1
            if square < pulls.distances[row]:
                pulls.distances[row] = square
                pulls.nearest[row] = s
    for row in range(n_pulled):
        rank[pulls.nodes[row]] = -1
    return n_pulled


@compiled
def children(
    order: NDArray[np.int64],
    pulls: Pulls,
    nodes: NDArray[np.float64],
    sources: NDArray[np.float64],
    length: float,
    bias_x: float,
    bias_y: float,
    is_stall_resolved: bool,
) -> tuple[NDArray[np.int32], NDArray[np.float64], NDArray[np.int32], NDArray[np.bool_]]:
    """Give the new nodes, one for every pulled node, in the given order.

    The direction is the normalized sum of the pulls (equation 3.1), then biased
    (equation 3.3). Where the pulls cancel so far that the child might come nearer
    to no source (mean cosine at most D / (2 d), d the distance of the nearest),
    the stall rule takes the direction of the nearest source instead, without a bias.

    Parameters
    ----------
    order : ndarray of shape (n,), int64
        Rows of ``pulls`` in ascending node id.
    pulls : Pulls
        From :func:`sum_pulls`.
    nodes, sources : ndarray of shape (capacity, 2), float64
        Material coordinates.
    length : float
        Segment length D, in material units.
    bias_x, bias_y : float
        The vector g of equation 3.3.
    is_stall_resolved : bool
        Whether the stall rule is in force.

    Returns
    -------
    parents : ndarray of shape (m,), int32
    material : ndarray of shape (m, 2), float64
    causes : ndarray of shape (m,), int32
        The nearest source that pulled.
    is_stalled : ndarray of shape (m,), bool
        Where the stall rule decided. A node whose pulls cancel to nothing, with
        the rule off, has no child (m < n).
    """
    n_pulled = len(order)
    parents = np.empty(n_pulled, dtype=np.int32)
    material = np.empty((n_pulled, 2))
    causes = np.empty(n_pulled, dtype=np.int32)
    is_stalled = np.zeros(n_pulled, dtype=np.bool_)
    n_children = 0
    for row in order:
        v = pulls.nodes[row]
        s = pulls.nearest[row]
        x, y = pulls.sums[row, 0], pulls.sums[row, 1]
        norm = np.sqrt(x * x + y * y)
        nearest = np.sqrt(pulls.distances[row])
        # mean cosine <= D / (2 d), written without a division by zero
        stalls = 2.0 * nearest * norm <= length * pulls.n_sources[row]
        if is_stall_resolved and stalls and pulls.n_sources[row] > 1:
            x, y = sources[s, 0] - nodes[v, 0], sources[s, 1] - nodes[v, 1]
            norm = nearest
            is_stalled[n_children] = True
        if norm == 0.0:
            continue
        x, y = x / norm, y / norm
        if not is_stalled[n_children] and (bias_x != 0.0 or bias_y != 0.0):
            biased_x, biased_y = x + bias_x, y + bias_y
            norm = np.sqrt(biased_x * biased_x + biased_y * biased_y)
            if norm > 0.0:
                x, y = biased_x / norm, biased_y / norm
        parents[n_children] = v
        causes[n_children] = s
        material[n_children, 0] = nodes[v, 0] + length * x
        material[n_children, 1] = nodes[v, 1] + length * y
        n_children += 1
    return (
        parents[:n_children],
        material[:n_children],
        causes[:n_children],
        is_stalled[:n_children],
    )
