"""Run, resume and verify: a config, a simulation and a timeline together."""

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.config import Experiment, experiment_from_record
from vasc.errors import TimelineError
from vasc.events import EventKind, StopReason
from vasc.models.base import Model
from vasc.network import Origin
from vasc.simulation import Observer, simulate
from vasc.state import TABLE_COLUMNS, Places, State
from vasc.streams import Streams
from vasc.timeline import Motion, Recorder, Timeline, motion_of

FRAME_COLUMNS = ("time", "motion", "outline_motion")
"""Columns of ``frames`` that a state gives under the same name, if at all."""

OUTLINE_ERROR = 0.1
"""A node at most that far beyond a deformed outline, in D, may be on the margin."""


def never() -> bool:
    """Tell a run to go on."""
    return False


@dataclass(frozen=True)
class Summary:
    """What came of a run.

    Parameters
    ----------
    output : Path
        The timeline.
    steps : int
        The last recorded step.
    nodes, segments : int
        Size of the network at that step.
    sources_placed, sources_left : int
        Sources that ever appeared, and those alive.
    joins, loops : int
        Segments that joined two veins, and those of them that closed a loop.
    stalls_resolved : int
        Times the stall rule chose a direction.
    nodes_outside : int
        Nodes that lie outside the blade, seeds left out.
    wall_seconds : float
        Time this session took.
    stop_reason : str or None
        Why the run ended, None if it can go on.
    is_interrupted : bool
        True when the caller stopped it.
    """

    output: Path
    steps: int
    nodes: int
    segments: int
    sources_placed: int
    sources_left: int
    joins: int
    loops: int
    stalls_resolved: int
    nodes_outside: int
    wall_seconds: float
    stop_reason: str | None
    is_interrupted: bool = False


class Difference(NamedTuple):
    """The first value of a column that a second run gives differently.

    The row is -1 when a whole is compared. In the table ``motion``, of explicit
    positions, it is counted from the first row of the step.
    """

    step: int
    table: str
    column: str
    row: int
    recorded: str
    repeated: str


def run(
    experiment: Experiment,
    output: str | Path,
    *,
    force: bool = False,
    steps: int | None = None,
    observers: Iterable[Observer] = (),
    should_stop: Callable[[], bool] = never,
) -> Summary:
    """Run an experiment from the start and record it.

    Parameters
    ----------
    experiment : Experiment
        What to run.
    output : str or Path
        The timeline to write; it appears once the model stands.
    force : bool
        Replace a file that exists.
    steps : int, optional
        Steps to make at most; the run can be resumed.
    observers : iterable of Observer
        Shown every state, after the recorder.
    should_stop : callable
        Asked after every step; when it says so, the run ends and can be resumed.

    Returns
    -------
    Summary
        What came of it.

    Raises
    ------
    OutputError
        If the file cannot be written.
    ConfigError
        If the blade or a file the config refers to cannot be used.
    """
    started = time.perf_counter()
    parameters = experiment.parameters
    model = experiment.model()
    streams = Streams(parameters.seed, parameters.stream_names)
    state = model.initial_state(streams)
    units = parameters.units
    recorder = Recorder.create(
        output,
        config_toml=experiment.toml,
        config=experiment.record,
        model=experiment.kind,
        growth=parameters.growth.kind,
        seed=parameters.seed,
        blade=state.blade,
        stream_names=streams.names,
        motion=motion_of(state),
        units=None if units is None else units.model_dump(mode="json"),
        force=force,
        record_perceived=parameters.record.perceived != "none",
    )
    with recorder:
        observers = [recorder, *observers]
        for observer in observers:
            observer.observe(state, streams)
        states = simulate(model, streams, state=state, observers=observers, max_steps=steps)
        return _recorded(recorder, state, states, started, should_stop)


