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


def veins(pair, n_primordia=40):
    """Lay out a stem of R = 50 whose primordia have the pair."""
    steps = [[m + step for step in pair] for m in range(n_primordia)]
    return laid_out(137.5, 50.0, 10.0, steps)


@pytest.fixture
def read(monkeypatch, recorded):
    """Let the command read a stem of some pair from a file that holds a leaf."""

    def reads(pair):
        graph = StemGraph(*veins(pair), math.radians(137.5), 10.0, 50.0)
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
    for words in ("(3, 5); on the surface", "judged: 11 to 27", "1.000 of those", "pass; asked"):
        assert words in text
    assert "exceptions" not in text


def test_another_pair_ends_with_one(read, capsys):
    with pytest.raises(typer.Exit) as ended:
        connectivity(read((2, 3)), as_json=True)
    assert ended.value.exit_code == 1
    found = json.loads(capsys.readouterr().out)
    assert (found["pair"], found["predicted"], found["pass"]) == ([2, 3], [3, 5], False)
    assert found["files"] == []
