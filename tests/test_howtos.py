"""The how-to pages do what they say: with their own files, in programs of their own."""

import csv
import os
import re
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from vasc.timeline import Timeline

ROOT = Path(__file__).resolve().parent.parent
HOWTO = ROOT / "docs" / "howto"
EXAMPLES = ROOT / "docs" / "examples"
PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
OFFLINE = ["--no-index", "--no-deps"]


def run(folder, *command, path=()):
    """Run a program in a folder, with packages that are installed in other folders."""
    places = os.pathsep.join(map(str, [*path, ROOT]))
    return subprocess.run(
        command,
        cwd=folder,
        env=os.environ | {"PYTHONPATH": places},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="module")
def young(tmp_path_factory):
    """Install the package of the page as a wheel, without network; gives its folder."""
    folder = tmp_path_factory.mktemp("young")
    wheels = folder / "wheels"
    source = EXAMPLES / "young-veins"
    install = ["--find-links", str(wheels), "--target", str(folder / "parts"), "young-veins"]
    commands = [
        [*PIP, "wheel", *OFFLINE, "--no-build-isolation", "--wheel-dir", str(wheels), str(source)],
        [*PIP, "install", *OFFLINE, *install],
    ]
    for command in commands:
        done = run(folder, *command)
        assert done.returncode == 0, done.stderr
    for config in source.glob("*.toml"):
        if config.name != "pyproject.toml":
            (folder / config.name).write_text(config.read_text())
    return folder


def vasc(folder, *arguments):
    """Run the program where the installed package is found."""
    return run(folder, sys.executable, "-m", "vasc", *arguments, path=[folder / "parts"])


@pytest.fixture(scope="module")
def runs(young):
    """Run the experiment of the page, and the one without a limit."""
    for name, options in (("young", ()), ("ever", ("--set", "competence=1000000"))):
        options = ("-o", f"{name}.h5", "--no-figure", "--quiet", *options)
        done = vasc(young, "run", "young-leaf.toml", *options)
        assert done.returncode == 0, done.stderr
    return young


def test_an_installed_hypothesis_makes_a_difference(runs):
    page = (HOWTO / "own-hypothesis.md").read_text()
    told = re.search(r"competence of (\d+) steps (\d+) of (\d+) sources are never reached", page)
    competence, n_left, n_sources = map(int, told.groups())
    with Timeline(runs / "young.h5") as young, Timeline(runs / "ever.h5") as ever:
        assert young.model == "young-open"
        assert young.frame().sources.n_sources == n_left
        assert young.events.counts()["source_placed"] == n_sources
        assert ever.frame().sources.n_sources == 0
        ages = [extension_ages(timeline.frame().network) for timeline in (young, ever)]
    assert ages[0].max() <= competence < ages[1].max()


def extension_ages(network):
    """Give how old the parent of each node was when the node was born."""
    children = np.flatnonzero(network.parents >= 0)
    return network.births[children] - network.births[network.parents[children]]


@pytest.mark.slow
def test_an_installed_hypothesis_is_resumed_to_the_same_bytes(runs):
    halved = (
        "run",
        "young-leaf.toml",
        "-o",
        "halves.h5",
        "--steps",
        "60",
        "--no-figure",
        "--quiet",
    )
    for arguments in (halved, ("resume", "halves.h5")):
        done = vasc(runs, *arguments)
        assert done.returncode == 0, done.stderr
    compared = vasc(runs, "compare", "young.h5", "halves.h5")
    assert "bit for bit" in compared.stdout


def test_keys_of_an_installed_hypothesis_are_checked(runs):
    refused = vasc(runs, "run", "young-leaf.toml", "-o", "bad.h5", "--set", "competence=0")
    assert refused.returncode == 2
    assert "competence = 0: must be a whole number of at least 1, in steps" in refused.stderr


@pytest.mark.parametrize("verb", ["verify", "resume"])
def test_without_the_package_a_run_asks_for_it(runs, verb):
    if verb == "resume":
        half = ("run", "young-leaf.toml", "-o", "half.h5", "--no-figure", "-q", "--steps", "5")
        assert vasc(runs, *half).returncode == 0
    file = {"verify": "young.h5", "resume": "half.h5"}[verb]
    done = run(runs, sys.executable, "-m", "vasc", verb, file)
    assert done.returncode == 2
    assert 'kind = "young-open": is not known here; install the package that' in done.stderr


@pytest.mark.parametrize("path", [["parts"], []], ids=["installed", "not installed"])
def test_leaves_of_the_model_are_judged_as_the_trees_they_are(runs, path):
    judge = (sys.executable, "-m", "vasc", "validate", "leaf", "young.h5")
    done = run(runs, *judge, path=[runs / part for part in path])
    assert done.returncode == 0, done.stderr
    assert "\nyoung: 2 of 2 checks pass\n" in done.stdout


@pytest.mark.slow
def test_the_sweep_of_the_page_answers_as_it_says(runs):
    swept = vasc(runs, "sweep", "young-sweep.toml", "-o", "competence")
    assert swept.returncode == 0, swept.stderr
    left = {}
    with (runs / "competence" / "results.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            left.setdefault(int(row["competence"]), []).append(int(row["summary.sources_left"]))
    assert 35 < np.mean(left[6]) < 45
    assert 7 < np.mean(left[25]) < 13
    assert max(left[100]) <= 1


def test_an_outline_of_your_own_gets_veins(tmp_path):
    for path in (EXAMPLES / "own-outline").iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    done = run(tmp_path, sys.executable, "-m", "vasc", "run", "my-leaf.toml", "--quiet")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "my-leaf.png").is_file()
    with Timeline(tmp_path / "my-leaf.h5") as timeline:
        frame = timeline.frame()
        assert frame.blade.length == pytest.approx(200.0)
        left, _, right, _ = frame.blade.bounds
        # the leaf of the page leans: it reaches farther to the right
        assert right > 1.2 * -left
        assert frame.blade.contains(frame.network.positions[1:]).all()
        assert frame.network.n_segments > frame.network.n_nodes


def test_tables_have_the_columns_that_the_page_reads_in_r(runs):
    page = (HOWTO / "other-programs.md").read_text()
    (written,) = re.findall(r"^vasc (export leaf\.h5 -o tables\.csv)", page, flags=re.MULTILINE)
    done = vasc(runs, *written.replace("leaf.h5", "young.h5").split())
    assert done.returncode == 0, done.stderr
    for table in ("nodes", "segments", "events"):
        (named,) = re.findall(rf'{table}\.csv"\)\s+# (?:a row .*: )?(.*)$', page, re.MULTILINE)
        with (runs / "tables.csv" / f"{table}.csv").open(newline="") as file:
            columns = set(csv.DictReader(file).fieldnames)
        used = set(re.findall(rf"\b{table}\$(\w+)", page))
        assert set(named.split(", ")) | used <= columns


def test_positions_come_out_of_the_file_as_the_page_says_for_r(runs):
    step = 100
    with h5py.File(runs / "young.h5") as file:
        # R has dimensions in the opposite order
        count = file["frames/n_nodes"][:].T[step]
        material = file["nodes/material"][:].T[:, :count]
        motion = file["frames/motion"][:].T[:, :, step]
        assert file.attrs["motion"] == b"affine"
    found = (motion[:2].T @ material + motion[2][:, None]).T
    with Timeline(runs / "young.h5") as timeline:
        assert found == pytest.approx(timeline.frame(step).network.positions)
