"""Sweeps by worker processes: whatever is killed, the table is that of an undisturbed sweep."""

import json
import os
import pty
import shutil
import signal

import pytest
from sweeps.sweep_files import (
    LONG,
    children,
    is_told,
    is_under_way,
    sessions,
    start,
    wait_until,
    write,
)

from vasc.cli import main
from vasc.sweeps import LocalWorkers, load_sweep, run_sweep
from vasc.timeline import validate


def table(folder):
    """Give the bytes of a table."""
    return (folder / "results.csv").read_bytes()


def test_workers_share_the_runs(here, short):
    assert main(["sweep", "small.toml", "-o", "out", "--workers", "3", "-q"]) == 0
    assert table(here / "out") == table(short)
    names = sorted(path.name for path in (here / "out" / "runs").iterdir())
    assert names == [f"{n:04d}.{suffix}" for n in range(1, 9) for suffix in ("h5", "json")]
    assert (here / "out" / "figure.png").read_bytes() == (short / "figure.png").read_bytes()


def test_a_run_of_a_sweep_is_the_run_of_its_config(here, short):
    first = json.loads((short / "sweep.json").read_text())["runs"][0]
    changes = [f"--set={key}={value}" for key, value in first["values"].items()]
    words = ["run", "leaf.toml", "-o", "one.h5", "--seed", str(first["seed"]), *changes]
    assert main([*words, "--no-figure", "-q"]) == 0
    assert sessions("one.h5") == ["complete"]
    assert main(["stats", "one.h5", "--json"]) == 0
    rows = table(short).decode().splitlines()
    density = dict(zip(rows[0].split(","), rows[1].split(","), strict=True))["stats.vein_density"]
    from vasc.analysis import statistics
    from vasc.timeline import Timeline

    with Timeline("one.h5") as timeline:
        assert repr(statistics(timeline.frame())["vein_density"]) == density


def test_the_same_command_makes_nothing_twice(here, short, capsys):
    shutil.copytree(short, "out")
    before = {path: path.stat().st_mtime_ns for path in (here / "out" / "runs").iterdir()}
    assert main(["sweep", "small.toml", "-o", "out"]) == 0
    assert "8 of them before" in capsys.readouterr().out
    assert before == {path: path.stat().st_mtime_ns for path in (here / "out" / "runs").iterdir()}


