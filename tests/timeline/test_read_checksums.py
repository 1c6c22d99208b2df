"""What is read as a whole is held against what was recorded."""

import shutil

import h5py
import numpy as np
import pytest
from timeline.synthetic import record, resume

from vasc.cli.program import main
from vasc.errors import TimelineError
from vasc.timeline import Recorder, Timeline, guard, validate
from vasc.timeline.redo import log_of, settle

READERS = {
    "nodes/birth": lambda timeline: timeline.table("nodes", "birth"),
    "segments/nodes": lambda timeline: timeline.table("segments", "nodes"),
    "sources/position": lambda timeline: timeline.tables(),
    "frames/time": lambda timeline: timeline.frames,
    "frames/streams": lambda timeline: timeline.frames,
    "events/kind": lambda timeline: timeline.events,
    "blade/ring_xy": lambda timeline: timeline.initial_blade,
    "config/toml": lambda timeline: timeline.config_toml,
}


def spoil(path, name):
    with h5py.File(path, "r+") as file:
        dataset = file[name]
        if dataset.shape == ():
            dataset[()] = dataset[()].upper()
        else:
            rows = dataset[3:4]
            rows.view(np.uint8).reshape(-1)[0] ^= 1
            dataset[3:4] = rows


@pytest.fixture
def path(tmp_path):
    record(tmp_path / "run.h5", 30)
    return tmp_path / "run.h5"


@pytest.mark.parametrize("name", READERS)
def test_a_changed_bit_is_refused_where_it_is_read(path, name):
    with Timeline(path) as timeline:
        READERS[name](timeline)
    spoil(path, name)
    said = f"is damaged: {name} is not what was recorded; `vasc show --check` tells more"
    with Timeline(path) as timeline, pytest.raises(TimelineError, match=said):
        READERS[name](timeline)
    with Timeline(path) as timeline:
        timeline.opened.trust()
        READERS[name](timeline)


@pytest.mark.parametrize("verb", [["stats"], ["lineage", "--fates"], ["export", "-o", "x.csv"]])
def test_no_number_is_told_of_a_changed_run(path, verb, monkeypatch, capsys):
    monkeypatch.chdir(path.parent)
    spoil(path, "nodes/position" if verb[0] == "stats" else "sources/birth")
    spoil(path, "nodes/birth")
    assert main([verb[0], "run.h5", *verb[1:]]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert "is not what was recorded" in err
    assert [file.name for file in path.parent.iterdir()] == ["run.h5"]


def changed_units(file):
    file["units"].attrs["segment"] = -2.0


def fewer_steps(file):
    file["committed"][0] = 3


def other_model(file):
    file.attrs["model"] = "of another"


@pytest.mark.parametrize(
    ("change", "name"),
    [(changed_units, "attributes"), (other_model, "attributes"), (fewer_steps, "committed")],
)
def test_attributes_and_the_count_of_steps_are_those_that_were_noted(path, change, name):
    with h5py.File(path, "r+") as file:
        file.attrs["of others"] = "a remark"
    with Timeline(path) as timeline:
        assert timeline.is_complete
        assert timeline.units["length"] == "um"
    with h5py.File(path, "r+") as file:
        change(file)
    for ask in (lambda timeline: timeline.units, lambda timeline: timeline.is_complete):
        said = f"{name} is not what was recorded"
        with Timeline(path) as timeline, pytest.raises(TimelineError, match=said):
            ask(timeline)


def test_a_stopped_run_that_is_marked_complete_is_refused(tmp_path):
    path = tmp_path / "run.h5"
    record(path, 30, stop_after=20)
    with h5py.File(path, "r+") as file:
        file["complete"][0] = 1
    with Timeline(path) as timeline, pytest.raises(TimelineError, match="complete is not what"):
        _ = timeline.is_complete
    assert any("complete is not what was recorded" in finding for finding in validate(path))


def test_a_run_that_ends_while_it_is_read_is_no_damage(tmp_path):
    path, seen = tmp_path / "run.h5", []

    def look(step):
        if step == 20:
            seen.append(Timeline(path))

    record(path, 30, watch=look)
    (timeline,) = seen
    with timeline:
        assert timeline.n_frames <= 21
        assert not timeline.is_complete
        assert timeline.model


@pytest.mark.parametrize("value", [0.0, -2.0, np.nan, np.inf, "two"])
def test_units_without_checksums_are_numbers_above_0(path, value):
    with h5py.File(path, "r+") as file:
        file["provenance/records"].resize(1, axis=0)
        file["units"].attrs["segment"] = value
    with Timeline(path) as timeline, pytest.raises(TimelineError, match="units: segment is"):
        _ = timeline.units


def test_a_run_that_went_on_is_compared_with_its_last_session(path):
    other = path.with_name("other.h5")
    record(other, 30, stop_after=20)
    resume(other, 30)
    with Timeline(other) as timeline:
        timeline.tables()
    with Recorder.resume(other), Timeline(other) as timeline:
        timeline.tables()


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("nodes/material", np.nan, "nodes/material of row 7 is [nan, nan]; it must be finite"),
        ("nodes/source", 10**6, "nodes/source of row 7 is 1000000; it must be a row of sources"),
        ("segments/nodes", 10**6, "segments/nodes of row 7 is [1000000, 1000000]; it must be a"),
        ("segments/nodes", -1, "it must be a row of nodes ("),
        ("frames/n_nodes", 10**6, "1000000"),
        ("frames/n_nodes", -5, "-5"),
    ],
)
def test_damage_without_checksums_is_told_too(tmp_path, name, value, said):
    """A run that was killed has noted none."""
    path, copy = tmp_path / "run.h5", tmp_path / "killed.h5"

    def kept(step):
        if step == 70:
            shutil.copy(path, copy)
            shutil.copy(log_of(path), log_of(copy))

    record(path, 70, watch=kept)
    settle(copy)
    with Timeline(copy) as timeline:
        last = timeline.last_step
    assert last == 64
    with h5py.File(copy, "r+") as file:
        file[name][7 if "frames" not in name else last] = value
    for ask in (
        lambda timeline: timeline.tables(),
        lambda timeline: timeline.table(
            *name.replace("frames", "nodes").replace("n_nodes", "birth").split("/")
        ),
    ):
        with pytest.raises(TimelineError) as caught, Timeline(copy) as timeline:
            ask(timeline)
        assert said in str(caught.value)


@pytest.mark.parametrize("error", guard.TRANSIENT)
@pytest.mark.parametrize(
    "ask",
    [
        lambda timeline: timeline.initial_blade,
        lambda timeline: timeline.config_toml,
        lambda timeline: timeline.event_names,
        lambda timeline: timeline.provenance,
    ],
    ids=["array", "text", "attributes", "provenance"],
)
def test_what_hdf5_cannot_open_is_damage(path, ask, error, monkeypatch):
    def refuse(*_):
        raise error("dataspace dim 0 is greater than maxdim")

    with Timeline(path) as timeline:
        monkeypatch.setattr(guard, "open_item", refuse)
        with pytest.raises(TimelineError, match=r"run.h5: .* is damaged: .*maxdim"):
            ask(timeline)
