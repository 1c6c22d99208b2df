"""A log that is damaged, or beside a file that is not its own: told, and never deleted."""

import shutil

import pytest
from timeline.synthetic import NAMES, SEED, SyntheticRun, contents, create, record, resume

from vasc.errors import OutputError
from vasc.streams import Streams
from vasc.timeline import Recorder, Timeline, validate, writer
from vasc.timeline.left_behind import concerns
from vasc.timeline.redo import Pager, log_of, problem_of
from vasc.timeline.redo.contents import FRAME_MAGIC, HEADER_BYTES
from vasc.timeline.redo.durability import BATCH_COMMITS

LAST = 9


def keep(path, copy):
    shutil.copy(path, copy)
    if log_of(path).exists():
        shutil.copy(log_of(path), log_of(copy))


@pytest.fixture
def path(tmp_path, monkeypatch):
    """A killed run: step 0 is in the file, and a commit a step is in the log."""
    monkeypatch.setattr(writer, "BATCH_FRAMES", 1)
    run, streams = SyntheticRun(LAST), Streams(SEED, NAMES)
    with create(tmp_path / "whole.h5") as recorder:
        for state in run.states(streams):
            recorder.observe(state, streams)
            if state.step == 5:
                keep(tmp_path / "whole.h5", tmp_path / "early.h5")
        keep(tmp_path / "whole.h5", tmp_path / "run.h5")
    assert problem_of(tmp_path / "run.h5") == ""
    assert concerns(tmp_path / "run.h5") == validate(tmp_path / "run.h5") == []
    with Timeline(tmp_path / "run.h5") as timeline:
        assert timeline.last_step == LAST
    return tmp_path / "run.h5"


def frames_in(log):
    """Where frames begin."""
    raw, places = log.read_bytes(), []
    at = raw.find(FRAME_MAGIC, HEADER_BYTES)
    while at >= 0:
        places.append(at)
        at = raw.find(FRAME_MAGIC, at + 1)
    return places


def spoil(file, at):
    raw = bytearray(file.read_bytes())
    raw[at] ^= 1
    file.write_bytes(raw)


def refused(path, said):
    """Neither a resume nor a new run touches what is there."""
    before = log_of(path).read_bytes()
    with pytest.raises(OutputError, match=said):
        Recorder.resume(path)
    with pytest.raises(OutputError, match=said):
        create(path, force=True)
    assert any(finding.startswith("[log] ") for finding in validate(path))
    assert log_of(path).read_bytes() == before


def test_commits_behind_a_bad_byte_are_told_and_made_again(path):
    places = frames_in(log_of(path))
    spoil(log_of(path), places[4] + 200)
    said = f"-wal: is damaged: {len(places) - 5} commits behind the damage cannot be used"
    assert said in problem_of(path)
    assert concerns(path) == [problem_of(path)]
    assert validate(path) == [f"[log] {problem_of(path)}"]
    with Timeline(path) as timeline:
        assert 0 < timeline.last_step < LAST
    resume(path, LAST)
    assert validate(path) == concerns(path) == []
    assert contents(path) == contents(path.with_name("whole.h5"))


@pytest.mark.parametrize("is_cut", [True, False])
def test_a_tail_that_is_not_whole_is_nothing_to_tell_of(path, is_cut):
    raw = log_of(path).read_bytes()
    if is_cut:
        log_of(path).write_bytes(raw[:-20])
    else:
        spoil(log_of(path), len(raw) - 20)
    assert concerns(path) == validate(path) == []
    with Timeline(path) as timeline:
        assert timeline.last_step == LAST - 1


@pytest.mark.parametrize("n_after", [0, 3])
def test_what_the_file_holds_already_is_not_lost(tmp_path, n_after):
    file = tmp_path / "run.h5"
    file.write_bytes(bytes(5000))
    pager = Pager(file)
    pager.identify(0, 10)
    # none of them makes the file longer
    for number in range(BATCH_COMMITS + n_after):
        pager.seek(100 + number % 2)
        pager.write(memoryview(bytes([1 + number])))
        pager.commit()
    pager.abandon()
    assert file.read_bytes()[100:102] == bytes([BATCH_COMMITS - 1, BATCH_COMMITS])
    spoil(log_of(file), frames_in(log_of(file))[2] + 60)
    said = f"{n_after} commits behind the damage cannot be used"
    assert problem_of(file) == (f"{log_of(file)}: is damaged: {said}" if n_after else "")
    # the commits before the damage are older than the file
    Pager(file).release()
    assert file.read_bytes()[100:102] == bytes([BATCH_COMMITS - 1, BATCH_COMMITS])


def test_a_header_that_is_damaged_is_told(path):
    spoil(log_of(path), 20)
    assert problem_of(path).endswith("-wal: its header is damaged: nothing in it can be read")
    resume(path, LAST)
    assert validate(path) == []


def test_the_log_of_another_run_is_left_alone(path, tmp_path):
    record(tmp_path / "other.h5", 3)
    shutil.copy(log_of(path), log_of(tmp_path / "other.h5"))
    refused(tmp_path / "other.h5", r"is the log of another file, and holds \d+ commits of it")
    with Timeline(tmp_path / "other.h5") as timeline:
        assert timeline.last_step == 3


def test_the_log_of_a_file_that_is_gone_is_left_alone(path):
    before = log_of(path).read_bytes()
    path.unlink()
    with pytest.raises(OutputError, match=r"is the log of a file that is gone.* use --force to"):
        create(path)
    assert log_of(path).read_bytes() == before
    assert not path.exists()
    record(path, 3, force=True)
    assert not log_of(path).exists()
    assert validate(path) == []


def test_a_log_is_not_used_on_an_older_copy(path):
    early = path.with_name("early.h5")
    with Timeline(early) as timeline:
        assert timeline.last_step == 5
    applied = path.with_name("applied.h5")
    keep(path, applied)
    with Recorder.resume(applied):
        # a log that begins where all commits before are in the file
        keep(applied, path)
    shutil.copy(early, path)
    refused(path, "this is an older copy of it")


def test_a_run_by_force_takes_the_log_of_what_it_replaces_away(path):
    record(path, 3, force=True)
    assert not log_of(path).exists()
    with Timeline(path) as timeline:
        assert timeline.last_step == 3


def test_a_file_that_was_moved_without_its_log_is_told(path, tmp_path):
    shutil.copy(path, tmp_path / "moved.h5")
    (said,) = concerns(tmp_path / "moved.h5")
    assert "moved.h5-wal is not beside it" in said
    assert validate(tmp_path / "moved.h5") == []
    resume(tmp_path / "moved.h5", LAST)
    assert concerns(tmp_path / "moved.h5") == []
    assert contents(tmp_path / "moved.h5") == contents(tmp_path / "whole.h5")
