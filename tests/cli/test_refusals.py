"""What a verb cannot do is told before it works, in one line that names what is wrong."""

import subprocess
import sys
from pathlib import Path

import h5py
import pytest

from vasc.cli import main

ROOT = Path(__file__).parents[2]
DRAW = ["render", "RUN", "-o", "a.png"]


@pytest.fixture
def leaf(recorded, tmp_path, monkeypatch):
    """The recorded run, and a folder to write into as the working one."""
    monkeypatch.chdir(tmp_path)
    return str(recorded / "leaf.h5")


def complaint(words, capsys):
    assert main(words) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.count("\n") == 1
    return said.err


@pytest.mark.parametrize("suffix", ["ply", "obj", "glb", "gltf"])
def test_a_solid_of_no_vein(leaf, capsys, suffix):
    said = complaint(["export", leaf, "-o", f"a.{suffix}", "--step", "0"], capsys)
    assert said == f"{leaf}: there is no vein at step 0 to make a solid of\n"
    assert not Path(f"a.{suffix}").exists()


def test_cells_larger_than_the_blade(leaf, capsys):
    said = complaint(["export", leaf, "-o", "a.toml", "--cell", "1e9"], capsys)
    assert "cells of 1e+09 D: the blade is smaller than a cell" in said


@pytest.mark.parametrize("suite", ["transitions", "leaf"])
def test_suites_refuse_a_suffix_before_they_run(monkeypatch, capsys, tmp_path, suite):
    monkeypatch.setattr("vasc.cli.validate._suites", lambda n: pytest.fail("ran"))
    said = complaint(["validate", suite, "-o", str(tmp_path / "x.json")], capsys)
    assert "x.json: suffix '.json' is not one of .png, .svg, .pdf" in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ["stats", "RUN", "--step", "3", "--step", "4"],
            "--step is given 2 times",
        ),
        (
            ["render", "RUN", "-o", "a.png", "--color", "age", "--births"],
            "--color is not for --births",
        ),
        (
            ["render", "RUN", "-o", "a.png", "--color", "age", "--genealogy"],
            "--color is not for --genealogy",
        ),
        (
            ["render", "RUN", "-o", "a.png", "--sources", "--growth"],
            "--sources is not for --growth",
        ),
    ],
)
def test_options_that_would_be_ignored(leaf, capsys, words, said):
    words = [leaf if word == "RUN" else word for word in words]
    assert said in complaint(words, capsys)
    assert not Path("a.png").exists()


def test_steps_of_networks(leaf, capsys):
    assert main(["export", leaf, "-o", "a.graphml"]) == 0
    capsys.readouterr()
    said = complaint(["compare", "a.graphml", "a.graphml", "--step", "3"], capsys)
    assert "--step 3: neither a.graphml nor a.graphml is a run" in said


@pytest.mark.parametrize("suffix", ["graphml", "toml", "png"])
def test_a_place_that_takes_no_file_is_named(leaf, capsys, monkeypatch, suffix):
    def refuse(*_, **__):
        raise OSError(30, "Read-only file system", ".a.temporary.new")

    monkeypatch.setattr(Path, "write_bytes", refuse)
    monkeypatch.setattr("os.fsync", refuse)
    verb = "render" if suffix == "png" else "export"
    said = complaint([verb, leaf, "-o", f"a.{suffix}"], capsys)
    assert said == f"a.{suffix}: cannot be written: Read-only file system\n"


@pytest.mark.parametrize(
    "words",
    [
        ["stats"],
        ["events"],
        ["lineage", "--fates"],
        ["lineage", "--life-table"],
        ["lineage", "--births"],
        ["lineage", "--node", "0"],
        ["lineage", "--competitors", "0"],
        ["export", "-o", "a.csv"],
        ["export", "-o", "a.ply"],
        ["render", "-o", "a.png"],
        ["render", "-o", "a.png", "--growth"],
    ],
)
def test_a_run_without_a_step_is_told_alike(leaf, capsys, tmp_path, words):
    path = tmp_path / "none.h5"
    path.write_bytes(Path(leaf).read_bytes())
    with h5py.File(path, "r+") as file:
        file["committed"][0] = file["complete"][0] = 0
    said = complaint([words[0], str(path), *words[1:]], capsys)
    assert said == f"{path}: no step is recorded yet\n"


def test_a_closed_output_is_no_error(leaf):
    command = f"{sys.executable} -m vasc lineage {leaf} --fates --csv >&-"
    done = subprocess.run(["sh", "-c", command], stderr=subprocess.PIPE, cwd=ROOT, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
