"""Connections of a network: components, cycles, degrees and free ends."""

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import Ids
from vasc.network import Origin, VeinNetwork


def component_labels(network: VeinNetwork) -> Ids:
    """Give every node the number of the connected component it is in.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.

    Returns
    -------
    ndarray of shape (n,), int32
        Labels 0 ... c-1; a node without segments is a component of its own.
    """
    return kernels.components.component_labels(network.segments, network.n_nodes)


def count_components(network: VeinNetwork) -> int:
    """Count the connected components; 0 for an empty network."""
    # a retired node is labelled as a component of its own
    return int(component_labels(network).max(initial=-1)) + 1 - len(network.retired)


def count_cycles(network: VeinNetwork, *, components: int | None = None) -> int:
    """Count the independent cycles, m - n + c: 0 for trees.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.
    components : int, optional
        Its number of components, if known already.

    Returns
    -------
    int
    """
    components = count_components(network) if components is None else components
    return network.n_segments - network.n_vein_nodes + components


def free_ends(network: VeinNetwork) -> Ids:
    """Give the ids of the nodes where a vein ends blindly.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.

    Returns
    -------
    ndarray of shape (k,), int32
        Nodes with one segment, ascending. Seeds are none, nor are primordia: the vein
        of a primordium goes on into its leaf.
    """
    goes_on = np.isin(network.origins, [Origin.SEED, Origin.PRIMORDIUM])
    is_end = (network.degrees == 1) & ~goes_on
    return np.flatnonzero(is_end).astype(np.int32)


def junctions(network: VeinNetwork) -> Ids:
    """Give the ids of the nodes where three or more segments meet, ascending."""
    return np.flatnonzero(network.degrees >= 3).astype(np.int32)


def junction_degree(network: VeinNetwork) -> dict[int, float]:
    """Give the share of junctions that each number of segments has.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.

    Returns
    -------
    dict of int to float
        Degrees from 3 on that occur, ascending, and their shares, which sum to
        1; empty if there is no junction.
    """
    degrees: NDArray[np.int32] = network.degrees[junctions(network)]
    values, counts = np.unique(degrees, return_counts=True)
    shares = (counts / max(len(degrees), 1)).tolist()
    return dict(zip(values.tolist(), shares, strict=True))
