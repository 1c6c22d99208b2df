"""A step cut out of a run is the recorded one, in the unit of the run."""

import numpy as np
import pytest

from vasc.analysis import statistics
from vasc.analysis.elongation import Elongation
from vasc.analysis.widths import WidthParameters, segment_radii
from vasc.cli.show import described
from vasc.events import EventKind
from vasc.export import specimen
from vasc.export.specimen import specimens
from vasc.network import SegmentKind
from vasc.pieces import growths_of
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


@pytest.mark.parametrize("name", ["closed", "areoles"])
def test_pieces_have_the_source_and_the_birth_of_what_grew_there(runs, name):
    # halved segments in one run, cut corners in the other: the chain of cuts is followed by hand
    with Timeline(getattr(runs, name)) as timeline:
        found, events = specimen(timeline), timeline.events
        ends, births = timeline.table("segments", "nodes"), timeline.table("segments", "birth")
        kinds, sources = timeline.table("segments", "kind"), timeline.table("nodes", "source")
        parents = timeline.table("nodes", "parent")
    is_cut = events["kind"] == EventKind.SEGMENT_REFINED
    objects = events["object"][is_cut].tolist()
    replaced = dict(zip(objects, events["subject"][is_cut].tolist(), strict=True))
    is_join = events["kind"] == EventKind.VEIN_JOINED
    subjects = events["subject"][is_join].tolist()
    met = dict(zip(subjects, events["object"][is_join].tolist(), strict=True))
    n_pieces = 0
    rows = zip(found.segment_ids, found.vein_births, found.segment_causes, strict=True)
    for segment, birth, cause in rows:
        while kinds[segment] == SegmentKind.REFINEMENT:
            first, second = ends[segment].tolist()
            is_corner = parents[first] == parents[second] and {first, second} <= set(replaced)
            segment = replaced[first if is_corner else max(first, second)]
            n_pieces += 1
        assert birth == births[segment]
        assert cause == met.get(segment, sources[ends[segment, 1]])
    assert n_pieces > 20
    assert (found.vein_births <= found.segment_births).all()


def test_a_chain_of_cut_corners_keeps_the_source_of_every_node():
    # 0-1-2-3, caused by sources 10, 11 and 12; the corners at 1 and 2 are cut: 4 5 and 6 7
    nodes = {
        "parent": np.array([-1, 0, 1, 2, 1, 1, 2, 2]),
        "source": np.array([-1, 10, 11, 12, 10, 10, 11, 11]),
    }
    ends = [(0, 1), (1, 2), (2, 3), (0, 4), (4, 5), (5, 2), (5, 6), (6, 7), (7, 3)]
    segments = {
        "nodes": np.array(ends),
        "birth": np.array([1, 2, 3, 9, 9, 9, 9, 9, 9]),
        "kind": np.array([0, 0, 0, 2, 2, 2, 2, 2, 2]),
    }
    events = {
        "kind": np.full(4, EventKind.SEGMENT_REFINED),
        "subject": np.array([0, 1, 5, 2]),
        "object": np.array([4, 5, 6, 7]),
    }
    found = growths_of(np.array([3, 4, 6, 7, 8]), nodes, segments, events)
    assert found.ids.tolist() == [0, 0, 1, 1, 2]
    assert found.causes.tolist() == [10, 10, 11, 11, 12]
    assert found.births.tolist() == [1, 1, 2, 2, 3]


def test_nodes_are_counted_in_one_way(runs):
    with Timeline(runs.areoles) as timeline:
        frame = timeline.frame()
        assert len(frame.network.retired)
        n_nodes = len(specimen(timeline).ids)
        assert frame.network.n_vein_nodes == n_nodes
        assert described(timeline)["nodes"] == statistics(frame)["nodes"] == n_nodes
        assert frame.to_networkx().number_of_nodes() == n_nodes
        assert repr(frame).endswith(f"nodes={n_nodes})")
        assert repr(frame.network).startswith(f"VeinNetwork(nodes={n_nodes}, segments=")
        for shown in (timeline, frame, frame.network):
            assert f"<th>nodes</th><td>{n_nodes:,}</td>" in shown._repr_html_()
        assert repr(timeline.lineage) == f"Lineage({str(runs.areoles)!r})"
        assert "<th>last step</th><td>150</td>" in timeline.lineage._repr_html_()
