"""Two writers, a writer that is dead, and readers beside a writer."""

import fcntl
import os
import random
import signal
import time
from pathlib import Path

import h5py
from faults import children
from faults.subjects import Acknowledged, Subject, small_batches, subjects
from faults.tiers import Report, tiered
from timeline.synthetic import contents

from vasc.errors import TimelineError
from vasc.timeline import Recorder
from vasc.timeline.redo import log_of


def compete(path: Path, start: int) -> str:
    """Try to continue a run at the same moment as another process does."""
    os.read(start, 1)
    try:
        recorder = Recorder.resume(path)
    except TimelineError as error:
        return str(error)
    time.sleep(0.2)
    recorder.close(complete=False)
    return "written"


def race(path: Path, n_writers: int) -> list[str]:
    """Let processes compete; give what became of each."""
    begin, trigger = os.pipe()
    pairs = [os.pipe() for _ in range(n_writers)]
    for _, answer in pairs:
        if not os.fork():
            os.write(answer, compete(path, begin).encode())
            os._exit(0)
    os.write(trigger, b"x" * n_writers)
    for _ in pairs:
        os.wait()
    found = [os.read(read, 10_000).decode() for read, _ in pairs]
    for handle in (begin, trigger, *(handle for pair in pairs for handle in pair)):
        os.close(handle)
    return found


@tiered(races=(3, 10, 20))
def test_of_two_writers_one_is_refused(races, tmp_path, report: Report):
    leaf, path, wrong = subjects()[0], tmp_path / "run.h5", []
    leaf.measure(tmp_path)
    leaf.record(path, steps=5)
    for _ in range(races):
        said = sorted(race(path, 2))
        if said[-1] != "written" or "is being written by another run" not in said[0]:
            wrong.append(said)
    report.add("two writers at once", tried=races, lost=len(wrong))
    assert not wrong
    leaf.finish(path)


@tiered(kills=(3, 10, 30))
def test_the_lock_of_a_dead_writer_is_taken_over(kills, tmp_path, report: Report):
    leaf, path, wrong = subjects()[0], tmp_path / "run.h5", []
    leaf.measure(tmp_path)
    for number in range(kills):
        acknowledged = Acknowledged()

        def die(number=number, acknowledged=acknowledged):
            def last(n_frames):
                acknowledged.set(n_frames)
                if n_frames > 3 * number:
                    os.kill(os.getpid(), signal.SIGKILL)

            with small_batches(4, 4):
                leaf.record(path, last)

        assert children.run(die).is_killed
        try:
            assert log_of(path).exists()
            assert leaf.check(path, acknowledged.get()) > 3 * number
            leaf.finish(path)
        except (TimelineError, AssertionError) as error:
            wrong.append(str(error))
        path.unlink()
    report.add("log and lock of a dead writer", tried=kills, lost=len(wrong))
    assert not wrong


@tiered(opens=(20, 100, 200))
def test_readers_beside_a_writer(opens, tmp_path, report: Report):
    """Every reader sees a beginning of the run; the writer is never stopped."""
    n_seen, wrong, frames = 0, [], set()
    for subject in subjects():
        subject.measure(tmp_path)
        path, chance = tmp_path / "run.h5", random.Random(5)
        while n_seen < opens * (1 + (subject.name == "canals")) // 2:
            path.unlink(missing_ok=True)
            writer = os.fork()
            if not writer:
                _write(subject, path)
            while os.waitpid(writer, os.WNOHANG) == (0, 0):
                if not path.exists():
                    time.sleep(0.002)
                    continue
                n_seen += 1
                try:
                    frames.add(subject.check(path, 0))
                except Exception as error:
                    wrong.append(f"{type(error).__name__}: {error}"[:300])
                time.sleep(chance.uniform(0.0, 0.02))
            subject.compare(contents(path), is_whole=True)
            assert not log_of(path).exists()
    report.add(
        "opened beside a writer", tried=n_seen, lost=len(wrong), note=f"{len(frames)} lengths seen"
    )
    assert not wrong
    assert len(frames) > 3


def _write(subject: Subject, path: Path) -> None:
    """Run in a child; never comes back."""
    code = 1
    try:
        with small_batches(4, 4):
            subject.record(path)
        code = 0
    finally:
        os._exit(code)


def hold(path: Path, ready: int, done: int) -> None:
    """Keep a file open under the lock of a reader, in a child; never comes back."""
    code = 1
    try:
        with path.open("rb") as reader, h5py.File(path, "r", locking=False) as held:
            fcntl.flock(reader, fcntl.LOCK_SH)
            steps = list(range(held["committed"][0]))
            os.write(ready, b"x")
            os.read(done, 1)
            code = list(held["frames/step"][: len(steps)]) != steps
    finally:
        os._exit(code)


@tiered(readers=(1, 3, 10))
def test_a_reader_that_holds_its_lock_stops_no_writer(readers, tmp_path, report: Report):
    """As every program does that opens the file with HDF5: the log grows meanwhile."""
    wrong = []
    for subject in subjects():
        subject.measure(tmp_path)
        for number in range(readers):
            path = tmp_path / f"run-{number}.h5"
            subject.record(path, steps=3 + 5 * number)
            (is_held, ready), (done, finished) = os.pipe(), os.pipe()
            holder = os.fork()
            if not holder:
                hold(path, ready, done)
            os.read(is_held, 1)
            try:
                subject.finish(path)
            except AssertionError as error:
                wrong.append(str(error))
            os.write(finished, b"x")
            if os.waitpid(holder, 0)[1]:
                wrong.append("the reader lost its steps")
            for handle in (is_held, ready, done, finished):
                os.close(handle)
            path.unlink()
    report.add("beside a reader that holds its lock", tried=2 * readers, lost=len(wrong))
    assert not wrong
