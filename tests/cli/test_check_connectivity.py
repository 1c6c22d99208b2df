"""``vasc check connectivity``: what it prints, draws and ends with, on stems given as arrays."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
import typer
from reference.stem_veins import laid_out

from vasc.cli.check import connectivity
from vasc.errors import ShapeError, TimelineError, VascError
from vasc.network import Origin
from vasc.validation.stem_phyllotaxis import StemGraph, reading


class StemRecord:
    """What is read of a timeline, from arrays."""

    path = Path("stem.h5")

    def __init__(self, veins, **config):
        positions, segments, primordia, ring = veins
        origins = np.full(len(positions), Origin.EXTENSION)
        origins[primordia], origins[ring] = Origin.PRIMORDIUM, Origin.SEED
        self.columns = {
            ("nodes", "position"): positions,
            ("nodes", "origin"): origins,
            ("segments", "nodes"): segments,
        }
        self.config = config

    def table(self, name, column):
        """Give a column."""
        return self.columns[name, column]


PARTS = {"domain": {"radius": 50.0}, "placement": {"divergence": 137.5, "rise": 10.0}}


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


def test_a_stem_is_read(recorded):
    graph = reading.read_stem(StemRecord(veins((3, 5)), **PARTS))
    assert len(graph.primordia) == 40
    assert graph.lattice.ratio == 5.0
    assert graph.per_level == 1
    np.testing.assert_array_equal(graph.ring, np.arange(len(graph.ring)))
    assert math.degrees(graph.divergence) == pytest.approx(137.5)


def test_what_is_no_stem_is_refused(recorded):
    with pytest.raises(VascError, match=r"leaf.h5: the run has no primordia"):
        connectivity(recorded / "leaf.h5")
    with pytest.raises(VascError, match=r"no placement\.divergence"):
        reading.read_stem(StemRecord(veins((3, 5)), domain={"radius": 50.0}))
    with pytest.raises(VascError, match=r"no domain\.radius"):
        reading.read_stem(StemRecord(veins((3, 5)), placement=PARTS["placement"]))
    flat = StemRecord(veins((3, 5)), **PARTS)
    flat.columns["nodes", "position"] = flat.columns["nodes", "position"][:, :2]
    with pytest.raises(ShapeError, match="positions"):
        reading.read_stem(flat)
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
