"""Simulation: a generator of states, watched by observers."""

from collections.abc import Iterable, Iterator
from typing import Protocol

import numpy as np

from vasc.errors import RunError
from vasc.fields import OF_WALLS
from vasc.limits import RUN_NODES, RUN_SOURCES, RUN_STEPS
from vasc.models.base import Model
from vasc.state import State
from vasc.streams import Streams


class Observer(Protocol):
    """Whoever watches a run: a recorder, a progress line."""

    def observe(self, state: State, streams: Streams) -> None:
        """Take note of a state and of the streams as they are after it."""


def refuse_more(state: State) -> None:
    """Refuse to go on from as many steps, nodes or sources as a run may have.

    Raises
    ------
    RunError
        If there are; the message names what there is too much of.
    """
    if state.step >= RUN_STEPS:
        raise RunError(f"the run is not at its end after {RUN_STEPS:,} steps, the most it may take")
    for name, most in (("nodes", RUN_NODES), ("sources", RUN_SOURCES)):
        if state.n_rows(name) > most:
            raise RunError(f"the run has {state.n_rows(name):,} {name}; it may have {most:,}")


def refuse_unsound(before: State, state: State) -> None:
    """Refuse a state with new places, or fields of a tissue, that are no finite numbers.

    Raises
    ------
    RunError
        If there are; the message names step, what and row.
    """
    for table in ("nodes", "sources"):
        first = before.n_rows(table)
        if state.n_rows(table) == first:
            continue
        is_sound = np.isfinite(state.rows(table, "position")[first:]).all(axis=1)
        if not is_sound.all():
            row = first + int(np.argmin(is_sound))
            raise RunError(f"step {state.step}: the place of {table[:-1]} {row} is no number")
    if state.fields is None:
        return
    for name in ("concentration", "flux", "carriers"):
        is_finite = np.isfinite(getattr(state.fields, name))
        if not is_finite.all():
            row = int(np.argwhere(~is_finite)[0][0])
            of = "wall" if name in OF_WALLS else "cell"
            raise RunError(f"step {state.step}: the {name} of {of} {row} is no finite number")


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

    Raises
    ------
    RunError
        If a step would go on from more than a run may hold, see :mod:`vasc.limits`, or a
        number of a state is none.
    """
    observers = list(observers)
    if state is None:
        state = model.initial_state(streams)
        for observer in observers:
            observer.observe(state, streams)
        yield state
    n_steps = 0
    while not model.is_finished(state) and (max_steps is None or n_steps < max_steps):
        refuse_more(state)
        before, state = state, model.advance(state, streams)
        n_steps += 1
        refuse_unsound(before, state)
        for observer in observers:
            observer.observe(state, streams)
        yield state
