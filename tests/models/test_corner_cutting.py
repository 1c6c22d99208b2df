"""Corner cutting, against the sentence written out; and what it leaves as it was."""

import numpy as np
import pytest
import shapely
from pydantic import ValidationError
from reference.corners import cut_corners
from reference.leaves import SMALL, leaf
from reference.networks import random_planar, random_tree

from vasc.domain import BladeParameters
from vasc.events import EventKind
from vasc.growth import IsogonicParameters, NoGrowthParameters
from vasc.models import MODELS, AreoleVenation
from vasc.models.corner_cutting import CornerCutting, CornerCuttingParameters
from vasc.network import Origin, SegmentKind
from vasc.placement import Moment
from vasc.simulation import simulate
from vasc.state import Tables
from vasc.streams import Streams
from vasc.vasculature import Vasculature

BLADE = BladeParameters(shape="ovate", length=20.0).blade()
STILL = NoGrowthParameters().growth(BLADE)
NAMES = ("placement", "refinement")


def vasculature(places, segments, growth=STILL):
    """Veins with given nodes and segments, all of step 0."""
    veins = Vasculature(Tables(), (-20.0, -20.0, 20.0, 20.0), 2.0, least_change=1)
    places = np.array(places, dtype=float)
    veins.seed(places, places * growth.scale(0))
    veins.add_segments(0, np.array(segments, dtype=np.int32), SegmentKind.EXTENSION)
    return veins


def refined(veins, *, threshold=3.0, alpha=0.6, jitter=0.0, held=(), seed=1, growth=STILL):
    """The cuts of one step."""
    moment = Moment.of(growth, 1)
    held = np.array(held, dtype=np.int32)
    return CornerCutting(threshold, alpha, jitter).refine(veins, moment, held, Streams(seed, NAMES))


def live_segments(veins):
    n_rows = veins.segments.n_rows
    return veins.segments.view("nodes")[~veins.refined[:n_rows]].tolist()


def edges_of(veins):
    """The live segments, as pairs of places."""
    places = veins.places("nodes")
    return {frozenset((tuple(places[a]), tuple(places[b]))) for a, b in live_segments(veins)}


def graphs(n):
    """Random planar graphs and trees, with branches, loops and ends."""
    rng = np.random.default_rng(7)
    for k in range(n):
        whole = random_planar(rng, 40, 0.45) if k % 2 else random_tree(rng, 40)
        yield whole.positions * 12.0, whole.segments.tolist(), rng


@pytest.mark.parametrize("alpha", [0.5, 0.6, 0.75])
@pytest.mark.parametrize("threshold", [1.5, 3.0, 9.0])
def test_cuts_are_those_of_the_sentence(threshold, alpha):
    n_cut = n_halved = 0
    for places, segments, rng in graphs(30):
        held = np.flatnonzero(rng.random(len(places)) < 0.15).tolist()
        veins = vasculature(places, segments)
        cuts = refined(veins, threshold=threshold, alpha=alpha, held=held)
        twin = cut_corners(places.tolist(), segments, held, threshold, alpha)
        assert {cut.node: (cut.first, cut.second) for cut in cuts}.keys() == twin.cut_nodes.keys()
        found, expected = sorted_edges(edges_of(veins)), sorted_edges(twin.edges())
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-12)
        n_cut += len(cuts)
        n_halved += veins.segments.n_rows - len(segments) - 3 * len(cuts) > 0
        assert not set(held) & twin.cut_nodes.keys()
    assert n_cut > 20
    assert n_halved > 0


def sorted_edges(edges):
    """Pairs of places as rows of numbers in one order."""
    rows = [sum(sorted(edge), ()) for edge in edges]
    return np.array(sorted(rows))


