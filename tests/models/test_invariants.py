"""What holds in every state of every run, whatever the darts do."""

from itertools import pairwise

import networkx as nx
import numpy as np
import pytest

from vasc.events import EventKind, StopReason
from vasc.models import ClosedVenation, OpenVenation
from vasc.network import Origin, SegmentKind
from vasc.simulation import simulate
from vasc.states import TRANSITIONS, Kind, SourceState
from vasc.streams import Streams

KINDS = {"open": OpenVenation, "closed": ClosedVenation}
GROWTHS = {
    "none": {"kind": "none"},
    "marginal": {"kind": "marginal", "final_length": 50.0, "length_per_step": 0.9},
    "isogonic": {"kind": "isogonic", "final_length": 80.0, "length_per_step": 1.1},
}
DARTS = {
    "kind": "darts",
    "density": 0.02,
    "birth_distance_sources": 5.0,
    "birth_distance_veins": 5.0,
}
BLADES = {
    1: {"shape": "ovate"},
    4: {"shape": "linear", "width": 0.6, "seeds": {"count": 4}},
}


def states_of(kind, growth, n_seeds=1, **tables):
    """All states of a run."""
    config = {
        "kind": kind,
        "domain": {**BLADES[n_seeds], "length": 50.0 if growth == "none" else 25.0},
        "growth": GROWTHS[growth],
        "placement": DARTS if growth != "none" else {**DARTS, "until": 60},
        "arrival": {"kill_distance": 1.0},
        **tables,
    }
    return list(simulate(KINDS[kind].model_validate(config).model(), Streams(8)))


def graph_of(network):
    """The network as a graph, with segments for edges."""
    graph = nx.MultiGraph()
    graph.add_nodes_from(range(network.n_nodes))
    graph.add_edges_from(network.segments.tolist())
    return graph


def count(state, kind):
    """How many events of a kind there have been."""
    return int(np.count_nonzero(state.rows("events", "kind") == kind))


def check_tables(state):
    """Births, parents and ids are in order, and positions those of the step of birth."""
    births, parents = state.rows("nodes", "birth"), state.rows("nodes", "parent")
    ids = np.arange(len(births))
    assert (np.diff(births) >= 0).all()
    assert (parents < ids).all()
    assert ((parents < 0) == (state.rows("nodes", "origin") == Origin.SEED)).all()
    is_extension = state.rows("nodes", "origin") == Origin.EXTENSION
    assert (births[parents[is_extension]] < births[is_extension]).all()
    assert (state.rows("nodes", "source")[is_extension] >= 0).all()
    assert births.max() <= state.step
    steps = state.rows("events", "step")
    assert (np.diff(steps) >= 0).all()
    kinds, subjects = state.rows("events", "kind"), state.rows("events", "subject")
    placed, removed = (
        subjects[kinds == kind] for kind in (EventKind.SOURCE_PLACED, EventKind.SOURCE_REMOVED)
    )
    assert placed.tolist() == list(range(state.n_rows("sources")))
    assert len(set(removed.tolist())) == len(removed)
    assert state.live.tolist() == sorted(set(placed.tolist()) - set(removed.tolist()))


def check_states(state):
    """The recorded changes of state are legal, and all lead where the events say."""
    current = dict.fromkeys(range(state.n_rows("sources")), SourceState.ACTIVE)
    for source, new in zip(
        state.rows("states", "id").tolist(), state.rows("states", "state").tolist(), strict=True
    ):
        assert (current[source], new) in TRANSITIONS[Kind.SOURCE]
        current[source] = new
    alive = [s for s, now in current.items() if now != SourceState.DRAINED]
    assert alive == state.live.tolist()
    assert state.sources.states.tolist() == [current[s] for s in alive]


@pytest.mark.parametrize("n_seeds", BLADES)
@pytest.mark.parametrize("growth", GROWTHS)
def test_open_venation_is_one_tree_a_seed(growth, n_seeds):
    states = states_of("open", growth, n_seeds)
    for state in states:
        graph = graph_of(state.network)
        assert nx.number_connected_components(graph) == n_seeds
        assert graph.number_of_edges() == graph.number_of_nodes() - n_seeds
        assert count(state, EventKind.VEIN_JOINED) == 0
    check_tables(states[-1])
    check_states(states[-1])
    assert states[-1].n_rows("nodes") > 100


@pytest.mark.parametrize("refinement", ["none", "subdivision"])
@pytest.mark.parametrize("n_seeds", BLADES)
@pytest.mark.parametrize("growth", GROWTHS)
def test_loops_of_closed_venation_are_the_cycle_rank(growth, n_seeds, refinement):
    states = states_of("closed", growth, n_seeds, refinement={"kind": refinement})
    for state in states:
        network, graph = state.network, graph_of(state.network)
        n_components = nx.number_connected_components(graph)
        rank = network.n_segments - network.n_nodes + n_components
        assert count(state, EventKind.LOOP_CLOSED) == rank
        n_joins = int((state.rows("segments", "kind") == SegmentKind.JOIN).sum())
        assert n_joins == count(state, EventKind.VEIN_JOINED)
        # each join closes a loop or connects the veins of two seeds
        assert n_joins - rank == n_seeds - n_components
        assert len({tuple(sorted(edge)) for edge in graph.edges()}) == network.n_segments
    assert rank > 5
    check_tables(states[-1])
    check_states(states[-1])


