"""Runs whose positions no affine map tells: recorded, read, continued and checked."""

from itertools import pairwise

import h5py
import numpy as np
import pytest
from timeline import synthetic
from timeline.synthetic import NAMES, SEED, SQUARE, ExplicitRun, SyntheticRun, contents, create

from vasc import experiment as experiments
from vasc.errors import TimelineError
from vasc.experiment import Difference
from vasc.network import Origin
from vasc.streams import Streams
from vasc.timeline import Motion, Recorder, Timeline, layout, validate, writer
from vasc.timeline.opening import open_to_continue

LAST = 150
COLUMNS = [f"motion/{name}" for name in layout.PLACES]


def record(path, last_step=LAST, **options):
    synthetic.record(path, last_step, kind=ExplicitRun, **options)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A recorded run, and every state of it."""
    path = tmp_path_factory.mktemp("explicit") / "run.h5"
    return path, synthetic.recorded_states(path, LAST, ExplicitRun)


@pytest.fixture
def path(tmp_path, recorded):
    """A copy that may be changed."""
    (tmp_path / "run.h5").write_bytes(recorded[0].read_bytes())
    return tmp_path / "run.h5"


def test_every_frame_equals_the_state_it_was(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        assert timeline.motion == Motion.EXPLICIT
        for state in shown:
            frame = timeline.frame(state.step)
            assert frame.motion is frame.outline_motion is None
            assert np.array_equal(frame.positions, state.places.nodes)
            assert np.array_equal(timeline.positions(state.step), state.places.nodes)
            assert np.array_equal(frame.network.positions, state.network.positions)
            assert np.array_equal(frame.sources.ids, state.live)
            assert np.array_equal(frame.sources.positions, state.sources.positions)
            assert np.array_equal(frame.blade.rings[0], state.blade.rings[0])
            assert np.array_equal(frame.blade.seeds, state.blade.seeds)
            for name in layout.PLACES:
                places = timeline.places(name, state.step)
                assert np.array_equal(places, getattr(state.places, name))


def test_the_seeds_of_an_explicit_blade_are_the_seed_nodes(path):
    with h5py.File(path, "r+") as file:
        file["nodes/origin"][7] = Origin.SEED
    with Timeline(path) as timeline:
        timeline.opened.trust()
        frame = timeline.frame()
        assert np.array_equal(frame.blade.seeds, frame.positions[[0, 7]])


def test_an_explicit_file_has_no_maps_and_an_affine_one_no_places(tmp_path, recorded):
    synthetic.record(tmp_path / "affine.h5", 3)
    with h5py.File(tmp_path / "affine.h5") as file:
        assert file.attrs["motion"] == b"affine"
        assert "motion" not in file
    with h5py.File(recorded[0]) as file:
        assert file.attrs["motion"] == b"explicit"
        assert not {"motion", "outline_motion"} & set(file["frames"])
    with Timeline(tmp_path / "affine.h5") as timeline:
        with pytest.raises(TimelineError, match="there are none: its motion is affine"):
            timeline.places("nodes")
        assert timeline.n_places == {}
    with (
        Timeline(recorded[0]) as timeline,
        pytest.raises(TimelineError, match="'roots'; there are nodes, sources"),
    ):
        timeline.places("roots")


def test_tables_and_data_frames_are_those_of_any_run(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        assert timeline.tables().counts() == shown[-1].counts
        frames = timeline.to_pandas("frames")
        assert len(frames) == LAST + 1
        assert "n_boundaries" in frames
        assert set(timeline.to_pandas("states")["what"]) == {"source", "canal"}
        network = timeline.frame().network
        assert len(network.positions) == len(timeline.positions())
        # nodes that refinement has replaced are no part of the graph
        assert timeline.frame().to_networkx().number_of_nodes() == network.n_vein_nodes


def test_the_last_frame_of_a_sound_file(recorded):
    assert validate(recorded[0]) == []


@pytest.mark.parametrize("last_step", [0, 1, 2])
def test_short_runs_are_sound(tmp_path, last_step):
    record(tmp_path / "run.h5", last_step)
    assert validate(tmp_path / "run.h5") == []


def test_whole_chunks_are_compressed_and_no_chunk_ever_moves(tmp_path, monkeypatch):
    """A chunk that was there at one commit is at the same place at the next."""
    path = tmp_path / "run.h5"
    monkeypatch.setattr(writer, "BATCH_FRAMES", 16)
    seen = []

    def look(step):
        if step % 16 == 0:
            with h5py.File(path, "r", locking="best-effort") as file:
                seen.append(
                    {(name, *chunk[::2]) for name in COLUMNS for chunk in chunks(file[name])}
                )

    record(path, 300, watch=look)
    assert all(before <= after for before, after in pairwise(seen))
    with h5py.File(path) as file:
        for name in COLUMNS:
            assert (file[name].compression, file[name].shuffle) == ("gzip", True)
            assert file[name].fletcher32
        whole = [chunk for chunk in chunks(file["motion/nodes"]) if chunk[1] == 0]
        assert len(whole) > 20
        size = layout.chunk_rows("motion/nodes") * 16
        assert all(chunk[3] < 0.95 * size for chunk in whole)
        assert file["motion/nodes"].id.get_storage_size() < 0.95 * file["motion/nodes"].nbytes
    assert validate(path) == []


def chunks(dataset):
    """Give where each chunk begins, the mask of its filters, its place and its size."""
    infos = [dataset.id.get_chunk_info(k) for k in range(dataset.id.get_num_chunks())]
    return [(info.chunk_offset, info.filter_mask, info.byte_offset, info.size) for info in infos]


def test_the_recording_process_can_look_at_its_own_file(tmp_path):
    path = tmp_path / "run.h5"
    streams = Streams(SEED, NAMES)
    with create(path, motion=Motion.EXPLICIT) as recorder:
        for state in ExplicitRun(LAST).states(streams):
            recorder.observe(state, streams)
            with Timeline(path) as timeline:
                assert timeline.n_frames == recorder.n_frames
                assert np.isfinite(timeline.positions()).all()
                assert len(timeline.places("outline")) == len(SQUARE)
    assert validate(path) == []


@pytest.mark.parametrize("step", [0, 1, 63, 64, 65, 100, LAST - 1])
def test_a_stopped_run_goes_on_to_the_same_bytes(tmp_path, recorded, step):
    path = tmp_path / "run.h5"
    record(path, stop_after=step)
    synthetic.resume(path, LAST, kind=ExplicitRun)
    assert contents(path) == contents(recorded[0])
    assert validate(path) == []
    with Timeline(path) as timeline:
        assert timeline.is_complete


def test_a_run_without_any_frame_starts_again(tmp_path, recorded):
    path = tmp_path / "run.h5"
    create(path, motion=Motion.EXPLICIT).close(complete=False)
    with Timeline(path) as timeline:
        assert timeline.n_places == dict.fromkeys(layout.PLACES, 0)
    synthetic.resume(path, LAST, kind=ExplicitRun)
    assert contents(path) == contents(recorded[0])


@pytest.mark.parametrize("grown", [1, 9000])
def test_rows_that_were_not_committed_are_dropped(tmp_path, recorded, grown):
    """What a killed run leaves in the columns of the motion, within and over chunks."""
    path = tmp_path / "run.h5"
    record(path, stop_after=70)
    store, found, starts, _ = open_to_continue(path)
    for name in COLUMNS:
        n_rows = int(starts[name.partition("/")[2]][-1])
        store.column(name).write(n_rows, np.full((grown, 2), 77.0))
    store.close()
    assert found.n_frames == 71
    assert contents(path) == contents(recorded[0], 71)
    assert validate(path) == []
    Recorder.resume(path).close(complete=False)
    with Timeline(path) as timeline, h5py.File(path, locking=False) as file:
        for name, n_rows in timeline.n_places.items():
            size = layout.chunk_rows(f"motion/{name}")
            assert n_rows <= file[f"motion/{name}"].shape[0] < n_rows + size
    synthetic.resume(path, LAST, kind=ExplicitRun)
    assert contents(path) == contents(recorded[0])
    assert validate(path) == []


def test_an_interrupt_in_the_middle_of_a_commit_loses_nothing(tmp_path, monkeypatch, recorded):
    path = tmp_path / "run.h5"
    monkeypatch.setattr(writer, "BATCH_FRAMES", 8)
    calls = iter(range(10_000))
    real = writer.CompressedColumn.write

    def interrupted(self, start, rows):
        real(self, start, rows)
        if next(calls) == 37:
            raise KeyboardInterrupt

    monkeypatch.setattr(writer.CompressedColumn, "write", interrupted)
    with pytest.raises(KeyboardInterrupt):
        record(path)
    with Timeline(path) as timeline:
        n_frames = timeline.n_frames
    assert 1 < n_frames < LAST
    assert contents(path) == contents(recorded[0], n_frames)
    assert validate(path) == []


def test_a_state_of_the_other_motion_is_refused(tmp_path):
    streams = Streams(SEED, NAMES)
    with create(tmp_path / "run.h5") as recorder:
        with pytest.raises(TimelineError, match="step 0 is explicit, the file is affine"):
            recorder.observe(next(ExplicitRun(3).states(streams)), streams)
        recorder.observe(next(SyntheticRun(3).states(streams)), streams)


def test_a_motion_that_is_none_is_refused(path):
    with h5py.File(path, "r+") as file:
        file.attrs["motion"] = np.bytes_("brownian")
    with pytest.raises(TimelineError, match="the attribute 'motion' is 'brownian'"):
        Timeline(path)


@pytest.mark.parametrize("name", COLUMNS)
def test_a_column_that_is_too_short_is_one_clear_error(path, name):
    with h5py.File(path, "r+") as file:
        file[name].resize(file[name].shape[0] - 1, axis=0)
    (finding,) = validate(path)
    assert finding.startswith("[readable]")
    assert f"{name} has " in finding
    with pytest.raises(TimelineError, match=f"{name} has .* are committed"):
        Recorder.resume(path)


def set_places(name, row, value):
    def change(file):
        file[name][row] = value

    return change


def move_at_birth(file):
    """The position of the youngest node, in the frame of its birth."""
    file["motion/nodes"][-1, 0] += 1e-8


def date_back(file):
    """A source that the explicit frame of its birth does not hold."""
    born = int(file["sources/birth"][-1])
    file["sources/birth"][-1] = born - 1


DAMAGED = {
    "a place that is none": (
        set_places("motion/nodes", 1000, [0.0, np.nan]),
        "written",
        "motion/nodes from row 0 on: row 1000",
    ),
    "a source nowhere": (
        set_places("motion/sources", 100, np.inf),
        "written",
        "motion/sources from row 0 on: row 100",
    ),
    "an outline nowhere": (
        set_places("motion/outline", 9, np.nan),
        "written",
        "motion/outline from row 0 on: row 9",
    ),
    "another outline at step 0": (
        set_places("motion/outline", 2, [1.0, 2.1]),
        "blade",
        "motion/outline: row 2",
    ),
    "a node that is elsewhere at its birth": (move_at_birth, "positions", "nodes/position: row"),
    "a node that was born elsewhere": (
        set_places("nodes/position", 30, [0.0, 0.0]),
        "positions",
        "nodes/position: row 30",
    ),
    "a source that the frame of its birth lacks": (
        date_back,
        "positions",
        "sources/position: row",
    ),
}


@pytest.mark.parametrize(("change", "rule", "place"), DAMAGED.values(), ids=DAMAGED)
def test_damage_to_explicit_positions_is_found(path, change, rule, place):
    with h5py.File(path, "r+") as file:
        change(file)
    findings = validate(path)
    assert any(f.startswith(f"[{rule}]") and place in f for f in findings), findings


def test_a_chunk_that_was_damaged_is_found(path):
    with h5py.File(path) as file:
        whole = [chunk for chunk in chunks(file["motion/nodes"]) if chunk[1] == 0]
    content = bytearray(path.read_bytes())
    content[whole[0][2] + 500] ^= 1
    path.write_bytes(content)
    (finding,) = validate(path)
    assert finding.startswith("[readable]")
    assert "motion/nodes" in finding


@pytest.fixture
def repeated(monkeypatch):
    """Let ``verify`` repeat the synthetic run."""
    synthetic.repeat(monkeypatch, LAST, ExplicitRun)


def test_a_repeated_run_is_the_same_bit_for_bit(path, repeated):
    assert experiments.verify(path) == []


@pytest.mark.parametrize("name", COLUMNS)
def test_one_changed_bit_of_the_motion_is_found(path, repeated, name):
    kind = name.partition("/")[2]
    with Timeline(path) as timeline:
        start = sum(len(timeline.places(kind, step)) for step in range(90))
    with h5py.File(path, "r+") as file:
        row = file[name][start + 3]
        row.view(np.uint8)[0] ^= 1
        file[name][start + 3] = row
    (found,) = experiments.verify(path)
    assert found[:4] == (90, "motion", kind, 3)
    assert found.recorded != found.repeated


def test_a_run_of_the_other_motion_differs_in_that(tmp_path, repeated):
    synthetic.record(tmp_path / "affine.h5", LAST)
    found = experiments.verify(tmp_path / "affine.h5")
    assert Difference(0, "", "motion", -1, "affine", "explicit") in found
    assert not any(one.table == "motion" for one in found)
