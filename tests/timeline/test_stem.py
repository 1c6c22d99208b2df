"""Runs in space, in which nothing moves: recorded, read, continued and checked."""

from contextlib import contextmanager
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
from timeline import synthetic
from timeline.synthetic import N_RING, NAMES, SEED, StemRun, SyntheticRun, blade, contents, create

from vasc import experiment as experiments
from vasc.cli.program import main
from vasc.errors import TimelineError, VascError
from vasc.experiment import Difference
from vasc.models.base import RecordParameters
from vasc.network import Origin
from vasc.render import draw_leaf
from vasc.sources import Cause
from vasc.state import TABLE_COLUMNS, Tables, table_columns
from vasc.streams import Streams
from vasc.timeline import Motion, Recorder, Timeline, layout, validate

LAST = 150
RING = np.arange(N_RING, dtype=np.int32)


def record(path, last_step=LAST, **options):
    synthetic.record(path, last_step, kind=StemRun, **options)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A recorded run, and every state of it."""
    path = tmp_path_factory.mktemp("stem") / "run.h5"
    return path, synthetic.recorded_states(path, LAST, StemRun)


@pytest.fixture
def path(tmp_path, recorded):
    """A copy that may be changed."""
    (tmp_path / "run.h5").write_bytes(recorded[0].read_bytes())
    return tmp_path / "run.h5"


def test_every_frame_equals_the_state_it_was(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        assert (timeline.motion, timeline.dimensions) == (Motion.NONE, 3)
        assert np.array_equal(timeline.base_ring, RING)
        for state in shown:
            frame = timeline.frame(state.step)
            assert frame.motion is frame.outline_motion is None
            assert frame.positions.shape == (state.n_rows("nodes"), 3)
            assert np.array_equal(frame.positions, state.rows("nodes", "material"))
            assert np.array_equal(timeline.positions(state.step), frame.positions)
            assert np.array_equal(frame.network.positions, state.network.positions)
            assert np.array_equal(frame.network.lengths, state.network.lengths)
            assert np.array_equal(frame.sources.ids, state.live)
            assert np.array_equal(frame.sources.positions, state.sources.positions)
            assert frame.sources.positions.shape == (len(state.live), 3)
            assert frame.areoles.n_areoles == 0


def test_the_file_has_a_stem_and_no_blade_maps_or_places(recorded, tmp_path):
    synthetic.record(tmp_path / "leaf.h5", 3)
    with h5py.File(recorded[0]) as file, h5py.File(tmp_path / "leaf.h5") as leaf:
        assert (file.attrs["dimensions"], file.attrs["motion"]) == (3, b"none")
        assert set(leaf) - set(file) == {"blade"}
        assert set(file) - set(leaf) == {"stem"}
        assert not {"motion", "outline_motion"} & set(file["frames"])
        assert file["stem/ring"].dtype == "i4"
        for table in ("nodes", "sources"):
            assert {file[table][name].shape[1:] for name in ("position", "material")} == {(3,)}
        assert leaf.attrs["dimensions"] == 2


def test_codes_of_primordia_are_named_in_the_file(recorded):
    with Timeline(recorded[0]) as timeline:
        assert set(timeline.to_pandas("sources")["cause"]) == {"primordium"}
        assert set(timeline.to_pandas("nodes")["origin"]) == {"seed", "extension", "primordium"}
        assert (timeline.table("sources", "cause") == Cause.PRIMORDIUM).all()
        assert (timeline.table("nodes", "origin")[:N_RING] == Origin.SEED).all()


def test_tables_data_frames_and_graphs_have_three_axes(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        tables = timeline.tables()
        assert (tables.dimensions, tables.counts()) == (3, shown[-1].counts)
        nodes, frames = timeline.to_pandas("nodes"), timeline.to_pandas("frames")
        axes = ["material_x", "material_y", "material_z"]
        assert np.array_equal(nodes[axes].to_numpy(), timeline.positions())
        assert "motion_0" not in frames
        assert len(frames) == LAST + 1
        graph = timeline.frame().to_networkx()
        places = [[graph.nodes[node][axis] for axis in "xyz"] for node in sorted(graph)]
        assert np.array_equal(places, timeline.positions())


def test_a_data_frame_in_the_plane_has_no_third_axis(tmp_path):
    synthetic.record(tmp_path / "leaf.h5", 3)
    with Timeline(tmp_path / "leaf.h5") as timeline:
        assert "material_y" in timeline.to_pandas("nodes")
        assert "material_z" not in timeline.to_pandas("nodes")
        assert "z" not in timeline.frame().to_networkx().nodes[0]


def test_only_columns_of_points_depend_on_the_dimensions():
    assert table_columns(2) == TABLE_COLUMNS
    wide = {
        (table, name)
        for table, columns in table_columns(3).items()
        for name, column in columns.items()
        if column != TABLE_COLUMNS[table][name]
    }
    names = ("position", "material")
    assert wide == {(table, name) for table in ("nodes", "sources") for name in names}
    assert Tables(3)["nodes"].view("position").shape == (0, 3)


def test_a_stem_has_no_blade_no_places_and_no_areas(recorded):
    with Timeline(recorded[0]) as timeline:
        with pytest.raises(TimelineError, match="a stem has no blade"):
            _ = timeline.frame().blade
        with pytest.raises(TimelineError, match="a stem has no blade"):
            _ = timeline.initial_blade
        with pytest.raises(TimelineError, match="there are none: its motion is none"):
            timeline.places("nodes")
        assert timeline.n_places == {}
        assert all(len(rows) == 0 for rows in timeline.areole_areas().values())


def test_a_leaf_has_no_ring_at_a_base(tmp_path):
    synthetic.record(tmp_path / "leaf.h5", 3)
    with (
        Timeline(tmp_path / "leaf.h5") as timeline,
        pytest.raises(TimelineError, match="a blade has no ring at its base"),
    ):
        _ = timeline.base_ring


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (["render", "-o", "out.png"], "{path}: is no stem, but a run of the kind 'synthetic'"),
        (
            ["animate", "-o", "out.gif"],
            "{path}: films are made of leaves; draw it with vasc render",
        ),
    ],
    ids=["render", "animate"],
)
def test_verbs_that_need_a_blade_or_a_known_stem_say_so(path, line, words, capsys, monkeypatch):
    monkeypatch.chdir(path.parent)
    verb, *options = line
    assert main([verb, str(path), *options]) == 2
    told = capsys.readouterr()
    assert told.err == f"{words.format(path=path)}\n"
    assert not list(path.parent.glob("out*"))


def test_pictures_of_states_say_that_there_is_no_blade(recorded):
    with pytest.raises(VascError, match="a stem has no blade"):
        draw_leaf(recorded[1][-1])


class StemModel:
    """The synthetic stem as a model."""

    def __init__(self):
        self.run = StemRun(LAST)

    def initial_state(self, streams):
        return next(self.run.states(streams))

    def advance(self, state, streams):
        return next(self.run.states(streams))

    def restore(self, tables, step, streams):
        self.run.restore(tables, step)
        return self.run._state()

    def is_finished(self, state):
        return state.is_finished


def experiment():
    """An experiment whose parameters know nothing of growth or a blade."""
    return SimpleNamespace(
        label="a stem",
        kind="stem",
        toml=synthetic.TOML,
        record=synthetic.CONFIG,
        parameters=SimpleNamespace(
            kind="own",
            seed=SEED,
            stream_names=NAMES,
            units=None,
            record=RecordParameters(perceived="nodes"),
        ),
        model=StemModel,
        refuse_own_file=lambda output: None,
    )


def test_an_experiment_on_a_stem_is_run_resumed_and_summed_up(tmp_path, recorded, monkeypatch):
    @contextmanager
    def repeatable(timeline):
        yield StemModel(), Streams(SEED, NAMES)

    monkeypatch.setattr(experiments, "repeatable", repeatable)
    path = tmp_path / "run.h5"
    begun = experiments.run(experiment(), path, steps=70)
    assert (begun.steps, begun.stop_reason) == (70, None)
    summary = experiments.resume(path)
    assert (summary.steps, summary.stop_reason) == (LAST, "no_sources")
    assert summary.nodes_outside is None
    assert contents(path) == contents(recorded[0])
    with Timeline(path) as timeline:
        assert timeline.growth == "none"
    assert experiments.verify(path) == []


@pytest.mark.parametrize("last_step", [0, 1, 2, LAST])
def test_sound_runs_have_no_findings(tmp_path, last_step):
    record(tmp_path / "run.h5", last_step)
    assert validate(tmp_path / "run.h5") == []


@pytest.mark.parametrize("step", [0, 1, 63, 64, 65, 100, LAST - 1])
def test_a_stopped_run_goes_on_to_the_same_bytes(tmp_path, recorded, step):
    path = tmp_path / "run.h5"
    record(path, stop_after=step)
    synthetic.resume(path, LAST, kind=StemRun)
    assert contents(path) == contents(recorded[0])
    assert validate(path) == []
    with Timeline(path) as timeline:
        assert timeline.is_complete


def test_a_run_without_any_frame_starts_again(tmp_path, recorded):
    path = tmp_path / "run.h5"
    create(path, StemRun).close(complete=False)
    assert validate(path) == []
    synthetic.resume(path, LAST, kind=StemRun)
    assert contents(path) == contents(recorded[0])


def test_rows_that_were_not_committed_are_dropped(tmp_path, recorded):
    path = tmp_path / "run.h5"
    record(path, stop_after=70)
    with h5py.File(path, "r+") as file:
        for name in layout.growing_columns(len(NAMES), Motion.NONE, dimensions=3):
            before = file[name].shape[0]
            file[name].resize(before + 5000, axis=0)
            file[name][before:] = 77
    assert contents(path) == contents(recorded[0], 71)
    assert validate(path) == []
    synthetic.resume(path, LAST, kind=StemRun)
    assert contents(path) == contents(recorded[0])


WRONG = {
    "a blade in space": ({"blade": blade(), "base_ring": None}, "takes a blade and no ring"),
    "a blade and a ring": ({"blade": blade()}, "takes a blade and no ring"),
    "a stem without a ring": ({"base_ring": None}, "takes a blade and no ring"),
    "a stem in the plane": (
        {"dimensions": 2, "motion": Motion.AFFINE},
        "takes a blade and no ring",
    ),
    "a stem that moves": ({"motion": Motion.EXPLICIT}, "'explicit' with 3 dimensions"),
    "a blade that cannot move": ({"dimensions": 2}, "'none' with 2 dimensions"),
    "a line": ({"dimensions": 1}, "'dimensions' is 1, must be 2 or 3"),
}


@pytest.mark.parametrize(("options", "told"), WRONG.values(), ids=WRONG)
def test_a_file_that_is_neither_leaf_nor_stem_is_not_made(tmp_path, options, told):
    with pytest.raises(TimelineError, match=told):
        create(tmp_path / "run.h5", StemRun, **options)
    assert not list(tmp_path.iterdir())


def test_a_state_of_another_form_is_refused(tmp_path):
    class FlatRun(StemRun):
        dimensions = 2
        _seeds = SyntheticRun._seeds

    streams = Streams(SEED, NAMES)
    with create(tmp_path / "run.h5", StemRun) as recorder:
        with pytest.raises(TimelineError, match="step 0 is affine, the file is none"):
            recorder.observe(next(SyntheticRun(3).states(streams)), streams)
        with pytest.raises(TimelineError, match="step 0 has 2 dimensions, the file 3"):
            recorder.observe(next(FlatRun(3).states(streams)), streams)
        recorder.observe(next(StemRun(3).states(streams)), streams)


def set_row(name, row, value):
    def change(file):
        file[name][row] = value

    return change


def set_attribute(name, value):
    def change(file):
        file.attrs[name] = value

    return change


def flatten(file):
    """The columns of a leaf in the place of those in space."""
    values = file["nodes/position"][:, :2]
    del file["nodes/position"]
    file.create_dataset("nodes/position", data=values, maxshape=(None, 2))


def add_areole(file):
    for name, value in (("birth", LAST), ("parent", -1), ("segment", 0)):
        file[f"areoles/{name}"].resize(1, axis=0)
        file[f"areoles/{name}"][0] = value
    file["frames/n_areoles"][-1] = 1


DAMAGED = {
    "a node that moved": (
        set_row("nodes/position", 30, [0.0, 0.0, 9.0]),
        "[positions] nodes/position: row 30",
    ),
    "a source that moved": (
        set_row("sources/material", 3, [0.0, 0.0, 9.0]),
        "[positions] sources/position: row 3",
    ),
    "a node nowhere": (
        set_row("nodes/material", 30, [0.0, 0.0, np.nan]),
        "[written] nodes/material: row 30",
    ),
    "a ring of nodes yet to come": (set_row("stem/ring", 2, 6), "[stem] stem/ring: row 2 is 6"),
    "a ring of no node": (set_row("stem/ring", 2, -1), "[stem] stem/ring: row 2 is -1"),
    "a node twice in the ring": (set_row("stem/ring", 4, 1), "[stem] stem/ring: row 4 is 1"),
    "no ring": (lambda file: file.pop("stem/ring"), "[readable] ", "stem/ring is missing"),
    "no stem": (lambda file: file.pop("stem"), "[readable] ", "stem is missing"),
    "a blade as well": (lambda file: file.create_group("blade"), "[header] blade: a file of 3"),
    "areoles": (add_areole, "[areoles] areoles holds rows"),
    "no dimensions": (
        lambda file: file.attrs.pop("dimensions"),
        "[readable] ",
        "the attribute 'dimensions' is None",
    ),
    "four dimensions": (set_attribute("dimensions", 4), "[readable] ", "must be 2 or 3"),
    "two dimensions": (set_attribute("dimensions", 2), "[readable] ", "'none' with 2 dimensions"),
    "another motion": (
        set_attribute("motion", np.bytes_("affine")),
        "[readable] ",
        "'affine' with 3 dimensions",
    ),
    "a flat column": (flatten, "[readable] ", "nodes/position is float64[2] a row"),
}


@pytest.mark.parametrize(("change", "parts"), [(c, p) for c, *p in DAMAGED.values()], ids=DAMAGED)
def test_damage_is_found(path, change, parts):
    with h5py.File(path, "r+") as file:
        change(file)
    findings = validate(path)
    assert any(finding.startswith(parts[0]) and parts[-1] in finding for finding in findings), (
        findings
    )


def test_areas_in_space_are_refused(path):
    with h5py.File(path, "r+") as file:
        add_areole(file)
    with Timeline(path) as timeline:
        with pytest.raises(TimelineError, match="recorded in space"):
            timeline.areole_areas()
        with pytest.raises(TimelineError, match="recorded in space"):
            _ = timeline.frame().areoles


@pytest.fixture
def repeated(monkeypatch):
    """Let ``verify`` repeat the synthetic run."""
    synthetic.repeat(monkeypatch, LAST, StemRun)


def test_a_repeated_run_is_the_same_bit_for_bit(path, repeated):
    assert experiments.verify(path) == []


@pytest.mark.parametrize("name", ["nodes/position", "nodes/material", "sources/material"])
def test_one_changed_bit_is_found(path, repeated, name):
    with h5py.File(path, "r+") as file:
        row = file[name][30]
        row.view(np.uint8)[16] ^= 1
        file[name][30] = row
    (found,) = experiments.verify(path)
    assert found[1:4] == (*name.split("/"), 30)
    assert found.recorded != found.repeated


def test_another_ring_is_found(path, repeated):
    with h5py.File(path, "r+") as file:
        file["stem/ring"][:] = RING[::-1]
    assert experiments.verify(path) == [Difference(0, "stem", "ring", 0, "5", "0")]


def test_a_run_of_other_dimensions_differs_in_that(tmp_path, repeated):
    synthetic.record(tmp_path / "leaf.h5", LAST)
    found = experiments.verify(tmp_path / "leaf.h5")
    assert Difference(0, "", "dimensions", -1, "2", "3") in found
    assert Difference(0, "", "motion", -1, "affine", "none") in found
    assert not any(one.table in TABLE_COLUMNS for one in found)


def test_a_stem_that_is_recorded_with_an_open_reader_is_whole(tmp_path):
    path, streams = tmp_path / "run.h5", Streams(SEED, NAMES)
    with create(path, StemRun) as recorder:
        for state in StemRun(70).states(streams):
            recorder.observe(state, streams)
            with Timeline(path) as timeline:
                assert timeline.n_frames == recorder.n_frames
                assert np.isfinite(timeline.positions()).all()
    Recorder.resume(path).close()
    assert validate(path) == []