@pytest.mark.parametrize("alpha", [0.5, 0.6, 0.75])
def test_branches_ends_and_loops_stay_what_they_were(alpha):
    for places, segments, _ in graphs(20):
        veins = vasculature(places, segments)
        before = np.bincount(np.ravel(segments), minlength=len(places))
        cuts = refined(veins, alpha=alpha)
        after = np.bincount(np.ravel(live_segments(veins)), minlength=veins.nodes.n_rows)
        is_kept = before != 2
        np.testing.assert_array_equal(after[: len(places)][is_kept], before[is_kept])
        assert (after[len(places) :] == 2).all()
        assert (after[[cut.node for cut in cuts]] == 0).all()
        # one segment more for each node more
        n_new = veins.nodes.n_rows - len(places) - len(cuts)
        assert len(live_segments(veins)) == len(segments) + n_new
        assert veins.is_retired.sum() == len(cuts)


def test_what_is_recorded_of_a_cut():
    veins = vasculature([(0, 0), (2, 0), (2, 2), (2, 3)], [(0, 1), (1, 2), (2, 3)])
    veins.nodes.arrays["source"][:4] = [4, 5, 6, 7]
    # of node 2 after node 1 is cut: 1.2 + 1 is not too long
    (cut,) = refined(veins, threshold=2.9, alpha=0.6)
    assert cut == (1, 4, 5)
    np.testing.assert_allclose(veins.nodes.view("position")[4:], [(1.2, 0), (2, 0.8)], atol=1e-15)
    assert veins.nodes.view("source")[4:].tolist() == [5, 5]
    assert veins.nodes.view("parent")[4:].tolist() == [1, 1]
    assert veins.nodes.view("birth")[4:].tolist() == [1, 1]
    assert veins.nodes.view("origin")[4:].tolist() == [Origin.REFINEMENT] * 2
    # from the seed on, as the segments they replace
    assert sorted(live_segments(veins)) == [[0, 4], [2, 3], [4, 5], [5, 2]]
    events = veins.tables["events"]
    rows = list(zip(*(events.view(name).tolist() for name in ("kind", "subject", "object")),
                    strict=True))  # fmt: skip
    assert rows == [
        (EventKind.SEGMENT_REFINED, 0, 4),
        (EventKind.SEGMENT_REFINED, 1, 5),
        (EventKind.NODE_RETIRED, 1, -1),
    ]


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 0, 2), (1, 2, 0)])
def test_proximal_nodes_stay_first_in_whatever_order_segments_were_made(order):
    path = [(0, 1), (1, 2), (2, 3)]
    veins = vasculature([(0, 0), (4, 0), (4, 6), (9, 9)], [path[k] for k in order])
    cuts = refined(veins)
    assert [cut.node for cut in cuts] == [1, 2]
    segments = live_segments(veins)
    following = dict(segments)
    assert len(following) == len(segments) == 5
    node, met = 0, [0]
    while node in following:
        node = following[node]
        met.append(node)
    assert len(met) == 6
    assert met[-1] == 3


def test_half_weights_take_the_middles_of_both_segments():
    veins = vasculature([(0, 0), (4, 0), (4, 6)], [(0, 1), (1, 2)])
    refined(veins, alpha=0.5)
    assert veins.nodes.view("position")[3:].tolist() == [[2.0, 0.0], [4.0, 3.0]]


@pytest.mark.parametrize("threshold", [4.0, 4.0 - 1e-9])
def test_two_segments_of_just_the_threshold_are_not_too_long(threshold):
    veins = vasculature([(0, 0), (2, 0), (2, 2)], [(0, 1), (1, 2)])
    assert len(refined(veins, threshold=threshold)) == (threshold < 4.0)


def test_held_nodes_are_not_cut_and_long_segments_between_them_are_halved():
    places = [(0, 0), (4, 0), (8, 0), (12, 0)]
    veins = vasculature(places, [(0, 1), (1, 2), (2, 3)])
    assert refined(veins, held=[1, 2]) == []
    middles = veins.nodes.view("position")[4:].tolist()
    assert sorted(middles) == [[2.0, 0.0], [6.0, 0.0], [10.0, 0.0]]


def test_nothing_to_cut():
    veins = vasculature([(0, 0), (1, 0), (2, 0)], [(0, 1), (1, 2)])
    assert len(refined(veins)) == 0
    assert veins.nodes.n_rows == 3
    assert veins.tables["events"].n_rows == 0


