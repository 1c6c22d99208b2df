"""Murray's law where veins branch: the exponent that widths of a run obey."""

import numpy as np

from vasc.analysis.ancestry import descent
from vasc.analysis.widths import WidthParameters, segment_radii
from vasc.arrays import Floats
from vasc.network import VeinNetwork

LARGEST = 64.0
"""Exponents above this are not told apart."""


def branching_exponents(network: VeinNetwork, parameters: WidthParameters) -> Floats:
    """Give n for which w0^n is the sum of w_i^n at each branching of a tree.

    Parameters
    ----------
    network : VeinNetwork
        Open venation.
    parameters : WidthParameters
        How wide its veins are.

    Returns
    -------
    ndarray of shape (b,), float64
        One for each node with a parent and two children or more, by node; empty without.

    Notes
    -----
    Solved for each node on its own by halving an interval: nothing of the recursion that
    made the widths is used.
    """
    widths = segment_radii(network, parameters)
    directions = descent(network)
    is_branching = (directions.n_children >= 2) & (directions.n_parents == 1)
    below = np.zeros(network.n_nodes)
    below[directions.distal] = widths
    rows = np.flatnonzero(is_branching[directions.proximal])
    nodes = directions.proximal[rows]
    ratios = widths[rows] / below[nodes]
    low, high = np.zeros(network.n_nodes), np.full(network.n_nodes, LARGEST)
    for _ in range(80):
        middle = (low + high) / 2.0
        sums = np.bincount(nodes, ratios ** middle[nodes], minlength=network.n_nodes)
        is_above = sums > 1.0
        low, high = np.where(is_above, middle, low), np.where(is_above, high, middle)
    return high[is_branching]
