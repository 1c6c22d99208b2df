"""The verbs on a run of canalization: what they say before and after, and what they refuse."""

import json

import h5py
import numpy as np
import pytest

from vasc.cli import main
from vasc.timeline import Timeline

CANALS = """kind = "canalization"
seed = 3
title = "Three canals"

[domain]
columns = 13
rows = 9

[veins]
lines = [[[2, 8]], [[10, 8]]]

[placement]
points = [[4, 2], [9, 3], [1, 1]]
rounds = [1, 2, 2]

[transport]
kind = "facilitated"
"""


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    folder = tmp_path_factory.mktemp("canals")
    (folder / "canals.toml").write_text(CANALS)
    output = ["-o", str(folder / "canals.h5"), "--no-figure", "--quiet"]
    assert main(["run", str(folder / "canals.toml"), *output]) == 0
    return folder


@pytest.fixture
def canals(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "canals.toml").write_text(CANALS)
    return tmp_path


def test_a_run_says_what_it_runs_and_what_came_of_it(canals, capsys):
    assert main(["run", "canals.toml", "--no-figure", "--set", "background=0.25"]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    lines = said.out.splitlines()
    assert lines[0] == "canals: canalization, facilitated transport, seed 3"
    assert lines[1] == "  117 cells, 212 walls"
    # 9 bytes a cell, 24 a wall
    assert lines[2].startswith("  each step takes up to 6.1 kB of the file, 100 steps up to 614")
    assert lines[3].startswith("  A = 3000 (gain of the feedback): canals form")
    assert "saturation = 3000: a canal is about 1 cell wide" in lines[4]
    assert lines[5].startswith("  q = 0.25 (")
    found = dict(line.split("  ", 1) for line in lines[6:])
    with Timeline("canals.h5") as timeline:
        assert int(found["steps"]) == timeline.last_step
        time = f"{timeline.frame().time:.6g} turnover times of a wall"
        assert found["time"].strip() == time
        most = timeline.fields(-1).concentration.max()
        assert found["auxin"].strip() == f"0 to {most:.4g} Kγ/β"
    assert found["cells"].strip() == "117, with 212 walls between them"
    assert found["sources"].strip() == "3 placed, 3 connected to a vein"
    assert found["rounds unsettled"].strip() == found["vortices"].strip() == "0"
    assert "the tissue is at rest" in found["ended"]
    # what only leaves have
    assert not {"joins", "stalls resolved", "nodes outside the blade"} & set(found)


@pytest.mark.parametrize(
    ("transport", "said", "warned"),
    [
        (
            ["kind=polar", "gain=300.0", "saturation=30.0"],
            ["A = 300", "A / saturation = 10, saturation = 30: a canal is about 2.2 cells wide"],
            "",
        ),
        (["kind=pool"], ["A = 30", "P_tot = 10 (carriers of a cell)"], ""),
        (
            ["kind=polar", "gain=3.0", "saturation=none"],
            ["A = 3 ", "no saturation"],
            "warning: transport.saturation = 'none': flux in closed loops may grow without bound",
        ),
    ],
)
def test_a_run_names_the_numbers_of_its_model(canals, capsys, transport, said, warned):
    changes = [word for one in transport for word in ("--set", f"transport.{one}")]
    assert main(["run", "canals.toml", "--no-figure", "--steps", "2", *changes]) == 0
    written = capsys.readouterr()
    for words in said:
        assert words in written.out
    assert warned in written.err
    assert bool(warned) == bool(written.err)
    assert "not finished; `vasc resume canals.h5` goes on" in written.out


def test_the_summary_for_scripts_agrees_with_the_file(canals, capsys):
    assert main(["run", "canals.toml", "--no-figure", "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    with Timeline("canals.h5") as timeline:
        assert summary["steps"] == timeline.last_step
        assert summary["time"] == timeline.frame().time
        counts = timeline.events.counts()
    assert (summary["cells"], summary["walls"]) == (117, 212)
    assert summary["connected"] == counts["source_removed"] == 3
    assert summary["vortices"] == summary["unsettled"] == 0
    assert summary["stop_reason"] == "at_rest"
    assert "tissue" not in summary


def test_a_run_of_some_steps_is_resumed_to_the_same_fields(canals, recorded, capsys):
    assert main(["run", "canals.toml", "--no-figure", "-q", "--steps", "30"]) == 0
    assert main(["verify", "canals.h5", "-q"]) == 0
    assert main(["resume", "canals.h5", "--steps", "9", "-q"]) == 0
    assert main(["resume", "canals.h5"]) == 0
    assert "3 connected to a vein" in capsys.readouterr().out
    assert main(["show", "canals.h5", "--check"]) == 0
    with Timeline("canals.h5") as resumed, Timeline(recorded / "canals.h5") as whole:
        assert resumed.n_frames == whole.n_frames
        for step in range(whole.n_frames):
            for rows, expected in zip(resumed.fields(step), whole.fields(step), strict=True):
                np.testing.assert_array_equal(rows, expected)


def test_verify_names_the_step_the_field_and_the_row(canals, recorded, capsys):
    (canals / "run.h5").write_bytes((recorded / "canals.h5").read_bytes())
    with h5py.File("run.h5", "r+") as file:
        file["fields/flux"][20 * 212 + 7] += 1e-9
    assert main(["verify", "run.h5"]) == 1
    assert "first difference: step 20, fields/flux row 7: recorded" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["show"], ["Three canals", "canalization", "source_removed", "tissue is at rest"]),
        (["show", "--check"], ["keeps to its specification"]),
        (["events", "--kind", "canals_settled"], ["canals_settled  -        -"]),
        (["lineage", "--source", "0"], ["removed", "nearest_node"]),
        (["lineage", "--node", "3"], ["ancestors", "seed"]),
        (["stats"], ["vein_length", "components"]),
    ],
)
def test_the_other_verbs_know_the_run(recorded, capsys, arguments, words):
    verb, *options = arguments
    assert main([verb, str(recorded / "canals.h5"), *options]) == 0
    said = capsys.readouterr().out
    for word in words:
        assert word in said
    assert main([verb, str(recorded / "canals.h5"), *options, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)


def test_show_gives_the_size_of_the_tissue(recorded, capsys):
    assert main(["show", str(recorded / "canals.h5"), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["cells"], found["walls"]) == (117, 212)


def test_a_run_on_cells_has_no_growth_to_draw(recorded, tmp_path, capsys):
    path = str(recorded / "canals.h5")
    assert main(["render", path, "-o", str(tmp_path / "a.png"), "--growth"]) == 2
    assert "kind = 'canalization': has no blade that grows" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("domain.columns=2000000", "domain.columns = 2000000"),
        ("transport.gain=-1", "transport.gain = -1"),
        ("background=-1", "background = -1"),
    ],
)
def test_what_cannot_be_run_is_refused_by_its_key(canals, capsys, change, words):
    assert main(["run", "canals.toml", "--no-figure", "--set", change]) == 2
    said = capsys.readouterr()
    assert words in said.err
    assert "Traceback" not in said.err
    assert not (canals / "canals.h5").exists()


