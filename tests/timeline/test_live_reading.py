import numpy as np
import pytest
from timeline.subjects import SUBJECTS
from timeline.synthetic import NAMES, SEED, SyntheticRun, contents, create

from vasc.errors import TimelineError
from vasc.streams import Streams
from vasc.timeline import Recorder, Timeline, validate


@pytest.mark.parametrize("subject", SUBJECTS, ids=lambda subject: subject.name)
def test_a_reader_sees_whole_steps_of_a_run_that_is_being_written(subject, tmp_path):
    whole, path = tmp_path / "whole.h5", tmp_path / "run.h5"
    subject.finish(whole, "record")
    with Timeline(whole) as timeline:
        frames, tables = timeline.frames, timeline.tables()
        has_tissue = timeline.tissue is not None
        fields = [timeline.fields(step) for step in range(timeline.n_frames)] if has_tissue else []
    child = subject.start(path, "record")
    seen = []
    while child.poll() is None:
        if not path.exists():
            continue
        with Timeline(path) as timeline:
            n_frames = timeline.n_frames
            seen.append(n_frames)
            if not n_frames:
                continue
            for name, rows in timeline.frames.items():
                assert np.array_equal(rows, frames[name][:n_frames]), name
            for name, table in timeline.tables().tables.items():
                for column in table.columns:
                    expected = tables[name].view(column, 0, table.n_rows)
                    assert np.array_equal(table.view(column), expected), f"{name}/{column}"
            for step in {0, n_frames // 2, n_frames - 1} if has_tissue else ():
                for rows, expected in zip(timeline.fields(step), fields[step], strict=True):
                    assert np.array_equal(rows, expected), step
    _, errors = child.communicate()
    assert child.returncode == 0, errors.decode()
    assert seen == sorted(seen)
    assert len(set(seen)) >= 4
    assert contents(path) == contents(whole)


def test_the_recording_process_can_look_at_its_own_file(tmp_path):
    """A live plot is an observer that reads the file, in the process that writes it."""
    path = tmp_path / "run.h5"
    streams = Streams(SEED, NAMES)
    with create(path) as recorder:
        for state in SyntheticRun(200).states(streams):
            recorder.observe(state, streams)
            if state.step % 50 == 0:
                with Timeline(path) as timeline:
                    assert timeline.n_frames == recorder.n_frames
                    assert timeline.frame(0).network.n_nodes == 1
    assert validate(path) == []


def test_a_reader_that_stays_open_never_stops_a_writer(tmp_path):
    subject = SUBJECTS[0]
    path = tmp_path / "run.h5"
    create(path).close(complete=False)
    with Timeline(path) as early:
        subject.finish(path, "resume")
        assert early.n_frames == 0
    with Timeline(path) as timeline:
        assert timeline.is_complete


def test_a_file_read_in_this_process_is_continued_only_after_closing_it(tmp_path):
    path = tmp_path / "run.h5"
    create(path).close(complete=False)
    with Timeline(path), pytest.raises(TimelineError, match="close it before it is continued"):
        Recorder.resume(path)
    Recorder.resume(path).close()


def test_a_reader_keeps_to_the_steps_it_found_when_it_opened(tmp_path):
    """Also when the file has grown by whole chunks and new index pages meanwhile."""
    subject = SUBJECTS[0]
    path = tmp_path / "run.h5"
    child = subject.start(path, "record")
    while subject.last_observed(path) < 100:
        assert child.poll() is None
    with Timeline(path) as timeline:
        n_frames = timeline.n_frames
        _, errors = child.communicate()
        assert child.returncode == 0, errors.decode()
        nodes = timeline.table("nodes", "birth")
        assert timeline.n_frames == n_frames
        assert len(timeline.frames["step"]) == n_frames
        assert nodes.max() == n_frames - 1
