"""Records of tissues without a file: the tables and the past of a run, copied."""

import numpy as np

from vasc.simulation import simulate
from vasc.state import Tables
from vasc.streams import Streams


class CopiedPast:
    """Fields and times of states that have been."""

    def __init__(self, states):
        self.states = states

    def fields(self, step):
        fields = self.states[step].fields
        return type(fields)(*(one.copy() for one in fields))

    def time(self, step):
        return self.states[step].time


def recorded(states):
    """The tables as a record holds them after the last of some states."""
    tables = Tables(past=CopiedPast(states))
    for name, table in tables.tables.items():
        n_rows = states[-1].n_rows(name)
        table.reserve(n_rows)
        for column in table.arrays:
            table.arrays[column][:n_rows] = states[-1].rows(name, column)
        table.n_rows = n_rows
    return tables


def whole_run(parameters):
    """All states of a run, and the words of its streams after each."""
    streams = Streams(parameters.seed, parameters.stream_names)
    states, words = [], []
    for state in simulate(parameters.model(), streams):
        states.append(state)
        words.append(streams.state())
    return states, words


def assert_goes_on_from(parameters, states, words, step):
    """A run that is restored at a step ends in the same bytes."""
    model, streams = parameters.model(), Streams(parameters.seed, parameters.stream_names)
    state = model.restore(recorded(states[: step + 1]), step, streams)
    assert (state.step, state.time, state.counts) == (
        step,
        states[step].time,
        states[step].counts,
    )
    streams.restore(words[step])
    *_, last = simulate(model, streams, state=state)
    expected = states[-1]
    assert (last.step, last.time, last.is_finished) == (expected.step, expected.time, True)
    assert last.counts == expected.counts
    np.testing.assert_array_equal(last.live, expected.live)
    np.testing.assert_array_equal(streams.state(), words[-1])
    for table in last.tables.tables:
        for column in last.tables[table].arrays:
            one, other = last.rows(table, column), expected.rows(table, column)
            assert one.tobytes() == other.tobytes(), f"{table}.{column} from step {step}"
    if expected.fields is not None:
        for name, one, other in zip(
            expected.fields._fields, last.fields, expected.fields, strict=True
        ):
            assert one.tobytes() == other.tobytes(), f"{name} from step {step}"
