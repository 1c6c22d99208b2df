"""Areoles, canals and retired nodes of a recorded run: read, and held against the rules."""

import h5py
import numpy as np
import pytest
from timeline.synthetic import NAMES, SEED, ExplicitRun, create, record

from vasc.areoles import polygon_areas
from vasc.arrays import NULL
from vasc.events import EventKind
from vasc.states import CanalState, Kind
from vasc.streams import Streams
from vasc.timeline import Motion, Timeline, validate

LAST = 60


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A recorded run, and the areoles of every state of it."""
    path = tmp_path_factory.mktemp("areoles") / "run.h5"
    streams, shown = Streams(SEED, NAMES), []
    with create(path, motion=Motion.EXPLICIT) as recorder:
        for state in ExplicitRun(LAST).states(streams):
            recorder.observe(state, streams)
            shown.append(state.areoles)
    return path, shown


@pytest.fixture
def path(tmp_path, recorded):
    """A copy that may be changed."""
    (tmp_path / "run.h5").write_bytes(recorded[0].read_bytes())
    return tmp_path / "run.h5"


def shoelace(ring):
    """Give the area of one polygon, corner by corner."""
    following = [*ring[1:], ring[0]]
    pairs = zip(ring, following, strict=True)
    return 0.5 * sum(x * v - u * y for (x, y), (u, v) in pairs)


def test_every_frame_has_the_areoles_of_the_state(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        for step, expected in enumerate(shown):
            areoles = timeline.frame(step).areoles
            assert areoles.n_areoles == expected.n_areoles
            for name in ("ids", "parents", "births", "segments", "areas"):
                assert np.array_equal(getattr(areoles, name), getattr(expected, name)), name
            rings = zip(areoles.boundaries, expected.boundaries, strict=True)
            assert all(np.array_equal(mine, theirs) for mine, theirs in rings)
    assert shown[-1].n_areoles > 5


def test_a_frame_has_the_canals_of_the_state(tmp_path):
    streams, shown = Streams(SEED, NAMES), []
    with create(tmp_path / "run.h5", motion=Motion.EXPLICIT) as recorder:
        for state in ExplicitRun(LAST).states(streams):
            recorder.observe(state, streams)
            shown.append(state.canals)
    with Timeline(tmp_path / "run.h5") as timeline:
        for step, expected in enumerate(shown):
            canals = timeline.frame(step).canals
            for name in vars(expected):
                assert np.array_equal(getattr(canals, name), getattr(expected, name)), name
    assert shown[-1].n_canals > 5


def test_areas_are_those_of_the_boundaries_at_that_step(recorded):
    with Timeline(recorded[0]) as timeline:
        frame = timeline.frame(LAST - 1)
        areoles = frame.areoles
        areas = [shoelace(frame.positions[ring].tolist()) for ring in areoles.boundaries]
        assert areoles.areas == pytest.approx(areas, rel=1e-12)
        births = timeline.table("areoles", "birth")
        assert np.array_equal(areoles.births, births[areoles.ids])


def test_an_areole_that_was_split_is_no_areole_any_more(recorded):
    with Timeline(recorded[0]) as timeline:
        events, parents = timeline.events, timeline.table("areoles", "parent")
        births = timeline.table("areoles", "birth")
        split = np.flatnonzero(events["kind"] == EventKind.AREOLE_SPLIT)
        assert split.size
        for row in split.tolist():
            areole, step = int(events["subject"][row]), int(events["step"][row])
            assert areole in timeline.frame(step - 1).areoles.ids
            now = timeline.frame(step).areoles.ids
            assert areole not in now
            assert set(np.flatnonzero((parents == areole) & (births == step))) <= set(now.tolist())


def test_areas_over_time_are_those_of_all_frames(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        table = timeline.areole_areas()
    assert np.array_equal(table["areole"], np.concatenate([one.ids for one in shown]))
    assert np.array_equal(table["area"], np.concatenate([one.areas for one in shown]))
    steps = np.repeat(np.arange(LAST + 1), [one.n_areoles for one in shown])
    assert np.array_equal(table["step"], steps)
    assert [column.dtype for column in table.values()] == ["i4", "i4", "f8"]


def test_areas_of_an_affine_run_are_read_with_its_maps(tmp_path):
    class AffineAreoles(ExplicitRun):
        """The same areoles in a blade that grows alike everywhere."""

        motion = Motion.AFFINE
        _moved = ExplicitRun.__base__._moved
        _where = ExplicitRun.__base__._where

    path = tmp_path / "run.h5"
    record(path, LAST, kind=AffineAreoles)
    assert validate(path) == []
    with Timeline(path) as timeline:
        table = timeline.areole_areas()
        frames = [timeline.frame(step).areoles for step in range(LAST + 1)]
    assert np.array_equal(table["areole"], np.concatenate([one.ids for one in frames]))
    assert np.array_equal(table["area"], np.concatenate([one.areas for one in frames]))


def test_a_run_without_areoles_has_none(tmp_path):
    record(tmp_path / "run.h5", 5)
    with Timeline(tmp_path / "run.h5") as timeline:
        areoles = timeline.frame().areoles
        assert (areoles.n_areoles, areoles.boundaries) == (0, [])
        assert [len(column) for column in timeline.areole_areas().values()] == [0, 0, 0]


def test_polygons_far_from_the_origin_keep_their_areas():
    triangle = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    points = np.concatenate([triangle, triangle[::-1]]) + 1e9
    areas = polygon_areas(points, np.array([0, 0, 0, 2, 2, 2]), 4)
    assert areas.tolist() == [0.5, 0.0, -0.5, 0.0]


def event_row(file, kind):
    return int(np.flatnonzero(file["events/kind"][...] == kind)[0])


def set_row(name, row, value):
    def change(file):
        file[name][row] = value

    return change


def set_event(kind, column, value):
    def change(file):
        file[f"events/{column}"][event_row(file, kind)] = value

    return change


def first_child(file):
    return int(np.flatnonzero(file["areoles/parent"][...] != NULL)[0])


def return_a_corner(file):
    file["boundaries/areole"][-1] = 0


def turn_around(file):
    """The boundary of the first areole runs the other way."""
    rows = np.flatnonzero(file["boundaries/areole"][...] == 0)
    file["boundaries/node"][rows] = file["boundaries/node"][rows][::-1]


def take_corners(file):
    """The second areole leaves all its corners but two to the first."""
    rows = np.flatnonzero(file["boundaries/areole"][...] == 1)
    file["boundaries/areole"][rows[:-2]] = 0


def split_twice(file):
    kinds, subjects = file["events/kind"][...], file["events/subject"]
    rows = np.flatnonzero(kinds == EventKind.AREOLE_SPLIT)
    subjects[int(rows[1])] = subjects[int(rows[0])]


def keep_whole(file):
    file["events/kind"][event_row(file, EventKind.AREOLE_SPLIT)] = EventKind.AREOLE_BORN


def keep_segment(file):
    """A segment that ends in the retired node is not refined."""
    file["events/kind"][event_row(file, EventKind.SEGMENT_REFINED)] = EventKind.LOOP_CLOSED
    file["events/object"][event_row(file, EventKind.LOOP_CLOSED)] = NULL


def retire_twice(file):
    node = file["events/subject"][event_row(file, EventKind.NODE_RETIRED)]
    row = event_row(file, EventKind.MESOPHYLL_EVENT)
    file["events/kind"][row] = EventKind.NODE_RETIRED
    file["events/subject"][row] = node


def skip_pre_pattern(file):
    row = int(np.flatnonzero(file["states/what"][...] == Kind.CANAL)[0])
    file["states/state"][row] = CanalState.VEIN


def canal_of_nobody(file):
    row = int(np.flatnonzero(file["states/what"][...] == Kind.CANAL)[0])
    file["states/id"][row] = 10**6


def child_in_the_past(file):
    file["areoles/parent"][first_child(file)] = first_child(file)


DAMAGED = {
    "a parent that is not there": (set_row("areoles/parent", 0, 10**6), "ids", "areoles/parent"),
    "a parent of its own": (child_in_the_past, "areoles", "must be an earlier row"),
    "a parent never split": (keep_whole, "areoles", "split at another step, or at none"),
    "two splits": (split_twice, "areoles", "splits; one is possible"),
    "a segment that is not there": (
        set_row("areoles/segment", 1, 10**6),
        "ids",
        "areoles/segment: row 1",
    ),
    "a segment born later": (
        lambda f: f["areoles/birth"].__setitem__(0, f["areoles/birth"][0] - 1),
        "areoles",
        "its segment is born after it",
    ),
    "a boundary of nobody": (
        set_row("boundaries/areole", -1, 10**6),
        "ids",
        "boundaries/areole: row",
    ),
    "a boundary node that is not there": (
        set_row("boundaries/node", 0, 10**6),
        "ids",
        "boundaries/node: row 0",
    ),
    "boundaries out of order": (return_a_corner, "areoles", "must never fall"),
    "a boundary of two": (take_corners, "areoles", "at least 3"),
    "a boundary that runs clockwise": (turn_around, "areoles", "must run counterclockwise"),
    "a canal of nobody": (canal_of_nobody, "ids", "states/id"),
    "a canal that leaves a state out": (skip_pre_pattern, "states", "no canal may change"),
    "a strand of nobody": (
        set_event(EventKind.STRAND_EXTENDED, "subject", 10**6),
        "ids",
        "no row of perceived",
    ),
    "an enclosure by nobody": (
        set_event(EventKind.SOURCE_ENCLOSED, "object", 10**6),
        "ids",
        "no row of areoles",
    ),
    "a segment of a retired node": (keep_segment, "retired", "lives on with a retired end"),
    "two retirements": (retire_twice, "retired", "retirements; one is possible"),
}


def test_a_sound_file_has_no_findings(path):
    assert validate(path) == []


@pytest.mark.parametrize(("change", "rule", "place"), DAMAGED.values(), ids=DAMAGED)
def test_damage_is_found(path, change, rule, place):
    with h5py.File(path, "r+") as file:
        change(file)
    findings = validate(path)
    assert any(f.startswith(f"[{rule}]") and place in f for f in findings), findings


def test_canals_that_were_not_recorded_may_be_spoken_of(tmp_path):
    path = tmp_path / "run.h5"
    record(path, 20, kind=ExplicitRun, record_perceived=False)
    assert validate(path) == []
