"""Canalization recorded: read, continued from any step, repeated, and cut off by divergence."""

import shutil

import h5py
import numpy as np
import pytest
from timeline import canals
from timeline.synthetic import contents

from vasc import experiment
from vasc.cli.program import main
from vasc.config import load_text
from vasc.errors import RunError
from vasc.events import EventKind
from vasc.fields import FIELD_COLUMNS
from vasc.simulation import simulate
from vasc.streams import Streams
from vasc.timeline import Timeline, validate

DIVERGES = """
kind = "canalization"
[domain]
columns = 31
rows = 17
[veins]
lines = [[[5, 16]], [[25, 16]]]
[placement]
points = [[0, 4]]
[transport]
kind = "polar"
gain = 30.0
saturation = "none"
"""


@pytest.fixture(scope="module", params=canals.KINDS)
def kind(request):
    return request.param


@pytest.fixture(scope="module")
def whole(kind, tmp_path_factory):
    """A recorded run."""
    path = tmp_path_factory.mktemp("canals") / "whole.h5"
    summary = canals.record(path, kind)
    assert summary.stop_reason == "at_rest"
    assert summary.tissue.connected >= 2
    return path


def test_a_record_is_the_run_bit_for_bit(kind, whole):
    own = canals.config(kind)
    streams = Streams(own.parameters.seed, own.parameters.stream_names)
    n_states = 0
    with Timeline(whole) as timeline:
        for state in simulate(own.model(), streams):
            n_states += 1
            frame = timeline.frame(state.step)
            assert frame.time == state.time
            assert np.array_equal(frame.sources.ids, state.live)
            assert np.array_equal(frame.network.positions, state.network.positions)
            assert np.array_equal(timeline.stream_words(state.step), streams.state())
            for name in FIELD_COLUMNS:
                found, expected = (getattr(one.fields, name) for one in (frame, state))
                assert (found.dtype, found.tobytes()) == (expected.dtype, expected.tobytes())
        assert timeline.n_frames == n_states
        # all rounds have come, each once the walls were at rest
        is_placed = timeline.events["kind"] == EventKind.SOURCE_PLACED
        placed = timeline.events["step"][is_placed]
        assert len(placed) == 4
        assert len(np.unique(placed)) == 3


def test_a_record_is_sound_and_repeatable(whole):
    assert validate(whole) == []
    assert experiment.verify(whole) == []


def test_a_run_stopped_at_any_turn_goes_on_to_the_same_bytes(kind, whole, tmp_path):
    with Timeline(whole) as timeline:
        events, last = timeline.events, timeline.last_step
        turns = np.unique(events["step"])
    # before and at everything that happens, and in between
    steps = {1, last // 3, *turns.tolist(), *(turns - 1).tolist()}
    expected = contents(whole)
    for step in sorted(step for step in steps if 0 < step < last):
        path = tmp_path / f"{step}.h5"
        assert canals.record(path, kind, steps=step).steps == step
        assert canals.resume(path, kind).stop_reason == "at_rest"
        assert contents(path) == expected, step


def test_a_run_may_be_stopped_again_and_again(kind, whole, tmp_path):
    path = tmp_path / "run.h5"
    canals.record(path, kind, steps=1)
    while not experiment.resume(path, steps=9).stop_reason:
        pass
    assert contents(path) == contents(whole)
    assert validate(path) == []


@pytest.mark.parametrize("name", FIELD_COLUMNS)
def test_verify_finds_one_flipped_bit_of_each_field(whole, tmp_path, name):
    path = shutil.copy(whole, tmp_path / "run.h5")
    with Timeline(path) as timeline:
        size = timeline.opened.found.rows_a_step(name)
    with h5py.File(path, "r+") as file:
        value = np.array(file[f"fields/{name}"][20 * size + 7 : 20 * size + 8])
        value.view(np.uint8).reshape(-1)[-1] ^= 1
        file[f"fields/{name}"][20 * size + 7 : 20 * size + 8] = value
    found = experiment.verify(path)
    assert [one[:4] for one in found] == [(20, "fields", name, 7)]


@pytest.fixture(scope="module")
def diverged(tmp_path_factory):
    """A run that cannot go on."""
    path = tmp_path_factory.mktemp("diverged") / "run.h5"
    with pytest.raises(RunError, match="grows without bound"):
        experiment.run(load_text(DIVERGES), path)
    return path


def test_a_run_that_diverges_keeps_its_steps(diverged):
    assert validate(diverged) == []
    with Timeline(diverged) as timeline:
        assert timeline.n_frames > 5
        assert not timeline.is_complete
        assert timeline.stop_reason is None
        assert timeline.provenance[-1]["outcome"].startswith("failed: RunError: step")
        assert f"step {timeline.n_frames}: flux" in timeline.provenance[-1]["outcome"]
        assert np.isfinite(timeline.fields().flux).all()
    assert experiment.verify(diverged) == []


def test_a_run_that_diverges_does_so_again(diverged, tmp_path):
    path = shutil.copy(diverged, tmp_path / "run.h5")
    before = contents(path)
    with pytest.raises(RunError, match="grows without bound"):
        experiment.resume(path)
    assert contents(path) == before


def test_the_program_says_in_one_line_that_a_run_diverged(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "run.toml").write_text(DIVERGES)
    assert main(["run", "run.toml", "--no-figure", "-q"]) == 3
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.count("\n") == 1
    with Timeline("run.h5") as timeline:
        last = timeline.last_step
    assert said.err.startswith(f"run.h5: step {last + 1}: flux in closed loops grows without bound")
    assert said.err.endswith(f"all steps up to {last} are kept\n")
    assert main(["show", "run.h5", "--check"]) == 0
    assert main(["resume", "run.h5", "-q"]) == 3
