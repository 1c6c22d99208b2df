"""Run, resume and verify as functions: what observers see, where a run stops, what differs."""

import json
import os
import shutil
import signal

import h5py
import numpy as np
import pytest

from vasc import experiment as experiments
from vasc.config import load_text
from vasc.errors import ConfigError, OutlineError, OutputError, TimelineError
from vasc.timeline import Timeline

CONFIG = """kind = "{kind}"
seed = 5
[domain]
shape = "ovate"
length = 20.0
[growth]
kind = "{growth}"
final_length = 40.0
length_per_step = 1.0
[placement]
kind = "darts"
density = 0.02
birth_distance_sources = 4.0
birth_distance_veins = 4.0
[arrival]
kill_distance = 1.0
[record]
perceived = "{perceived}"
"""
TABLES = ("frames", "nodes", "segments", "sources", "perceived", "states", "events")


def leaf(kind="closed", growth="marginal", perceived="veins"):
    """Give a small experiment."""
    return load_text(CONFIG.format(kind=kind, growth=growth, perceived=perceived), name="leaf")


def columns(path):
    """Read every growing column of a timeline."""
    with h5py.File(path) as file:
        return {
            f"{table}/{name}": file[table][name][()] for table in TABLES for name in file[table]
        }


def assert_same(path, other):
    """Hold two timelines against each other, bit for bit."""
    first, second = columns(path), columns(other)
    assert first.keys() == second.keys()
    for name, rows in first.items():
        assert rows.tobytes() == second[name].tobytes(), name


class Watcher:
    """An observer that notes the steps it was shown."""

    def __init__(self):
        self.steps = []

    def observe(self, state, streams):
        self.steps.append(state.step)


@pytest.fixture
def whole(tmp_path):
    """Record the small leaf."""
    path = tmp_path / "whole.h5"
    experiments.run(leaf(), path)
    return path


@pytest.mark.parametrize("kind", ["open", "closed"])
@pytest.mark.parametrize("growth", ["marginal", "isogonic"])
@pytest.mark.parametrize("perceived", ["veins", "nodes", "none"])
def test_a_run_verifies_and_resumes_to_the_same_bytes(kind, growth, perceived, tmp_path):
    experiment = leaf(kind, growth, perceived)
    watcher = Watcher()
    summary = experiments.run(experiment, tmp_path / "whole.h5", observers=[watcher])
    assert summary.stop_reason == "no_sources"
    assert watcher.steps == list(range(summary.steps + 1))
    assert experiments.verify(tmp_path / "whole.h5") == []
    path = tmp_path / "parts.h5"
    experiments.run(experiment, path, steps=1)
    for steps in (1, 10, 7):
        experiments.resume(path, steps=steps)
        assert experiments.verify(path) == []
    last = experiments.resume(path)
    assert last.stop_reason == "no_sources"
    assert_same(path, tmp_path / "whole.h5")


def test_a_run_stops_when_asked_and_says_so(tmp_path, whole):
    watcher = Watcher()
    path = tmp_path / "a.h5"
    summary = experiments.run(
        leaf(), path, observers=[watcher], should_stop=lambda: watcher.steps[-1] == 9
    )
    assert summary.is_interrupted
    assert summary.stop_reason is None
    assert summary.steps == 9
    with Timeline(path) as timeline:
        assert timeline.last_step == 9
        assert not timeline.is_complete
        assert timeline.provenance[-1]["outcome"] == "interrupted"
    seen = Watcher()
    experiments.resume(path, observers=[seen])
    assert seen.steps[0] == 10
    assert_same(path, whole)


def test_a_wish_to_stop_after_the_last_step_comes_too_late(tmp_path):
    watcher, last = Watcher(), experiments.run(leaf(), tmp_path / "a.h5").steps
    summary = experiments.run(
        leaf(),
        tmp_path / "b.h5",
        observers=[watcher],
        should_stop=lambda: watcher.steps[-1] == last,
    )
    assert not summary.is_interrupted
    assert summary.stop_reason == "no_sources"


@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError])
def test_a_run_that_breaks_keeps_what_it_made(error, tmp_path, whole):
    class Breaker:
        def observe(self, state, streams):
            if state.step == 6:
                raise error

    path = tmp_path / "a.h5"
    with pytest.raises(error):
        experiments.run(leaf(), path, observers=[Breaker()])
    with Timeline(path) as timeline:
        assert timeline.last_step == 6
    experiments.resume(path)
    assert_same(path, whole)


def test_a_run_killed_before_its_first_step_is_resumed(tmp_path, whole, monkeypatch):
    path = tmp_path / "a.h5"
    child = os.fork()
    if not child:
        monkeypatch.setattr(
            "vasc.timeline.Recorder.observe", lambda *_: os.kill(os.getpid(), signal.SIGKILL)
        )
        experiments.run(leaf(), path)
    os.waitpid(child, 0)
    with pytest.raises(TimelineError, match="no step"):
        experiments.verify(path)
    watcher = Watcher()
    experiments.resume(path, observers=[watcher])
    assert watcher.steps[0] == 0
    assert_same(path, whole)


