"""Widths of a run by the rule that its config asks for."""

import numpy as np
import pytest
from reference.networks import PlainMoment, network, sources, square_blade

from vasc.analysis import WidthParameters, murray_radii, run_widths

FORK = [(0, 1), (1, 2), (1, 3)]


def moments():
    """A fork whose blade doubles in size, then gets a third branch."""
    points = np.array([(0, 0), (0, 1), (-1, 2), (1, 2)], dtype=float)
    later = np.vstack([2.0 * points, [[0.0, 3.0]]])
    nets = [network(points, FORK), network(later, [*FORK, (1, 4)])]
    return [PlainMoment(net, square_blade(), sources(), step=k) for k, net in enumerate(nets)]


def test_by_murray():
    widths = run_widths(moments().__getitem__, 0, WidthParameters(tip_radius=3.0))
    radii = murray_radii(moments()[0].network, WidthParameters(tip_radius=3.0))
    assert widths == pytest.approx([2 * radii[1], 6.0, 6.0])
    assert widths[0] == pytest.approx(6.0 * np.sqrt(2.0))


def test_by_elongation_old_veins_are_wide():
    asked = WidthParameters(rule="elongation", tip_radius=3.0)
    assert run_widths(moments().__getitem__, 0, asked) == pytest.approx([6.0] * 3)
    # all that was there has doubled its length and its width; the new branch is as wide as its tip
    assert run_widths(moments().__getitem__, 1, asked) == pytest.approx([12.0, 12.0, 12.0, 6.0])
