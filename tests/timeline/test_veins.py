"""Veins, their orders and births, competition and fates, against twins that go row by row."""

import subprocess
import sys

import numpy as np
import pytest
from reference import lineages
from timeline import canals
from timeline.subjects import SUBJECTS
from timeline.synthetic import ExplicitRun, StemRun, SyntheticRun, TissueRun, record

from vasc.config import load
from vasc.errors import TimelineError, VascError
from vasc.experiment import run
from vasc.timeline import Fate, Timeline
from vasc.timeline.access import OpenFile
from vasc.timeline.lineage import LINEAGE_TABLES
from vasc.timeline.moving import positions_at

MODELS = {
    "closed": ("param-kill-distance-e", 160),
    "open": ("sweetgum-leaf", 100),
    "areole": ("arabidopsis-first-leaf", 240),
    "stem": ("stem-golden-1-2", 60),
    "closed-refined": ("arabidopsis-closed", 150),
}


@pytest.fixture(scope="module", params=MODELS)
def timeline(request, tmp_path_factory):
    """A run of each model, and one of the closed model in which veins are refined."""
    name, steps = MODELS[request.param]
    path = tmp_path_factory.mktemp(request.param) / "run.h5"
    run(load(name), path, steps=steps)
    with Timeline(path) as opened:
        yield opened


def test_orders_are_those_of_going_node_by_node(timeline):
    firsts, orders = lineages.veins(timeline)
    assert timeline.lineage.veins.firsts.tolist() == firsts
    assert timeline.lineage.veins.orders.tolist() == orders


def test_births_are_what_the_frames_say(timeline):
    table = timeline.lineage.births()
    names = ("step", "vein", "branching_order", "origin", "height", "nodes")
    found = list(zip(*(table[name].tolist() for name in names), strict=True))
    for mine, expected in zip(found, lineages.births(timeline), strict=True):
        assert mine[:4] == expected[:4]
        assert mine[4] == pytest.approx(expected[4], abs=1e-9)
        assert mine[5] == expected[5]
    assert table["time"].tolist() == timeline.frames["time"][table["step"]].tolist()


def test_orders_may_come_from_elsewhere(timeline):
    n_nodes = timeline.n_rows("nodes")
    table = timeline.lineage.births(np.full(n_nodes, 7))
    assert set(table["order"].tolist()) == {7}
    for bad in (np.zeros(3, dtype=int), np.zeros(n_nodes)):
        with pytest.raises(TimelineError, match=rf"integers of shape \({n_nodes},\), one a node"):
            timeline.lineage.births(bad)


def test_a_vein_has_the_lowest_order_that_is_known_of_its_nodes(timeline):
    firsts = timeline.lineage.veins.firsts
    orders = np.arange(len(firsts)) % 3 - 1
    table = timeline.lineage.births(orders)
    assert {-1, 0, 1} >= set(table["order"].tolist())
    for vein, order in zip(table["vein"].tolist(), table["order"].tolist(), strict=True):
        known = orders[(firsts == vein) & (orders >= 0)]
        assert order == (known.min() if len(known) else -1)


def test_births_by_order_count_every_vein_once(timeline):
    births = timeline.lineage.births()
    table = timeline.lineage.table("births_by_order")
    assert table["veins"].sum() == len(births["vein"])
    for order, first, median in zip(
        table["branching_order"], table["first"], table["median"], strict=True
    ):
        steps = births["step"][births["branching_order"] == order]
        assert (first, median) == (min(steps), np.median(steps))


def test_competitors_are_what_perceived_says(timeline):
    if timeline.dimensions == 3:
        with pytest.raises(TimelineError, match="does not hold which nodes sources attract"):
            timeline.lineage.competitors()
        return
    every = timeline.lineage.competitors()
    for source in range(0, timeline.n_rows("sources"), 7):
        table = timeline.lineage.competitors(source)
        rows = zip(
            *(
                table[name].tolist()
                for name in ("first_recorded", "last_recorded", "nodes_recorded")
            ),
            strict=True,
        )
        found = dict(zip(table["vein"].tolist(), rows, strict=True))
        assert found == lineages.competitors(timeline, source)
        is_its = every["source"] == source
        assert all(np.array_equal(every[name][is_its], table[name]) for name in table)
    with pytest.raises(TimelineError, match="there is no source -1"):
        timeline.lineage.competitors(-1)


def test_a_source_that_is_removed_was_reached_by_a_competitor(timeline):
    if timeline.dimensions == 3:
        return
    table, fates = timeline.lineage.competitors(), timeline.lineage.fates
    removed = set(np.flatnonzero(fates["removed"] >= 0).tolist())
    assert removed
    assert removed <= set(table["source"][table["reached"]].tolist())
    # whoever lives and is not awaited has been reached by nobody
    alive = np.flatnonzero((fates["removed"] < 0) & (fates["tagged"] < 0))
    assert not set(alive.tolist()) & set(table["source"][table["reached"]].tolist())


def test_the_table_of_fates_agrees_with_single_fates(timeline):
    table = timeline.lineage.table("fates")
    for source in range(0, timeline.n_rows("sources"), 5):
        fate = timeline.lineage.fate_of(source)
        assert table["joins"][source] == len(fate.joins)
        assert table["nodes"][source] == len(fate.nodes)
        assert (table["fate"][source] == Fate.JOINED) == (len(fate.joins) > 0)
        if fate.removed < 0 and not len(fate.joins):
            assert table["fate"][source] == (Fate.ALIVE if fate.tagged < 0 else Fate.TAGGED)


