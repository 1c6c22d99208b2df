import json
import os
import subprocess
import sys

import h5py
import numpy as np
import pytest
from timeline.synthetic import CONFIG, NAMES, SEED, TOML, SyntheticRun, contents, create, record

from vasc.errors import OutputError, TimelineError
from vasc.streams import Streams
from vasc.timeline import Recorder, Timeline, validate, writer


def test_everything_given_is_read_back(tmp_path):
    path = tmp_path / "run.h5"
    record(path, 20)
    with Timeline(path) as timeline:
        assert (timeline.n_frames, timeline.last_step, timeline.is_complete) == (21, 20, True)
        assert (timeline.model, timeline.growth, timeline.seed) == ("synthetic", "isogonic", SEED)
        assert (timeline.config_toml, timeline.config) == (TOML, CONFIG)
        assert timeline.units == {"length": "um", "segment": 4.0}
        assert timeline.stream_names == NAMES
        assert timeline.records_perceived
        assert timeline.version == "1.0"
        assert timeline.stop_reason == "no_sources"


def test_columns_are_plain_and_say_what_they_are(tmp_path):
    record(tmp_path / "run.h5", 3)
    with h5py.File(tmp_path / "run.h5") as file:
        position = file["nodes/position"]
        assert position.compression is None
        assert position.maxshape == (None, 2)
        assert position.attrs["unit"] == b"length"
        assert b"position at birth" in position.attrs["meaning"]
        assert b"run_finished" in file["events/kind"].attrs["names"]
        assert file.attrs["format"] == b"vasc-timeline"


def test_a_run_without_streams_or_units_is_recorded(tmp_path):
    path = tmp_path / "run.h5"
    streams = Streams(SEED, ())
    with create(path, stream_names=(), units=None) as recorder:
        recorder.observe(next(SyntheticRun(0).states(streams)), streams)
    with Timeline(path) as timeline:
        assert timeline.stream_words().shape == (0, 6)
        assert timeline.units == {}
    assert validate(path) == []


def test_perceived_is_left_out_when_not_wanted(tmp_path):
    record(tmp_path / "all.h5", 30)
    record(tmp_path / "few.h5", 30, record_perceived=False)
    with Timeline(tmp_path / "few.h5") as few, Timeline(tmp_path / "all.h5") as everything:
        assert everything.n_rows("perceived") > 0
        assert few.n_rows("perceived") == 0
        assert not few.records_perceived
        assert few.n_rows("events") == everything.n_rows("events")
        assert few.tables()["perceived"].n_rows == 0
    assert validate(tmp_path / "few.h5") == []


def test_frames_are_committed_in_batches_and_step_0_at_once(tmp_path, monkeypatch):
    monkeypatch.setattr(writer, "BATCH_SECONDS", 1e9)
    streams = Streams(SEED, NAMES)
    committed = []
    with create(tmp_path / "run.h5") as recorder:
        for state in SyntheticRun(130).states(streams):
            recorder.observe(state, streams)
            committed.append(recorder.n_frames)
    assert committed[:2] == [1, 1]
    assert sorted(set(committed)) == [1, 65, 129]
    with Timeline(tmp_path / "run.h5") as timeline:
        assert timeline.n_frames == 131


def test_slow_steps_are_committed_one_by_one(tmp_path, monkeypatch):
    clock = iter(np.arange(0.0, 1e6, 0.3))
    monkeypatch.setattr(writer.time, "perf_counter", lambda: float(next(clock)))
    streams = Streams(SEED, NAMES)
    with create(tmp_path / "run.h5") as recorder:
        for state in SyntheticRun(10).states(streams):
            recorder.observe(state, streams)
            # two calls a step: a step takes 0.6 s, so that a second one would come too late
            assert state.step + 1 - recorder.n_frames <= 1


def raise_at(step, error):
    """Give a watcher of steps that raises an error at one of them."""

    def watch(now):
        if now == step:
            raise error

    return watch


@pytest.mark.parametrize(
    ("error", "outcome"),
    [
        (KeyboardInterrupt(), "interrupted"),
        (ValueError("no luck"), "failed: ValueError: no luck"),
    ],
)
def test_what_was_observed_is_committed_when_the_run_fails(tmp_path, error, outcome):
    path = tmp_path / "run.h5"
    with pytest.raises(type(error)):
        record(path, 100, watch=raise_at(17, error))
    with Timeline(path) as timeline:
        assert (timeline.n_frames, timeline.is_complete) == (18, False)
        assert timeline.provenance[0]["outcome"] == outcome
    assert validate(path) == []


def test_an_interrupt_in_the_middle_of_a_commit_loses_nothing(tmp_path, monkeypatch):
    path, plain = tmp_path / "run.h5", tmp_path / "plain.h5"
    record(plain, 40)
    monkeypatch.setattr(writer, "BATCH_FRAMES", 8)
    calls = iter(range(10_000))
    real = writer.GrowingColumn.write

    def interrupted(self, start, rows):
        if next(calls) == 150:
            raise KeyboardInterrupt
        real(self, start, rows)

    monkeypatch.setattr(writer.GrowingColumn, "write", interrupted)
    with pytest.raises(KeyboardInterrupt):
        record(path, 40)
    with Timeline(path) as timeline:
        n_frames = timeline.n_frames
        assert timeline.provenance[0]["outcome"] == "interrupted"
    assert 1 < n_frames < 41
    assert contents(path) == contents(plain, n_frames)