def test_a_tissue_that_the_disk_has_no_room_for_is_refused(canals, capsys, monkeypatch):
    monkeypatch.setattr("shutil.disk_usage", lambda path: (10**9, 10**9, 60_000))
    assert main(["run", "canals.toml", "--no-figure", "--large"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line == (
        "canals.h5: the disk has no room for it: each step of domain, 117 cells and 212 walls,"
        " takes up to 6,141 bytes, and 60,000 are free; at least 100 steps must fit"
    )
    assert not (canals / "canals.h5").exists()


def test_cells_show_no_sequence_of_a_leaf_and_say_so(recorded, capsys):
    assert main(["check", "sequence", str(recorded / "canals.h5")]) in (1, 2)
    said = capsys.readouterr()
    assert "unexpected" not in said.err


@pytest.mark.parametrize("change", ["tolerance=1e-12", "rest=1e-300", "until=1e12"])
def test_runs_that_would_hardly_end_are_refused_by_key(change, recorded, tmp_path, capsys):
    output = tmp_path / "run.h5"
    words = ["run", str(recorded / "canals.toml"), "-o", str(output), "--no-figure"]
    assert main([*words, "--set", f"settling.{change}"]) == 2
    said = capsys.readouterr().err
    assert f"settling.{change.partition('=')[0]}" in said
    assert not output.exists()


def test_a_run_that_diverged_is_not_said_to_go_on(tmp_path, capsys):
    diverging = CANALS.replace("columns = 13\nrows = 9", "columns = 31\nrows = 17")
    diverging = diverging.replace("[[2, 8]], [[10, 8]]", "[[5, 16]], [[25, 16]]")
    diverging = diverging.replace("[[4, 2], [9, 3], [1, 1]]\nrounds = [1, 2, 2]", "[[0, 4]]")
    diverging = diverging.replace('"facilitated"', '"polar"\ngain = 30.0\nsaturation = "none"')
    (tmp_path / "run.toml").write_text(diverging)
    output = tmp_path / "run.h5"
    words = ["run", str(tmp_path / "run.toml"), "-o", str(output), "--no-figure"]
    assert main([*words, "--quiet"]) == 3
    assert main(["show", str(output)]) == 0
    said = capsys.readouterr().out
    assert "with an error" in said
    assert "goes on" not in said


@pytest.mark.parametrize(
    ("name", "changes", "unit", "own", "lacking"),
    [
        (
            "up-the-gradient",
            ["domain.columns=6", "domain.rows=5", "times.recorded=10"],
            "Au/µm²",
            "60 s",
            ["sources", "rounds", "vortices", "nodes", "segments", "vein"],
        ),
        (
            "constant-production",
            ["domain.rows=11"],
            "K D²/D_c",
            "steps",
            ["sources", "rounds", "vortices"],
        ),
    ],
)
def test_models_without_sources_are_summed_up_in_their_own_words(
    tmp_path, capsys, name, changes, unit, own, lacking
):
    output = str(tmp_path / "run.h5")
    words = [word for change in changes for word in ("--set", change)]
    assert main(["run", name, "-o", output, "--no-figure", "--steps", "120", *words]) == 0
    ran = capsys.readouterr().out.partition(" a step")[0] + capsys.readouterr().out
    assert main(["resume", output]) == 0
    capsys.readouterr()
    assert main(["show", output]) == 0
    shown = capsys.readouterr().out.partition("\nevents")[0]
    assert unit in shown
    assert "turnover" not in ran + shown
    for word in lacking:
        assert not [line for line in shown.splitlines() if line.startswith(word)]
    assert "no source is to come" not in shown
    assert own.split(" ")[-1] in shown
    assert main(["show", output, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["auxin_unit"] == unit
    assert found["auxin"][0] <= found["auxin"][1]


@pytest.mark.parametrize("key", ["growth", "arrival"])
def test_a_table_of_other_models_is_to_be_removed(canals, capsys, key):
    assert main(["run", "canals.toml", "--no-figure", "--set", f"{key}.kind=none"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.endswith(
        f'unknown key; other models have {key}, kind "canalization" has none: remove the table'
        f" [{key}]"
    )


def test_loops_of_given_veins_are_areoles_and_no_sequence(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    ring = "[[2, 4], [11, 4], [11, 8]], [[2, 4], [2, 8], [11, 8]]"
    (tmp_path / "ring.toml").write_text(CANALS.replace("[[2, 8]], [[10, 8]]", ring))
    assert main(["run", "ring.toml", "--steps", "2", "--no-figure", "-q"]) == 0
    assert main(["stats", "ring.h5", "--step", "0", "--json"]) == 0
    counted = json.loads(capsys.readouterr().out)["areoles"]
    with Timeline("ring.h5") as timeline:
        tree = timeline.lineage.genealogy(0)
        assert tree.n_areoles == counted == 1
        assert (tree.births.tolist(), tree.parents.tolist()) == ([0], [-1])
    assert main(["check", "sequence", "ring.h5"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("ring.h5: is a run on a tissue")
