"""Runs, resumes and sweeps killed at random moments, and signals that ask for an end."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import pytest
from faults import children
from faults.subjects import Acknowledged, Subject, small_batches, subjects
from faults.tiers import Report, tiered
from timeline.synthetic import contents

from vasc.cli import main
from vasc.timeline import Timeline, validate

ROOT = Path(__file__).parents[2]
MOST_RESUMES = 6

SWEEP = """base = "leaf.toml"
title = "Small leaves"
measures = ["summary.nodes"]

[axes]
arrival.kill_distance = [1.0, 1.5, 2.0]
"""


@pytest.fixture(scope="module", params=subjects(), ids=lambda subject: subject.name)
def subject(request, tmp_path_factory) -> Subject:
    request.param.measure(tmp_path_factory.mktemp("whole"))
    return request.param


def seconds_of(subject: Subject, path: Path) -> float:
    """Measure how long an undisturbed run takes in a child."""
    started = time.monotonic()
    assert children.run(lambda: subject.record(path)).answer is None
    path.unlink()
    return time.monotonic() - started


@tiered(kills=(4, 60, 470))
def test_kills_of_run_and_resume(subject: Subject, kills, tmp_path, report: Report):
    path, chance = tmp_path / "run.h5", random.Random(1)
    n_killed, n_finished, wrong = 0, 0, []
    seconds = seconds_of(subject, path)
    while n_killed < kills:
        acknowledged, n_times = Acknowledged(), 0
        run = subject.with_(chance.choice(["process", "batch", "strict"]))
        path.unlink(missing_ok=True)
        while n_times < MOST_RESUMES and n_killed < kills:

            def work(run=run, acknowledged=acknowledged):
                with small_batches(chance.choice([1, 4, 64])):
                    run.resume(path, acknowledged.set)

            ending = children.run(work, kill_after=chance.uniform(0.0, seconds))
            if not ending.is_killed:
                assert ending.answer is None, ending
                break
            n_killed, n_times = n_killed + 1, n_times + 1
            try:
                run.check(path, acknowledged.get())
            except Exception as error:
                wrong.append(f"{type(error).__name__}: {error}"[:300])
                path.unlink(missing_ok=True)
                break
        else:
            children.run(lambda run=run: run.resume(path))
        if path.exists():
            n_finished += 1
            subject.finish(path)
            path.unlink()
    report.add(
        f"kill -9 of run and resume ({subject.name})",
        tried=n_killed,
        lost=len(wrong),
        note=f"{n_finished} runs finished, all to the same bytes",
    )
    assert not wrong


@tiered(kills=(0, 8, 60))
def test_kills_of_a_sweep(kills, tmp_path, report: Report):
    """Kill the whole group of processes; the same command makes what is missing."""
    leaf = subjects()[0]
    (tmp_path / "leaf.toml").write_text(leaf.toml)
    (tmp_path / "grid.toml").write_text(SWEEP)
    command = [sys.executable, "-m", "vasc", "sweep", "grid.toml", "--workers", "2", "--quiet"]
    paths = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    options = {"cwd": tmp_path, "env": os.environ | {"PYTHONPATH": paths}}
    started = time.monotonic()
    subprocess.run(command, check=True, capture_output=True, **options)
    seconds = time.monotonic() - started
    whole = {path.name: contents(path) for path in (tmp_path / "grid").rglob("*.h5")}
    assert len(whole) == 3
    chance, n_killed, wrong = random.Random(3), 0, []
    while n_killed < kills:
        shutil.rmtree(tmp_path / "grid", ignore_errors=True)
        for _ in range(4):
            sweep = subprocess.Popen(
                command,
                start_new_session=True,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                **options,
            )
            time.sleep(chance.uniform(0.3 * seconds, seconds))
            if sweep.poll() is not None:
                break
            os.killpg(sweep.pid, signal.SIGKILL)
            sweep.wait()
            n_killed += 1
            wrong += [text for path in whole if (text := wrong_in(tmp_path, path, whole[path]))]
        subprocess.run(command, check=True, capture_output=True, **options)
        found = {path.name: contents(path) for path in (tmp_path / "grid").rglob("*.h5")}
        if found != whole:
            wrong.append("the finished sweep differs")
    report.add("kill -9 of a sweep with two workers", tried=n_killed, lost=len(wrong))
    assert not wrong


def wrong_in(folder: Path, name: str, whole: dict[str, bytes]) -> str:
    """Say what is wrong with a timeline of a killed sweep."""
    for path in (folder / "grid").rglob(name):
        try:
            with Timeline(path) as timeline:
                n_frames = timeline.n_frames
            found = contents(path) if n_frames else {}
        except Exception as error:
            return f"{name}: {type(error).__name__}: {error}"
        if any(not whole[column].startswith(rows) for column, rows in found.items()):
            return f"{name}: differs"
    return ""


@tiered(signals=(3, 12, 50))
def test_signals_end_with_a_commit_and_a_sentence(signals, tmp_path, report: Report):
    """The program is told to stop while it runs: the step is finished and committed."""
    leaf, chance, wrong = subjects()[0], random.Random(4), []
    leaf.measure(tmp_path)
    config, path = tmp_path / "leaf.toml", tmp_path / "run.h5"
    config.write_text(leaf.toml)
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    arguments = ["run", str(config), "-o", str(path), "--no-figure", "--quiet", "--large"]
    n_tried = 0
    while n_tried < signals:
        path.unlink(missing_ok=True)
        number = numbers[n_tried % 3]
        wait = chance.uniform(0.0, 0.3)
        ending = children.run(partial(told, arguments, number, path, wait))
        n_tried += 1
        if ending.answer == 0 or is_complete(path):
            # it came after the last step
            continue
        try:
            assert ending.signal == 0
            assert ending.answer == 128 + number, ending
            assert "`vasc resume" in ending.said
            assert "Traceback" not in ending.said
            leaf.check(path, 1)
            assert validate(path) == []
            with Timeline(path) as timeline:
                assert timeline.provenance[-1]["outcome"] == "interrupted"
            leaf.finish(path)
        except AssertionError as error:
            wrong.append(str(error))
    report.add("SIGINT, SIGTERM, SIGHUP", tried=n_tried, lost=len(wrong))
    assert not wrong


def is_complete(path: Path) -> bool:
    """Tell whether a run was at its end."""
    with Timeline(path) as timeline:
        return timeline.is_complete


def told(
    arguments: list[str],
    number: int,
    path: Path,
    wait: float,
) -> int:
    """Run the program, and send it a signal once it records."""
    sender = os.fork()
    if not sender:
        until = time.monotonic() + 30.0
        while not path.exists() and time.monotonic() < until:
            time.sleep(0.002)
        time.sleep(wait)
        os.kill(os.getppid(), number)
        os._exit(0)
    try:
        return main(arguments)
    finally:
        os.waitpid(sender, 0)
