"""Gravelius orders: how often a vein has left one that carries more on its way from the base."""

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.analysis.ancestry import Descent, descent, grown_nodes
from vasc.analysis.widths import Pipes, pipes
from vasc.arrays import Ids
from vasc.network import SegmentKind, VeinNetwork


def gravelius_orders(
    network: VeinNetwork, *, counted: Pipes | None = None, directions: Descent | None = None
) -> Ids:
    """Give every segment its Gravelius order, 1 for the veins that leave a seed.

    At each node the segment that carries most pipes (of equals, the oldest)
    continues the vein; every other one begins a vein of the next order, as streams
    are counted from the mouth of a river (Gravelius 1914). It is made from the drawing
    alone, and is neither the order of leaf architecture, which also weighs widths at the
    origin and courses (:func:`vasc.analysis.segment_orders`), nor the branching order by
    parentage (:attr:`vasc.timeline.veins.Veins.orders`).

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.
    counted : Pipes, optional
        The network's :func:`vasc.analysis.widths.pipes`, if known already.
    directions : Descent, optional
        The network's :func:`vasc.analysis.ancestry.descent`, if known already.

    Returns
    -------
    ndarray of shape (m,), int32
        Orders, from 1. A segment that joins veins continues the one it springs from.
    """
    directions = descent(network) if directions is None else directions
    counted = pipes(network, directions=directions) if counted is None else counted
    if network.n_segments == 0:
        return np.zeros(0, dtype=np.int32)
    # one segment leads to each node: the vein it grew in, before any join
    grown = _first_of_each(directions.distal, network.segment_kinds == SegmentKind.JOIN)
    proximal = directions.proximal[grown]
    ages = grown_nodes(network, directions)[grown]
    main = grown[_first_of_each(proximal, -counted.segments[grown], ages)]
    is_main = np.zeros(network.n_segments, dtype=bool)
    is_main[main] = True
    # every segment that leaves a seed begins a first-order vein, as in palmate leaves
    is_main |= directions.n_parents[directions.proximal] == 0
    rows = grown[np.argsort(directions.ranks[directions.distal[grown]], kind="stable")]
    orders = np.ones(network.n_nodes, dtype=np.int32)
    kernels.branches.count_turns(
        directions.proximal[rows], directions.distal[rows], is_main[rows], orders
    )
    of_segments: Ids = orders[directions.proximal]
    of_segments[grown] = orders[directions.distal[grown]]
    return of_segments


def _first_of_each(keys: NDArray, *priorities: NDArray) -> NDArray[np.intp]:
    """Give one row for every distinct key: the lowest by the first priority, then the next."""
    rows = np.lexsort((*reversed(priorities), keys))
    is_first = np.ones(len(rows), dtype=bool)
    is_first[1:] = np.diff(keys[rows]) != 0
    return rows[is_first]
