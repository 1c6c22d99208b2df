"""Run, resume and verify: a config, a simulation and a timeline together."""

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from vasc.analysis.summaries import Summary, summed_up
from vasc.config import Experiment, experiment_from_record
from vasc.config.expected import ExpectedSize, refuse_full_disk, refuse_what_no_machine_holds
from vasc.config.foreseen import foreseen
from vasc.errors import RunError, TimelineError
from vasc.events import EventKind, StopReason
from vasc.models.base import Model
from vasc.simulation import Observer, simulate
from vasc.state import State
from vasc.streams import Streams
from vasc.timeline import Recorder, Timeline, motion_of
from vasc.timeline.checksums import check_header
from vasc.timeline.comparison import (
    FRAME_COLUMNS,
    Difference,
    blade_differences,
    compare_fields,
    compare_places,
    form_differences,
    frame_differences,
    length_differences,
    table_differences,
)
from vasc.timeline.redo import Durability, settle


def never() -> bool:
    """Tell a run to go on."""
    return False


def run(
    experiment: Experiment,
    output: str | Path,
    *,
    force: bool = False,
    large: bool = False,
    steps: int | None = None,
    observers: Iterable[Observer] = (),
    should_stop: Callable[[], bool] = never,
    on_size: Callable[[ExpectedSize], None] | None = None,
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
    large : bool
        Run even what memory or disk are not expected to hold.
    steps : int, optional
        Steps to make at most; the run can be resumed.
    observers : iterable of Observer
        Shown every state, after the recorder.
    should_stop : callable
        Asked after every step; when it says so, the run ends and can be resumed.
    on_size : callable, optional
        Told how large the run may become, before it begins.

    Returns
    -------
    Summary
        What came of it.

    Raises
    ------
    OutputError
        If the file cannot be written, is one that the config refers to, or the disk is not
        expected to hold it.
    ConfigError
        If the blade or a file the config refers to cannot be used, or memory is not
        expected to hold the run.
    RunError
        If the run cannot go on; the file holds the steps so far.
    """
    started = time.perf_counter()
    parameters = experiment.parameters
    experiment.refuse_own_file(Path(output))
    model = experiment.model()
    size = foreseen(parameters, model)
    if on_size is not None:
        on_size(size)
    if not large:
        refuse_full_disk(Path(output))
        refuse_what_no_machine_holds(size, Path(output), experiment.label or experiment.name)
    streams = Streams(parameters.seed, parameters.stream_names)
    state = model.initial_state(streams)
    units = parameters.units
    recorder = Recorder.create(
        output,
        config_toml=experiment.toml,
        config=experiment.record,
        model=experiment.kind,
        growth=_growth_name(experiment),
        seed=parameters.seed,
        blade=state.blade,
        stream_names=streams.names,
        motion=motion_of(state),
        dimensions=state.dimensions,
        base_ring=state.base_ring,
        tissue=state.tissue,
        units=None if units is None else units.model_dump(mode="json"),
        force=force,
        record_perceived=parameters.record.perceived != "none",
        durability=Durability(parameters.record.durability),
    )
    with recorder:
        observers = [recorder, *observers]
        for observer in observers:
            observer.observe(state, streams)
        states = simulate(model, streams, state=state, observers=observers, max_steps=steps)
        return _recorded(recorder, state, states, experiment.record, started, should_stop)


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
    RunError
        If the run cannot go on; the file holds the steps so far.
    """
    started = time.perf_counter()
    with Timeline(path) as timeline, repeatable(timeline) as (model, streams):
        reason, is_complete = timeline.stop_reason, timeline.is_complete
        config = timeline.config
        durability = _durability(config)
        if timeline.n_frames:
            state = model.restore(timeline.tables(), timeline.last_step, streams)
            streams.restore(timeline.stream_words())
        else:
            state = model.initial_state(streams)
        is_begun = timeline.n_frames > 0
    if is_complete:
        # killed after its last commit, before its log was removed
        settle(Path(path))
        return summed_up(Path(path), state, config, started, reason)
    with Recorder.resume(path, durability=durability) as recorder:
        if reason is not None:
            # killed after its last step, before the file was marked as complete
            recorder.close(complete=True)
            return summed_up(recorder.path, state, config, started, reason)
        observers = [recorder, *observers]
        if not is_begun:
            for observer in observers:
                observer.observe(state, streams)
        states = simulate(model, streams, state=state, observers=observers, max_steps=steps)
        return _recorded(recorder, state, states, config, started, should_stop)


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
    with Timeline(path) as timeline:
        # model, growth and units are no result: that they are as recorded, checksums alone tell
        check_header(timeline.path, timeline.opened.file, timeline.opened.found)
        # what else was changed is shown, where checksums would only refuse it
        timeline.opened.trust()
        if not timeline.n_frames:
            raise TimelineError(f"{path}: holds no step to compare")
        return sorted(_differences(timeline, observers), key=lambda difference: difference.step)


def _differences(timeline: Timeline, observers: Iterable[Observer]) -> Iterator[Difference]:
    """Run a recorded run again, and give what is not the same."""
    frames: dict[str, list[Any]] = {name: [] for name in ("counts", "streams", *FRAME_COLUMNS)}
    sliced: dict[str, Difference] = {}
    with repeatable(timeline) as (model, streams):
        for state in simulate(model, streams, observers=observers, max_steps=timeline.last_step):
            frames["streams"].append(streams.state())
            for name in ("counts", *FRAME_COLUMNS):
                frames[name].append(getattr(state, name))
            if state.step == 0:
                yield from blade_differences(timeline, state)
            compare_places(timeline, state, sliced)
            compare_fields(timeline, state, sliced)
    yield from sliced.values()
    repeated = {name: np.array(rows) for name, rows in frames.items() if rows[0] is not None}
    yield from frame_differences(timeline, repeated)
    yield from table_differences(timeline, state)
    yield from form_differences(timeline, state)
    yield from length_differences(timeline)
    if timeline.is_complete != state.is_finished:
        said = [str(flag).lower() for flag in (timeline.is_complete, state.is_finished)]
        yield Difference(timeline.last_step, "", "complete", -1, *said)


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
    config: Mapping[str, Any],
    started: float,
    should_stop: Callable[[], bool],
) -> Summary:
    """Let a run go to its end, until it is told to stop, or until it cannot go on."""
    prepared = time.perf_counter()
    recorder.phases["prepare"] = prepared - started
    is_interrupted = False
    try:
        for state in states:
            if should_stop() and not state.is_finished:
                is_interrupted = True
                break
    except RunError as error:
        recorder.close(complete=False, outcome=f"failed: RunError: {error}"[:400])
        kept = f"all steps up to {recorder.n_frames - 1} are kept"
        raise RunError(f"{recorder.path}: {error}; {kept}") from error
    recorder.phases["simulate_and_record"] = time.perf_counter() - prepared
    recorder.close(outcome="interrupted" if is_interrupted else None)
    return summed_up(recorder.path, state, config, started, _stop_reason(state), is_interrupted)


def _durability(config: Mapping[str, Any]) -> Durability:
    """Give what the recorded config says of a loss of power; the default if it says nothing."""
    recorded = config.get("record")
    said = recorded.get("durability") if isinstance(recorded, Mapping) else None
    return Durability(said) if said in list(Durability) else Durability.BATCH


def _growth_name(experiment: Experiment) -> str:
    """Give the name of the growth; experiments on stems have none."""
    growth = getattr(experiment.parameters, "growth", None)
    return "none" if growth is None else str(growth.kind)


def _stop_reason(state: State) -> str | None:
    """Give the reason the model gave for ending, in lower case."""
    kinds = state.rows("events", "kind")
    rows = np.flatnonzero(kinds == EventKind.RUN_FINISHED)
    if not state.is_finished or not len(rows):
        return None
    return StopReason(int(state.rows("events", "subject")[rows[-1]])).name.lower()
