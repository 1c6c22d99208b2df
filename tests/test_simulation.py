"""The loop: a generator of states, watched by observers."""

import numpy as np
import pytest

from vasc.models import OpenVenation
from vasc.simulation import simulate
from vasc.streams import Streams


class Witness:
    """An observer that notes what it is shown."""

    def __init__(self):
        self.steps = []
        self.words = []

    def observe(self, state, streams):
        self.steps.append(state.step)
        self.words.append(streams.state())


@pytest.fixture
def model():
    """A small leaf."""
    darts = {"kind": "darts", "density": 0.01}
    darts |= {"birth_distance_sources": 5.0, "birth_distance_veins": 5.0}
    config = {
        "kind": "open",
        "domain": {"shape": "ovate", "length": 15.0},
        "growth": {"kind": "marginal", "final_length": 30.0, "length_per_step": 1.0},
        "placement": darts,
        "arrival": {"kill_distance": 1.0},
    }
    return OpenVenation.model_validate(config).model()


def test_every_state_is_given_once_and_observed_before(model):
    witness = Witness()
    for n_given, state in enumerate(simulate(model, Streams(1), observers=[witness])):
        assert state.step == n_given
        assert witness.steps == list(range(n_given + 1))
    assert state.is_finished
    assert state.step >= 15


def test_observers_are_shown_the_streams_after_the_step(model):
    one, other, streams = Witness(), Witness(), Streams(1)
    for _ in simulate(model, streams, observers=iter([one, other])):
        np.testing.assert_array_equal(one.words[-1], streams.state())
    assert one.steps == other.steps
    assert not np.array_equal(one.words[0], one.words[-1])


def test_a_run_can_be_cut_anywhere_and_goes_on(model):
    streams = Streams(1)
    *_, cut = simulate(model, streams, max_steps=7)
    assert cut.step == 7
    rest = list(simulate(model, streams, state=cut))
    assert rest[0].step == 8
    assert rest[-1].is_finished


def test_no_steps_give_the_initial_state_alone(model):
    states = list(simulate(model, Streams(1), max_steps=0))
    assert [state.step for state in states] == [0]
    assert states[0].n_rows("nodes") == 1
    assert list(simulate(model, Streams(1), state=states[0], max_steps=0)) == []


def test_a_finished_run_makes_no_more_steps(model):
    streams = Streams(1)
    *_, last = simulate(model, streams)
    assert list(simulate(model, streams, state=last)) == []


def test_an_observer_that_fails_stops_the_run(model):
    class Failing:
        def observe(self, state, streams):
            if state.step == 3:
                raise RuntimeError("disk full")

    given = []
    with pytest.raises(RuntimeError, match="disk full"):
        given.extend(state.step for state in simulate(model, Streams(1), observers=[Failing()]))
    assert given == [] or given == [0, 1, 2]