@pytest.mark.parametrize("growth", GROWTHS)
@pytest.mark.parametrize("kind", KINDS)
def test_runs_end_without_sources_and_without_nodes_twice(kind, growth):
    *_, last = states_of(kind, growth, refinement={"kind": "subdivision"})
    assert last.is_finished
    assert len(last.live) == 0
    assert last.rows("events", "kind")[-1] == EventKind.RUN_FINISHED
    assert last.rows("events", "subject")[-1] == StopReason.NO_SOURCES
    assert count(last, EventKind.RUN_FINISHED) == 1
    assert count(last, EventKind.GROWTH_ENDED) == (growth != "none")
    nodes = last.rows("nodes", "material")
    assert len(np.unique(nodes, axis=0)) == len(nodes)
    assert count(last, EventKind.SOURCE_REMOVED) == last.n_rows("sources") > 10


@pytest.mark.parametrize("growth", GROWTHS)
def test_states_stay_what_they_were(growth):
    states = states_of("closed", growth, refinement={"kind": "subdivision"})
    early = states[15]
    network, nodes = early.network, early.rows("nodes", "position").tobytes()
    assert network.n_nodes < states[-1].network.n_nodes
    again = states_of("closed", growth, refinement={"kind": "subdivision"})[early.step]
    assert again.rows("nodes", "position").tobytes() == nodes
    np.testing.assert_array_equal(again.network.segments, network.segments)


@pytest.mark.parametrize("longest", [None, 1.4])
def test_subdivision_keeps_segments_short_and_veins_where_they_are(longest):
    refinement = {"kind": "subdivision"} if longest is None else {
        "kind": "subdivision", "longest": longest
    }  # fmt: skip
    limit = longest or 2.0
    states = states_of("closed", "isogonic", refinement=refinement)
    for state in states:
        network = state.network
        is_older = network.segment_births < state.step
        # what is born in a step is halved in the next, if need be
        assert network.lengths[is_older].max(initial=0.0) <= limit * (1.0 + 1e-12)
    last = states[-1]
    subjects, middles = (
        last.rows("events", name)[last.rows("events", "kind") == EventKind.SEGMENT_REFINED]
        for name in ("subject", "object")
    )
    assert len(subjects) > 20
    assert len(np.unique(subjects)) == len(subjects)
    material, ends = last.rows("nodes", "material"), last.rows("segments", "nodes")[subjects]
    np.testing.assert_array_equal(
        material[middles], 0.5 * (material[ends[:, 0]] + material[ends[:, 1]])
    )
    segments = {tuple(pair) for pair in last.rows("segments", "nodes").tolist()}
    for (a, b), middle in zip(ends.tolist(), middles.tolist(), strict=True):
        assert {(a, middle), (middle, b)} <= segments


@pytest.mark.parametrize("kind", KINDS)
def test_sources_are_born_in_the_blade_and_apart(kind):
    states = states_of(kind, "isogonic")
    n_before = 0
    for before, state in pairwise(states):
        born = np.arange(n_before, state.n_rows("sources"))
        n_before = state.n_rows("sources")
        positions = state.positions("sources")[born]
        np.testing.assert_allclose(positions, state.rows("sources", "position")[born], rtol=1e-15)
        assert state.blade.contains(positions).all()
        nodes = state.positions("nodes")[: before.n_rows("nodes")]
        live = state.positions("sources")[before.live]
        others = np.concatenate([nodes, live])
        for position in positions:
            assert np.hypot(*(others - position).T).min() > 5.0 * (1.0 - 1e-12)
            others = np.concatenate([others, [position]])


def test_the_last_step_of_a_config_ends_a_run():
    *_, last = states_of("closed", "marginal", stop={"steps": 9})
    assert last.step == 9
    assert last.rows("events", "subject")[-1] == StopReason.STEP_LIMIT
    assert len(last.live) > 0


@pytest.mark.parametrize(
    ("shape", "growth"), [("bilobed", "none"), ("cordate", "isogonic"), ("lobed", "marginal")]
)
@pytest.mark.parametrize("kind", KINDS)
def test_confined_veins_never_leave_the_blade(kind, shape, growth):
    # between the lobes free veins take the short way, through the air
    domain = {"shape": shape, "length": 50.0 if growth == "none" else 25.0}
    tables = {"domain": domain, "placement": {**DARTS, "until": 40}}
    free, confined = (
        states_of(kind, growth, **tables, extension={"kind": way}) for way in ("free", "confined")
    )
    assert any(not s.blade.contains(s.network.positions[1:]).all() for s in free)
    assert all(s.blade.contains(s.network.positions[1:]).all() for s in confined)
    assert confined[-1].network.n_nodes > 100
