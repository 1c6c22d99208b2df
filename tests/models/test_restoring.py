"""A run that is broken off and restored goes on to the same bytes."""

import numpy as np
import pytest

from vasc.models import ClosedVenation, OpenVenation
from vasc.simulation import simulate
from vasc.state import Tables
from vasc.streams import Streams

DARTS = {"kind": "darts", "density": 0.004, "birth_distance_sources": 6.0}
DARTS["birth_distance_veins"] = 6.0
MARGINAL = {"kind": "marginal", "final_length": 50.0, "length_per_step": 1.0}
ISOGONIC = {"kind": "isogonic", "final_length": 80.0, "length_per_step": 1.0}
STATIC = {"kind": "none"}


def venation(kind, growth, **tables):
    """A small leaf."""
    length = 40.0 if growth is STATIC else 20.0
    config = {
        "kind": kind,
        "domain": {"shape": "cordate", "length": length},
        "growth": growth,
        "placement": DARTS,
        "arrival": {"kill_distance": 1.0},
        **tables,
    }
    return (OpenVenation if kind == "open" else ClosedVenation).model_validate(config)


RUNS = {
    "open marginal": ("open", MARGINAL, {}),
    "closed marginal": ("closed", MARGINAL, {"record": {"perceived": "nodes"}}),
    "closed isogonic": ("closed", ISOGONIC, {"refinement": {"kind": "subdivision"}}),
    "open isogonic": ("open", ISOGONIC, {"record": {"perceived": "none"}}),
    "closed static": ("closed", STATIC, {}),
    "confined": ("closed", MARGINAL, {"extension": {"kind": "confined"}}),
    "urquhart": ("closed", ISOGONIC, {"perception": {"kind": "urquhart"}}),
    "largest blade": ("closed", MARGINAL, {"placement": {**DARTS, "reading": "largest_blade"}}),
    "seeds": ("closed", ISOGONIC, {}),
}


def copy_of(state):
    """The tables as a record holds them after a state."""
    tables = Tables()
    for name, table in tables.tables.items():
        n_rows = state.n_rows(name)
        table.reserve(n_rows)
        for column in table.arrays:
            table.arrays[column][:n_rows] = state.rows(name, column)
        table.n_rows = n_rows
    return tables


@pytest.mark.parametrize("name", RUNS)
def test_every_step_is_a_place_to_go_on_from(name):
    kind, growth, tables = RUNS[name]
    parameters = venation(kind, growth, **tables)
    if name == "seeds":
        domain = {"shape": "linear", "length": 20.0, "width": 0.6, "seeds": {"count": 4}}
        parameters = venation(kind, growth, domain=domain)
    streams = Streams(5)
    states, words = [], []
    for state in simulate(parameters.model(), streams):
        states.append(state)
        words.append(streams.state())
    last = states[-1]
    assert len(last.live) == 0
    for step in range(1, last.step, max(1, last.step // 12)):
        model, again = parameters.model(), Streams(5)
        restored = model.restore(copy_of(states[step]), step, again)
        again.restore(words[step])
        for restored in simulate(model, again, state=restored):
            pass
        for table in Tables().tables:
            for column in restored.tables[table].arrays:
                expected, found = last.rows(table, column), restored.rows(table, column)
                np.testing.assert_array_equal(found, expected, f"{table}.{column} from {step}")


def test_a_state_that_has_a_successor_cannot_be_advanced_again():
    parameters = venation("open", MARGINAL)
    model, streams = parameters.model(), Streams(1)
    first = model.initial_state(streams)
    state = first
    while state.counts == first.counts:
        state = model.advance(state, streams)
    with pytest.raises(ValueError, match="has been advanced already"):
        model.advance(first, streams)


def test_seeds_differ_and_repeat():
    parameters = venation("closed", MARGINAL)
    runs = []
    for seed in (1, 1, 2):
        *_, last = simulate(parameters.model(), Streams(seed))
        runs.append(last.rows("nodes", "position").tobytes())
    assert runs[0] == runs[1]
    assert runs[0] != runs[2]


def test_subdivision_keeps_segments_short_and_veins_where_they_are():
    parameters = venation("closed", ISOGONIC, refinement={"kind": "subdivision"})
    longest = 0.0
    for state in simulate(parameters.model(), Streams(3)):
        if state.n_rows("segments"):
            longest = max(longest, float(state.network.lengths.max()))
    assert longest <= 2.0 + 1e-9
    kinds = state.rows("events", "kind")
    assert (kinds == 8).sum() > 20
    network = state.network
    cycles = network.n_segments - network.n_nodes + 1
    assert cycles == (kinds == 6).sum()
