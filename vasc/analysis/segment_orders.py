"""Vein orders of the segments and nodes of a network, as all tables and pictures tell them."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.ancestry import descent
from vasc.analysis.moment import Moment
from vasc.analysis.run_widths import run_widths
from vasc.analysis.sections import find_sections, segment_origins
from vasc.analysis.vein_orders import vein_orders
from vasc.analysis.widths import WidthParameters
from vasc.arrays import NULL, Floats, Ids
from vasc.network import SegmentKind, VeinNetwork

UNKNOWN = np.iinfo(np.int32).max
"""Above every order."""


def segment_orders(network: VeinNetwork, widths: Floats) -> Ids:
    """Give every segment its vein order, 1 for the main veins from the base.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty. Strands in space are all of first order.
    widths : ndarray of shape (m,), float64
        Widths of the segments.

    Returns
    -------
    ndarray of shape (m,), int32
        The :func:`vasc.analysis.vein_orders` of the section a segment lies in, the lowest
        where it is cut by others. One that is not drawn, as it has no length or lies on
        another, has the lowest order of those at its ends.
    """
    if network.positions.shape[1] != 2:
        return np.ones(network.n_segments, dtype=np.int32)
    sections = find_sections(network, widths)
    drawn = vein_orders(sections)[sections.owners]
    found = np.full(network.n_segments, UNKNOWN, dtype=np.int32)
    np.minimum.at(found, segment_origins(network, sections.drawing)[sections.rows], drawn)
    if (is_hidden := found == UNKNOWN).any():
        beside = _lowest_at(network.segments, found, network.n_nodes)[network.segments]
        found[is_hidden] = beside.min(axis=1)[is_hidden]
        found[found == UNKNOWN] = 1
    return found


def node_orders(network: VeinNetwork, orders: Ids) -> Ids:
    """Give every node the vein order of the segment that leads to it from the base.

    Parameters
    ----------
    network : VeinNetwork
        The network.
    orders : ndarray of shape (m,), int32
        Its :func:`segment_orders`.

    Returns
    -------
    ndarray of shape (n,), int32
        A seed has the lowest order of the veins that leave it; -1 for a node without a
        segment, as refinement leaves behind.
    """
    is_grown = network.segment_kinds != SegmentKind.JOIN
    distal = descent(network).distal[:, None]
    leading = _lowest_at(distal[is_grown], orders[is_grown], network.n_nodes)
    of_nodes = _lowest_at(network.segments, orders, network.n_nodes)
    found = np.where(leading == UNKNOWN, of_nodes, leading)
    found[found == UNKNOWN] = NULL
    return found


def run_node_orders(
    frame: Callable[[int], Moment], step: int, parameters: WidthParameters, n_nodes: int
) -> Ids:
    """Give the nodes of a run their vein orders at a step.

    Parameters
    ----------
    frame : callable
        Gives the moment of a step, as :meth:`vasc.timeline.Timeline.frame` does.
    step : int
        The step, at least 0.
    parameters : WidthParameters
        The rule of widths, by which orders are told.
    n_nodes : int
        Nodes at the end of the run.

    Returns
    -------
    ndarray of shape (n_nodes,), int32
        As :func:`node_orders` gives them; -1 for those born later.
    """
    network = frame(step).network
    found = np.full(n_nodes, NULL, dtype=np.int32)
    widths = (
        run_widths(frame, step, parameters)
        if network.positions.shape[1] == 2
        else np.ones(network.n_segments)
    )
    found[: network.n_nodes] = node_orders(network, segment_orders(network, widths))
    return found


def _lowest_at(nodes: Ids, orders: Ids, n_nodes: int) -> NDArray[np.int32]:
    """Give the lowest order of the segments at each of n nodes; nodes of shape (m, k)."""
    found = np.full(n_nodes, UNKNOWN, dtype=np.int32)
    np.minimum.at(found, nodes.ravel(), np.repeat(orders, nodes.shape[1]))
    return found
