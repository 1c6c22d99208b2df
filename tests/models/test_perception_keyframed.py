"""What sources perceive on a leaf that is deformed and whose veins are cut, by brute force."""

import numpy as np
import pytest
from reference.leaves import SMALL, keyframed, leaf
from reference.nearest import nearest
from reference.relative_neighbors import relative_neighbors
from reference.urquhart import urquhart

from vasc.events import EventKind
from vasc.growth import KeyframedParameters
from vasc.models import MODELS
from vasc.network import Origin
from vasc.simulation import simulate
from vasc.streams import Streams

RULES = {
    "nearest": ("open", nearest),
    "relative": ("closed", relative_neighbors),
    "urquhart": ("closed", urquhart),
}


def far_sources():
    """Sources far from the first veins, so that growth alone changes what they perceive."""
    growth = KeyframedParameters.model_validate(keyframed(SMALL)).growth()
    rng = np.random.default_rng(5)
    births = np.sort(rng.integers(1, 25, 24)).tolist()
    material = np.stack([rng.uniform(-0.9, 0.9, 24), rng.uniform(0.1, 0.95, 24)], axis=1)
    points = [
        growth.position(point[None], birth)[0].tolist()
        for birth, point in zip(births, material, strict=True)
    ]
    return {"kind": "given", "points": points, "births": births}


@pytest.mark.parametrize("refinement", ["corner_cutting", "none"])
@pytest.mark.parametrize("name", RULES)
def test_the_recorded_sets_are_those_of_the_definition_at_every_step(name, refinement):
    kind, rule = RULES[name]
    tables = leaf(
        kind,
        SMALL,
        refinement={"kind": refinement},
        perception={"kind": name},
        record={"perceived": "nodes"},
        placement=far_sources(),
    )
    before, current, n_compared = None, {}, 0
    for state in simulate(MODELS[kind].model_validate(tables).model(), Streams(1), max_steps=35):
        if before is not None:
            current.update(recorded_now(state))
            ids = perceiving(state)
            places = [tuple(place) for place in state.positions("nodes")[ids].tolist()]
            live = [
                *before.live.tolist(),
                *range(before.n_rows("sources"), state.n_rows("sources")),
            ]
            for source in live:
                place = tuple(state.positions("sources")[source].tolist())
                assert current[source] == ids[rule(place, places)].tolist()
                n_compared += 1
        before = state
    assert n_compared > 100
    has_cuts = (state.rows("events", "kind") == EventKind.NODE_RETIRED).any()
    assert has_cuts == (refinement == "corner_cutting")


def recorded_now(state):
    """Sources whose sets were recorded in a step, and the sets."""
    rows = np.flatnonzero(state.rows("perceived", "step") == state.step)
    sources = state.rows("perceived", "source")[rows]
    nodes = state.rows("perceived", "node")[rows]
    for source in np.unique(sources).tolist():
        yield source, nodes[sources == source].tolist()


def perceiving(state):
    """The live nodes when sources attracted them: before veins extended."""
    is_there = (state.rows("nodes", "birth") < state.step) | (
        state.rows("nodes", "origin") == Origin.REFINEMENT
    )
    kinds = state.rows("events", "kind")
    is_there[state.rows("events", "subject")[kinds == EventKind.NODE_RETIRED]] = False
    return np.flatnonzero(is_there)


@pytest.mark.parametrize("kind", ["open", "closed"])
def test_nodes_that_sources_attract_or_wait_for_are_not_cut(kind):
    refinement = {"kind": "corner_cutting", "threshold": 2.05}
    tables = leaf(kind, SMALL, 7.0, until=120, refinement=refinement)
    held, n_retired, n_spared = set(), 0, 0
    for state in simulate(MODELS[kind].model_validate(tables).model(), Streams(1), max_steps=140):
        now = state.rows("events", "step") == state.step
        kinds, subjects = state.rows("events", "kind"), state.rows("events", "subject")
        retired = set(subjects[now & (kinds == EventKind.NODE_RETIRED)].tolist())
        assert not retired & held
        n_retired += len(retired)
        n_spared += sum(is_long(state, node) for node in held)
        # by the end of a step the sets have followed the veins that extended in it
        ids = np.flatnonzero(is_alive(state))
        places = [tuple(place) for place in state.positions("nodes")[ids].tolist()]
        rule = nearest if kind == "open" else relative_neighbors
        held = set()
        for source in state.live.tolist():
            place = tuple(state.positions("sources")[source].tolist())
            held |= set(ids[rule(place, places)].tolist())
    assert n_retired > 50
    # or nothing would have been cut anyway
    assert n_spared > 0


def is_long(state, node):
    """Whether a node has two segments that are too long together, those of this step left out."""
    is_older = state.network.segment_births < state.step
    ends = state.network.segments[is_older & (state.network.segments == node).any(axis=1)]
    gaps = np.diff(state.positions("nodes")[ends], axis=1)[:, 0]
    return len(ends) == 2 and np.hypot(*gaps.T).sum() > 2.05


def is_alive(state):
    alive = np.ones(state.n_rows("nodes"), dtype=bool)
    kinds = state.rows("events", "kind")
    alive[state.rows("events", "subject")[kinds == EventKind.NODE_RETIRED]] = False
    return alive
