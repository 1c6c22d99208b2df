"""The files that a config refers to are never written over, even with --force."""

import os

import pytest

from vasc.cli import main
from vasc.config import load
from vasc.errors import OutputError
from vasc.experiment import run

DRAWN = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M 0 40 L 14 20 L 0 0 L -14 20 Z"/></svg>'
CONFIG = """kind = "open"

[domain]
file = "scan.svg"
length = 20.0

[placement]
kind = "darts"
density = 0.05
birth_distance_sources = 5.0
birth_distance_veins = 5.0

[arrival]
kill_distance = 1.0
"""


@pytest.fixture
def drawn(tmp_path, monkeypatch):
    """Work in a folder with a config, the outline it names, and a run of it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scan.toml").write_text(CONFIG)
    (tmp_path / "scan.svg").write_text(DRAWN)
    assert main(["run", "scan.toml", "-q", "--steps", "2", "--no-figure"]) == 0
    return tmp_path


@pytest.mark.parametrize(
    ("arguments", "hint"),
    [
        (["run", "scan.toml", "--steps", "2", "--figure", "scan.svg"], "--figure, or --no-figure"),
        (["run", "scan.toml", "--steps", "2", "--no-figure", "-o", "scan.svg"], "--output"),
        (["render", "scan.h5", "-o", "scan.svg"], "--output"),
        (["render", "scan.h5", "-o", "copy.svg"], "--output"),
        (["render", "scan.h5", "-o", "elsewhere/scan.svg"], "--output"),
        (["validate", "leaf", "scan.h5", "-o", "scan.svg"], "--output"),
        (["export", "scan.h5", "-o", "scan.svg"], "--output"),
    ],
)
def test_a_file_that_the_config_refers_to_is_refused(drawn, capsys, arguments, hint):
    (drawn / "copy.svg").write_text(DRAWN)
    (drawn / "elsewhere").mkdir()
    (drawn / "elsewhere" / "scan.svg").write_text(DRAWN + "\n")
    before = {path: path.read_bytes() for path in drawn.rglob("*") if path.is_file()}
    assert main([*arguments, "--force"]) == 2
    said = capsys.readouterr().err
    assert 'is the file of domain.file = "scan.svg", and is never replaced' in said
    assert hint in said
    assert said.count("\n") == 1
    assert {path: path.read_bytes() for path in drawn.rglob("*") if path.is_file()} == before


@pytest.mark.parametrize(
    "arguments",
    [
        ["run", "scan.toml", "--steps", "2", "--no-figure", "-o"],
        ["run", "scan.toml", "--steps", "2", "-o", "other.h5", "--figure"],
        ["render", "scan.h5", "-o"],
        ["animate", "scan.h5", "-o"],
        ["export", "scan.h5", "-o"],
    ],
)
def test_what_is_no_file_is_not_replaced_by_one(drawn, capsys, arguments):
    suffix = {"run": ".png", "export": ".wkt", "animate": ".gif"}.get(arguments[0], ".svg")
    for name, make in (("pipe", os.mkfifo), ("link", lambda path: path.symlink_to("nothing"))):
        path = drawn / f"{name}{suffix}"
        make(path)
        before = path.lstat()
        assert main([*arguments, path.name, "--force"]) == 2
        assert "is a device, a pipe or a link to nothing" in capsys.readouterr().err
        assert path.lstat() == before


def test_resume_does_not_draw_over_it(drawn, capsys):
    assert main(["resume", "scan.h5", "--figure", "scan.svg", "--force"]) == 2
    assert "is never replaced; choose another name with --figure" in capsys.readouterr().err
    assert (drawn / "scan.svg").read_text() == DRAWN


def test_python_refuses_it_too(drawn):
    with pytest.raises(OutputError, match=r"scan\.svg: is the file of domain\.file"):
        run(load(drawn / "scan.toml"), drawn / "scan.svg", force=True, steps=1)
    assert (drawn / "scan.svg").read_text() == DRAWN


def test_other_pictures_are_replaced_as_ever(drawn):
    (drawn / "other.svg").write_text("an older picture")
    assert main(["render", "scan.h5", "-o", "other.svg", "--force"]) == 0
    assert (drawn / "other.svg").read_text() != "an older picture"