def resume(
    path: str | Path,
    *,
    steps: int | None = None,
    observers: Iterable[Observer] = (),
    should_stop: Callable[[], bool] = never,
) -> Summary:
    """Go on with a run from its last committed frame, to the same bytes.

    Parameters
    ----------
    path : str or Path
        The timeline; one that is complete is left as it is.
    steps : int, optional
        Steps to make at most, here and now.
    observers : iterable of Observer
        Shown every new state, after the recorder.
    should_stop : callable
        Asked after every step.

    Returns
    -------
    Summary
        What the run is now.

    Raises
    ------
    TimelineError
        If the file is no sound timeline or is being written by another run.
    ConfigError
        If this version cannot read its config.
    """
    started = time.perf_counter()
    with Timeline(path) as timeline, repeatable(timeline) as (model, streams):
        reason, is_complete = timeline.stop_reason, timeline.is_complete
        if timeline.n_frames:
            state = model.restore(timeline.tables(), timeline.last_step, streams)
            streams.restore(timeline.stream_words())
        else:
            state = model.initial_state(streams)
        is_begun = timeline.n_frames > 0
    if is_complete:
        return _summary(Path(path), state, started, reason)
    with Recorder.resume(path) as recorder:
        if reason is not None:
            # killed after its last step, before the file was marked as complete
            recorder.close(complete=True)
            return _summary(recorder.path, state, started, reason)
        observers = [recorder, *observers]
        if not is_begun:
            for observer in observers:
                observer.observe(state, streams)
        states = simulate(model, streams, state=state, observers=observers, max_steps=steps)
        return _recorded(recorder, state, states, started, should_stop)


def verify(path: str | Path, *, observers: Iterable[Observer] = ()) -> list[Difference]:
    """Run a recorded run again from its own config, and compare every bit.

    Parameters
    ----------
    path : str or Path
        The timeline; one that is not complete is compared as far as it goes.
    observers : iterable of Observer
        Shown every state of the second run.

    Returns
    -------
    list of Difference
        One for every column that differs, the earliest step first; empty if
        all tables, frames and random streams are the same.

    Raises
    ------
    TimelineError
        If the file is no sound timeline, or holds no step.
    ConfigError
        If this version cannot read its config.
    """
    with Timeline(path) as timeline, repeatable(timeline) as (model, streams):
        if not timeline.n_frames:
            raise TimelineError(f"{path}: holds no step to compare")
        frames: dict[str, list[Any]] = {name: [] for name in ("counts", "streams", *FRAME_COLUMNS)}
        places: dict[str, Difference] = {}
        for state in simulate(model, streams, observers=observers, max_steps=timeline.last_step):
            frames["streams"].append(streams.state())
            for name in ("counts", *FRAME_COLUMNS):
                frames[name].append(getattr(state, name))
            _compare_places(timeline, state, places)
        repeated = {name: np.array(rows) for name, rows in frames.items() if rows[0] is not None}
        found = [*_frame_differences(timeline, repeated), *_table_differences(timeline, state)]
        found.extend(places.values())
        if timeline.motion != motion_of(state):
            said = [str(timeline.motion), str(motion_of(state))]
            found.append(Difference(0, "", "motion", -1, *said))
        if timeline.is_complete != state.is_finished:
            said = [str(flag).lower() for flag in (timeline.is_complete, state.is_finished)]
            found.append(Difference(timeline.last_step, "", "complete", -1, *said))
    return sorted(found, key=lambda difference: difference.step)


@contextmanager
def repeatable(timeline: Timeline) -> Iterator[tuple[Model, Streams]]:
    """Give the model of a recorded run, and its streams as they were before the first step.

    Raises
    ------
    ConfigError
        If this version cannot read its config.
    """
    with experiment_from_record(timeline.config, name=str(timeline.path)) as experiment:
        model = experiment.model()
    yield model, Streams(timeline.seed, timeline.stream_names)


def _recorded(
    recorder: Recorder,
    state: State,
    states: Iterator[State],
    started: float,
    should_stop: Callable[[], bool],
) -> Summary:
    """Let a run go to its end, or until it is told to stop."""
    prepared = time.perf_counter()
    recorder.phases["prepare"] = prepared - started
    is_interrupted = False
    for state in states:
        if should_stop() and not state.is_finished:
            is_interrupted = True
            break
    recorder.phases["simulate_and_record"] = time.perf_counter() - prepared
    recorder.close(outcome="interrupted" if is_interrupted else None)
    return _summary(recorder.path, state, started, _stop_reason(state), is_interrupted)