def test_a_run_killed_after_its_last_step_is_marked_complete_and_not_continued(tmp_path, whole):
    path = shutil.copy(whole, tmp_path / "a.h5")
    with h5py.File(path, "r+") as file:
        file["complete"][0] = 0
    (difference,) = experiments.verify(path)
    assert (difference.column, difference.recorded, difference.repeated) == (
        "complete",
        "false",
        "true",
    )
    summary = experiments.resume(path)
    assert summary.stop_reason == "no_sources"
    assert experiments.verify(path) == []
    assert_same(path, whole)


@pytest.mark.parametrize(
    ("table", "column"),
    [
        (table, column)
        for table, names in {
            "frames": ["time", "motion", "outline_motion", "streams"],
            "nodes": ["birth", "parent", "origin", "source", "position", "material"],
            "segments": ["nodes", "birth", "kind"],
            "sources": ["birth", "cause", "position", "material"],
            "perceived": ["step", "source", "node"],
            "states": ["step", "what", "id", "state"],
            "events": ["step", "kind", "subject", "object"],
        }.items()
        for column in names
    ],
)
def test_one_changed_bit_is_found_in_every_column(table, column, tmp_path, whole):
    path = shutil.copy(whole, tmp_path / "a.h5")
    with h5py.File(path, "r+") as file:
        rows = file[f"{table}/{column}"]
        n_rows = len(rows)
        row = n_rows // 2
        content = rows[row : row + 1]
        content.view(np.uint8).reshape(-1)[0] ^= 1
        rows[row : row + 1] = content
        n_column = file["frames"].get(f"n_{table}")
        step = row if n_column is None else int(np.searchsorted(n_column[()], row, side="right"))
    found = experiments.verify(path)
    assert [(one.table, one.column, one.row, one.step) for one in found] == [
        (table, column, row, step)
    ]
    assert found[0].recorded != found[0].repeated


@pytest.mark.parametrize("column", ["ring_xy", "seeds"])
def test_another_blade_is_found(column, tmp_path, whole):
    path = shutil.copy(whole, tmp_path / "a.h5")
    with h5py.File(path, "r+") as file:
        file[f"blade/{column}"][0, 0] += 1e-12
    (found,) = experiments.verify(path)
    assert found[:4] == (0, "blade", column, 0)


def test_steps_that_are_no_longer_counted_are_found(tmp_path):
    path = tmp_path / "a.h5"
    experiments.run(leaf(), path, steps=12)
    with h5py.File(path, "r+") as file:
        file["committed"][0] = 8
    (found,) = experiments.verify(path)
    assert found == (8, "", "committed", -1, "8 steps", "13 steps")


def test_a_run_of_another_config_differs_first_where_it_begins_to(tmp_path, whole):
    path = shutil.copy(whole, tmp_path / "a.h5")
    with h5py.File(path, "r+") as file:
        config = json.loads(file["config/json"][()])
        config["placement"]["density"] *= 1.5
        text = json.dumps(config).encode()
        del file["config/json"]
        kind = h5py.string_dtype("utf-8", len(text))
        file["config"].create_dataset("json", data=np.array(text, dtype=kind))
    found = experiments.verify(path)
    assert len(found) > 10
    assert [one.step for one in found] == sorted(one.step for one in found)
    with Timeline(path) as timeline:
        with pytest.raises(TimelineError, match="config/json is not what was recorded"):
            _ = timeline.config
        births = timeline.table("sources", "birth")
    assert found[0].step <= births[0]


def test_what_cannot_be_written_is_refused_and_nothing_is_left(tmp_path):
    (tmp_path / "a.h5").write_bytes(b"mine")
    with pytest.raises(OutputError, match="exists"):
        experiments.run(leaf(), tmp_path / "a.h5")
    with pytest.raises(OutputError, match="does not exist"):
        experiments.run(leaf(), tmp_path / "nowhere" / "a.h5")
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [("a.h5", b"mine")]


def test_a_model_that_does_not_stand_leaves_no_file(tmp_path):
    text = CONFIG.format(kind="closed", growth="marginal", perceived="veins")
    text = text.replace("length = 20.0\n", "length = 20.0\nseeds = [[5.0, 5.0]]\n")
    with pytest.raises((OutlineError, ConfigError), match="seed"):
        experiments.run(load_text(text), tmp_path / "a.h5")
    assert list(tmp_path.iterdir()) == []


def test_given_sources_travel_with_the_run(tmp_path):
    (tmp_path / "sources.csv").write_text("x,y,birth\n0,10,1\n2,12,3\n-3,8,2\n")
    text = CONFIG.format(kind="closed", growth="none", perceived="veins")
    text = text.replace("final_length = 40.0\nlength_per_step = 1.0\n", "")
    head, _, tail = text.partition("[placement]")
    given = f'{head}[placement]\nkind = "given"\nfile = "sources.csv"\n[arrival]'
    text = given + tail.partition("[arrival]")[2]
    path = tmp_path / "a.h5"
    summary = experiments.run(load_text(text, folder=tmp_path), path, steps=5)
    assert summary.sources_placed == 3
    (tmp_path / "sources.csv").unlink()
    assert experiments.resume(path).stop_reason == "no_sources"
    assert experiments.verify(path) == []
    with Timeline(path) as timeline:
        assert timeline.config["placement"]["file"] == "sources.csv"
