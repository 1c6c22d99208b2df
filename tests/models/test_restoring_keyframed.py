"""Runs on key-framed leaves that are restored from tables alone go on to the same bytes."""

import numpy as np
import pytest
from reference.leaves import ARABIDOPSIS, SMALL, leaf

from vasc.models import MODELS
from vasc.simulation import simulate
from vasc.state import Tables
from vasc.states import CanalState, Kind
from vasc.streams import Streams

EVENT = {"mesophyll": {"kind": "time", "time": 90}}
JITTER = {"refinement": {"kind": "corner_cutting", "jitter": 0.05}}
NODES = {"record": {"perceived": "nodes"}}
RUNS = {
    "arabidopsis": (leaf("areole", ARABIDOPSIS), 235, 1),
    "areole to its end": (leaf("areole", SMALL, 6.0, until=160, **EVENT), 400, 1),
    "areole jittered": (leaf("areole", SMALL, 6.0, until=160, **EVENT, **JITTER), 400, 3),
    "areole uncut": (
        leaf("areole", SMALL, 7.0, until=140, refinement={"kind": "none"}),
        400,
        1,
    ),
    "closed": (leaf("closed", SMALL, 6.0, until=130, **NODES), 400, 1),
    "closed jittered": (leaf("closed", SMALL, 6.0, until=130, **JITTER), 400, 3),
    "open": (leaf("open", SMALL, 6.0, until=130), 400, 1),
    "open uncut": (leaf("open", SMALL, 6.0, until=130, refinement={"kind": "none"}), 400, 1),
}
N_STEPS = 22
"""Steps gone on with, more than those from one restored step to the next."""


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


def assert_same(found, expected, note):
    """Two states are alike to the last bit, with where everything is."""
    assert found.step == expected.step
    assert found.is_finished == expected.is_finished, note
    assert found.live.tobytes() == expected.live.tobytes(), note
    for table in Tables().tables:
        assert found.n_rows(table) == expected.n_rows(table), f"{table} {note}"
        for column in found.tables[table].arrays:
            one, other = found.rows(table, column), expected.rows(table, column)
            assert one.tobytes() == other.tobytes(), f"{table}.{column} {note}"
    for table in ("nodes", "sources"):
        assert found.positions(table).tobytes() == expected.positions(table).tobytes(), note
    assert found.network.segments.tobytes() == expected.network.segments.tobytes(), note


@pytest.mark.parametrize("name", RUNS)
def test_steps_are_places_to_go_on_from(name):
    tables, n_steps, seed = RUNS[name]
    parameters = MODELS[tables["kind"]].model_validate(tables)
    streams = Streams(seed, parameters.stream_names)
    states, words = [], []
    for state in simulate(parameters.model(), streams, max_steps=n_steps):
        states.append(state)
        words.append(streams.state())
    last = states[-1].step
    # none of the kinds of moments is left out: near the end, in the event, before cuts
    for step in sorted({*range(0, last, 19), 3, 89, 90, 91, last - 1} & set(range(last))):
        model, other = parameters.model(), Streams(seed, parameters.stream_names)
        state = model.restore(copy_of(states[step]), step, other)
        assert_same_moment(state, states[step])
        other.restore(words[step])
        n_left = min(N_STEPS, last - step)
        for now in simulate(model, other, state=state, max_steps=n_left):
            np.testing.assert_array_equal(other.state(), words[now.step])
        assert_same(now, states[now.step], f"from step {step}")
    assert states[-1].n_rows("nodes") > 200


def assert_same_moment(found, expected):
    """The restored state is the one that was recorded."""
    assert found.step == expected.step
    assert found.counts == expected.counts
    np.testing.assert_array_equal(found.live, expected.live)
    for table in ("nodes", "sources"):
        np.testing.assert_array_equal(found.positions(table), expected.positions(table))
    np.testing.assert_array_equal(found.blade.rings[0], expected.blade.rings[0])


def test_all_states_of_canals_are_among_the_restored():
    # or the comparison above says little
    tables, n_steps, seed = RUNS["areole to its end"]
    model = MODELS["areole"].model_validate(tables).model()
    met = set()
    for state in simulate(model, Streams(seed), max_steps=n_steps):
        if state.step % 19 == 0 or state.step in (89, 90, 91):
            is_canal = state.rows("states", "what") == Kind.CANAL
            ids, values = (state.rows("states", name)[is_canal] for name in ("id", "state"))
            met |= set(dict(zip(ids.tolist(), values.tolist(), strict=True)).values())
    assert met == {state.value for state in CanalState} - {CanalState.GROUND}