def test_a_failed_write_is_one_clear_error_and_keeps_what_was_committed(tmp_path, monkeypatch):
    path = tmp_path / "run.h5"

    def full(self, start, rows):
        raise OSError(28, "No space left on device")

    def fill_disk(step):
        monkeypatch.setattr(writer.GrowingColumn, "write", full)

    with pytest.raises(OutputError, match=r"run\.h5: cannot be written: .*No space left"):
        record(path, 100, watch=fill_disk)
    with Timeline(path) as timeline:
        assert timeline.n_frames == 1


def test_a_file_is_never_replaced_unless_forced(tmp_path):
    path = tmp_path / "run.h5"
    path.write_text("precious")
    with pytest.raises(OutputError, match="exists already"):
        create(path)
    assert path.read_text() == "precious"
    record(path, 2, force=True)
    assert validate(path) == []
    assert os.listdir(tmp_path) == ["run.h5"]


def test_a_file_that_is_being_written_is_not_even_replaced_by_force(tmp_path):
    path = tmp_path / "run.h5"
    with h5py.File(path, "w", locking=True):
        code = (
            "import sys; from pathlib import Path\n"
            "from vasc.timeline.storage import check_output\n"
            "check_output(Path(sys.argv[1]), force=True)"
        )
        done = subprocess.run(
            [sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=False
        )
    assert "is being written by another run" in done.stderr


def test_missing_folders_and_folders_are_refused(tmp_path):
    with pytest.raises(OutputError, match="does not exist"):
        create(tmp_path / "nowhere" / "run.h5")
    with pytest.raises(OutputError, match="is a folder"):
        create(tmp_path)


def test_a_failed_creation_leaves_no_file(tmp_path):
    with pytest.raises(TypeError):
        create(tmp_path / "run.h5", config={"bad": object()})
    with pytest.raises(TypeError):
        create(tmp_path / "run.h5", units={"length": object()})
    assert os.listdir(tmp_path) == []


def test_a_failed_forced_creation_keeps_the_old_file(tmp_path):
    path = tmp_path / "run.h5"
    path.write_text("precious")
    with pytest.raises(TypeError):
        create(path, units={"length": object()}, force=True)
    assert path.read_text() == "precious"
    assert os.listdir(tmp_path) == ["run.h5"]


def test_steps_must_follow_one_another(tmp_path):
    streams = Streams(SEED, NAMES)
    states = list(SyntheticRun(3).states(streams))
    with create(tmp_path / "run.h5") as recorder:
        recorder.observe(states[0], streams)
        with pytest.raises(TimelineError, match="step 2 came, step 1 was expected"):
            recorder.observe(states[2], streams)
        recorder.close()
        with pytest.raises(TimelineError, match="closed"):
            recorder.observe(states[1], streams)


def test_closing_decides_what_is_complete(tmp_path):
    for name, complete in (("yes.h5", True), ("no.h5", False)):
        streams = Streams(SEED, NAMES)
        recorder = create(tmp_path / name)
        recorder.observe(next(SyntheticRun(5).states(streams)), streams)
        recorder.close(complete)
        recorder.close()
        with Timeline(tmp_path / name) as timeline:
            assert timeline.is_complete is complete


def test_only_the_two_marks_are_ever_rewritten(tmp_path, monkeypatch):
    """Every write to a growing column starts where its committed rows end."""
    written, kept = {}, []
    real = writer.GrowingColumn.write

    def watched(self, start, rows):
        kept.append(self)  # so that no other column gets its identity
        written.setdefault(id(self), []).append((start, len(rows), self.n_rows))
        real(self, start, rows)

    monkeypatch.setattr(writer.GrowingColumn, "write", watched)
    streams = Streams(SEED, NAMES)
    with create(tmp_path / "run.h5") as recorder:
        columns = list(recorder._columns.values())
        for state in SyntheticRun(200).states(streams):
            recorder.observe(state, streams)
    for column in columns:
        starts = written.get(id(column), [])
        assert all(start == before for start, _, before in starts)
        assert sum(n for _, n, _ in starts) == column.n_rows


def test_the_recorder_keeps_the_seed_exactly(tmp_path):
    seed = 2**64 - 1
    with create(tmp_path / "run.h5", seed=seed):
        pass
    with Timeline(tmp_path / "run.h5") as timeline:
        assert timeline.seed == seed
        assert timeline.provenance[0]["seed"] == seed
        assert json.dumps(timeline.provenance)


def test_a_recorder_is_made_by_its_two_doors_only(tmp_path):
    assert isinstance(create(tmp_path / "run.h5"), Recorder)
