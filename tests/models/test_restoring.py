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


DENSE = {**DARTS, "density": 0.02, "birth_distance_sources": 3.0, "birth_distance_veins": 3.0}
SHORT = {**ISOGONIC, "final_length": 55.0}
SEEDS = {"shape": "linear", "length": 20.0, "width": 0.6, "seeds": {"count": 4}}

RUNS = {
    "open marginal": ("open", MARGINAL, {}),
    "closed marginal": ("closed", MARGINAL, {"record": {"perceived": "nodes"}}),
    "closed isogonic": ("closed", ISOGONIC, {"refinement": {"kind": "subdivision"}}),
    "open isogonic": ("open", ISOGONIC, {"record": {"perceived": "none"}}),
    # saturated long after the last vein has arrived: the config of every run without "until"
    "closed static": ("closed", STATIC, {"placement": {**DARTS, "density": 0.05}}),
    "open static": ("open", STATIC, {"placement": {**DARTS, "until": 25}}),
    "confined": ("closed", MARGINAL, {"extension": {"kind": "confined"}}),
    "urquhart": ("closed", ISOGONIC, {"perception": {"kind": "urquhart"}}),
    "largest blade": ("closed", MARGINAL, {"placement": {**DARTS, "reading": "largest_blade"}}),
    "open largest blade": ("open", MARGINAL, {"placement": {**DARTS, "reading": "largest_blade"}}),
    "seeds": ("closed", ISOGONIC, {"domain": SEEDS}),
    # joins between tips are halved, and one of the tips extends later on
    "halved joins": (
        "closed",
        ISOGONIC,
        {
            "refinement": {"kind": "subdivision"},
            "placement": DENSE,
            "arrival": {"kill_distance": 2.0},
            "record": {"perceived": "nodes"},
        },
    ),
    "biased within a radius": (
        "closed",
        SHORT,
        {
            "perception": {"kind": "relative", "influence_radius": 30.0},
            "extension": {"bias": (0.1, 0.1)},
        },
    ),
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


def whole_run(parameters, seed):
    """All states of a run, and the words of its streams after each."""
    streams = Streams(seed)
    states, words = [], []
    for state in simulate(parameters.model(), streams):
        states.append(state)
        words.append(streams.state())
    return states, words


def gone_on(parameters, states, words, step, seed):
    """The last state of a run that is restored at a step from copied tables."""
    model, streams = parameters.model(), Streams(seed)
    state = model.restore(copy_of(states[step]), step, streams)
    assert state.step == step
    assert state.counts == states[step].counts
    np.testing.assert_array_equal(state.live, states[step].live)
    streams.restore(words[step])
    *_, last = simulate(model, streams, state=state)
    np.testing.assert_array_equal(streams.state(), words[-1])
    return last


def assert_same_tables(found, expected, note):
    """Two states have all rows in common, to the last bit."""
    assert found.step == expected.step
    assert found.is_finished
    for table in Tables().tables:
        assert found.n_rows(table) == expected.n_rows(table), f"{table} {note}"
        for column in found.tables[table].arrays:
            one, other = found.rows(table, column), expected.rows(table, column)
            assert one.tobytes() == other.tobytes(), f"{table}.{column} {note}"


@pytest.mark.parametrize("name", RUNS)
def test_every_step_is_a_place_to_go_on_from(name):
    kind, growth, tables = RUNS[name]
    parameters = venation(kind, growth, **tables)
    states, words = whole_run(parameters, 2)
    assert len(states[-1].live) == 0
    assert states[-1].n_rows("nodes") > 100
    for step in range(states[-1].step):
        last = gone_on(parameters, states, words, step, 2)
        assert_same_tables(last, states[-1], f"from step {step}")


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
