import random
import subprocess
import time
from pathlib import Path

import pytest
from timeline.subjects import SUBJECTS, Subject
from timeline.synthetic import contents

from vasc.timeline import Timeline, validate

FEW, MANY = 2, 50


@pytest.fixture(scope="module", params=SUBJECTS, ids=lambda subject: subject.name)
def undisturbed(request, tmp_path_factory) -> tuple[Subject, Path]:
    """A subject and the file of its undisturbed run."""
    path = tmp_path_factory.mktemp("kills") / "whole.h5"
    request.param.finish(path, "record")
    assert validate(path) == []
    return request.param, path


def kill_once(subject: Subject, path: Path, verb: str, seconds: float) -> None:
    """Start a run, kill it some time after its file is there."""
    child = subject.start(path, verb)
    patience = time.monotonic() + 60.0
    while subject.last_observed(path) < 0 and child.poll() is None:
        assert time.monotonic() < patience
        time.sleep(0.001)
    time.sleep(seconds)
    child.kill()
    child.communicate()


def check_killed(subject: Subject, path: Path, whole: Path) -> int:
    """Check that a killed run's file is sound and lacks at most its last batch."""
    with Timeline(path) as timeline:
        n_frames = timeline.n_frames
    lost = subject.last_observed(path) + 1 - n_frames
    assert lost <= subject.batch
    assert validate(path) == []
    assert contents(path) == contents(whole, n_frames)
    return n_frames


def kill_at_random(subject, whole, folder, trials, seed):
    """Kill a run at random moments, each trial once in the run and once in its resume."""
    chance = random.Random(seed)
    killed = 0
    for trial in range(trials):
        path, n_sessions = folder / f"{trial}.h5", 1
        for verb in ("record", "resume"):
            kill_once(subject, path, verb, chance.uniform(0.0, subject.seconds))
            check_killed(subject, path, whole)
            with Timeline(path) as timeline:
                killed += not timeline.is_complete
                n_sessions += not timeline.is_complete
        subject.finish(path, "resume")
        assert contents(path) == contents(whole)
        with Timeline(path) as timeline:
            assert timeline.is_complete
            # what is complete need not be continued
            assert len(timeline.provenance) >= n_sessions
    # a kill after the end of the run proves nothing
    assert killed >= trials // 2


def test_a_killed_run_keeps_whole_steps_and_goes_on_to_the_same_bytes(undisturbed, tmp_path):
    subject, whole = undisturbed
    kill_at_random(subject, whole, tmp_path, FEW, seed=1)


@pytest.mark.slow
def test_fifty_kills_lose_nothing_that_was_committed(undisturbed, tmp_path):
    subject, whole = undisturbed
    kill_at_random(subject, whole, tmp_path, MANY, seed=2)


def test_an_interrupted_run_keeps_every_step_it_observed(undisturbed, tmp_path):
    subject, whole = undisturbed
    path = tmp_path / "run.h5"
    child = subject.start(path, "record")
    while subject.last_observed(path) < 20 and child.poll() is None:
        time.sleep(0.001)
    child.send_signal(subprocess.signal.SIGINT)
    child.communicate()
    with Timeline(path) as timeline:
        assert timeline.last_step >= subject.last_observed(path)
        assert timeline.provenance[0]["outcome"] == "interrupted"
    assert contents(path) == contents(whole, timeline.n_frames)