def _summary(
    path: Path, state: State, started: float, reason: str | None, is_interrupted: bool = False
) -> Summary:
    """Sum up a state."""
    kinds = np.bincount(state.rows("events", "kind"), minlength=len(EventKind)).tolist()
    network = state.network
    # a seed lies on the margin, where the petiole is attached
    is_outside = ~state.blade.contains(network.positions)
    is_outside &= network.origins != Origin.SEED
    is_outside[network.retired] = False
    outside = np.flatnonzero(is_outside)
    if state.places is not None:
        # the recorded outline is a polygon, nodes on the margin are between its corners
        gaps = state.blade.margin_distance(network.positions[outside])
        outside = outside[gaps > OUTLINE_ERROR]
    return Summary(
        output=path,
        steps=state.step,
        nodes=network.n_vein_nodes,
        segments=network.n_segments,
        sources_placed=kinds[EventKind.SOURCE_PLACED],
        sources_left=len(state.live),
        joins=kinds[EventKind.VEIN_JOINED],
        loops=kinds[EventKind.LOOP_CLOSED],
        stalls_resolved=kinds[EventKind.STALL_RESOLVED],
        nodes_outside=len(outside),
        wall_seconds=time.perf_counter() - started,
        stop_reason=reason,
        is_interrupted=is_interrupted,
    )


def _stop_reason(state: State) -> str | None:
    """Give the reason the model gave for ending, in lower case."""
    kinds = state.rows("events", "kind")
    rows = np.flatnonzero(kinds == EventKind.RUN_FINISHED)
    if not state.is_finished or not len(rows):
        return None
    return StopReason(int(state.rows("events", "subject")[rows[-1]])).name.lower()


def _compare_places(timeline: Timeline, state: State, found: dict[str, Difference]) -> None:
    """Compare the explicit positions of a step; the first difference of each kind is added."""
    if state.places is None or timeline.motion != Motion.EXPLICIT:
        return
    for name in (one for one in Places._fields if one not in found):
        recorded, repeated = timeline.places(name, state.step), getattr(state.places, name)
        steps = np.full(max(len(recorded), len(repeated)), state.step)
        for difference in _difference("motion", name, recorded, repeated, steps):
            found[name] = difference


def _frame_differences(timeline: Timeline, repeated: dict[str, NDArray]) -> Iterator[Difference]:
    """Compare the columns of ``frames``."""
    recorded = timeline.frames
    # an explicit motion has no maps
    for name in (one for one in ("streams", *FRAME_COLUMNS) if one in recorded and one in repeated):
        steps = np.arange(max(len(recorded[name]), len(repeated[name])))
        yield from _difference("frames", name, recorded[name], repeated[name], steps)
    for index, table in enumerate(TABLE_COLUMNS):
        if table == "perceived" and not timeline.records_perceived:
            continue
        counts, column = repeated["counts"][:, index], f"n_{table}"
        steps = np.arange(max(timeline.n_frames, len(counts)))
        yield from _difference("frames", column, recorded[column], counts, steps)


def _table_differences(timeline: Timeline, state: State) -> Iterator[Difference]:
    """Compare the columns of every table."""
    for table, columns in TABLE_COLUMNS.items():
        if table == "perceived" and not timeline.records_perceived:
            continue
        n_rows = max(timeline.n_rows(table), state.n_rows(table))
        counts = timeline.frames[f"n_{table}"]
        # the first step whose count is beyond a row is the step of its birth
        steps = np.searchsorted(counts, np.arange(n_rows), side="right")
        for name in columns:
            recorded, repeated = timeline.table(table, name), state.rows(table, name)
            yield from _difference(table, name, recorded, repeated, steps)


def _difference(
    table: str, column: str, recorded: NDArray, repeated: NDArray, steps: NDArray
) -> Iterator[Difference]:
    """Give the first row at which two columns differ in any bit, if there is one."""
    n_both = min(len(recorded), len(repeated))
    rows = [_bits(rows[:n_both], recorded.dtype) for rows in (recorded, repeated)]
    differing = np.flatnonzero((rows[0] != rows[1]).any(axis=1))
    if len(differing):
        row = int(differing[0])
        said = [str(np.asarray(values[row]).tolist()) for values in (recorded, repeated)]
        yield Difference(int(steps[row]), table, column, row, *said)
    elif len(recorded) != len(repeated):
        said = [f"{len(values)} rows" for values in (recorded, repeated)]
        yield Difference(int(steps[n_both]), table, column, n_both, *said)


def _bits(rows: NDArray, dtype: np.dtype) -> NDArray[np.uint8]:
    """Give the bytes of each row, so that equal means equal in every bit."""
    width = dtype.itemsize * int(np.prod(rows.shape[1:]))
    return np.ascontiguousarray(rows, dtype=dtype).view(np.uint8).reshape(len(rows), width)