def test_only_what_is_missing_is_made(here, short, capsys):
    shutil.copytree(short, "out")
    runs = here / "out" / "runs"
    # one is gone, one was not measured, one's result is damaged
    (runs / "0002.h5").unlink()
    for number in (2, 4):
        (runs / f"{number:04d}.json").unlink()
    (runs / "0006.json").write_text('{"number": 6, "sta')
    (here / "out" / "results.csv").unlink()
    assert main(["sweep", "small.toml", "-o", "out", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert (said["runs"], said["made"], said["done"], said["failed"]) == (8, 3, 8, [])
    assert table(here / "out") == table(short)
    assert sessions(runs / "0004.h5") == ["complete"]


def test_a_timeline_that_was_overwritten_is_made_again_and_one_removed_is_not(here, short, capsys):
    shutil.copytree(short, "out")
    runs = here / "out" / "runs"
    whole = (runs / "0003.h5").read_bytes()
    (runs / "0002.h5").unlink()
    (runs / "0003.h5").write_bytes(b"notes on this run")
    (runs / "0005.h5").write_bytes(b"x" * (runs / "0005.h5").stat().st_size)
    (runs / "0006.h5").write_bytes(whole)
    assert main(["sweep", "small.toml", "-o", "out"]) == 0
    assert "5 of them before" in capsys.readouterr().out
    assert table(here / "out") == table(short)
    for number in (3, 5, 6):
        assert validate(runs / f"{number:04d}.h5") == []
    assert not (runs / "0002.h5").exists()


def test_a_result_that_no_sweep_has_written_is_made_again(here, short, capsys):
    shutil.copytree(short, "out")
    runs = here / "out" / "runs"

    def change(number, **keys):
        path = runs / f"{number:04d}.json"
        path.write_text(json.dumps(json.loads(path.read_text()) | keys))

    measures = json.loads((runs / "0004.json").read_text())["measures"]
    name = next(iter(measures))
    change(1, measures=3)
    change(2, status="weird")
    change(3, measures=measures | {name: float("nan")})
    change(4, measures={})
    change(5, measures=measures | {name: {"x": 1}})
    change(6, error=None)
    assert main(["sweep", "small.toml", "-o", "out"]) == 0
    assert "2 of them before" in capsys.readouterr().out
    assert table(here / "out") == table(short)


def test_a_worker_that_is_killed_loses_its_own_run_alone(tmp_path, long):
    sweep = start(write(tmp_path, LONG).parent, "sweep", "small.toml", "-o", "out", "--workers=2")
    wait_until(lambda: is_under_way(tmp_path / "out", 1))
    os.kill(children(sweep.pid)[0], signal.SIGKILL)
    said, errors = sweep.communicate(timeout=120)
    assert (sweep.returncode, errors) == (0, "")
    assert said.startswith("3 runs: 3 done, 0 failed\n")
    assert table(tmp_path / "out") == table(long)
    ends = [sessions(tmp_path / "out" / "runs" / f"{number:04d}.h5") for number in (1, 2, 3)]
    # its run was gone on with by another worker, unless it was just between two runs
    assert sorted(map(len, ends)) in ([1, 1, 2], [1, 1, 1])
    assert [end[-1] for end in ends] == ["complete"] * 3
    assert [path for path in (tmp_path / "out" / "runs").glob("*.h5") if validate(path)] == []


def test_a_sweep_that_is_killed_goes_on(tmp_path, long):
    arguments = ["sweep", "small.toml", "-o", "out", "--workers", "2"]
    write(tmp_path, LONG)
    for _ in range(3):
        sweep = start(tmp_path, *arguments)
        wait_until(lambda: any(is_under_way(tmp_path / "out", number) for number in (1, 2, 3)))
        sweep.kill()
        sweep.communicate(timeout=60)
    sweep = start(tmp_path, *arguments)
    _, errors = sweep.communicate(timeout=120)
    assert (sweep.returncode, errors) == (0, "")
    assert table(tmp_path / "out") == table(long)
    left = [path.name for path in (tmp_path / "out" / "runs").iterdir()]
    assert sorted(left) == [f"{n:04d}.{suffix}" for n in (1, 2, 3) for suffix in ("h5", "json")]


def test_a_killed_sweep_leaves_no_worker(tmp_path):
    sweep = start(write(tmp_path, LONG).parent, "sweep", "small.toml", "-o", "out", "--workers=2")
    wait_until(lambda: is_under_way(tmp_path / "out", 1))
    workers = children(sweep.pid)
    assert len(workers) == 2
    sweep.kill()
    sweep.communicate(timeout=60)
    wait_until(lambda: not any(os.path.exists(f"/proc/{worker}") for worker in workers), 30.0)
    assert len(list((tmp_path / "out" / "runs").glob("*.json"))) < 3


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_stops_the_workers_with_a_sentence(number, code, tmp_path, long):
    arguments = ["sweep", "small.toml", "-o", "out", "--workers", "2"]
    sweep = start(write(tmp_path, LONG).parent, *arguments)
    wait_until(lambda: is_under_way(tmp_path / "out", 1, n_steps=5))
    workers = children(sweep.pid)
    # a fast machine would end its runs before it hears: no worker moves until it has been told
    for worker in workers:
        os.kill(worker, signal.SIGSTOP)
    assert not (tmp_path / "out" / "runs" / "0001.json").exists()
    sweep.send_signal(number)
    wait_until(lambda: all(is_told(worker, signal.SIGTERM) for worker in workers))
    for worker in workers:
        os.kill(worker, signal.SIGCONT)
    said, errors = sweep.communicate(timeout=60)
    assert sweep.returncode == code
    assert said == ""
    assert "Traceback" not in errors
    assert errors.splitlines()[-1].startswith("interrupted: out holds the results of ")
    assert not any(os.path.exists(f"/proc/{worker}") for worker in workers)
    ends = [sessions(path) for path in (tmp_path / "out" / "runs").glob("*.h5")]
    assert ["interrupted"] in ends
    assert [end for end in ends if end not in (["interrupted"], ["complete"])] == []
    assert b",missing," in table(tmp_path / "out")
    _, errors = start(tmp_path, *arguments).communicate(timeout=120)
    assert errors == ""
    assert table(tmp_path / "out") == table(long)


def test_two_sweeps_do_not_share_a_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("vasc.sweeps.folder.PATIENCE", 0.2)
    sweep = start(write(tmp_path, LONG).parent, "sweep", "small.toml", "-o", "out", "--workers=1")
    wait_until(lambda: is_under_way(tmp_path / "out", 1))
    try:
        assert main(["sweep", "small.toml", "-o", "out"]) == 2
        assert capsys.readouterr().err == "out: another sweep is at work in it\n"
    finally:
        sweep.send_signal(signal.SIGINT)
        sweep.communicate(timeout=60)


class Killers(LocalWorkers):
    """Workers that are killed whenever one has started."""

    def next_result(self, seconds):
        for number in self.process_ids:
            os.kill(number, signal.SIGKILL)
        return super().next_result(0.01)


def test_a_run_that_loses_every_worker_is_given_up(here):
    (here / "small.toml").write_text(
        (here / "small.toml").read_text().replace("replicates = 2", "replicates = 1")
    )
    outcome = run_sweep(load_sweep("small.toml"), "out", lambda: Killers(4))
    assert outcome.progress.failed == dict.fromkeys(
        (1, 2, 3, 4), "3 workers were lost; the last was ended by SIGKILL"
    )
    outcome = run_sweep(load_sweep("small.toml"), "out", lambda: LocalWorkers(1))
    assert (outcome.progress.made, len(outcome.progress.failed)) == (0, 4)
    outcome = run_sweep(load_sweep("small.toml"), "out", lambda: LocalWorkers(1), retry=True)
    assert (outcome.progress.made, outcome.progress.failed) == (4, {})


def test_a_terminal_shows_how_far_a_sweep_is(here):
    leader, follower = pty.openpty()
    sweep = start(here, "sweep", "small.toml", "-o", "out", "--workers", "1", stderr=follower)
    os.close(follower)
    shown = b""
    try:
        while piece := os.read(leader, 4096):
            shown += piece
    except OSError:
        pass
    sweep.communicate(timeout=60)
    lines = shown.decode().split("\r\x1b[K")
    assert lines[-1] == ""
    assert any("1 running  0 failed" in line and " left" in line for line in lines)
