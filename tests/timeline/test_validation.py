import h5py
import numpy as np
import pytest
from timeline.synthetic import NAMES, SEED, SyntheticRun, record

from vasc.errors import TimelineError
from vasc.events import EventKind
from vasc.states import SourceState
from vasc.streams import Streams
from vasc.timeline import Recorder, Timeline, validate

LAST = 40


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    path = tmp_path_factory.mktemp("sound") / "run.h5"
    record(path, LAST)
    return path.read_bytes()


@pytest.fixture
def path(tmp_path, sound):
    (tmp_path / "run.h5").write_bytes(sound)
    return tmp_path / "run.h5"


def test_a_sound_file_has_no_findings(path):
    assert validate(path) == []


@pytest.mark.parametrize("last_step", [0, 1, 2])
def test_short_runs_are_sound(tmp_path, last_step):
    record(tmp_path / "run.h5", last_step)
    assert validate(tmp_path / "run.h5") == []


def set_row(name, row, value):
    def change(file):
        file[name][row] = value

    return change


def event_row(file, kind, nth=0):
    return int(np.flatnonzero(file["events/kind"][...] == kind)[nth])


def set_event(kind, column, value):
    def change(file):
        file[f"events/{column}"][event_row(file, kind)] = value

    return change


def skip_tag(file):
    """A source that was tagged and drained goes straight to drained, twice."""
    file["states/state"][0] = SourceState.DRAINED


def perceive_the_dead(file):
    row = event_row(file, EventKind.SOURCE_REMOVED)
    n_rows = file["perceived/source"].shape[0]
    file["perceived/source"][n_rows - 1] = file["events/subject"][row]


def perceive_before_birth(file):
    """The first pair is dated back, to before the birth of its source."""
    births, sources = file["sources/birth"][...], file["perceived/source"][...]
    row = int(np.flatnonzero(births[sources] > 1)[0])
    file["perceived/step"][: row + 1] = 1


def remove_twice(file):
    first, second = (event_row(file, EventKind.SOURCE_REMOVED, nth) for nth in (0, 1))
    file["events/subject"][second] = file["events/subject"][first]


def refine_twice(file):
    rows = [event_row(file, EventKind.VEIN_JOINED, nth) for nth in (-2, -1)]
    file["events/kind"][rows] = EventKind.SEGMENT_REFINED
    file["events/subject"][rows] = 3
    file["events/object"][rows] = 3


def shorten_name(file):
    names = file["events/kind"].attrs["names"]
    names[0] = b"dart_thrown"
    file["events/kind"].attrs["names"] = names


def forget_names(file):
    del file["nodes/origin"].attrs["names"]


def link(file):
    file["nodes/extra"] = h5py.SoftLink("/frames/step")


def fixed_length(file):
    old = file["states/id"][...]
    del file["states/id"]
    file["states/id"] = old


def no_perceived(file):
    file.attrs["records_perceived"] = np.int8(0)