def test_the_threshold_is_in_segment_lengths_of_the_grown_blade():
    growth = IsogonicParameters(final_length=80.0, length_per_step=20.0).growth(BLADE)
    scale = growth.scale(1)
    assert scale == 2.0
    for size, n_cuts in ((0.76, 1), (0.74, 0)):
        veins = vasculature([(0, 0), (size, 0), (size, size)], [(0, 1), (1, 2)], growth)
        assert len(refined(veins, growth=growth)) == n_cuts


def test_jitter_is_that_of_the_stream():
    segments = [(k, k + 1) for k in range(19)]
    places = [(3.0 * k, float(k % 2)) for k in range(20)]
    found = {}
    for name, jitter, seed in (
        ("none", 0.0, 1),
        ("one", 0.2, 1),
        ("same", 0.2, 1),
        ("two", 0.2, 2),
    ):
        veins = vasculature(places, segments)
        refined(veins, jitter=jitter, seed=seed)
        found[name] = veins.nodes.view("position")[20:].copy()
    np.testing.assert_array_equal(found["one"], found["same"])
    assert (found["one"] != found["two"]).any()
    shifts = found["one"] - found["none"]
    assert np.abs(shifts).max() <= 0.2
    assert np.abs(shifts).max(axis=0).min() > 0.1
    assert shifts.min() < 0.0 < shifts.max()


def test_only_jitter_draws_from_its_stream():
    calm = AreoleVenation.model_validate(leaf("areole", SMALL))
    assert calm.stream_names == ("placement",)
    jittered = {"refinement": {"kind": "corner_cutting", "jitter": 0.05}}
    wild = AreoleVenation.model_validate(leaf("areole", SMALL, **jittered))
    assert wild.stream_names == NAMES
    ends = {}
    for name, parameters, seed in (("calm", calm, 1), ("one", wild, 1), ("other", wild, 2)):
        streams = Streams(seed, NAMES)
        words = streams.state()
        *_, last = simulate(parameters.model(), streams, max_steps=70)
        ends[name] = last.rows("nodes", "position").copy()
        drawn = (streams.state() != words).any(axis=1).tolist()
        assert drawn == [False, name != "calm"]
    assert ends["one"].tobytes() != ends["other"].tobytes() != ends["calm"].tobytes()
    again = Streams(1, NAMES)
    *_, last = simulate(wild.model(), again, max_steps=70)
    assert last.rows("nodes", "position").tobytes() == ends["one"].tobytes()


@pytest.mark.parametrize("alpha", [0.49, 1.0, 0.0])
def test_weights_that_cut_nothing_or_across_are_refused(alpha):
    with pytest.raises(ValidationError, match="alpha"):
        CornerCuttingParameters(alpha=alpha)


@pytest.mark.parametrize("kind", ["areole", "closed", "open"])
def test_veins_of_a_whole_leaf_stay_fine_and_become_smooth(kind):
    lengths, angles = {}, {}
    for refinement in ("corner_cutting", "none"):
        tables = leaf(kind, SMALL, 8.0, until=100, refinement={"kind": refinement})
        *_, last = simulate(MODELS[kind].model_validate(tables).model(), Streams(1), max_steps=140)
        network = last.network
        lengths[refinement] = network.lengths.max()
        angles[refinement] = np.mean(turns(network))
        assert not (
            shapely.length(shapely.linestrings(network.positions[network.segments])) == 0
        ).any()
    # a segment between nodes that were never cut may be three segments long, and longer by growth
    assert lengths["corner_cutting"] < 3.5 < lengths["none"]
    assert angles["corner_cutting"] < angles["none"]


def turns(network):
    """The angles by which veins turn at nodes with two segments."""
    found = []
    around = {}
    for a, b in network.segments.tolist():
        around.setdefault(a, []).append(b)
        around.setdefault(b, []).append(a)
    for node, ends in around.items():
        if len(ends) == 2:
            one, two = network.positions[ends] - network.positions[node]
            cosine = -(one @ two) / np.sqrt((one @ one) * (two @ two))
            found.append(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return found
