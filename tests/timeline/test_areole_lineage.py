"""The genealogy of areoles, in a real leaf until its first loops are split."""

import json

import pytest

from vasc.cli import main
from vasc.config import load
from vasc.errors import TimelineError
from vasc.experiment import run
from vasc.timeline import Timeline

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
