"""``vasc check connectivity``: what it prints, draws and ends with, on stems given as arrays."""

import json
import math
from pathlib import Path

import pytest
import typer
from reference.stem_veins import laid_out

from vasc.cli.check import connectivity
from vasc.errors import TimelineError
from vasc.validation.stem_phyllotaxis import StemGraph, reading


def veins(pair, n_primordia=40, radius=50.0):
    """Lay out a stem whose primordia have the pair."""
    steps = [[m + step for step in pair] for m in range(n_primordia)]
    return laid_out(137.5, radius, 10.0, steps)


@pytest.fixture
def read(monkeypatch, recorded):
    """Let the command read a stem of some pair from a file that holds a leaf."""

    def reads(pair, radius=50.0, **options):
        stem = veins(pair, radius=radius)
        graph = StemGraph(*stem, math.radians(137.5), 10.0, radius, **options)
        monkeypatch.setattr(reading, "read_stem", lambda timeline: graph)
        return recorded / "leaf.h5"

    return reads


def test_what_is_no_stem_is_refused(recorded):
    with pytest.raises(TimelineError, match=r"leaf.h5: is no stem, but a run of the kind 'closed'"):
        connectivity(recorded / "leaf.h5")
    with pytest.raises(TimelineError):
        connectivity(Path("none.h5"))


def test_the_predicted_pair_passes(read, capsys, tmp_path):
    picture = tmp_path / "stem.png"
    connectivity(read((3, 5)), output=picture)
    text = capsys.readouterr().out
    assert picture.stat().st_size > 1000
    for words in (
        "predicted on the surface  (3, 5)",
        "judged: 11 to 27",
        "1.000 of those",
        "pass; asked",
    ):
        assert words in text
    assert "exceptions" not in text


def test_a_tie_is_undecided_and_no_success(read, capsys, monkeypatch):
    # every second primordium is connected to the next one
    steps = [[m + 1, m + 2] if m % 2 else [m + 2] for m in range(40)]
    stem = laid_out(137.5, 16.0, 10.0, steps)
    path = read((1, 2))
    graph = StemGraph(*stem, math.radians(137.5), 10.0, 16.0)
    monkeypatch.setattr(reading, "read_stem", lambda timeline: graph)
    connectivity(path)
    lines = capsys.readouterr().out.splitlines()
    connected = next(line for line in lines if line.startswith("connected"))
    assert connected.split(maxsplit=1)[1] == "(2); undecided, by a tie: (1)"
    assert lines[-1].endswith("leaf.h5: tied, (1) undecided; what is no tie is as predicted")
    assert "pass" not in "".join(lines)


def test_the_radius_that_is_judged_by_is_told_where_it_changes(read, capsys):
    connectivity(read((3, 5), radius_range=(40.0, 100.0)))
    text = capsys.readouterr().out
    assert "40 to 100, R/H 4 to 10; judged by that at the middle primordium" in text
    connectivity(read((3, 5)))
    assert "along the stem" not in capsys.readouterr().out


def test_another_pair_ends_with_one(read, capsys):
    with pytest.raises(typer.Exit) as ended:
        connectivity(read((2, 3)), as_json=True)
    assert ended.value.exit_code == 1
    found = json.loads(capsys.readouterr().out)
    assert (found["pair"], found["predicted"], found["pass"]) == ([2, 3], [3, 5], False)
    assert found["files"] == []
