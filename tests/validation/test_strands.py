"""Strands of recorded runs, read by the check and told by the command line."""

import json

import pytest

from vasc.cli import main
from vasc.config import load_text
from vasc.errors import ConfigError, TimelineError
from vasc.experiment import run
from vasc.timeline import Timeline
from vasc.validation.strands import check_strand

CANALS = """kind = "canalization"

[domain]
columns = 21
rows = 13

[veins]
lines = [[[3.0, 12.0]], [[17.0, 12.0]]]

[placement]
points = [[8.0, 4.0], [12.0, 5.0]]
rounds = [1, 2]

[transport]
kind = "facilitated"
"""
LEAF = """kind = "open"

[domain]
shape = "ovate"
length = 20.0

[placement]
kind = "given"
points = [[0.0, 10.0]]

[arrival]
kill_distance = 1.0
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A recorded run of two sources, one after the other."""
    path = tmp_path_factory.mktemp("canals") / "canals.h5"
    run(load_text(CANALS), path)
    return path


def test_a_strand_is_read_when_it_became_a_vein(path):
    with Timeline(path) as timeline:
        first, second = (check_strand(timeline, source) for source in (0, 1))
        newest = check_strand(timeline)
        network = timeline.frame(-1).network
    assert newest.source == 1
    assert first.step < second.step
    assert first.passed
    assert second.passed
    assert [len(one) for one in first.nodes] == [1, 1]
    assert first.end == 0
    assert first.strand.is_nearest(first.strand.reached)
    # the strand of the first source is a vein for the second, and its own is not
    assert [len(one) for one in second.nodes] == [len(first.strand.path), 1]
    births = network.births
    assert (births[second.nodes[0]] < second.step).all()
    # where the strand ends is where the vein that it became begins
    fresh = int((births < second.step).sum())
    assert network.parents[fresh] == second.end
    assert network.n_nodes - fresh == len(second.strand.path) - 1


def test_the_report_holds_what_scripts_rely_on(path):
    with Timeline(path) as timeline:
        report = check_strand(timeline, 0).as_json()
    wanted = {"source", "sinks", "reached", "nearest", "flux_share", "width", "tortuosity", "pass"}
    assert wanted | {"thresholds", "is_nearest", "is_nearest_by_cells"} <= set(report)
    assert (report["reached"], report["nearest"], report["pass"]) == (0, 0, True)
    assert report["sinks"][0]["nodes"] == [0]
    assert report["flux_share"] > 0.99
    assert sum(sink["flux_share"] for sink in report["sinks"]) == pytest.approx(1.0)
    assert report["thresholds"]["least_share"] == 0.1


def test_the_command_line_tells_the_strand(path, capsys):
    assert main(["check", "strand", str(path), "--source", "0"]) == 0
    shown = capsys.readouterr().out
    assert "reached, nearest, nearest over cells" in shown
    assert "canals.h5: pass" in shown
    assert main(["check", "strand", str(path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["source"] == 1


def test_a_strand_that_has_not_formed_yet_does_not_pass(path, capsys):
    assert main(["check", "strand", str(path), "--step", "3", "--json"]) == 1
    report = json.loads(capsys.readouterr().out)
    assert (report["source"], report["step"], report["formed"]) == (0, 3, False)
    assert report["width"] > 5.0


def test_sources_that_are_none_are_refused(path, capsys):
    assert main(["check", "strand", str(path), "--source", "2"]) == 2
    assert "must be one of those placed by step" in capsys.readouterr().err
    assert main(["check", "strand", str(path), "--step", "0"]) == 2
    assert "step 0: none" in capsys.readouterr().err


def test_a_leaf_without_cells_has_no_strands(tmp_path, capsys):
    path = tmp_path / "leaf.h5"
    run(load_text(LEAF), path)
    with Timeline(path) as timeline, pytest.raises(TimelineError, match="no tissue"):
        check_strand(timeline)
    assert main(["check", "strand", str(path)]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "'open'" in told


def test_a_model_without_canals_is_refused(tmp_path, path, monkeypatch):
    from vasc.models.transport import FacilitatedDiffusion

    monkeypatch.setattr(FacilitatedDiffusion, "activation", None)
    with Timeline(path) as timeline, pytest.raises(ConfigError, match="'canalization'"):
        check_strand(timeline)
