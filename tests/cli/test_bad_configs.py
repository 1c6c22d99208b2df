"""A wrong config ends `vasc run` with lines and exit code 2, and leaves nothing behind."""

import os
from pathlib import Path

import pytest
from config.wrong_configs import WRONG, config, tissue_config

from vasc.cli import main


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    """Work in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refused(arguments, capsys):
    """Give the lines of a run that is refused before anything is made."""
    assert main(arguments) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert "Traceback" not in said.err
    lines = said.err.splitlines()
    assert lines
    return lines


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_config_is_refused(case, here, capsys):
    text, *parts = WRONG[case]
    (here / "leaf.toml").write_text(text)
    lines = refused(["run", "leaf.toml"], capsys)
    assert len([line for line in lines if all(part in line for part in parts)]) == 1, lines
    assert [line for line in lines if not line.startswith("leaf.toml: ")] == []
    assert [path.name for path in here.iterdir()] == ["leaf.toml"]


@pytest.mark.parametrize(
    ("spoilt", "part"),
    [
        ({"placement": 'kind = "given"\npoints = [[500.0, 5.0]]'}, "(500, 5) lies outside"),
        (
            {"domain": "points = [[-1, 0], [1, 2], [1, 0], [-1, 2]]\nlength = 20.0"},
            "cross",
        ),
        (
            {"domain": 'shape = "ovate"\nlength = 20.0\nseeds = [[5.0, 5.0]]'},
            "seed",
        ),
    ],
    ids=["source outside", "outline crosses itself", "seed outside"],
)
def test_what_only_geometry_can_tell_is_refused_too(spoilt, part, here, capsys):
    (here / "leaf.toml").write_text(config(**spoilt))
    (line,) = refused(["run", "leaf.toml"], capsys)
    assert line.startswith("leaf.toml: ")
    assert part in line
    assert [path.name for path in here.iterdir()] == ["leaf.toml"]


LONG = 'blade = { shape = "ovate", length = 3000.0 }'
THIN = "[[0, 0], [1, 1.0], [1.0001, 1.0], [0.0001, 0]]"
APART = """blade = { points = [[0, 0], [10, 0], [10, 4.4], [20, 4.4], [20, 0], [30, 0], [30, 10],
 [20, 10], [20, 4.45], [10, 4.45], [10, 10], [0, 10]], length = 10.0 }"""


@pytest.mark.parametrize(
    ("spoilt", "parts"),
    [
        (
            {"placement": "points = [[5.0, 2.0], [50.0, 2.0]]"},
            [
                "placement.points[1] = [50, 2]",
                "outside the tissue",
                "(-0.5, -0.5) and (20.5, 10.5)",
            ],
        ),
        (
            {"placement": "points = [[10.1, 9.9]]"},
            ["placement.points[0] = [10.1, 9.9]", "in a cell of a vein"],
        ),
        (
            {"placement": "points = [[5.0, 2.0], [6.0, 2.0], [5.1, 2.0]]"},
            ["placement.points[2] = [5.1, 2]", "two sources lie in one cell", "[5, 2]"],
        ),
        (
            {"veins": "lines = [[[1.0, 1.0]], [[10.0, 10.0], [10.0, 20.0]]]"},
            ["veins.lines[1]", "outside the tissue at (10, 11.25)", "(20.5, 10.5)"],
        ),
        (
            {"veins": "lines = [[[1.0, 1.0], [1e300, 10.0]]]"},
            ["veins.lines[0]", "outside the tissue at (1e+300, 10)"],
        ),
        (
            {"domain": f"blade = {{ points = {THIN}, length = 2e4 }}"},
            ["domain.blade: fills one part in", "one in 100 at least"],
        ),
        ({"domain": LONG}, ["domain.blade.length = 3000", "at most 250,000"]),
        (
            {"domain": 'blade = { shape = "ovate", length = 0.5 }'},
            ["domain.blade: has room for 0 cells", "at least 2"],
        ),
        ({"domain": APART}, ["domain.blade: falls apart: ", "share no wall"]),
        (
            {"domain": 'blade = { shape = "ovate", length = 9.0, seeds = [[5.0, 5.0]] }'},
            ["domain.blade.seeds[0]", "outside the outline"],
        ),
    ],
    ids=[
        *("source outside", "source in a vein", "two sources in a cell", "vein outside"),
        *("vein to far away", "thin"),
        *("too large", "too small", "apart", "seed outside"),
    ],
)
def test_what_only_a_tissue_can_tell_is_refused_too(spoilt, parts, here, capsys):
    (here / "tissue.toml").write_text(tissue_config(**spoilt))
    (line,) = refused(["run", "tissue.toml"], capsys)
    assert line.startswith("tissue.toml: ")
    assert [part for part in parts if part not in line] == []
    assert [path.name for path in here.iterdir()] == ["tissue.toml"]


def test_sources_of_a_tissue_are_read_from_a_file(here, capsys):
    text = tissue_config(placement='kind = "given"\nfile = "s.csv"')
    (here / "tissue.toml").write_text(text)
    for content, part in {
        "x,y,birth\n5,2,1\n7,2,3\n": 'placement.file = "s.csv": its births hold 3 but not 2',
        "x,y\n5,2\n5,oops\n": "line 3",
        "x,y\n5,2\n50,2\n": "placement.file: source [50, 2]: lies outside the tissue",
    }.items():
        (here / "s.csv").write_text(content)
        (line,) = refused(["run", "tissue.toml"], capsys)
        assert part in line


@pytest.mark.parametrize(
    ("content", "part"),
    [
        ("x,y\n0,5\n1,oops\n", "line 3"),
        ("x,y\n0,nan\n", "must be finite"),
        ("a,b\n0,5\n", "columns x, y"),
        ("", "holds no sources"),
    ],
)
def test_a_file_of_sources_is_read_before_anything_is_made(content, part, here, capsys):
    (here / "leaf.toml").write_text(config(placement='kind = "given"\nfile = "s.csv"'))
    (here / "s.csv").write_text(content)
    (line,) = refused(["run", "leaf.toml"], capsys)
    assert line.startswith("leaf.toml: ")
    assert part in line
    assert {path.name for path in here.iterdir()} == {"leaf.toml", "s.csv"}


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["none.toml"], ["none.toml", "no such file"]),
        (["poplar-lef"], ["nearest: poplar-leaf"]),
        (["."], ["is a folder"]),
        (["poplar-leaf", "--set", "seed"], ["--set seed", "KEY=VALUE"]),
        (["poplar-leaf", "--set", "seed.x=1"], ["seed is not a table"]),
        (["poplar-leaf", "--set", "growth.knd=none"], ["growth.knd", 'nearest: "kind"']),
        (["poplar-leaf", "--seed", "-1"], ["seed = -1", "at least 0"]),
        (["poplar-leaf", "--seed", "x"], ["--seed", "x"]),
        (["poplar-leaf", "--steps", "0"], ["'--steps'", " 0 "]),
        (["poplar-leaf", "--steps=-7"], ["'--steps'", " -7 "]),
        (["poplar-leaf", "--seed", "9" * 20_000], ["'--seed'", "999 ... 999"]),
        (["poplar-leaf", "--steps", "9" * 20_000], ["'--steps'", "999 ... 999"]),
        (["poplar-leaf", "--set", f"seed={'9' * 20_000}"], ["seed = ", "999 ... 999"]),
        (["poplar-leaf", "--set", "9" * 20_000], ["KEY=VALUE", "999 ... 999"]),
        (["poplar-leaf", "--set", f"{'.' * 20_000}=1"], ["is not a key", "... ..."]),
        (["poplar-leaf", "-o", "nowhere/p.h5"], ["nowhere", "does not exist"]),
        (["poplar-leaf", "-o", "."], ["is a folder"]),
        (["poplar-leaf", "-o", f"{'p' * 300}.h5"], ["ppp", "is not the name of a file"]),
        (["poplar-leaf", "--figure", f"{'p' * 300}.png"], ["ppp", "is not the name of a file"]),
        (["poplar-leaf", "--figure", "nowhere/p.png"], ["nowhere", "does not exist"]),
        (["poplar-leaf", "--figure", "p.bmp"], ["p.bmp", ".png, .svg, .pdf"]),
        (["poplar-leaf", "--figure", "p"], [".png, .svg, .pdf"]),
        (["poplar-leaf", "-o", "p.png"], ["p.png", "timeline and picture at once"]),
        (["poplar-leaf", "--figure", "p.png", "--no-figure"], ["exclude each other"]),
    ],
)
def test_wrong_arguments_are_refused(arguments, parts, here, capsys):
    (line,) = refused(["run", *arguments], capsys)
    assert [part for part in parts if part not in line] == []
    assert len(line) < 600
    assert list(here.iterdir()) == []


def test_a_file_that_exists_is_refused_before_the_run(here, capsys):
    (here / "poplar-leaf.h5").write_bytes(b"mine")
    (line,) = refused(["run", "poplar-leaf"], capsys)
    assert "poplar-leaf.h5: exists already; use --force" in line
    (here / "poplar-leaf.h5").rename(here / "poplar-leaf.png")
    (line,) = refused(["run", "poplar-leaf"], capsys)
    assert "poplar-leaf.png: exists already; use --force" in line
    assert [(path.name, path.read_bytes()) for path in here.iterdir()] == [
        ("poplar-leaf.png", b"mine")
    ]


def test_a_folder_that_is_read_only_is_refused_before_the_run(here, capsys, monkeypatch):
    (here / "mine").mkdir()
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path) != Path("mine"))
    for arguments in (["-o", "mine/p.h5"], ["--figure", "mine/p.png"]):
        (line,) = refused(["run", "poplar-leaf", *arguments], capsys)
        assert "the folder 'mine' cannot be written to" in line


def test_a_config_is_never_overwritten(here, capsys):
    (here / "leaf.toml").write_text(config())
    (here / "link.h5").symlink_to("leaf.toml")
    for output in ("leaf.toml", "link.h5"):
        (line,) = refused(["run", "leaf.toml", "-o", output, "--force", "--no-figure"], capsys)
        assert "config and timeline at once" in line
    assert (here / "leaf.toml").read_text() == config()
