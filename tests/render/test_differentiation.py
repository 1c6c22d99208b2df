"""Canals and strands: told by the tables of a moment, and drawn in their states."""

from dataclasses import replace

import numpy as np
import pytest
from reference.networks import PlainBlade, PlainMoment, network, sources
from reference.recordings import cross_leaf

from vasc.analysis.ancestry import descent
from vasc.canals import NO_CANALS, CanalSet
from vasc.config import load, parse_override
from vasc.models.canals import UNDER_WAY
from vasc.render import LeafStyle, draw_leaf
from vasc.render.differentiation import segment_states, state_key, undifferentiated
from vasc.render.leaf import narrowest_of, view_of
from vasc.render.styles import SOURCE_STATE_COLORS, STATE_COLORS
from vasc.simulation import simulate
from vasc.states import CanalState
from vasc.streams import Streams

VEIN, INBOUND, OUTBOUND = range(3)
SETTINGS = ("placement.until=255", "stop.steps=255", "mesophyll.time=225")


@pytest.fixture(scope="module")
def followed():
    """The states of a leaf, and what its model knew of the canals at each of them."""
    experiment = load("arabidopsis-first-leaf", [parse_override(text) for text in SETTINGS])
    model = experiment.parameters.model(experiment.folder)
    streams, found = Streams(1), []
    for state in simulate(model, streams):
        known = {
            canal.id: (canal.source, canal.node, canal.state, canal.tip)
            for canals in model.perception.canals.by_source.values()
            for canal in canals
        }
        found.append((state, known))
    return found


def test_a_state_tells_what_its_model_knows(followed):
    for state, known in followed:
        canals = state.canals
        is_open = ~np.isin(canals.states, (CanalState.VEIN, CanalState.ARRESTED))
        assert canals.ids[is_open].tolist() == sorted(known)
        for row in np.flatnonzero(is_open).tolist():
            source, node, code, tip = known[int(canals.ids[row])]
            assert (canals.sources[row], canals.states[row]) == (source, code)
            # the vein that an inbound strand has left may be refined meanwhile
            assert code == CanalState.INBOUND or canals.nodes[row] == node
            assert code not in UNDER_WAY or canals.tips[row] == tip


def test_every_state_of_canals_occurs(followed):
    seen = {code for state, _ in followed for code in state.canals.states.tolist()}
    assert seen == set(CanalState) - {CanalState.GROUND}


def test_segments_of_a_strand_under_way_lead_from_its_start_to_its_tip(followed):
    n_seen = 0
    for state, known in followed:
        directions = descent(state.network)
        states = segment_states(state.canals, directions)
        tips = {tip: code for _, _, code, tip in known.values() if code in UNDER_WAY}
        ends = np.isin(directions.distal, list(tips))
        for row in np.flatnonzero(ends).tolist():
            code = tips[int(directions.distal[row])]
            is_new = state.network.births[directions.distal[row]] == state.step
            expected = INBOUND if code == CanalState.INBOUND else OUTBOUND
            # the tip of a strand that has not moved yet belongs to the vein it leaves
            assert not is_new or states[row] == expected
            n_seen += is_new
        if not tips:
            assert (states == VEIN).all()
    assert n_seen > 50


def test_tips_of_arrested_strands_end_blindly(followed):
    state = followed[-1][0]
    tips = state.canals.tips[state.canals.states == CanalState.ARRESTED]
    degrees = np.bincount(state.network.segments.ravel(), minlength=state.network.n_nodes)
    assert len(tips) > 0
    assert (degrees[tips] == 1).all()


def hand_made():
    """A midvein; a source with one canal inbound half-way, and one that waits."""
    veins = network([(0, 0), (0, 5), (0, 10), (2, 5)], [(0, 1), (1, 2), (1, 3)])
    canals = CanalSet(
        ids=np.array([0, 1], dtype=np.int32),
        sources=np.array([0, 0], dtype=np.int32),
        source_positions=np.array([[4.0, 5.0], [4.0, 5.0]]),
        nodes=np.array([1, 2], dtype=np.int32),
        states=np.array([CanalState.INBOUND, CanalState.PRE_PATTERN], dtype=np.int8),
        tips=np.array([3, -1], dtype=np.int32),
        strands=np.array([-1, -1, -1, 0], dtype=np.int32),
    )
    return PlainMoment(veins, cross_leaf().blade, sources([(4.0, 5.0)]), canals=canals)


def test_what_is_no_vein_yet_runs_from_the_tip_or_the_source():
    moment = hand_made()
    lines = undifferentiated(moment.canals, moment.network.positions)
    assert lines.tolist() == [[[4.0, 5.0], [0.0, 10.0]], [[2.0, 5.0], [4.0, 5.0]]]


def test_a_strand_is_drawn_in_its_colour_and_the_source_in_red():
    moment = hand_made()
    states = segment_states(moment.canals, descent(moment.network))
    assert states.tolist() == [VEIN, VEIN, INBOUND]
    view = view_of(moment.blade, LeafStyle())
    figure = draw_leaf(moment, color="state", view=view)
    figure.set_dpi(200)
    figure.canvas.draw()
    pixels = np.asarray(figure.canvas.buffer_rgba())[:, :, :3]
    left, bottom, right, top = view.box
    for (x, y), color in (
        ((0.0, 2.0), STATE_COLORS["vein"]),
        ((1.0, 5.0), STATE_COLORS["inbound"]),
        ((4.0, 5.0), SOURCE_STATE_COLORS["active"]),
    ):
        row = int((top - y) / (top - bottom) * pixels.shape[0])
        column = int((x - left) / (right - left) * pixels.shape[1])
        assert "#{:02x}{:02x}{:02x}".format(*pixels[row, column]) == color


def test_only_states_colour_strands_and_draw_canals():
    plain = draw_leaf(hand_made(), scale_bar=False).axes[0]
    states = draw_leaf(hand_made(), color="state", scale_bar=False, key=False).axes[0]
    assert len(plain.collections) == 1
    assert len(plain.lines) == 0
    assert len(states.collections) == 2


def test_a_leaf_without_canals_has_a_short_key():
    assert state_key(NO_CANALS).labels == ("vein",)
    figure = draw_leaf(cross_leaf(), color="state", scale_bar=False)
    assert [text.get_text() for text in figure.axes[0].texts] == ["vein", "state"]


def test_a_picture_is_as_wide_as_its_key():
    assert narrowest_of(hand_made(), "state") > 4.0
    assert narrowest_of(hand_made(), "age") == narrowest_of(cross_leaf(), "age") < 2.0


@pytest.mark.parametrize("segment", [0.3, 0.4, 0.5, 0.75])
@pytest.mark.parametrize("squeeze", [0.3, 0.7])
def test_the_scale_bar_ends_before_the_key_begins(segment, squeeze):
    moment = hand_made()
    rings = tuple(ring * (squeeze, 1.0) for ring in moment.blade.rings)
    units = {"length": "mm", "segment": segment}
    figure = draw_leaf(replace(moment, blade=PlainBlade(rings, 10.0)), color="state", units=units)
    figure.canvas.draw()
    (axes,) = figure.axes
    bar = max(axes.lines, key=lambda line: line.get_linewidth() * (line.get_linestyle() == "-"))
    title = next(text for text in axes.texts if text.get_text() == "state")
    assert bar.get_window_extent().x1 < title.get_window_extent().x0
