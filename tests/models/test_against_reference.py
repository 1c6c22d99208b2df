"""The models grow, node for node, what the obvious program grows."""

import numpy as np
import pytest
from reference import colonization as slow
from reference.comparing import assert_same, config, model_of

from vasc.errors import VascError
from vasc.events import EventKind, StopReason
from vasc.simulation import simulate
from vasc.streams import Streams


def sources_in_disc(n_sources, seed, spread=7.0):
    """Places in a disc that touches the origin."""
    rng = np.random.default_rng(seed)
    places = rng.uniform(-spread, spread, (4 * n_sources, 2))
    inside = places[(places**2).sum(axis=1) < (0.9 * spread) ** 2][:n_sources]
    return [(x, y + spread) for x, y in inside.tolist()]


def run(tables):
    """The last state of a config's run."""
    *_, last = simulate(model_of(tables), Streams(1), max_steps=400)
    return last


@pytest.mark.parametrize("kind", ["open", "closed"])
@pytest.mark.parametrize("seed", range(4))
def test_static_blade(kind, seed):
    points = sources_in_disc(25, seed)
    state = run(config(kind, points))
    rules = slow.Rules(is_closed=kind == "closed", kill=1.2)
    given = [(1, p) for p in points]
    assert_same(state, slow.grow([(0.0, 0.0)], given, rules, state.step))
    assert state.is_finished
    assert len(state.live) == 0


@pytest.mark.parametrize("kind", ["open", "closed"])
def test_sources_that_appear_one_after_the_other(kind):
    points = sources_in_disc(30, 9)
    births = [1 + 2 * (k // 3) for k in range(30)]
    state = run(config(kind, points, births))
    rules = slow.Rules(is_closed=kind == "closed", kill=1.2)
    given = list(zip(births, points, strict=True))
    assert_same(state, slow.grow([(0.0, 0.0)], given, rules, state.step))


@pytest.mark.parametrize("kind", ["open", "closed"])
def test_isogonic_blade(kind):
    points = sources_in_disc(20, 5)
    births = [1 + 3 * (k // 4) for k in range(20)]

    def scale(step):
        return min(40.0, 14.0 + step * 1.0) / 14.0

    real = [(x * scale(b), y * scale(b)) for (x, y), b in zip(points, births, strict=True)]
    growth = {"kind": "isogonic", "final_length": 40.0, "length_per_step": 1.0}
    state = run(config(kind, real, births, growth=growth))
    rules = slow.Rules(is_closed=kind == "closed", kill=1.2, scale=scale, last_growth=26)
    given = [(b, (x / scale(b), y / scale(b))) for b, (x, y) in zip(births, real, strict=True)]
    assert_same(state, slow.grow([(0.0, 0.0)], given, rules, state.step))


@pytest.mark.parametrize("kind", ["open", "closed"])
@pytest.mark.parametrize(
    ("perception", "extension", "changed"),
    [
        ({"influence_radius": 4.0}, {}, {"influence": 4.0}),
        ({}, {"bias": (0.2, 0.1)}, {"bias": (0.2, 0.1)}),
        ({}, {"segment_length": 0.5}, {"length": 0.5}),
    ],
)
def test_other_rules(kind, perception, extension, changed):
    points = sources_in_disc(25, 2)
    names = {"open": "nearest", "closed": "relative"}
    perception = {"kind": names[kind], **perception}
    tables = config(kind, points, perception=perception, extension=extension)
    tables["stop"] = {"steps": 60}
    state = run(tables)
    rules = slow.Rules(is_closed=kind == "closed", kill=1.2, **changed)
    given = [(1, p) for p in points]
    assert_same(state, slow.grow([(0.0, 0.0)], given, rules, state.step))


@pytest.mark.parametrize("radius", [4.0, 6.0])
def test_no_source_waits_for_veins_beyond_the_influence_radius(radius):
    points = sources_in_disc(40, 7)
    tables = config("closed", points)
    tables["perception"] = {"kind": "relative", "influence_radius": radius}
    state = run(tables)
    assert all(state.sources.states == 0)


def test_several_seeds():
    points = sources_in_disc(25, 4)
    tables = config("closed", points)
    tables["domain"]["seeds"] = [(0.0, 0.0), (-0.1, 0.3), (0.2, 0.3)]
    state = run(tables)
    seeds = [tuple(p) for p in state.rows("nodes", "material")[:3].tolist()]
    rules = slow.Rules(is_closed=True, kill=1.2)
    assert_same(state, slow.grow(seeds, [(1, p) for p in points], rules, state.step))


def test_pulls_that_cancel_stop_the_literal_rule_and_not_the_cured_one():
    # the seed lies exactly between two sources
    tables = config("open", [(-4.0, 7.0), (4.0, 7.0)])
    tables["domain"]["seeds"] = [(0.0, 0.5)]
    tables["extension"] = {"stall_rule": False}
    literal = run(tables)
    kinds = literal.rows("events", "kind")
    reason = literal.rows("events", "subject")[kinds == EventKind.RUN_FINISHED]
    assert reason.tolist() == [StopReason.NOTHING_PULLED]
    assert len(literal.live) == 2
    tables["extension"] = {"stall_rule": True}
    cured = run(tables)
    assert len(cured.live) == 0
    assert (cured.rows("events", "kind") == EventKind.STALL_RESOLVED).sum() > 0


def test_a_livelock_is_reported():
    # slightly off the line the sum points sideways, and the child is nearer to neither
    tables = config("open", [(-4.0, 5.2), (4.0, 5.2)], extension={"stall_rule": False})
    tables["domain"]["seeds"] = [(0.0, 5.0 / 14.0)]
    state = run(tables)
    kinds = state.rows("events", "kind")
    assert state.rows("events", "subject")[kinds == EventKind.RUN_FINISHED] == [StopReason.LIVELOCK]
    assert state.step < 50


@pytest.mark.parametrize("kind", ["open", "closed"])
def test_a_vein_exactly_at_the_kill_distance_has_reached_its_source(kind):
    # d_k = D and a source a whole number of segments away: every distance is exact
    tables = config(kind, [(0.0, 5.0)], arrival={"kill_distance": 1.0})
    tables["domain"]["seeds"] = [(0.0, 0.0)]
    state = run(tables)
    assert len(state.live) == 0
    assert state.rows("nodes", "material").tolist() == [[0.0, y] for y in range(5)]


def test_a_kill_distance_below_the_segment_length_is_refused_with_the_reason():
    tables = config("open", [(1.0, 5.0)])
    tables["arrival"] = {"kill_distance": 0.5}
    with pytest.raises((VascError, ValueError), match="step over"):
        run(tables)
