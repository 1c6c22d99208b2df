import re

import h5py
import numpy as np
import pytest
from timeline.synthetic import record

from vasc.errors import TimelineError
from vasc.events import EventKind
from vasc.timeline import Timeline, validate


@pytest.fixture(scope="module")
def timeline(tmp_path_factory):
    path = tmp_path_factory.mktemp("lineage") / "run.h5"
    record(path, 60)
    with Timeline(path) as opened:
        yield opened


def climb(parents, node):
    found = []
    while parents[node] != -1:
        node = int(parents[node])
        found.append(node)
    return found


def test_ancestors_run_from_the_parent_to_the_seed(timeline):
    parents = timeline.table("nodes", "parent")
    for node in range(0, len(parents), 7):
        assert timeline.lineage.ancestors(node).tolist() == climb(parents, node)


def test_descendants_are_those_whose_ancestors_hold_the_node(timeline):
    parents = timeline.table("nodes", "parent")
    for node in range(0, len(parents), 11):
        expected = [other for other in range(len(parents)) if node in climb(parents, other)]
        assert timeline.lineage.descendants(node).tolist() == expected


def test_a_source_knows_its_nodes_and_a_node_its_source(timeline):
    lineage = timeline.lineage
    for source in range(0, timeline.n_rows("sources"), 5):
        nodes = lineage.nodes_of(source)
        assert all(lineage.source_of(int(node)) == source for node in nodes)
    assert lineage.source_of(0) == -1


def test_fates_are_what_the_events_say(timeline):
    events = list(zip(*(timeline.events[name].tolist() for name in timeline.events), strict=True))
    for source in range(timeline.n_rows("sources")):
        fate = timeline.lineage.fate_of(source)
        mine = [event for event in events if event[2] == source]
        tagged = [step for step, kind, *_ in mine if kind == EventKind.SOURCE_TAGGED]
        ends = [(step, node) for step, kind, _, node in mine if kind == EventKind.SOURCE_REMOVED]
        joins = [
            segment
            for _, kind, segment, other in events
            if kind == EventKind.VEIN_JOINED and other == source
        ]
        assert fate.birth == timeline.table("sources", "birth")[source]
        assert fate.tagged == (tagged[0] if tagged else -1)
        assert (fate.removed, fate.nearest) == (ends[0] if ends else (-1, -1))
        assert fate.joins.tolist() == joins
        assert np.array_equal(fate.nodes, timeline.lineage.nodes_of(source))


def test_the_life_table_counts_every_source_once(timeline):
    lineage = timeline.lineage
    table, fates = lineage.life_table(), lineage.fates
    n_sources = timeline.n_rows("sources")
    assert table["at_risk"][0] == n_sources
    assert table["deaths"].sum() + table["censored"].sum() == n_sources
    ages = [
        (death if death != -1 else timeline.last_step) - birth
        for birth, death in zip(fates["birth"], fates["removed"], strict=True)
    ]
    assert table["at_risk"].tolist() == [sum(a >= k for a in ages) for k in table["age"]]
    share = 1.0
    for risk, deaths, survival in zip(
        table["at_risk"], table["deaths"], table["survival"], strict=True
    ):
        share *= 1.0 - deaths / risk
        assert survival == pytest.approx(share, abs=1e-12)


def test_the_life_table_of_no_sources_is_empty(tmp_path):
    record(tmp_path / "run.h5", 0)
    with Timeline(tmp_path / "run.h5") as opened:
        assert all(len(column) == 0 for column in opened.lineage.life_table().values())


@pytest.mark.parametrize("damage", [{50: -7}, {50: 50}, {50: 10**8}, {50: 51, 51: 52, 52: 50}])
def test_damaged_parents_are_refused_wherever_they_are_read(tmp_path, damage):
    path = tmp_path / "run.h5"
    record(path, 60)
    with h5py.File(path, "r+") as file:
        for row, parent in damage.items():
            file["nodes/parent"][row] = parent
    said = re.escape(f"{path}: damaged: nodes/parent of row 50 is {damage[50]}; it must be an ")
    for ask in (
        lambda timeline: timeline.lineage.table("births"),
        lambda timeline: timeline.lineage.ancestors(60),
        lambda timeline: timeline.lineage.competitors(1),
        lambda timeline: timeline.frame().network,
        lambda timeline: timeline.tables(),
    ):
        with Timeline(path) as timeline:
            # as in a file without checksums
            timeline.opened.trust()
            with pytest.raises(TimelineError, match=said):
                ask(timeline)
    assert any("nodes/parent: row 50" in finding for finding in validate(path))
