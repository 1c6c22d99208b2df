"""A step cut out of a run is the recorded one, in the unit of the run."""

import numpy as np
import pytest

from vasc.analysis.elongation import Elongation
from vasc.analysis.widths import WidthParameters, segment_radii
from vasc.export import specimen
from vasc.export.specimen import specimens
from vasc.timeline import Timeline


def test_lengths_are_in_the_unit_of_the_run(timeline):
    found, network = specimen(timeline), timeline.frame().network
    scale = 4.0 if timeline.units else 1.0
    assert found.unit.name == ("um" if timeline.units else "D")
    np.testing.assert_array_equal(found.positions, network.positions[found.ids] * scale)
    np.testing.assert_allclose(found.lengths, network.lengths * scale, rtol=1e-12)
    assert found.run == timeline.path.name
    assert found.step == timeline.last_step
    assert any("um; D" in line for line in found.heading) == bool(timeline.units)


def test_segments_join_the_same_nodes(timeline):
    found, network = specimen(timeline), timeline.frame().network
    pairs = np.sort(found.ids[found.ends], axis=1)
    np.testing.assert_array_equal(pairs, np.sort(network.segments, axis=1))
    # the proximal node grew first
    assert (found.ranks[found.ends[:, 0]] < found.ranks[found.ends[:, 1]]).all()


def test_nodes_that_were_replaced_are_left_out(runs):
    with Timeline(runs.areoles) as timeline:
        network = timeline.frame().network
        assert len(network.retired)
        found = specimen(timeline)
        assert len(found.ids) == network.n_vein_nodes
        assert not set(found.ids.tolist()) & set(network.retired.tolist())


def test_widths_are_those_that_the_config_asks_for(runs):
    with Timeline(runs.closed) as timeline:
        parameters = WidthParameters(tip_radius=0.2, exponent=2.5)
        expected = 8.0 * segment_radii(timeline.frame().network, parameters)
        found = specimen(timeline)
    np.testing.assert_allclose(found.widths, expected)
    assert found.radii.max() == pytest.approx(found.widths.max() / 2.0)


def test_widths_by_elongation_are_the_same_alone_and_in_a_series(runs):
    with Timeline(runs.areoles) as timeline:
        elongation = Elongation(1.0)
        for step in range(timeline.last_step + 1):
            elongation.update(timeline.frame(step))
        series = list(specimens(timeline, [50, timeline.last_step]))
        assert [each.step for each in series] == [50, timeline.last_step]
        network = timeline.frame().network
        expected = 0.2 * np.maximum(elongation.widths[network.segments].min(axis=1), 1.0)
        np.testing.assert_allclose(series[1].widths, expected)
        for each in series:
            np.testing.assert_array_equal(specimen(timeline, each.step).widths, each.widths)


def test_the_outline_is_that_of_the_step(runs):
    with Timeline(runs.closed) as timeline:
        small, large = specimen(timeline, 0), specimen(timeline)
        blade = timeline.frame().blade
    assert np.ptp(large.rings[0], axis=0)[1] == pytest.approx(4.0 * blade.length)
    assert np.ptp(small.rings[0], axis=0)[1] == pytest.approx(80.0)
    with Timeline(runs.stem) as timeline:
        assert specimen(timeline).rings == ()
