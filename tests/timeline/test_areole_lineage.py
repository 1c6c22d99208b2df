"""The genealogy of areoles, in a real leaf until its first loops are split."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
from reference.networks import network

from vasc.cli import main
from vasc.config import load
from vasc.errors import TimelineError
from vasc.experiment import run
from vasc.timeline import Timeline
from vasc.timeline.place_history import history_at

STEPS = 240


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """The first leaf of Arabidopsis, recorded until its first loops are split."""
    path = tmp_path_factory.mktemp("leaf") / "leaf.h5"
    run(load("arabidopsis-first-leaf"), path, steps=STEPS)
    return path


@pytest.fixture(scope="module")
def timeline(path):
    with Timeline(path) as timeline:
        yield timeline


def test_every_areole_has_one_place_in_the_genealogy(timeline):
    fates = [timeline.lineage.areole(row) for row in range(timeline.n_rows("areoles"))]
    assert len(fates) > 8
    for fate in fates:
        assert (fate.split >= 0) == (len(fate.children) == 2)
        for child in fate.children:
            assert fates[child].parent == fate.areole
            assert fates[child].birth == fate.split
            assert fates[child].ancestors == (fate.areole, *fate.ancestors)
    whole = {fate.areole for fate in fates if fate.split < 0}
    assert whole == set(timeline.frame(STEPS).areoles.ids.tolist())


def test_a_source_splits_the_areole_that_encloses_it(timeline):
    # the first loops are areoles 0 and 1; a source appears in each, and is drained before the split
    for areole in (0, 1):
        fate = timeline.lineage.areole(areole)
        assert fate.parent == -1
        assert len(fate.sources) == 1
        assert fate.birth < fate.drained[0] < fate.split
        (source,) = fate.sources.tolist()
        joined = timeline.lineage.fate_of(source).joins.tolist()
        assert {timeline.lineage.areole(child).segment for child in fate.children} <= set(joined)


def test_areas_of_the_parts_add_up_to_the_whole(timeline):
    areas = timeline.areole_areas()
    fate = timeline.lineage.areole(0)

    def area(areole, step):
        rows = (areas["areole"] == areole) & (areas["step"] == step)
        return float(areas["area"][rows].sum())

    # a part may be split again in the same step
    of_it = [
        a for a in range(timeline.n_rows("areoles")) if 0 in timeline.lineage.areole(a).ancestors
    ]
    parts = sum(area(descendant, fate.split) for descendant in of_it)
    # the boundary of the parent was recorded at its birth, and corners have been cut since
    assert parts == pytest.approx(area(0, fate.split - 1), rel=0.05)


def test_the_command_line_tells_it(path, capsys):
    assert main(["lineage", str(path), "--areole", "0", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["split"] == 230
    assert told["area_at_end"] > told["area_at_birth"]
    assert main(["lineage", str(path), "--areole", "999"]) == 2
    assert "there is no areole 999; ids are 0 to" in capsys.readouterr().err
    assert main(["lineage", str(path), "--areole", "0", "--node", "1"]) == 2


def test_a_run_without_areoles_says_so(tmp_path):
    run(load("arabidopsis-first-leaf"), tmp_path / "young.h5", steps=20)
    with (
        Timeline(tmp_path / "young.h5") as young,
        pytest.raises(TimelineError, match="there is no areole 0; the run has none"),
    ):
        young.lineage.areole(0)


def test_a_place_tells_its_vein_its_source_and_its_areoles(timeline):
    frame, lineage = timeline.frame(STEPS), timeline.lineage
    tree = lineage.genealogy(STEPS)
    child = lineage.areole(0).children[0]
    # beside the middle of a side of the areole, on its left, which is within
    ring = frame.positions[tree.boundaries[child]]
    a, b = ring[0], ring[1]
    along = b - a
    x, y = ((a + b) / 2.0 + 0.05 * np.array([-along[1], along[0]])).tolist()
    found = lineage.at(x, y, STEPS)
    assert found.distance == pytest.approx(0.05 * np.hypot(*along))
    assert found.areoles == (0, child)
    assert found.areole_births == (lineage.areole(0).birth, lineage.areole(child).birth)
    ends = timeline.table("segments", "nodes")[found.segment].tolist()
    assert sorted(ends) == sorted(tree.boundaries[child][:2].tolist())
    assert found.node == max(ends)
    assert found.vein == lineage.veins.firsts[found.node]
    row = frame.network.segment_ids.tolist().index(found.segment)
    assert found.source == frame.network.growths.causes[row] >= 0
    assert found.vein_birth <= found.grown == frame.network.vein_births[row]
    assert found.source_birth == lineage.fate_of(found.source).birth
    # before the split the parent was there
    assert lineage.at(*young_place(timeline, 0)).areoles == (0,)


def young_place(timeline, areole):
    """A place in the middle of an areole a step before it is split, and that step."""
    step = timeline.lineage.areole(areole).split - 1
    frame = timeline.frame(step)
    areoles = frame.areoles
    ring = dict(zip(areoles.ids.tolist(), areoles.boundaries, strict=True))[areole]
    return (*frame.positions[ring].mean(axis=0).tolist(), step)


def test_a_place_on_open_tissue_is_in_no_areole_and_one_off_the_blade_is_refused(timeline):
    high = timeline.frame(STEPS).blade.bounds[3]
    found = timeline.lineage.at(0.0, high - 0.5)
    assert (found.areole, found.areoles) == (-1, ())
    with pytest.raises(TimelineError, match=r"the place 500,0 is off the blade, \d+\.?\d* D from"):
        timeline.lineage.at(500.0, 0.0)
    with pytest.raises(TimelineError, match="step 9999 is not recorded"):
        timeline.lineage.at(0.0, 1.0, 9999)


def test_without_a_vein_nothing_is_near():
    class Bare:
        path, dimensions = "bare.h5", 2

        def n_rows(self, table):
            return 0

        def frame(self, step=-1):
            return SimpleNamespace(
                step=0, network=network([(0, 0)], []), positions=np.zeros((1, 2))
            )

    with pytest.raises(TimelineError, match="there is no vein at step 0"):
        history_at(Bare(), Bare().frame(), None, {}, (0.0, 0.0))


def test_the_command_line_tells_a_place(path, capsys):
    assert main(["lineage", str(path), "--at", "-3,20", "--step", "230", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    with Timeline(path) as timeline:
        found = timeline.lineage.at(-3.0, 20.0, 230)
    assert (told["segment"], told["vein"], told["step"]) == (found.segment, found.vein, 230)
    assert told["areoles"] == list(found.areoles)
    assert main(["lineage", str(path), "--at", "900,1"]) == 2
    assert "off the blade" in capsys.readouterr().err
