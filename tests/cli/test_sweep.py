"""``vasc sweep``: what it says of a plan, and of what came of it."""

import itertools
import json
import re
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest
from sweeps.sweep_files import write

from vasc.cli import main
from vasc.cli.sweep_progress import duration, line_of
from vasc.sweeps import Progress, load_sweep
from vasc.sweeps.pilot import largest_run
from vasc.sweeps.plan import PlannedRun

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Work in a folder that holds a sweep and its base alone."""
    monkeypatch.chdir(tmp_path)
    write(tmp_path)
    return tmp_path


def test_a_plan_tells_what_would_run_and_leaves_nothing(here, capsys):
    assert main(["sweep", "small.toml", "--plan", "--workers", "2"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("small: Small leaves\n")
    assert "arrival.kill_distance  2 values: 1, 3" in text
    assert re.search(r"^runs +8$", text, flags=re.MULTILINE)
    said = r"^run 3, expected to be largest +[\d.]+ (s|min.*), [\d.]+ [kM]B$"
    assert re.search(said, text, flags=re.MULTILINE)
    assert "if all are like run 3\n" in text
    assert "with 2 workers" in text
    assert sorted(path.name for path in here.iterdir()) == ["leaf.toml", "small.toml"]


def test_a_plan_as_json_has_every_run(here, capsys):
    assert main(["sweep", "small.toml", "--plan", "--json", "--workers", "4"]) == 0
    said = json.loads(capsys.readouterr().out)
    runs = load_sweep("small.toml").runs
    assert said["runs"] == [run.as_json() for run in runs]
    assert said["missing"] == list(range(1, 9))
    found = said["estimate"]
    assert (found["runs"], found["workers"], found["error"]) == (8, 4, "")
    assert found["bytes"] == 8 * found["run_bytes"] > 0
    assert found["seconds"] == pytest.approx(found["start_seconds"] + found["run_seconds"])


@pytest.mark.parametrize(
    ("values", "number"),
    [
        ({"arrival.kill_distance": [3.0, 1.0]}, 2),
        ({"growth.final_length": [30.0, 60.0, 40.0]}, 2),
        ({"growth.final_length": [30.0, 60.0], "arrival.kill_distance": [3.0, 1.0]}, 4),
    ],
)
def test_the_largest_run_is_found_from_the_config(here, values, number):
    loaded = load_sweep("small.toml")
    runs = [
        PlannedRun(k, dict(zip(values, choice, strict=True)), 1, 1, seed=k)
        for k, choice in enumerate(itertools.product(*values.values()), start=1)
    ]
    sweep = replace(loaded, runs=tuple(runs))
    assert largest_run(sweep, [run.number for run in runs]) == number
    # only runs that are missing are made
    assert largest_run(sweep, [1]) == 1


def test_a_plan_of_runs_that_fail_says_why(here, capsys):
    text = (here / "small.toml").read_text()
    (here / "small.toml").write_text(text.replace("summary.nodes", "check.connectivity.pair"))
    assert main(["sweep", "small.toml", "--plan"]) == 0
    assert "\nrun 3 fails: check.connectivity: " in capsys.readouterr().out


def test_the_line_of_progress_tells_how_long(here):
    progress = Progress(total=10, done=4, failed={3: "why"}, running=2, made=5)
    assert line_of(progress, 60.0) == "4 done  2 running  1 failed  5 left  about 1 min 0 s to go"
    assert line_of(Progress(total=2), 1.0) == "0 done  0 running  0 failed  2 left"
    assert duration(7260) == "2 h 1 min"


def test_the_sweep_of_the_page_is_one(here):
    text = (ROOT / "docs" / "sweeps.md").read_text()
    (block,) = re.findall(r"^```toml\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)
    (here / "my-sweep.toml").write_text(block)
    assert tomllib.loads(block)["base"] == "poplar-leaf"
    sweep = load_sweep("my-sweep.toml")
    assert len(sweep.runs) == 5 * 3 * 4


def test_a_bundled_sweep_is_copied(here, capsys):
    assert main(["configs", "--copy", "kill-distance-by-darts"]) == 0
    copied = load_sweep("kill-distance-by-darts.toml")
    assert copied.runs == load_sweep(ROOT / "configs/sweeps/kill-distance-by-darts.toml").runs
    assert copied.folder is None
    assert main(["configs", "--json"]) == 0
    listed = json.loads(capsys.readouterr().out.partition("\n")[2])
    assert [one["name"] for one in listed if one["verb"] == "sweep"][1] == "kill-distance-by-darts"
