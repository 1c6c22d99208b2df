"""Widths of a run by the rule that its config asks for."""

import numpy as np
import pytest
from reference.networks import PlainMoment, network, sources, square_blade

from vasc.analysis import WidthParameters, murray_radii, run_widths
from vasc.analysis.run_widths import widths_at, widths_of

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


@pytest.mark.parametrize("rule", ["murray", "elongation"])
def test_widths_at_several_steps_are_those_of_each(rule):
    asked = WidthParameters(rule=rule, tip_radius=3.0)
    # a step that is asked for twice is given twice
    steps = [0, 1, 1]
    found = list(widths_at(moments().__getitem__, steps, asked))
    assert len(found) == len(steps)
    for step, (moment, widths) in zip(steps, found, strict=True):
        assert moment.network.n_segments == len(widths)
        assert np.array_equal(widths, run_widths(moments().__getitem__, step, asked))


def test_a_config_without_widths_asks_for_the_default_ones():
    assert widths_of({}) == widths_of({"widths": {}}) == WidthParameters()
    assert widths_of({"widths": {"exponent": 3.0}}).exponent == 3.0
