"""Vein widths by elongation: veins that are stretched grow wider (Runions 2008, section 5.2)."""

import numpy as np

from vasc.analysis.moment import Moment
from vasc.analysis.widths import Pipes
from vasc.arrays import Floats
from vasc.network import Origin, VeinNetwork


class Elongation:
    """Follows a run step by step and keeps the width of every node.

    The width of a node increases in proportion to the elongation of the segments
    that contain it: w becomes w (1 + kappa (l' / l - 1)), where l and l' are the
    lengths of these segments together before and after a step of growth. Nodes
    begin with the width 1; those that refinement adds inherit that of the node they
    replace, or of the thinner end of the segment they halve.

    Parameters
    ----------
    kappa : float
        Increase of the width relative to that of the length.

    Attributes
    ----------
    widths : ndarray of shape (n,), float64
        Width of every node of the latest moment, that of a new node is 1.
    """

    def __init__(self, kappa: float = 1.0) -> None:
        self.kappa = kappa
        self.widths: Floats = np.empty(0)
        self._network: VeinNetwork | None = None

    def update(self, moment: Moment) -> None:
        """Take the next step of the run into account."""
        network = moment.network
        if self._network is not None:
            self._stretch(self._network, network)
        self._add(network)
        self._network = network

    def _stretch(self, before: VeinNetwork, after: VeinNetwork) -> None:
        """Widen the nodes whose segments growth has stretched."""
        ends = before.segments
        now = after.positions[ends]
        lengths = np.sqrt(((now[:, 1] - now[:, 0]) ** 2).sum(axis=1))
        n_nodes = before.n_nodes
        sums = [
            np.bincount(ends.ravel(), np.repeat(values, 2), minlength=n_nodes)
            for values in (before.lengths, lengths)
        ]
        has_length = sums[0] > 0.0
        stretch = np.ones(n_nodes)
        stretch[has_length] = sums[1][has_length] / sums[0][has_length]
        self.widths = self.widths * (1.0 + self.kappa * (stretch - 1.0))

    def _add(self, network: VeinNetwork) -> None:
        """Give widths to new nodes."""
        widths = np.ones(network.n_nodes)
        n_known = len(self.widths)
        widths[:n_known] = self.widths
        is_refined = network.origins == Origin.REFINEMENT
        is_refined[:n_known] = False
        thinner = self._thinner_ends(network)
        # a parent may be as new: rows are in the order of birth
        is_replacing = np.isin(network.parents, network.retired)
        for node in np.flatnonzero(is_refined).tolist():
            inherited = widths[network.parents[node]]
            widths[node] = inherited if is_replacing[node] else min(inherited, thinner[node])
        self.widths = widths

    def _thinner_ends(self, network: VeinNetwork) -> Floats:
        """Give for every node the width of its thinnest neighbor that is not new."""
        known = np.full(network.n_nodes, np.inf)
        known[: len(self.widths)] = self.widths
        thinner = np.full(network.n_nodes, np.inf)
        for near, far in (network.segments.T, network.segments.T[::-1]):
            np.minimum.at(thinner, near, known[far])
        return thinner


def stretched_pipes(network: VeinNetwork, widths: Floats, exponent: float) -> Pipes:
    """Give the pipes that veins of given widths stand for, so that they are drawn as wide.

    A segment is as wide as the thinner of its nodes: a junction is as wide as its
    widest vein, and the thinner ones do not swell toward it.

    Parameters
    ----------
    network : VeinNetwork
        The veins.
    widths : ndarray of shape (n,), float64
        Width of every node.
    exponent : float
        That of :func:`vasc.analysis.widths.radii`.

    Returns
    -------
    Pipes
        Of nodes ``widths**exponent``; empty for a network without nodes.
    """
    amounts = widths**exponent
    return Pipes(amounts, amounts[network.segments].min(axis=1, initial=np.inf))
