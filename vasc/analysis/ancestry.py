"""Which end of a segment is nearer to the base: an order of nodes without cycles."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids
from vasc.network import Origin, SegmentKind, VeinNetwork


@dataclass(frozen=True)
class Descent:
    """The segments of a network, each turned from its older node to its newer one.

    Parameters
    ----------
    ranks : ndarray of shape (n,), int32
        Place of each node in the order of creation (see :func:`creation_ranks`).
    proximal, distal : ndarray of shape (m,), int32
        Older and newer node of each segment, in the order of the network's segments.
    n_parents : ndarray of shape (n,), int32
        Segments that lead from each node toward the base: 0 for a seed, more
        than 1 where veins joined.
    n_children : ndarray of shape (n,), int32
        Segments that lead away from the base: 0 for the tip of a veinlet.
    """

    ranks: Ids
    proximal: Ids
    distal: Ids
    n_parents: Ids
    n_children: Ids

    @property
    def from_tips(self) -> NDArray[np.intp]:
        """Rows of the segments, newest distal node first, shape (m,)."""
        return np.argsort(-self.ranks[self.distal], kind="stable")


def descent(network: VeinNetwork) -> Descent:
    """Turn every segment from the older of its nodes to the newer.

    Every node but the seeds then has at least one parent, a node where veins
    joined has several, and no walk along the segments returns to its start.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.

    Returns
    -------
    Descent
    """
    ranks = creation_ranks(network)
    first, second = network.segments[:, 0], network.segments[:, 1]
    is_turned = ranks[first] > ranks[second]
    proximal = np.where(is_turned, second, first).astype(np.int32)
    distal = np.where(is_turned, first, second).astype(np.int32)
    return Descent(
        ranks=ranks,
        proximal=proximal,
        distal=distal,
        n_parents=np.bincount(distal, minlength=network.n_nodes).astype(np.int32),
        n_children=np.bincount(proximal, minlength=network.n_nodes).astype(np.int32),
    )


def creation_ranks(network: VeinNetwork) -> Ids:
    """Give each node its place in the order of creation.

    For nodes that veins made by growing this is the order of their ids. A node
    that only halves a segment is younger than both ends but lies between them:
    it is put right behind the end it hangs on, before any node made later.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.

    Returns
    -------
    ndarray of shape (n,), int32
        A permutation of 0 ... n-1; a parent's rank is below its child's.
    """
    n_nodes = network.n_nodes
    is_halving = (network.origins == Origin.REFINEMENT) & (network.parents != NULL)
    if not is_halving.any():
        return np.arange(n_nodes, dtype=np.int32)
    anchors = np.arange(n_nodes)
    anchors[is_halving] = network.parents[is_halving]
    anchors, _ = _walk_to_roots(anchors)
    levels = _levels(network, anchors, is_halving)
    order = np.lexsort((np.arange(n_nodes), levels, anchors))
    ranks = np.empty(n_nodes, dtype=np.int32)
    ranks[order] = np.arange(n_nodes, dtype=np.int32)
    return ranks


def grown_nodes(network: VeinNetwork, directions: Descent) -> Ids:
    """Give for every segment the node whose growth made the vein in it.

    For most segments that is the distal node. Nodes that refinement adds grew nothing: the
    pieces of a segment belong to the node that it led to, whether that is still there or not.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.
    directions : Descent
        The network's :func:`descent`.

    Returns
    -------
    ndarray of shape (m,), int32
        Node ids.
    """
    return directions.distal if network.growths is None else network.growths.nodes


def segment_causes(network: VeinNetwork, directions: Descent) -> Ids:
    """Give the source that caused the vein in every segment, -1 for none; shape (m,), int32."""
    if network.growths is None:
        found: Ids = network.causes[directions.distal]
        return found
    return network.growths.causes


def _levels(
    network: VeinNetwork, anchors: NDArray[np.intp], is_halving: NDArray[np.bool_]
) -> NDArray[np.int64]:
    """Count the halving nodes between each halving node and its anchor, itself included."""
    proximal, distal = network.segments[:, 0], network.segments[:, 1]
    is_link = (
        (network.segment_kinds != SegmentKind.JOIN)
        & is_halving[distal]
        & (anchors[proximal] == anchors[distal])
    )
    before = np.arange(network.n_nodes)
    before[distal[is_link]] = proximal[is_link]
    return _walk_to_roots(before)[1]


def _walk_to_roots(before: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.int64]]:
    """Follow ``before`` from every node to a node that is its own; give ends and steps."""
    steps = (before != np.arange(len(before))).astype(np.int64)
    # strides double at each turn, so that the longest walk takes log2(n) turns
    for _ in range(max(1, len(before).bit_length() + 1)):
        farther = before[before]
        if np.array_equal(farther, before):
            break
        steps += steps[before]
        before = farther
    return before, steps
