import subprocess
import sys

import numpy as np
import pytest
from timeline.synthetic import NAMES, SEED, SyntheticRun, blade, create, record

from vasc.errors import TimelineError, VascError
from vasc.state import TABLE_COLUMNS
from vasc.streams import Streams
from vasc.timeline import Timeline

LAST = 40


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A recorded run, and for every step what the simulation itself showed."""
    path = tmp_path_factory.mktemp("reader") / "run.h5"
    streams, shown = Streams(SEED, NAMES), []
    with create(path) as recorder:
        for state in SyntheticRun(LAST).states(streams):
            recorder.observe(state, streams)
            shown.append((state, state.network, state.sources, streams.state()))
    return path, shown


def test_every_frame_equals_the_state_it_was(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        for state, network, sources, words in shown:
            frame = timeline.frame(state.step)
            assert (frame.step, frame.time) == (state.step, state.time)
            assert np.array_equal(frame.motion, state.motion)
            assert np.array_equal(frame.outline_motion, state.outline_motion)
            for name in ("positions", "parents", "births", "origins", "causes", "segments"):
                assert np.array_equal(getattr(frame.network, name), getattr(network, name)), name
            assert np.array_equal(frame.network.segment_ids, network.segment_ids)
            for name in ("ids", "positions", "births", "states"):
                assert np.array_equal(getattr(frame.sources, name), getattr(sources, name)), name
            assert np.array_equal(timeline.positions(state.step), network.positions)
            assert np.array_equal(timeline.stream_words(state.step), words)
            rings = zip(frame.blade.rings, state.blade.rings, strict=True)
            assert all(np.array_equal(mine, theirs) for mine, theirs in rings)


def test_the_last_frame_is_the_default(recorded):
    with Timeline(recorded[0]) as timeline:
        assert timeline.frame().step == timeline.last_step == LAST
        assert len(timeline.positions()) == timeline.n_rows("nodes")


def test_tables_are_filled_as_the_run_had_them(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        for step in (0, 7, LAST):
            tables, state = timeline.tables(step), shown[step][0]
            assert tables.counts() == state.counts
            for name, columns in TABLE_COLUMNS.items():
                for column in columns:
                    assert np.array_equal(tables[name].view(column), state.rows(name, column))
        tables["events"].append(step=LAST, kind=0, subject=0, object=-1)
        assert tables["events"].n_rows == timeline.n_rows("events") + 1


def test_frames_and_events_are_columns(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        assert np.array_equal(timeline.frames["step"], np.arange(LAST + 1))
        assert timeline.frames["n_nodes"].tolist() == [s[0].counts[0] for s in shown]
        assert timeline.frames["motion"].shape == (LAST + 1, 2, 3)
        events = timeline.events
        assert list(events) == ["step", "kind", "subject", "object"]
        assert sum(events.counts().values()) == timeline.n_rows("events")
        assert events.counts()["run_finished"] == 1


def test_slices_of_a_column_are_read_alone(recorded):
    with Timeline(recorded[0]) as timeline:
        births = timeline.table("nodes", "birth")
        assert np.array_equal(timeline.table("nodes", "birth", 3, 9), births[3:9])
        assert timeline.table("nodes", "position", 5, 5).shape == (0, 2)


@pytest.mark.parametrize(
    ("ask", "answer"),
    [
        (lambda t: t.frame(LAST + 1), rf"step {LAST + 1} is not recorded; steps 0 to {LAST} are"),
        (lambda t: t.frame(-2), "step -2 is not recorded"),
        (lambda t: t.table("roots", "birth"), "no table 'roots'; tables are nodes, segments"),
        (lambda t: t.table("nodes", "colour"), "no column 'colour'; columns are birth, parent"),
        (lambda t: t.table("nodes", "birth", 0, 10**9), "rows 0 to 1000000000 of nodes"),
        (lambda t: t.to_pandas("roots"), "no table 'roots'"),
        (lambda t: t.lineage.ancestors(10**9), "no node 1000000000"),
        (lambda t: t.lineage.fate_of(-1), "no source -1"),
    ],
)
def test_what_is_not_there_is_said_in_one_line(recorded, ask, answer):
    with Timeline(recorded[0]) as timeline, pytest.raises(TimelineError, match=answer) as caught:
        ask(timeline)
    assert "\n" not in str(caught.value)


def test_a_closed_timeline_says_so(recorded):
    with Timeline(recorded[0]) as timeline:
        network = timeline.frame().network
    assert network.n_nodes > 1
    with pytest.raises(TimelineError, match="closed"):
        timeline.frame()


def test_a_file_without_frames_opens(tmp_path):
    create(tmp_path / "run.h5").close(complete=False)
    with Timeline(tmp_path / "run.h5") as timeline:
        assert (timeline.n_frames, timeline.last_step) == (0, -1)
        assert timeline.stop_reason is None
        with pytest.raises(TimelineError, match="no step is recorded yet"):
            timeline.frame()


def test_the_initial_blade_is_the_one_given(recorded):
    with Timeline(recorded[0]) as timeline:
        assert np.array_equal(timeline.initial_blade.rings[0], blade().rings[0])
        assert np.array_equal(timeline.initial_blade.seeds, blade().seeds)


def test_data_frames_name_codes_and_split_pairs(recorded):
    with Timeline(recorded[0]) as timeline:
        nodes = timeline.to_pandas("nodes")
        assert list(nodes) == [
            *("birth", "parent", "origin", "source"),
            *("position_x", "position_y", "material_x", "material_y"),
        ]
        assert nodes["origin"].iloc[0] == "seed"
        assert nodes["position_y"].iloc[-1] == timeline.table("nodes", "position")[-1, 1]
        events = timeline.to_pandas("events")
        assert events["kind"].iloc[-1] == "run_finished"
        assert events["kind"].value_counts()["source_placed"] == timeline.n_rows("sources")
        assert len(timeline.to_pandas("frames")) == LAST + 1


def test_graphs_carry_what_is_known_of_nodes_and_edges(recorded):
    with Timeline(recorded[0]) as timeline:
        frame = timeline.frame()
        graph = frame.to_networkx()
        assert graph.number_of_nodes() == frame.network.n_nodes
        start, end = frame.network.segments[0].tolist()
        assert graph.edges[start, end]["kind"] == "extension"
        assert graph.edges[start, end]["length"] == frame.network.lengths[0]
        assert graph.nodes[0]["origin"] == "seed"


@pytest.mark.parametrize(
    ("package", "extra", "ask"),
    [
        ("pandas", "tables", lambda timeline: timeline.to_pandas("nodes")),
        ("networkx", "graph", lambda timeline: timeline.frame().to_networkx()),
    ],
)
def test_a_missing_extra_is_named(recorded, monkeypatch, package, extra, ask):
    monkeypatch.setitem(sys.modules, package, None)
    with Timeline(recorded[0]) as timeline, pytest.raises(VascError) as caught:
        ask(timeline)
    assert f'pip install "vasc[{extra}]"' in str(caught.value)


def test_opening_loads_nothing_heavy(recorded):
    code = (
        "import sys; from vasc.timeline import Timeline\n"
        "t = Timeline(sys.argv[1]); t.frame(); t.events.counts(); t.provenance; t.config\n"
        "print([m for m in ('scipy', 'numba', 'matplotlib', 'shapely', 'pandas', 'networkx',"
        " 'vasc.models', 'vasc.growth') if m in sys.modules])"
    )
    command = [sys.executable, "-c", code, str(recorded[0])]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_opening_takes_as_long_for_a_long_run_as_for_a_short_one(tmp_path, monkeypatch):
    """Opening reads as many rows of ``frames`` as there are tables, whatever the length."""
    import h5py

    reads = []
    real = h5py.Dataset.__getitem__

    def counted(self, key, **options):
        rows = real(self, key, **options)
        reads.append(np.size(rows))
        return rows

    monkeypatch.setattr(h5py.Dataset, "__getitem__", counted)
    totals = []
    for last_step in (3, 300):
        path = tmp_path / f"{last_step}.h5"
        record(path, last_step)
        reads.clear()
        Timeline(path).close()
        totals.append((len(reads), sum(reads)))
    assert totals[0] == totals[1]
    assert totals[0][1] < 20
