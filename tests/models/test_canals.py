"""Canals of a source: which differentiates first, and where they lead after a cut."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from reference import canals as slow

from vasc.domain import BladeParameters
from vasc.events import EventKind
from vasc.growth import NoGrowthParameters
from vasc.models.canals import Canal, CanalPerception, Canals
from vasc.models.perception import Cut
from vasc.network import Origin, SegmentKind
from vasc.placement import Moment
from vasc.sources import Cause
from vasc.state import Tables
from vasc.states import CanalState
from vasc.vasculature import Vasculature

BLADE = BladeParameters(shape="ovate", length=20.0).blade()
MOMENT = Moment.of(NoGrowthParameters().growth(BLADE), 1)
TIE = 0.1


def vasculature(nodes, veins_of, sources):
    """Vein nodes, each of the vein that leads to a source, and sources born in step 1."""
    veins = Vasculature(Tables(), (-30.0, -30.0, 30.0, 30.0), 2.0, least_change=1)
    places = np.array(nodes, dtype=float)
    veins.seed(places, places)
    veins.nodes.arrays["source"][: len(places)] = veins_of
    veins.reserve_sources(len(sources))
    there = np.array(sources, dtype=float)
    veins.new_places(len(sources))[:] = there
    veins.add_sources(1, there, there, Cause.SPACE)
    return veins


def induced(nodes, veins_of, source):
    """The canals of a source, the one that differentiates first, and all canals."""
    veins = vasculature(nodes, veins_of, [source])
    found = CanalPerception(Canals(), TIE).perceive(veins, MOMENT)
    (inbound,) = found.under_way()
    assert inbound.state == CanalState.INBOUND
    assert inbound.tip == inbound.node
    others = [canal for canal in found.by_source[0] if canal is not inbound]
    assert all(canal.state == CanalState.PRE_PATTERN for canal in others)
    return [canal.node for canal in found.by_source[0]], inbound.node


def test_of_equally_near_neighbors_the_oldest_vein_goes_first():
    nodes = [(10.0, 0.0), (-10.0, 0.0), (0.0, 10.0)]
    assert induced(nodes, [2, 1, 3], (0.0, 0.0)) == ([1, 0, 2], 1)
    assert induced(nodes, [2, 3, 1], (0.0, 0.0)) == ([1, 0, 2], 2)
    # of one vein the lowest node, of these the one nearest to the midline
    assert induced([(6.0, 8.0), (0.0, -10.0)], [1, 1], (0.0, 0.0))[1] == 1
    assert induced([(9.0, 0.0), (-1.0, 0.0)], [1, 1], (4.0, 0.0))[1] == 1


def test_the_seed_and_the_first_vein_are_one():
    # node 0 is a seed and node 1 of the first vein; the lower one goes first
    assert induced([(0.0, 10.0), (10.0, 0.0)], [-1, 0], (0.0, 0.0))[1] == 1
    assert induced([(0.0, -10.0), (10.0, 0.0)], [-1, 0], (0.0, 0.0))[1] == 0


def test_a_neighbor_that_is_nearer_by_more_than_a_tie_goes_first():
    for gap, first in ((0.09, 0), (0.11, 1)):
        assert induced([(10.0, 0.0), (-10.0 + gap, 0.0)], [1, 2], (0.0, 0.0))[1] == first


@given(st.integers(0, 2**32 - 1), st.integers(1, 25))
def test_the_first_canal_is_that_of_the_sentence(seed, n_nodes):
    rng = np.random.default_rng(seed)
    angles = rng.choice(24, min(n_nodes, 24), replace=False) * np.pi / 12.0
    radii = 8.0 + rng.choice([0.0, 0.05, 0.2, 3.0], len(angles))
    nodes = radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    veins_of = rng.integers(-1, 4, len(nodes))
    nodes, source = nodes.tolist(), (0.0, 0.0)
    neighbors = slow.relative_neighbors(source, nodes)
    first = slow.closest(neighbors, source, nodes, veins_of.tolist(), TIE)
    assert induced(nodes, veins_of, source) == (neighbors, first)


def test_a_leaning_vein_leaves_nearer_to_the_base_but_never_beyond_a_branch():
    # a midvein of 13 nodes, 1 D apart, and a branch at the height 2; the source is 4 D off
    nodes = [(0.0, float(y)) for y in range(13)] + [(-1.0, 2.0)]
    segments = [(y, y + 1) for y in range(12)] + [(2, 13)]
    for lean, cause, height in (
        (0.0, Cause.SPACE, 8),
        (0.5, Cause.SPACE, 6),
        (2.0, Cause.SPACE, 2),
        (0.5, Cause.MARGIN, 8),
    ):
        veins = vasculature(nodes, [0] * 14, [(4.0, 8.0)])
        veins.add_segments(0, np.array(segments, dtype=np.int32), SegmentKind.EXTENSION)
        veins.nodes.arrays["origin"][1:14] = Origin.EXTENSION
        veins.sources.arrays["cause"][0] = cause
        (inbound,) = CanalPerception(Canals(), TIE, lean).perceive(veins, MOMENT).under_way()
        assert (inbound.node, inbound.tip) == (8, height)


def test_canals_lead_to_the_nearer_of_the_nodes_that_replace_one():
    # node 0 becomes nodes 1, on the left, and 2, on the right; node 3 is the tip of a strand
    nodes = [(0.0, 0.0), (-2.0, 0.0), (2.0, 0.0), (1.0, 9.0), (-9.0, 0.0)]
    for x, expected in ((-5.0, 1), (5.0, 2), (0.0, 1)):
        veins = vasculature(nodes, [0] * 5, [(x, 5.0), (x, -5.0)])
        canals = [
            Canal(0, 0, 0, CanalState.PRE_PATTERN),
            Canal(1, 0, 4, CanalState.PRE_PATTERN),
            # a strand that comes from the node is no matter of the cut
            Canal(2, 1, 0, CanalState.INBOUND, 3),
            # one on its way takes the node nearer to its tip, wherever its source was
            Canal(3, 1, 0, CanalState.OUTBOUND, 3),
        ]
        perception = CanalPerception(Canals({0: canals[:2], 1: canals[2:]}), TIE)
        perception.follow(veins, MOMENT, [Cut(0, 1, 2)])
        assert [canal.node for canal in canals] == [expected, 4, 0, 2]
        events = veins.tables["events"]
        rows = events.view("kind") == EventKind.CANAL_RETARGETED
        assert events.view("subject")[rows].tolist() == [0, 3]
        assert events.view("object")[rows].tolist() == [expected, 2]


def test_tips_and_drained_sources_are_held():
    veins = vasculature([(0.0, 0.0)] * 6, [0] * 6, [(5.0, 5.0)])
    canals = [
        Canal(0, 0, 1, CanalState.PRE_PATTERN),
        Canal(1, 0, 2, CanalState.OUTBOUND, 4),
        Canal(2, 0, 2, CanalState.INBOUND, 3),
    ]
    perception = CanalPerception(Canals({0: canals}, {0: 5}), TIE)
    assert perception.held(veins).tolist() == [3, 4, 5]
