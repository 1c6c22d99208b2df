"""Runs on a tissue of cells: recorded, read, continued and checked, by a run that computes none."""

from dataclasses import replace
from itertools import pairwise

import h5py
import numpy as np
import pytest
from timeline import synthetic
from timeline.synthetic import NAMES, SEED, SyntheticRun, TissueRun, contents, create

from vasc import experiment as experiments
from vasc.domain.tilings import rectangular
from vasc.errors import TimelineError
from vasc.fields import FIELD_COLUMNS, Fields
from vasc.streams import Streams
from vasc.timeline import Motion, Recorder, Timeline, layout, validate, writer
from vasc.timeline.opening import open_to_continue
from vasc.timeline.tissues import ARRAYS, arrays_of, n_bytes_a_step

LAST = 150
CELLS, WALLS = TissueRun.tissue.n_cells, TissueRun.tissue.n_walls
COLUMNS = [f"fields/{name}" for name in FIELD_COLUMNS]


def rows_of(name):
    return layout.rows_a_step(name, CELLS, WALLS)


def record(path, last_step=LAST, **options):
    synthetic.record(path, last_step, kind=TissueRun, **options)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A recorded run, and every state of it."""
    path = tmp_path_factory.mktemp("tissue") / "run.h5"
    return path, synthetic.recorded_states(path, LAST, TissueRun)


@pytest.fixture
def path(tmp_path, recorded):
    """A copy that may be changed."""
    (tmp_path / "run.h5").write_bytes(recorded[0].read_bytes())
    return tmp_path / "run.h5"


def test_every_frame_equals_the_state_it_was(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        for state in shown:
            frame = timeline.frame(state.step)
            for name in FIELD_COLUMNS:
                expected = getattr(state.fields, name)
                for fields in (frame.fields, timeline.fields(state.step)):
                    found = getattr(fields, name)
                    assert (found.dtype, found.tobytes()) == (expected.dtype, expected.tobytes())
            assert frame.tissue is timeline.tissue
        assert np.array_equal(timeline.fields().flux, shown[-1].fields.flux)


def test_the_tissue_is_that_of_the_states(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        read, made = arrays_of(timeline.tissue), arrays_of(shown[0].tissue)
        for name in made:
            assert (read[name].dtype, read[name].tobytes()) == (
                made[name].dtype,
                made[name].tobytes(),
            )
        assert np.array_equal(timeline.tissue.blade.rings[0], shown[0].blade.rings[0])
        assert (timeline.tissue.n_cells, timeline.tissue.n_walls) == (CELLS, WALLS)


def test_tables_tell_the_past(recorded):
    path, shown = recorded
    with Timeline(path) as timeline:
        past = timeline.tables(40).past
        for step in (0, 17, 40):
            assert past.time(step) == shown[step].time
            assert np.array_equal(past.fields(step).carriers, shown[step].fields.carriers)


def test_a_file_without_a_tissue_has_none(tmp_path):
    synthetic.record(tmp_path / "leaf.h5", 3)
    with h5py.File(tmp_path / "leaf.h5", "r+") as file:
        assert file.attrs["tissue"] == 0
        assert not {"tissue", "fields"} & set(file)
        # as written before there were any
        del file.attrs["tissue"]
    # nothing is amiss but that this is not what was recorded
    assert validate(tmp_path / "leaf.h5") == ["[checksums] attributes is not what was recorded"]
    with Timeline(tmp_path / "leaf.h5") as timeline:
        assert timeline.tissue is timeline.frame().fields is timeline.frame().tissue is None
        assert timeline.tables().past is None
        with pytest.raises(TimelineError, match=r"leaf\.h5: has no tissue"):
            timeline.fields()


def test_cells_and_walls_are_data_frames(recorded, tmp_path):
    path, shown = recorded
    tissue, fields = TissueRun.tissue, shown[17].fields
    with Timeline(path) as timeline:
        cells, walls = (timeline.to_pandas(name, 17) for name in ("cells", "walls"))
        assert np.array_equal(timeline.to_pandas("walls")["flux"], shown[-1].fields.flux)
    assert np.array_equal(cells[["position_x", "position_y"]], tissue.positions)
    assert np.array_equal(cells["concentration"], fields.concentration)
    assert cells["role"].value_counts().to_dict() == {"ground": 32, "vein": 2, "source": 1}
    assert np.array_equal(walls[["first", "second"]], tissue.walls)
    assert np.array_equal(walls[["carriers_forth", "carriers_back"]], fields.carriers)
    synthetic.record(tmp_path / "leaf.h5", 3)
    with (
        Timeline(tmp_path / "leaf.h5") as timeline,
        pytest.raises(TimelineError, match="has no tissue"),
    ):
        timeline.to_pandas("cells")


def test_a_step_that_is_not_recorded_has_no_fields(recorded):
    with Timeline(recorded[0]) as timeline, pytest.raises(TimelineError, match="step 151 is not"):
        timeline.fields(LAST + 1)


def test_the_size_of_a_step_is_known_beforehand(recorded):
    fields = recorded[1][0].fields
    assert n_bytes_a_step(CELLS, WALLS) == sum(rows.nbytes for rows in fields)


@pytest.mark.parametrize("last_step", [0, 1, 2])
def test_short_runs_are_sound(tmp_path, last_step):
    record(tmp_path / "run.h5", last_step)
    assert validate(tmp_path / "run.h5") == []


def test_the_recorded_file_is_sound(recorded):
    assert validate(recorded[0]) == []


class LargeRun(TissueRun):
    """So many cells that a chunk is a step."""

    tissue = rectangular(80, 60)


def chunks(dataset):
    """Give where each chunk begins, the mask of its filters, its place and its size."""
    infos = [dataset.id.get_chunk_info(k) for k in range(dataset.id.get_num_chunks())]
    return [(info.chunk_offset, info.filter_mask, info.byte_offset, info.size) for info in infos]


@pytest.mark.parametrize(("kind", "steps"), [(TissueRun, (118, 71)), (LargeRun, (1, 1))])
def test_chunks_hold_whole_steps_are_compressed_and_never_move(tmp_path, monkeypatch, kind, steps):
    path, seen, last = tmp_path / "run.h5", [], 12 if kind is LargeRun else 300
    monkeypatch.setattr(writer, "BATCH_FRAMES", 4)

    def look(step):
        if step % 4 == 0:
            with h5py.File(path, "r", locking="best-effort") as file:
                found = {(name, *chunk[::2]) for name in COLUMNS for chunk in chunks(file[name])}
                seen.append(found)

    synthetic.record(path, last, kind=kind, watch=look)
    assert all(before <= after for before, after in pairwise(seen))
    with h5py.File(path) as file:
        for name in FIELD_COLUMNS:
            dataset = file[f"fields/{name}"]
            n = layout.rows_a_step(name, kind.tissue.n_cells, kind.tissue.n_walls)
            assert dataset.chunks[0] == n * steps[n == kind.tissue.n_walls]
            assert (dataset.compression, dataset.shuffle) == ("gzip", True)
            assert dataset.fletcher32
            if kind is LargeRun:
                # the first is there from the beginning, as it is
                masks = [mask == 0 for _, mask, _, _ in chunks(dataset)]
                assert masks == [False] + [True] * last
    assert validate(path) == []


def test_the_recording_process_can_look_at_its_own_file(tmp_path):
    path, streams = tmp_path / "run.h5", Streams(SEED, NAMES)
    with create(path, TissueRun) as recorder:
        for state in TissueRun(LAST).states(streams):
            recorder.observe(state, streams)
            with Timeline(path) as timeline:
                assert timeline.n_frames == recorder.n_frames
                assert np.isfinite(timeline.fields().carriers).all()
    assert validate(path) == []


@pytest.mark.parametrize("step", [0, 1, 63, 64, 65, 100, LAST - 1])
def test_a_stopped_run_goes_on_to_the_same_bytes(tmp_path, recorded, step):
    path = tmp_path / "run.h5"
    record(path, stop_after=step)
    synthetic.resume(path, LAST, kind=TissueRun)
    assert contents(path) == contents(recorded[0])
    assert validate(path) == []


def test_a_run_without_any_frame_starts_again(tmp_path, recorded):
    path = tmp_path / "run.h5"
    create(path, TissueRun).close(complete=False)
    assert validate(path) == []
    with Timeline(path) as timeline, pytest.raises(TimelineError, match="no step is recorded"):
        timeline.fields()
    synthetic.resume(path, LAST, kind=TissueRun)
    assert contents(path) == contents(recorded[0])


@pytest.mark.parametrize("grown", [1, 9000])
def test_rows_that_were_not_committed_are_dropped(tmp_path, recorded, grown):
    path = tmp_path / "run.h5"
    record(path, stop_after=70)
    store, found, _, _ = open_to_continue(path)
    for name in FIELD_COLUMNS:
        column = store.column(f"fields/{name}")
        shape = (grown, *FIELD_COLUMNS[name].shape)
        column.write(71 * found.rows_a_step(name), np.full(shape, 77, dtype=column.dtype))
    store.close()
    assert contents(path) == contents(recorded[0], 71)
    assert validate(path) == []
    Recorder.resume(path).close(complete=False)
    with h5py.File(path, locking=False) as file:
        for name in FIELD_COLUMNS:
            dataset = file[f"fields/{name}"]
            assert 71 * rows_of(name) <= dataset.shape[0] < 71 * rows_of(name) + dataset.chunks[0]
    synthetic.resume(path, LAST, kind=TissueRun)
    assert contents(path) == contents(recorded[0])
    assert validate(path) == []


def test_an_interrupt_in_the_middle_of_a_commit_loses_nothing(tmp_path, monkeypatch, recorded):
    path, calls, real = tmp_path / "run.h5", iter(range(10_000)), writer.CompressedColumn.write
    monkeypatch.setattr(writer, "BATCH_FRAMES", 8)

    def interrupted(self, start, rows):
        real(self, start, rows)
        if next(calls) == 37:
            raise KeyboardInterrupt

    monkeypatch.setattr(writer.CompressedColumn, "write", interrupted)
    with pytest.raises(KeyboardInterrupt):
        record(path)
    with Timeline(path) as timeline:
        n_frames = timeline.n_frames
    assert 1 < n_frames < LAST
    assert contents(path) == contents(recorded[0], n_frames)
    assert validate(path) == []


def test_states_and_files_of_another_form_are_refused(tmp_path):
    streams = Streams(SEED, NAMES)
    plain = next(SyntheticRun(3).states(streams))
    cells = next(TissueRun(3).states(streams))
    with create(tmp_path / "leaf.h5") as recorder:
        with pytest.raises(TimelineError, match="step 0 has 35 cells and 58 walls, the file 0 and"):
            recorder.observe(cells, streams)
        recorder.observe(plain, streams)
    with create(tmp_path / "run.h5", TissueRun) as recorder:
        with pytest.raises(TimelineError, match="step 0 has 0 cells and 0 walls, the file 35 and"):
            recorder.observe(plain, streams)
        recorder.observe(cells, streams)
    with pytest.raises(TimelineError, match="motion 'explicit' with a tissue"):
        create(tmp_path / "bent.h5", TissueRun, motion=Motion.EXPLICIT)


def test_a_tissue_without_a_wall_is_recorded(tmp_path):
    class OneCell(SyntheticRun):
        tissue = rectangular(1, 1)

        def _state(self):
            empty = np.zeros(0)
            fields = Fields(np.zeros(1), empty, empty.reshape(0, 2), np.zeros(1, dtype=np.int8))
            return replace(super()._state(), tissue=self.tissue, fields=fields)

    synthetic.record(tmp_path / "run.h5", 70, kind=OneCell)
    assert validate(tmp_path / "run.h5") == []
    with Timeline(tmp_path / "run.h5") as timeline:
        assert timeline.fields().carriers.shape == (0, 2)
    Recorder.resume(tmp_path / "run.h5").close()


@pytest.mark.parametrize("name", COLUMNS)
def test_a_column_that_is_too_short_is_one_clear_error(path, name):
    with h5py.File(path, "r+") as file:
        file[name].resize((LAST + 1) * rows_of(name.partition("/")[2]) - 1, axis=0)
    (finding,) = validate(path)
    assert finding.startswith("[readable]")
    assert f"{name} has " in finding
    with pytest.raises(TimelineError, match=f"{name} has .* are committed"):
        Recorder.resume(path)


def set_rows(name, row, value):
    def change(file):
        file[name][row] = value

    return change


def resized(name, size):
    def change(file):
        rows = file[name][:size]
        del file[name]
        file[name] = rows

    return change


def attribute(value):
    def change(file):
        file.attrs["tissue"] = value

    return change


def without(name):
    def change(file):
        del file[name]

    return change


STEP = 70
VEIN_WALL = int(np.flatnonzero((TissueRun.tissue.walls == TissueRun.VEINS).all(axis=1))[0])
INTO_VEIN = int(np.flatnonzero(TissueRun.tissue.walls[:, 1] == TissueRun.VEINS[0])[0])
DAMAGED = {
    "concentration nowhere": (
        set_rows("fields/concentration", STEP * CELLS + 5, np.nan),
        "[written] fields/concentration at step 70: row 5 is nan",
    ),
    "carriers nowhere": (
        set_rows("fields/carriers", STEP * WALLS + 5, [1.0, np.inf]),
        "[written] fields/carriers at step 70: row 5",
    ),
    "flux nowhere": (
        set_rows("fields/flux", STEP * WALLS + 5, -np.inf),
        "[written] fields/flux at step 70: row 5",
    ),
    "a role that is none": (
        set_rows("fields/roles", STEP * CELLS + 5, 3),
        "[fields] fields/roles at step 70: row 5 is 3, a role that is not named",
    ),
    "flux along a vein": (
        set_rows("fields/flux", STEP * WALLS + VEIN_WALL, 1e-9),
        f"[fields] fields/flux at step 70: row {VEIN_WALL} is 1e-09, must be 0 from vein to vein",
    ),
    "a vein that gives": (
        set_rows("fields/flux", STEP * WALLS + INTO_VEIN, -99.0),
        "[fields] fields/flux at step 70: -9",
    ),
    "a cell nowhere": (
        set_rows("tissue/position", 3, [np.nan, 0.0]),
        "[tissue] tissue/position: row 3",
    ),
    "a cell without area": (
        set_rows("tissue/volume", 3, 0.0),
        "[tissue] tissue/volume: row 3 is 0.0, must be finite and above 0",
    ),
    "a wall of no length": (set_rows("tissue/length", 3, -1.0), "[tissue] tissue/length: row 3"),
    "a wall of one cell": (set_rows("tissue/walls", 3, [4, 4]), "[tissue] tissue/walls: row 3"),
    "a wall that descends": (set_rows("tissue/walls", 3, [5, 4]), "[tissue] tissue/walls: row 3"),
    "a wall to no cell": (
        set_rows("tissue/walls", 3, [4, CELLS]),
        "tissue/walls: row 3 is [4, 35]; two of 35 cells are needed",
    ),
    "a wall from no cell": (set_rows("tissue/walls", 3, [-1, 4]), "[tissue] tissue/walls: row 3"),
    "a cell of no corners": (
        set_rows("tissue/starts", 3, 8),
        "[tissue] tissue/starts does not divide the corners",
    ),
    "corners of no cell": (
        set_rows("tissue/starts", CELLS, 4 * CELLS - 1),
        "[tissue] tissue/starts does not divide the corners",
    ),
    "a volume that is missing": (
        resized("tissue/volume", CELLS - 1),
        "[tissue] tissue/volume has 34 rows; 35 are needed",
    ),
    "an attribute that is none": (attribute(2), "the attribute 'tissue' is 2, must be 0 or 1"),
    "an attribute that is no number": (attribute(np.bytes_("yes")), "'tissue' is 'yes'"),
    "a tissue that is denied": (
        attribute(0),
        "[header] tissue: a file without a tissue has no such group",
    ),
    "no fields": (without("fields"), "[readable]"),
    "no flux": (without("fields/flux"), "fields/flux is missing"),
    "no walls": (without("tissue/walls"), "tissue/walls is missing"),
}


@pytest.mark.parametrize(("change", "finding"), DAMAGED.values(), ids=DAMAGED)
def test_damage_is_found(path, change, finding):
    with h5py.File(path, "r+") as file:
        change(file)
    findings = validate(path)
    assert any(finding in one for one in findings), findings


@pytest.mark.parametrize("name", ["walls", "starts", "volume"])
def test_cells_that_do_not_fit_each_other_are_refused_in_one_line(path, name):
    change = {"walls": DAMAGED["a wall to no cell"], "starts": DAMAGED["a cell of no corners"]}
    with h5py.File(path, "r+") as file:
        change.get(name, DAMAGED["a volume that is missing"])[0](file)
    with Timeline(path) as timeline, pytest.raises(TimelineError, match=f"tissue/{name}") as caught:
        _ = timeline.frame().tissue
    assert "\n" not in str(caught.value)


def test_a_tissue_in_space_is_refused(path):
    with h5py.File(path, "r+") as file:
        file.attrs["motion"] = np.bytes_("explicit")
    with pytest.raises(TimelineError, match="motion 'explicit' with a tissue"):
        Timeline(path)


def test_fields_that_declare_more_than_the_file_holds_are_refused(path):
    with h5py.File(path, "r+") as file:
        file["fields/flux"].resize(1 << 40, axis=0)
    with pytest.raises(TimelineError, match=r"fields/flux declares \d+ bytes"):
        Timeline(path)


def test_a_chunk_that_was_damaged_is_found(tmp_path):
    path = tmp_path / "run.h5"
    synthetic.record(path, 5, kind=LargeRun)
    with h5py.File(path) as file:
        whole = [chunk for chunk in chunks(file["fields/flux"]) if chunk[1] == 0]
    content = bytearray(path.read_bytes())
    content[whole[2][2] + 500] ^= 1
    path.write_bytes(content)
    (finding,) = validate(path)
    assert finding.startswith("[readable]")
    assert "fields/flux" in finding


@pytest.fixture
def repeated(monkeypatch):
    """Let ``verify`` repeat the synthetic run."""
    synthetic.repeat(monkeypatch, LAST, TissueRun)


def test_a_repeated_run_is_the_same_bit_for_bit(path, repeated):
    assert experiments.verify(path) == []


def flip(path, name, row):
    with h5py.File(path, "r+") as file:
        value = np.array(file[name][row : row + 1])
        value.view(np.uint8).reshape(-1)[0] ^= 1
        file[name][row : row + 1] = value


@pytest.mark.parametrize("name", FIELD_COLUMNS)
def test_one_changed_bit_of_a_field_is_found(path, repeated, name):
    flip(path, f"fields/{name}", 90 * rows_of(name) + 3)
    (found,) = experiments.verify(path)
    assert found[:4] == (90, "fields", name, 3)
    assert found.recorded != found.repeated


@pytest.mark.parametrize("name", ["position", "volume", "length", "distance", "corners"])
def test_one_changed_bit_of_the_tissue_is_found(path, repeated, name):
    assert name in ARRAYS
    flip(path, f"tissue/{name}", 3)
    (found,) = experiments.verify(path)
    assert found[:4] == (0, "tissue", name, 3)


def test_a_run_without_cells_differs_in_that(tmp_path, repeated):
    synthetic.record(tmp_path / "leaf.h5", LAST)
    found = experiments.verify(tmp_path / "leaf.h5")
    assert (0, "", "tissue", -1, "0", "1") in found
    assert not any(one.table in ("tissue", "fields") for one in found)
