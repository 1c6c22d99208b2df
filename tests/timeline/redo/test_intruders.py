"""What stands beside a file, and what is done to its name while it is written."""

import os
import shutil

import pytest
from timeline.synthetic import NAMES, SEED, SyntheticRun, create, record

from vasc.errors import OutputError, TimelineError
from vasc.streams import Streams
from vasc.timeline import Recorder, Timeline, validate
from vasc.timeline.redo import MovedError, log_of


@pytest.fixture
def path(tmp_path):
    """A run that was stopped after ten steps."""
    record(tmp_path / "run.h5", 30, stop_after=10)
    return tmp_path / "run.h5"


def notes(log):
    log.write_text("my notes")


def link(log):
    (log.parent / "precious").write_text("precious")
    log.symlink_to(log.parent / "precious")


KINDS = {"notes": notes, "link": link, "pipe": os.mkfifo, "folder": os.mkdir}


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_no_log_is_left_alone(path, kind):
    KINDS[kind](log_of(path))
    with pytest.raises(OutputError, match="-wal: is no log of vasc"):
        Recorder.resume(path)
    with Timeline(path) as timeline:
        assert timeline.last_step == 10
    if kind != "notes":
        assert validate(path)[0].endswith("-wal: cannot be read, or is no file")
    assert os.path.lexists(log_of(path))
    if kind in ("notes", "link"):
        assert log_of(path).read_text() in ("my notes", "precious")


def test_a_new_run_takes_no_name_beside_which_something_else_stands(tmp_path):
    notes(tmp_path / "new.h5-wal")
    with pytest.raises(OutputError, match="move it away"):
        create(tmp_path / "new.h5")
    assert [file.name for file in tmp_path.iterdir()] == ["new.h5-wal"]


def test_a_second_writer_is_refused_under_another_name(path):
    os.link(path, path.with_name("other.h5"))
    with Recorder.resume(path) as recorder:
        with pytest.raises(TimelineError, match="is being written"):
            Recorder.resume(path.with_name("other.h5"))
        assert not log_of(path.with_name("other.h5")).exists()
        log_of(path).unlink()
        with pytest.raises(TimelineError, match="is being written"):
            Recorder.resume(path)
        recorder.close(complete=False)
    assert validate(path) == []


@pytest.mark.parametrize("is_replaced", [True, False])
def test_a_file_that_is_moved_while_it_is_written_has_all_steps_and_the_run_says_so(
    tmp_path, is_replaced
):
    path, moved, other = (tmp_path / name for name in ("run.h5", "moved.h5", "other.h5"))
    run, streams = SyntheticRun(30), Streams(SEED, NAMES)

    def recorded():
        with create(path) as recorder:
            for state in run.states(streams):
                recorder.observe(state, streams)
                if state.step == 10:
                    path.rename(moved)
                    with pytest.raises(OutputError, match="is being written"):
                        create(path)
                    assert not path.exists()
                    if is_replaced:
                        record(other, 3)
                        shutil.copy(other, path)

    with pytest.raises(MovedError, match="was moved, replaced or removed"):
        recorded()
    assert MovedError.exit_code == 3
    with Timeline(moved) as timeline:
        assert timeline.last_step == 30
    if is_replaced:
        with Timeline(path) as timeline:
            assert timeline.last_step == 3
