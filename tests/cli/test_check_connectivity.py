"""``vasc check connectivity``: what it prints, draws and ends with, on stems given as arrays."""

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
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
        put(graph)
        return recorded / "leaf.h5"

    def put(graph):
        monkeypatch.setattr(reading, "read_stem", lambda timeline: graph)

    reads.put = put
    return reads


def said(capsys):
    return capsys.readouterr().out.splitlines()


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


def test_a_tie_is_undecided_and_no_success(read, capsys):
    # every second primordium is connected to the next one
    steps = [[m + 1, m + 2] if m % 2 else [m + 2] for m in range(40)]
    stem = laid_out(137.5, 16.0, 10.0, steps)
    path = read((1, 2))
    read.put(StemGraph(*stem, math.radians(137.5), 10.0, 16.0))
    connectivity(path)
    lines = capsys.readouterr().out.splitlines()
    connected = next(line for line in lines if line.startswith("connected"))
    assert connected.split(maxsplit=1)[1] == "(2); undecided, by a tie: (1)"
    assert lines[-1].endswith("leaf.h5: tied, (1) undecided; what is no tie is as predicted")
    assert "pass" not in "".join(lines)


def test_where_the_radius_changes_each_primordium_is_judged_by_its_own(read, capsys):
    # at R = 100 and H = 10 the pair is (5, 8)
    radii = np.where(np.arange(60) < 25, 50.0, 100.0)
    steps = [[m + 3, m + 5] if m < 25 else [m + 5, m + 8] for m in range(60)]
    path, stem = read((3, 5)), laid_out(137.5, 50.0, 10.0, steps)
    graph = StemGraph(*stem, math.radians(137.5), 10.0, 50.0, radii=radii)
    read.put(graph)
    connectivity(path)
    lines = dict(re.split(r"  +", line, maxsplit=1) for line in said(capsys) if "  " in line)
    assert lines["R along the stem"].startswith("50 to 100, R/H 5 to 10; ")
    assert lines["connected"] == "(3, 5) from 14 to 24; (5, 8) from 25 to 41"
    assert lines["predicted"] == lines["connected"]
    assert lines["as their own R/H predicts"] == "1.000 of those judged"
    read.put(replace(graph, radii=np.full(60, 50.0)))
    with pytest.raises(typer.Exit):
        connectivity(path, as_json=True)
    found = json.loads(capsys.readouterr().out)
    # as 50 D wants no 8, fewer primordia at the ends are left out: 11 to 47
    assert found["local_fraction"] == pytest.approx(14 / 37)
    assert found["exceptions"][0] == {
        "primordium": 25,
        "steps": [5, 8],
        "missing": [3],
        "extra": [8],
    }
    connectivity(read((3, 5)))
    assert "along the stem" not in capsys.readouterr().out


def test_another_pair_ends_with_one(read, capsys):
    with pytest.raises(typer.Exit) as ended:
        connectivity(read((2, 3)), as_json=True)
    assert ended.value.exit_code == 1
    found = json.loads(capsys.readouterr().out)
    assert (found["pair"], found["predicted"], found["pass"]) == ([2, 3], [3, 5], False)
    assert found["files"] == []