TAMPERED = {
    "a mark that is neither": (set_row("complete", 0, 2), "header", "complete is 2"),
    "a link": (link, "hard-links", "nodes/extra"),
    "no model": (lambda f: f.attrs.__delitem__("model"), "header", "'model'"),
    "names forgotten": (forget_names, "header", "nodes/origin"),
    "a column that cannot grow": (fixed_length, "header", "states/id cannot grow"),
    "a toml that is none": (set_row("config/toml", (), b"kind = "), "texts", "config/toml"),
    "a json that is none": (set_row("config/json", (), b"{"), "texts", "config/json"),
    "no provenance": (
        lambda f: f["provenance/records"].resize(0, axis=0),
        "texts",
        "holds no session",
    ),
    "a poor provenance": (
        set_row("provenance/records", 0, b'{"session": 0}'),
        "texts",
        "session 0 lacks kind, started",
    ),
    "an outline with a hole": (
        set_row("blade/ring_xy", 1, np.nan),
        "blade",
        "blade/ring_xy: row 1",
    ),
    "rings that overlap": (set_row("blade/ring_starts", 1, 3), "blade", "ring_starts"),
    "a seed nowhere": (set_row("blade/seeds", 0, np.inf), "blade", "blade/seeds: row 0"),
    "a step left out": (set_row("frames/step", 5, 6), "frames", "frames/step: row 5 is 6"),
    "time that falls": (set_row("frames/time", 9, 0.0), "frames", "frames/time: row 9"),
    "a motion that is none": (
        set_row("frames/motion", 4, np.nan),
        "frames",
        "frames/motion: row 4",
    ),
    "an outline motion that is none": (
        set_row("frames/outline_motion", 4, np.inf),
        "frames",
        "frames/outline_motion: row 4",
    ),
    "a count that falls": (set_row("frames/n_nodes", 7, 1), "counts", "frames/n_nodes: row 7"),
    "a count below 0": (set_row("frames/n_states", 0, -4), "counts", "frames/n_states: row 0"),
    "perceived though not recorded": (no_perceived, "counts", "perceived holds rows"),
    "a row that was never written": (
        set_row("nodes/source", 8, np.iinfo("i4").min),
        "written",
        "nodes/source: row 8",
    ),
    "a position that is none": (
        set_row("sources/position", 2, [np.nan, 0.0]),
        "written",
        "sources/position: row 2",
    ),
    "an unknown event": (set_row("events/kind", 3, 99), "codes", "events/kind: row 3 is 99"),
    "an unknown origin": (set_row("nodes/origin", 3, 77), "codes", "nodes/origin: row 3 is 77"),
    "an unknown state": (set_row("states/state", 0, 9), "codes", "states/state: row 0 is 9"),
    "an unknown stop reason": (
        set_event(EventKind.RUN_FINISHED, "subject", 44),
        "codes",
        "events/subject",
    ),
    "a name of its own": (shorten_name, "codes", "code 0 is named 'dart_thrown'"),
    "a birth in the future": (set_row("nodes/birth", 9, LAST), "steps", "nodes/birth: row 9 is 40"),
    "a birth before time": (set_row("sources/birth", 0, -1), "steps", "sources/birth: row 0 is -1"),
    "an event in the future": (set_row("events/step", 0, LAST), "steps", "events/step: row 0"),
    "an event in the past": (set_row("events/step", -1, 1), "steps", "events/step"),
    "a parent that is not there": (set_row("nodes/parent", 9, 10**6), "ids", "nodes/parent: row 9"),
    "a parent below -1": (set_row("nodes/parent", 9, -2), "ids", "nodes/parent: row 9 is -2"),
    "a cause that is not there": (set_row("nodes/source", 9, 10**6), "ids", "nodes/source: row 9"),
    "an end that is not there": (
        set_row("segments/nodes", 2, [0, 10**6]),
        "ids",
        "segments/nodes: row 2",
    ),
    "an end that was not there yet": (
        set_row("segments/nodes", 2, [0, 180]),
        "ids",
        "segments/nodes: row 2 is [0, 180]",
    ),
    "a perceiving node that is not there": (
        set_row("perceived/node", 0, 10**6),
        "ids",
        "perceived/node: row 0",
    ),
    "a perceived source that is not there": (
        set_row("perceived/source", 0, -1),
        "ids",
        "perceived/source: row 0",
    ),
    "a state of nobody": (set_row("states/id", 0, 10**6), "ids", "states/id: row 0"),
    "an event of nobody": (
        set_event(EventKind.SOURCE_PLACED, "subject", 10**6),
        "ids",
        "events/subject",
    ),
    "an event with nobody": (
        set_event(EventKind.SOURCE_TAGGED, "object", 10**6),
        "ids",
        "events/object",
    ),
    "a seed with a parent": (set_row("nodes/origin", 9, 0), "descent", "a seed has no parent"),
    "an extension of nothing": (set_row("nodes/parent", 9, -1), "descent", "has a parent"),
    "a parent of its own": (set_row("nodes/parent", 9, 9), "descent", "must be an earlier row"),
    "a parent as old as the child": (set_row("nodes/parent", 9, 8), "descent", "be born earlier"),
    "a segment with one end": (
        set_row("segments/nodes", 2, [1, 1]),
        "segments",
        "segments/nodes: row 2 is [1, 1]",
    ),
    "a segment born before its end": (
        set_row("segments/birth", 30, 1),
        "segments",
        "an end is born after it",
    ),
    "a segment refined twice": (refine_twice, "segments", "refines segment 3 a second time"),
    "a node that is elsewhere": (
        lambda f: f["nodes/position"].__setitem__((8, 0), f["nodes/position"][8, 0] + 1e-8),
        "positions",
        "nodes/position: row 8",
    ),
    "a source that is elsewhere": (
        set_row("sources/material", 1, [0.0, 9.0]),
        "positions",
        "sources/position: row 1",
    ),
    "a state left out": (skip_tag, "states", "no source may change to that"),
    "a removal that is none": (
        set_event(EventKind.SOURCE_REMOVED, "kind", EventKind.SOURCE_TAGGED),
        "ends",
        "they must agree",
    ),
    "two removals": (remove_twice, "ends", "removals; one is possible"),
    "a dead source perceived": (perceive_the_dead, "ends", "a source removed before"),
    "an unborn source perceived": (perceive_before_birth, "ends", "a source not yet born"),
}


