"""Sweeps on a Dask cluster of processes of this machine, and what is left when some are killed."""

import os
import signal
import time
from contextlib import contextmanager

import pytest
from sweeps.sweep_files import LONG, ROOT, is_under_way, sessions, start, wait_until, write

from vasc.cli import main
from vasc.errors import ConfigError
from vasc.sweeps import LocalWorkers, load_sweep, run_sweep
from vasc.sweeps.cluster import ClusterWorkers
from vasc.timeline import validate

MANY = """base = "leaf.toml"
replicates = 10
measures = ["summary.nodes", "summary.steps", "stats.vein_length", "lineage.source_life_mean"]

[axes]
arrival.kill_distance = { from = 1.0, to = 3.0, num = 20 }
"""
"""Two hundred short runs."""

# the cluster's own threads and sockets, which it lets go of when it is collected
pytestmark = pytest.mark.filterwarnings("default")


@contextmanager
def cluster(n_workers, monkeypatch):
    """Start a scheduler and worker processes, each under a nanny that replaces it."""
    from dask.distributed import LocalCluster

    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    made = LocalCluster(
        n_workers=n_workers,
        threads_per_worker=1,
        processes=True,
        dashboard_address=None,
        host="127.0.0.1",
        silence_logs=50,
    )
    with made:
        yield made


class Watcher:
    """Kills one worker process of a cluster when it is told to."""

    def __init__(self, made, is_time):
        self.made, self.is_time = made, is_time
        self.killed = []

    def show(self, progress):
        if not self.killed and self.is_time(progress):
            number = next(iter(self.made.workers.values())).process.pid
            os.kill(number, signal.SIGKILL)
            self.killed.append(number)


def made_on(address, folder, watcher=None):
    """Make a sweep on a cluster."""
    sweep = load_sweep(folder / "small.toml")
    return run_sweep(sweep, folder / "out", lambda: ClusterWorkers(address), watcher=watcher)


@pytest.mark.slow
def test_a_cluster_that_loses_a_worker_makes_the_same_table(tmp_path, long, monkeypatch):
    write(tmp_path, LONG)
    with cluster(2, monkeypatch) as made:
        watcher = Watcher(made, lambda progress: is_under_way(tmp_path / "out", 1))
        outcome = made_on(made.scheduler_address, tmp_path, watcher)
    assert len(watcher.killed) == 1
    assert (outcome.progress.done, outcome.progress.failed) == (3, {})
    assert (tmp_path / "out/results.csv").read_bytes() == (long / "results.csv").read_bytes()
    assert [path for path in (tmp_path / "out" / "runs").glob("*.h5") if validate(path)] == []


@pytest.mark.slow
def test_two_hundred_runs_on_four_workers_of_which_one_is_killed(tmp_path, monkeypatch):
    (tmp_path / "cluster").mkdir()
    (tmp_path / "serial").mkdir()
    for folder in ("cluster", "serial"):
        write(tmp_path / folder, MANY)
    assert len(load_sweep(tmp_path / "serial" / "small.toml").runs) == 200
    with cluster(4, monkeypatch) as made:
        watcher = Watcher(made, lambda progress: progress.made >= 50)
        began = time.perf_counter()
        outcome = made_on(made.scheduler_address, tmp_path / "cluster", watcher)
        seconds = time.perf_counter() - began
    assert len(watcher.killed) == 1
    assert (outcome.progress.made, outcome.progress.failed) == (200, {})
    sweep = load_sweep(tmp_path / "serial" / "small.toml")
    serial = run_sweep(sweep, tmp_path / "serial" / "out", lambda: LocalWorkers(1))
    assert (serial.progress.made, serial.progress.failed) == (200, {})
    tables = [tmp_path / name / "out" / "results.csv" for name in ("cluster", "serial")]
    assert tables[0].read_bytes() == tables[1].read_bytes()
    print(f"200 runs on the cluster: {seconds:.1f} s")


def test_the_command_runs_on_a_cluster(here, short, monkeypatch):
    with cluster(1, monkeypatch) as made:
        words = ["sweep", "small.toml", "-o", "out", "--scheduler", made.scheduler_address, "-q"]
        assert main(words) == 0
    assert (here / "out" / "results.csv").read_bytes() == (short / "results.csv").read_bytes()


@pytest.mark.slow
def test_a_sweep_that_is_stopped_on_a_cluster_goes_on_without_one(tmp_path, long, monkeypatch):
    write(tmp_path, LONG)
    words = ["sweep", "small.toml", "-o", "out"]
    with cluster(1, monkeypatch) as made:
        sweep = start(tmp_path, *words, "--scheduler", made.scheduler_address)
        wait_until(lambda: is_under_way(tmp_path / "out", 1))
        sweep.send_signal(signal.SIGINT)
        _, errors = sweep.communicate(timeout=60)
        assert sweep.returncode == 130
        assert "the same command goes on" in errors
        assert "Traceback" not in errors
        # the run under way comes to its end there, and nobody else writes to it meanwhile
        again = start(tmp_path, *words, "--workers", "2")
        _, errors = again.communicate(timeout=120)
        assert (again.returncode, errors) == (0, "")
    assert sessions(tmp_path / "out" / "runs" / "0001.h5") == ["complete"]
    assert (tmp_path / "out/results.csv").read_bytes() == (long / "results.csv").read_bytes()


def test_a_scheduler_that_is_not_there_is_told_in_one_line(here, monkeypatch, capsys):
    monkeypatch.setattr("vasc.sweeps.cluster.SECONDS_TO_CONNECT", 1.0)
    assert main(["sweep", "small.toml", "-o", "out", "--scheduler", "tcp://127.0.0.1:9"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("--scheduler tcp://127.0.0.1:9: cannot be reached")


def test_workers_of_another_version_are_refused(here, monkeypatch):
    with cluster(1, monkeypatch) as made:
        monkeypatch.setattr("vasc.__version__", "9.9")
        with pytest.raises(ConfigError, match=r"has vasc 0\.1\.0, and here is 9\.9"):
            made_on(made.scheduler_address, here)


def test_processes_and_a_cluster_exclude_each_other(here, capsys):
    assert main(["sweep", "small.toml", "--workers", "2", "--scheduler", "tcp://a:1"]) == 2
    assert "exclude each other" in capsys.readouterr().err
