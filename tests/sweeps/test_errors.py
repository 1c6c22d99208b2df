"""Runs and measures that fail are rows of the table; folders of others are refused."""

import csv
import json
import shutil
from pathlib import Path

import pytest
from sweeps.sweep_files import LEAF, write

from vasc.cli import main

FAILING = """base = "leaf.toml"
measures = ["summary.nodes", "check.connectivity.pair"]

[axes]
"domain.length" = [20.0, 60.0]
"growth.final_length" = [50.0, 90.0]
"""


def rows(folder):
    """Give the rows of a table."""
    with (Path(folder) / "results.csv").open(newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture
def failed(tmp_path, monkeypatch, capsys):
    """Make a sweep of which all runs fail, one way or the other; give what was said."""
    monkeypatch.chdir(tmp_path)
    write(tmp_path, FAILING)
    assert main(["sweep", "small.toml", "-o", "out", "--workers", "1"]) == 3
    return capsys.readouterr()


def test_a_run_that_fails_is_a_row_with_its_error(failed):
    found = rows("out")
    assert [row["status"] for row in found] == ["failed"] * 4
    assert found[2]["error"].startswith("leaf: growth.final_length is 50; ")
    assert found[2]["summary.nodes"] == ""
    assert failed.out.splitlines()[0] == "4 runs: 0 done, 4 failed"
    lines = failed.err.splitlines()
    assert len(lines) == 4
    assert [line.partition(":")[0] for line in lines] == [f"run {n}" for n in (1, 2, 3, 4)]


def test_a_measure_that_cannot_be_taken_leaves_the_others(failed):
    row = rows("out")[0]
    assert row["error"].startswith("check.connectivity: ")
    assert row["check.connectivity.pair"] == ""
    assert int(row["summary.nodes"]) > 50


def test_failed_runs_are_made_again_when_asked_for(failed, capsys):
    assert main(["sweep", "small.toml", "-o", "out"]) == 3
    assert "4 of them before" in capsys.readouterr().out
    assert main(["sweep", "small.toml", "-o", "out", "--retry", "--json", "--workers=1"]) == 3
    said = json.loads(capsys.readouterr().out)
    assert said["made"] == 4
    assert [one["run"] for one in said["failed"]] == [1, 2, 3, 4]


@pytest.mark.parametrize(
    ("old", "new", "part"),
    [
        ("= [1.0, 3.0]", "= [1.0, 2.0]", "arrival.kill_distance"),
        ("replicates = 2", "replicates = 3", "small: replicates is 2 there, 3 here"),
        ('"stats.vein_density", ', "", "small: measures is ["),
    ],
)
def test_the_folder_of_another_sweep_is_refused_by_name(old, new, part, here, short, capsys):
    shutil.copytree(short, "out")
    before = (here / "out" / "sweep.json").read_bytes()
    write(here, (here / "small.toml").read_text().replace(old, new), "other.toml")
    for words in ([], ["--plan"]):
        assert main(["sweep", "other.toml", "-o", "out", *words]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith("out: belongs to another sweep, small: ")
        assert part in line
    assert (here / "out" / "sweep.json").read_bytes() == before


def test_another_base_is_another_sweep(here, short, capsys):
    shutil.copytree(short, "out")
    (here / "leaf.toml").write_text(LEAF.replace("length = 20.0", "length = 21.0"))
    assert main(["sweep", "small.toml", "-o", "out"]) == 2
    assert (
        "out: belongs to another sweep, small: its base leaf was another then"
        in capsys.readouterr().err
    )


@pytest.mark.parametrize(
    ("make", "part"),
    [
        (lambda path: path.write_text(""), "is not a folder"),
        (lambda path: (path.mkdir(), (path / "a").write_text("")), "holds other files"),
        (lambda path: (path.mkdir(), (path / "sweep.json").write_text("{")), "is damaged"),
        (lambda path: (path.mkdir(), (path / "sweep.json").write_text("{}")), "not the descr"),
    ],
)
def test_what_is_no_folder_of_a_sweep_is_left_alone(make, part, here, capsys):
    make(here / "out")
    assert main(["sweep", "small.toml", "-o", "out"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert part in line


def test_a_scheduler_that_is_not_there_is_told_before_all_else(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, FAILING)
    assert main(["sweep", "small.toml", "-o", "out", "--scheduler", "nowhere://x"]) == 2
    assert "--scheduler" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