@pytest.mark.parametrize(("change", "rule", "place"), TAMPERED.values(), ids=TAMPERED)
def test_a_tampered_file_is_found_out(path, change, rule, place):
    with h5py.File(path, "r+") as file:
        change(file)
    findings = validate(path)
    assert any(f.startswith(f"[{rule}]") and place in f for f in findings), findings
    assert all("\n" not in finding for finding in findings)


def test_a_finding_says_how_many_rows_are_bad(path):
    with h5py.File(path, "r+") as file:
        file["nodes/origin"][3:9] = 77
    assert any("(6 rows are bad)" in finding for finding in validate(path))


def test_the_tolerance_of_positions_is_held_on_both_sides(path):
    with h5py.File(path, "r+") as file:
        file["nodes/position"][8, 0] += 1e-10
    # it keeps to the rules, and is not what was recorded
    assert validate(path) == ["[checksums] nodes/position is not what was recorded"]


@pytest.mark.parametrize(
    ("name", "said"),
    [("blade/seeds", "blade/seeds"), ("config/toml", "config/toml"), ("seed", "attributes")],
)
def test_what_never_changes_is_checked_too(path, name, said):
    with h5py.File(path, "r+") as file:
        if name == "seed":
            file.attrs.modify(name, file.attrs[name] + np.uint64(1))
        elif name == "config/toml":
            file[name][()] = file[name][()].replace(b"synthetic", b"Synthetic")
        else:
            file[name][0, 0] += 0.25
    assert validate(path) == [f"[checksums] {said} is not what was recorded"]
    with pytest.raises(TimelineError, match=f"is damaged: {said} is not what was recorded"):
        Recorder.resume(path)


def test_what_was_recorded_before_a_kill_is_checked_up_to_there(tmp_path):
    path = tmp_path / "run.h5"
    record(path, 30, stop_after=10)
    recorder = resumed_and_killed(path, 20)
    assert recorder.n_frames == 21
    assert validate(path) == []
    with h5py.File(path, "r+") as file:
        file["frames/time"][4] += 1e-12
    assert validate(path) == ["[checksums] frames/time is not what was recorded"]


def resumed_and_killed(path, last_step):
    """Go on with a run, and end it as a kill does, all commits being in the file."""
    run, streams = SyntheticRun(30), Streams(SEED, NAMES)
    with Timeline(path) as timeline:
        run.restore(timeline.tables(), timeline.last_step)
        streams.restore(timeline.stream_words())
    recorder = Recorder.resume(path)
    for state in run.states(streams):
        recorder.observe(state, streams)
        if state.step == last_step:
            break
    recorder._commit()
    recorder._store.give_up()
    return recorder


def test_a_complete_run_names_its_reason(path):
    with Timeline(path) as timeline:
        assert timeline.stop_reason == "no_sources"
