import subprocess
import sys

import h5py
import numpy as np
import pytest
from timeline.synthetic import NAMES, SEED, SyntheticRun, contents, create, record, resume

from vasc.errors import TimelineError
from vasc.streams import Streams
from vasc.timeline import Recorder, Timeline, layout, validate
from vasc.timeline.redo import Pager, log_of, settle

LAST = 150


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = tmp_path_factory.mktemp("resume") / "whole.h5"
    record(path, LAST)
    return contents(path)


@pytest.mark.parametrize("step", [0, 1, 63, 64, 65, 100, LAST - 1])
def test_a_stopped_run_goes_on_to_the_same_bytes(tmp_path, whole, step):
    path = tmp_path / "run.h5"
    record(path, LAST, stop_after=step)
    resume(path, LAST)
    assert contents(path) == whole
    assert validate(path) == []
    with Timeline(path) as timeline:
        assert timeline.is_complete


def test_a_run_without_any_frame_starts_again(tmp_path, whole):
    path = tmp_path / "run.h5"
    create(path).close(complete=False)
    resume(path, LAST)
    assert contents(path) == whole


def test_rows_that_were_not_committed_are_dropped(tmp_path, whole):
    """What a killed run leaves: columns that grew, one or all, by garbage, over chunks."""
    path = tmp_path / "run.h5"
    record(path, LAST, stop_after=70)
    with h5py.File(path, "r+") as file:
        for k, name in enumerate(layout.growing_columns(len(NAMES))):
            dataset = file[name]
            grown = 3 if k % 3 else 2 * layout.chunk_rows(name)
            before = dataset.shape[0]
            dataset.resize(before + grown, axis=0)
            dataset[before:] = 77
    assert contents(path) == contents_of_prefix(tmp_path, 71)
    assert validate(path) == []
    resume(path, LAST)
    assert contents(path) == whole
    with h5py.File(path) as file, Timeline(path) as timeline:
        assert file["nodes/birth"].shape[0] == timeline.n_rows("nodes")
        assert file["frames/step"].shape[0] == timeline.n_frames


def contents_of_prefix(folder, n_frames):
    record(folder / "plain.h5", LAST)
    return contents(folder / "plain.h5", n_frames)


def test_a_complete_run_stays_complete_when_nothing_is_added(tmp_path, whole):
    path = tmp_path / "run.h5"
    record(path, LAST)
    Recorder.resume(path).close()
    assert contents(path) == whole
    with Timeline(path) as timeline:
        assert timeline.is_complete
        assert len(timeline.provenance) == 2


def test_a_complete_run_that_goes_on_is_not_complete_until_it_ends(tmp_path):
    path = tmp_path / "run.h5"
    record(path, 10)
    run, streams = SyntheticRun(20), Streams(SEED, NAMES)
    with Timeline(path) as timeline:
        run.restore(timeline.tables(), 10)
        streams.restore(timeline.stream_words())
    recorder = Recorder.resume(path)
    recorder.observe(next(run.states(streams)), streams)
    recorder.close(complete=False)
    with Timeline(path) as timeline:
        assert (timeline.n_frames, timeline.is_complete) == (12, False)


def test_a_complete_run_killed_before_its_log_was_removed_is_settled(tmp_path, whole, monkeypatch):
    path = tmp_path / "run.h5"
    with monkeypatch.context() as patched:
        patched.setattr(Pager, "release", Pager.abandon)
        record(path, LAST)
    log = log_of(path)
    assert log.exists()
    assert contents(path) == whole
    settle(path)
    assert not log.exists()
    assert contents(path) == whole
    settle(path)


def test_a_second_writer_is_refused(tmp_path):
    path = tmp_path / "run.h5"
    with create(path):
        code = (
            "import sys; from vasc.timeline import Recorder\nRecorder.resume(sys.argv[1]).close()"
        )
        command = [sys.executable, "-c", code, str(path)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert "TimelineError" in done.stderr
    assert "is being written by another run" in done.stderr


def test_a_newer_minor_version_is_read_but_not_continued(tmp_path):
    path = tmp_path / "run.h5"
    record(path, 3)
    with h5py.File(path, "r+") as file:
        file.attrs["version"] = np.bytes_("1.7")
    with Timeline(path) as timeline:
        assert timeline.version == "1.7"
    with pytest.raises(TimelineError, match=r"version 1\.7, this vasc continues 1\.0 at most"):
        Recorder.resume(path)


def test_what_is_no_timeline_is_not_resumed_and_not_touched(tmp_path):
    path = tmp_path / "other.h5"
    with h5py.File(path, "w") as file:
        file["x"] = 1
    before = path.read_bytes()
    with pytest.raises(TimelineError, match="not a timeline"):
        Recorder.resume(path)
    assert path.read_bytes() == before
