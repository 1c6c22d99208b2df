"""A run that is stopped from outside keeps what it made, and says how to go on."""

import builtins
import os
import pty
import re
import select
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from vasc.cli import main
from vasc.cli.failures import InterruptedRunError, end_of, interruptible
from vasc.cli.interrupts import Interrupts
from vasc.cli.progress import ProgressLine
from vasc.timeline import Timeline, validate

ROOT = Path(__file__).resolve().parents[2]
# so long a run that a signal always comes in time
LONG = ["--set", "growth.final_length=4000", "--set", "placement.density=2e-4"]


def start(folder, *arguments, **options):
    """Start the program."""
    return subprocess.Popen(
        [sys.executable, "-m", "vasc", *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        **options,
    )


def wait_for_steps(path, n_steps, seconds=60.0):
    """Wait until a run has recorded some steps."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if path.exists():
            with Timeline(path) as timeline:
                if timeline.n_frames >= n_steps:
                    return
        time.sleep(0.02)
    raise AssertionError(f"{path} did not get {n_steps} steps")


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]
)
def test_a_signal_ends_a_run_that_can_be_resumed(here, number, code):
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    run = start(here, "run", "leaf.toml", "--no-figure", *LONG, **pipes)
    wait_for_steps(here / "leaf.h5", 60)
    run.send_signal(number)
    _, said = run.communicate(timeout=30)
    assert run.returncode == code
    assert "Traceback" not in said
    assert "`vasc resume leaf.h5` goes on" in said
    assert validate("leaf.h5") == []
    with Timeline("leaf.h5") as timeline:
        last_step = timeline.last_step
        assert not timeline.is_complete
        assert timeline.provenance[-1]["outcome"] == "interrupted"
        assert f"up to {last_step};" in said
    assert main(["resume", "leaf.h5", "--steps", "3", "-q"]) == 0
    with Timeline("leaf.h5") as timeline:
        assert timeline.last_step == last_step + 3
    assert main(["verify", "leaf.h5", "-q"]) == 0


def seen_on_a_terminal(here, **options):
    """Give what a terminal is sent during a run."""
    leader, follower = pty.openpty()
    options = {name: follower if it is None else it for name, it in options.items()}
    run = start(here, "run", "leaf.toml", "--no-figure", stderr=follower, **options)
    os.close(follower)
    shown = b""
    while select.select([leader], [], [], 60.0)[0]:
        try:
            piece = os.read(leader, 4096)
        except OSError:
            break
        if not piece:
            break
        shown += piece
    os.close(leader)
    assert run.wait(timeout=60) == 0
    return shown.decode()


def test_what_is_run_is_told_on_a_line_of_its_own(here):
    text = seen_on_a_terminal(here, stdout=None)
    before, told, after = text.partition("leaf: closed venation")
    assert before.endswith("\r\x1b[K")
    assert told not in after


def test_a_terminal_shows_one_line_of_progress(here):
    text = seen_on_a_terminal(here, stdout=subprocess.DEVNULL)
    assert "\n" not in text
    lines = text.split("\r\x1b[K")
    assert lines[-1] == ""
    assert any(
        all(word in line for word in ("step ", "time ", "nodes ", "sources ", "steps/s"))
        for line in lines
    )


class Screen:
    """An error output that says it is a terminal."""

    def __init__(self):
        self.pieces = []

    def isatty(self):
        return True

    def write(self, text):
        self.pieces.append(text)

    def flush(self):
        pass


def states(n_states):
    """Give states of a run."""
    from types import SimpleNamespace

    for step in range(n_states):
        yield SimpleNamespace(
            step=step,
            time=float(step),
            blade=SimpleNamespace(length=20.0 + step),
            live=np.zeros(7),
            n_vein_nodes=1234,
        )


def test_progress_is_written_ten_times_a_second_at_most(monkeypatch):
    screen, clock = Screen(), iter(np.arange(0.0, 10.0, 0.001).tolist())
    monkeypatch.setattr("sys.stderr", screen)
    monkeypatch.setattr("vasc.cli.terminal_line.time.perf_counter", lambda: next(clock))
    monkeypatch.setenv("COLUMNS", "120")
    with ProgressLine() as progress:
        for state in states(3000):
            progress.observe(state, None)
    # one look at the clock a state: 3000 states in 3 s
    lines = screen.pieces[1:-1]
    assert 29 <= len(lines) <= 31
    shown = r"step 2,9\d\d  time 29\d\d  blade 29\d\d D  nodes 1,234  sources 7  1,000 steps/s"
    assert re.fullmatch(r"\r\x1b\[K" + shown, lines[-1])
    monkeypatch.setenv("COLUMNS", "20")
    progress.write("x" * 100)
    assert screen.pieces[-1] == "\r\x1b[K" + "x" * 19


@pytest.mark.parametrize("quiet", [True, False])
def test_progress_is_for_terminals_alone(quiet, monkeypatch):
    screen = Screen()
    screen.isatty = lambda: quiet
    monkeypatch.setattr("sys.stderr", screen)
    with ProgressLine(quiet=quiet) as progress:
        for state in states(3):
            progress.observe(state, None)
    assert screen.pieces == []


def test_the_second_signal_stops_at_once_and_handlers_are_put_back(capfd):
    before = signal.getsignal(signal.SIGINT)
    with Interrupts() as interrupts:
        assert not interrupts.should_stop()
        signal.raise_signal(signal.SIGINT)
        assert interrupts.should_stop()
        assert interrupts.exit_code == 130
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) == before
    assert "stopping after this step" in capfd.readouterr().err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_second_signal_has_the_exit_code_of_a_signal(number, capfd):
    @interruptible
    def verb():
        with Interrupts():
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(number)

    with pytest.raises(InterruptedRunError) as caught:
        verb()
    assert end_of(caught.value, with_traceback=False) == 128 + number
    assert capfd.readouterr().err.endswith("interrupted\n")


def test_a_thread_that_may_not_ask_for_signals_runs_without():
    found = []

    def work():
        with Interrupts() as interrupts:
            found.append(interrupts.should_stop())

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert found == [False]


def test_an_interrupt_while_the_program_loads_is_one(monkeypatch, capsys):
    def interrupted(name, *arguments):
        if name == "vasc.cli.program":
            raise KeyboardInterrupt
        return import_module(name, *arguments)

    import_module = builtins.__import__
    monkeypatch.setattr(builtins, "__import__", interrupted)
    assert main(["configs"]) == 130
    assert capsys.readouterr().err == "interrupted\n"


def test_a_run_is_continued_by_one_at_a_time(here, capsys):
    long = start(here, "run", "leaf.toml", "--no-figure", *LONG, stderr=subprocess.DEVNULL)
    try:
        wait_for_steps(here / "leaf.h5", 60)
        for words in (["resume", "leaf.h5"], ["run", "leaf.toml", "--force", "--no-figure"]):
            assert main(words) == 2
            by = rf"another run \(process {long.pid} on .*\)"
            assert re.fullmatch(rf"leaf\.h5: is being written by {by}\n", capsys.readouterr().err)
    finally:
        long.send_signal(signal.SIGINT)
        assert long.wait(timeout=30) == 130
    assert main(["resume", "leaf.h5", "--steps", "2", "-q"]) == 0
    assert validate("leaf.h5") == []