def test_tables_are_data_frames_too(timeline):
    for name in LINEAGE_TABLES:
        if timeline.dimensions == 3 and name in ("areoles", "competitors"):
            continue
        columns, frame = timeline.lineage.table(name), timeline.lineage.to_pandas(name)
        assert [frame.index.name, *frame.columns] == list(columns)
        assert len(frame) == len(next(iter(columns.values())))
    assert set(timeline.lineage.to_pandas("fates")["fate"]) <= {f.name.lower() for f in Fate}


def test_without_pandas_numbers_stay_and_the_message_names_the_extra(timeline, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    assert len(timeline.lineage.table("fates")["source"])
    with pytest.raises(VascError, match=r'pip install "vasc\[tables\]"'):
        timeline.lineage.to_pandas("fates")


def test_a_table_that_is_not_there_is_refused(timeline):
    with pytest.raises(TimelineError, match="no table 'deaths' of lineage; tables are areoles, "):
        timeline.lineage.table("deaths")


@pytest.mark.parametrize("kind", [SyntheticRun, ExplicitRun, StemRun])
def test_single_positions_are_those_of_whole_frames(kind, tmp_path):
    record(tmp_path / "run.h5", 40, kind=kind)
    with Timeline(tmp_path / "run.h5") as opened:
        births = opened.table("nodes", "birth")
        nodes = np.arange(0, len(births), 3, dtype=np.int32)
        steps = np.minimum(births[nodes] + nodes % 5, 40).astype(np.int32)
        found = positions_at(opened, nodes, steps)
        expected = [opened.positions(int(s))[n] for n, s in zip(nodes, steps, strict=True)]
        assert found == pytest.approx(np.array(expected), abs=1e-12)
        assert positions_at(opened, nodes[:0], steps[:0]).shape == (0, opened.dimensions)


@pytest.mark.parametrize("subject", SUBJECTS, ids=lambda subject: subject.name)
def test_lineage_of_a_run_that_is_being_written_is_that_of_a_run_that_ended_there(
    subject, tmp_path
):
    path = tmp_path / "run.h5"
    child = subject.start(path, "record")
    seen = {}
    while child.poll() is None and len(seen) < 4:
        if not path.exists() or subject.last_observed(path) < 5:
            continue
        with Timeline(path) as live:
            if live.n_frames > 2:
                seen[live.last_step] = answers(live)
    _, errors = child.communicate()
    assert child.returncode == 0, errors.decode()
    assert len(seen) >= 2
    for step, found in seen.items():
        ended = tmp_path / f"{step}.h5"
        record_as(subject, ended, step)
        with Timeline(ended) as timeline:
            expected = answers(timeline)
        assert found.keys() == expected.keys()
        for name, columns in found.items():
            for column, values in columns.items():
                assert np.array_equal(values, expected[name][column], equal_nan=True), (
                    name,
                    column,
                )


def record_as(subject, path, last_step):
    """Record what a subject records, to an earlier end."""
    if subject.name == "canals":
        canals.record(path, "polar", steps=last_step)
        return
    kinds = {"explicit": ExplicitRun, "stem": StemRun, "tissue": TissueRun}
    kind = kinds.get(subject.name, SyntheticRun)
    record(path, last_step + 1, stop_after=last_step, kind=kind)


def answers(timeline):
    """Ask for every table, and for the descent of some nodes."""
    lineage = timeline.lineage
    names = [name for name in LINEAGE_TABLES if name != "areoles"]
    found = {name: lineage.table(name) for name in names}
    last = timeline.n_rows("nodes") - 1
    found["descent"] = {"up": lineage.ancestors(last), "down": lineage.descendants(0)}
    return found


def test_lineage_loads_neither_pandas_nor_numba(tmp_path):
    """Opened and answered at once: what takes long to load is not needed."""
    record(tmp_path / "run.h5", 20)
    program = f"""
import sys
from vasc.timeline import Timeline
with Timeline({str(tmp_path / "run.h5")!r}) as timeline:
    for name in ("fates", "births", "life_table", "competitors"):
        timeline.lineage.table(name)
print(*sorted({{"pandas", "numba", "matplotlib"}} & set(sys.modules)))
"""
    said = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert said.stdout.strip() == ""


READS = {
    "ancestors": {"nodes/parent"},
    "descendants": {"nodes/parent"},
    "source_of": {"nodes/source"},
    "life_table": {"sources/birth", *(f"events/{name}" for name in ("kind", "object", "step"))},
}


def test_a_question_reads_what_it_needs_and_no_more(tmp_path, monkeypatch):
    record(tmp_path / "run.h5", 200, kind=ExplicitRun)
    with Timeline(tmp_path / "run.h5") as timeline:
        n_positions = timeline.n_places["nodes"]
        n_veins = len(timeline.lineage.births()["vein"])
    read = {}

    def watched(opened, name, start, stop, out=None):
        read[name] = read.get(name, 0) + stop - start
        return original(opened, name, start, stop, out)

    original = OpenFile.read
    monkeypatch.setattr(OpenFile, "read", watched)
    with Timeline(tmp_path / "run.h5") as timeline:
        # opened: nothing but the header
        assert read == {}
        for question, columns in READS.items():
            read.clear()
            arguments = () if question == "life_table" else (400,)
            getattr(Timeline(tmp_path / "run.h5").lineage, question)(*arguments)
            assert set(read) - {"events/subject"} == columns
        read.clear()
        timeline.lineage.births()
    # at each step, the rows between the first and the last vein born then, and the base
    births = n_veins + 200
    assert read["motion/nodes"] <= births + 5 * 200 < n_positions / 50
    assert "motion/sources" not in read
    assert "perceived/node" not in read
