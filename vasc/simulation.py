"""Simulation: a generator of states, watched by observers."""

from collections.abc import Iterable, Iterator
from typing import Protocol

from vasc.models.base import Model
from vasc.state import State
from vasc.streams import Streams


class Observer(Protocol):
    """Whoever watches a run: a recorder, a progress line."""

    def observe(self, state: State, streams: Streams) -> None:
        """Take note of a state and of the streams as they are after it."""


def simulate(
    model: Model,
    streams: Streams,
    *,
    state: State | None = None,
    observers: Iterable[Observer] = (),
    max_steps: int | None = None,
) -> Iterator[State]:
    """Run a model: give its states one after the other until it is finished.

    Parameters
    ----------
    model : Model
        What makes the states.
    streams : Streams
        All randomness of the run.
    state : State or None
        The state to go on from, which is not given again; None: from the start.
    observers : iterable of Observer
        Shown every state before it is given.
    max_steps : int or None
        Steps to make at most, here and now.

    Yields
    ------
    State
        The initial state (if none was given), then one a step.
    """
    observers = list(observers)
    if state is None:
        state = model.initial_state(streams)
        for observer in observers:
            observer.observe(state, streams)
        yield state
    n_steps = 0
    while not model.is_finished(state) and (max_steps is None or n_steps < max_steps):
        state = model.advance(state, streams)
        n_steps += 1
        for observer in observers:
            observer.observe(state, streams)
        yield state
