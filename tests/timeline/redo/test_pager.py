"""The pager and its log, on a file that is no timeline: bytes in, bytes out."""

import fcntl
import os
import shutil

import pytest

from vasc.errors import OutputError
from vasc.timeline.redo import BusyError, Durability, Pager, Snapshot, is_being_written, pager
from vasc.timeline.redo.contents import HEADER_BYTES, log_of

OWN = b"this file and no other"


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "run.h5"
    path.write_bytes(OWN + bytes(5000))
    return path


def opened(path, durability=Durability.BATCH):
    found = Pager(path, durability=durability)
    found.identify(0, len(OWN))
    return found


def write(found, offset, content):
    found.seek(offset)
    found.write(memoryview(content))


def killed(path):
    """A run that has committed twice and written once more, and is gone."""
    found = opened(path)
    write(found, 100, b"first")
    found.commit()
    write(found, 7000, b"second")
    found.commit()
    write(found, 100, b"never")
    found.abandon()


def seen(path):
    """What a reader sees."""
    snapshot = Snapshot.of(path)
    if snapshot is None:
        return path.read_bytes()
    content = bytearray(snapshot.seek(0, os.SEEK_END))
    snapshot.seek(0)
    assert snapshot.readinto(memoryview(content)) == len(content)
    snapshot.close()
    return bytes(content)


def expected():
    content = bytearray(OWN + bytes(7006 - len(OWN)))
    content[100:105], content[7000:7006] = b"first", b"second"
    return bytes(content)


def test_what_is_committed_is_read_before_it_is_in_the_file(path):
    before = path.read_bytes()
    killed(path)
    assert path.read_bytes() == before
    assert seen(path) == expected()
    assert path.read_bytes() == before


def test_what_is_committed_is_in_the_file_after_the_next_writer(path):
    killed(path)
    opened(path).release()
    assert path.read_bytes() == expected()
    assert not log_of(path).exists()


@pytest.mark.parametrize("durability", Durability)
def test_a_file_that_is_closed_has_no_log(path, durability):
    found = opened(path, durability)
    write(found, 100, b"first")
    found.commit()
    write(found, 7000, b"second")
    found.commit()
    assert seen(path) == expected()
    found.release()
    found.release()
    assert path.read_bytes() == expected()
    assert os.listdir(path.parent) == ["run.h5"]


def test_every_cut_of_a_log_leaves_whole_commits(path):
    before = path.read_bytes()
    found = opened(path)
    write(found, 100, b"first")
    found.commit()
    middle = log_of(path).stat().st_size
    found.abandon()
    first = seen(path)
    path.write_bytes(before)
    log_of(path).unlink()
    killed(path)
    raw = log_of(path).read_bytes()
    for size in range(len(raw) + 1):
        log_of(path).write_bytes(raw[:size])
        whole = expected() if size == len(raw) else first if size >= middle else before
        assert seen(path) == whole, size


def test_a_flipped_bit_drops_a_commit_and_those_after_it(path):
    before = path.read_bytes()
    killed(path)
    raw = log_of(path).read_bytes()
    for place in range(len(raw)):
        log_of(path).write_bytes(raw[:place] + bytes([raw[place] ^ 4]) + raw[place + 1 :])
        found = seen(path)
        assert found == before or found[100:105] == b"first"
        assert found != expected()


def test_the_log_of_another_file_is_not_replayed(path):
    killed(path)
    path.write_bytes(b"T" + path.read_bytes()[1:])
    before = path.read_bytes()
    assert seen(path) == before
    log = log_of(path).read_bytes()
    with pytest.raises(
        OutputError, match=r"-wal: is the log of another file, and holds \d commits"
    ):
        opened(path)
    assert (path.read_bytes(), log_of(path).read_bytes()) == (before, log)


@pytest.mark.parametrize("size", [4000, 8000])
def test_the_log_of_an_older_or_newer_copy_is_not_replayed(path, size):
    killed(path)
    path.write_bytes(path.read_bytes()[:size].ljust(size, b"x"))
    before = path.read_bytes()
    assert seen(path) == before


def test_a_copy_with_its_log_is_whole_and_one_without_is_as_it_was(path, tmp_path):
    before = path.read_bytes()
    killed(path)
    copy = tmp_path / "copy.h5"
    shutil.copy(path, copy)
    assert seen(copy) == before
    shutil.copy(log_of(path), log_of(copy))
    assert seen(copy) == expected()


def test_a_link_to_a_file_has_the_same_log(path, tmp_path):
    killed(path)
    link = tmp_path / "link.h5"
    link.symlink_to(path)
    assert seen(link) == expected()


def test_a_second_writer_is_refused(path):
    found = opened(path)
    assert is_being_written(path, log_of(path))
    with pytest.raises(BusyError):
        Pager(path)
    found.release()
    assert not is_being_written(path, log_of(path))


def test_a_reader_under_a_lock_is_waited_for_and_stops_nobody(path, monkeypatch):
    before = path.read_bytes()
    found = opened(path, Durability.PROCESS)
    with path.open("rb") as reader:
        fcntl.flock(reader, fcntl.LOCK_SH)
        for _ in range(3):
            write(found, 100, b"first")
            found.commit()
        assert path.read_bytes() == before
        assert seen(path)[100:105] == b"first"
        monkeypatch.setattr(pager, "MOST_LOG_BYTES", log_of(path).stat().st_size)
        write(found, 7000, b"second")
        found.commit()
    # the log is bounded: by force if need be
    assert path.read_bytes() == expected()
    assert log_of(path).stat().st_size > HEADER_BYTES
    assert seen(path) == expected()
    found.release()


def test_at_the_end_the_file_is_whole_whoever_reads_it(path, monkeypatch):
    monkeypatch.setattr(pager, "PATIENCE", 0.0)
    found = opened(path)
    write(found, 100, b"first")
    write(found, 7000, b"second")
    with path.open("rb") as reader:
        fcntl.flock(reader, fcntl.LOCK_SH)
        found.commit()
        found.release()
    assert path.read_bytes() == expected()
    assert not log_of(path).exists()


def test_a_file_that_was_not_begun_is_not_touched(path):
    killed(path)
    before, log = path.read_bytes(), log_of(path).read_bytes()
    Pager(path).abandon()
    assert (path.read_bytes(), log_of(path).read_bytes()) == (before, log)
    log_of(path).unlink()
    Pager(path).abandon()
    assert not log_of(path).exists()
