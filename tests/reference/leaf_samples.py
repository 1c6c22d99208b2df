"""Leaves to be judged, drawn by hand: their numbers are known or made to fail."""

from functools import cache

import numpy as np
from reference.drawn_networks import honeycomb

from vasc.real_network import RealNetwork
from vasc.validation.vein_statistics import Densities, LeafReport, LeafSample, check_leaf
from vasc.validation.vein_statistics.checks import check_growing, check_open
from vasc.validation.vein_statistics.samples import dalbergia


@cache
def regular_leaf(name="honeycomb", kind="closed"):
    """Regular hexagons with widths at random: real in numbers of corners, and in little else."""
    net = honeycomb(12, 12)
    widths = np.random.default_rng(5).uniform(1.0, 9.0, net.n_segments)
    return LeafSample(name, kind, RealNetwork(net, widths, net.lengths, "D"))


@cache
def real_leaf():
    """The leaflet of Dalbergia, measured once."""
    return dalbergia()


def small_report():
    """A report without a run: hexagons beside the real leaf."""
    leaves = [regular_leaf(), real_leaf()]
    areas = np.array([10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0])
    densities = Densities(areas, areas**-0.5, np.full(8, 2.0))
    exponents = np.array([2.0, 2.0 + 1e-9])
    checks = [check for sample in leaves for check in check_leaf(sample)]
    checks += check_growing("honeycomb", densities)
    checks += check_open(regular_leaf(), exponents, 2.0)
    return LeafReport(checks, leaves, exponents, {"honeycomb": densities})
