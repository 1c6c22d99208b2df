"""`vasc run` and `vasc resume`: files, summary, options."""

import json

import h5py
import numpy as np
import pytest

from vasc.cli import main
from vasc.timeline import Timeline


def names(folder):
    """Give what a folder holds."""
    return {path.name for path in folder.iterdir()}


def test_a_run_leaves_a_timeline_and_a_picture_named_after_the_config(here, capsys):
    assert main(["run", "leaf.toml"]) == 0
    assert names(here) == {"leaf.toml", "leaf.h5", "leaf.png"}
    assert (here / "leaf.png").read_bytes().startswith(b"\x89PNG")
    said = capsys.readouterr()
    # no terminal, no progress
    assert said.err == ""
    assert "v = 1 (margin speed over vein speed)" in said.out
    assert "rho b^2 = 0.5" in said.out
    for word in ("steps", "nodes", "segments", "0 left", "loop", "stalls", "wall time", "ended"):
        assert word in said.out
    with Timeline("leaf.h5") as timeline:
        assert timeline.is_complete
        assert timeline.config_toml == (here / "leaf.toml").read_text()
        assert f"steps                    {timeline.last_step}\n" in said.out
        assert timeline.units["segment"] == 4.0


def test_the_summary_for_scripts_agrees_with_the_file(here, capsys):
    assert main(["run", "leaf.toml", "-o", "a.h5", "--figure", "b.svg", "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    with Timeline("a.h5") as timeline:
        counts = timeline.events.counts()
        network = timeline.frame().network
        assert summary["steps"] == timeline.last_step
        assert summary["stop_reason"] == timeline.stop_reason == "no_sources"
    assert summary["complete"] is True
    assert summary["nodes"] == network.n_nodes
    assert summary["segments"] == network.n_segments
    assert summary["sources_placed"] == counts["source_placed"]
    assert summary["sources_left"] == 0
    assert summary["joins"] == counts["vein_joined"]
    assert summary["loops"] == counts["loop_closed"] > 0
    assert summary["loops"] == network.n_segments - network.n_nodes + 1
    assert summary["stalls_resolved"] == counts.get("stall_resolved", 0)
    assert summary["nodes_outside"] == 0
    assert summary["files"] == ["a.h5", "b.svg"]
    assert names(here) == {"leaf.toml", "a.h5", "b.svg"}


def test_a_quiet_run_says_nothing(here, capsys):
    assert main(["run", "leaf.toml", "--no-figure", "-q"]) == 0
    assert capsys.readouterr() == ("", "")
    assert names(here) == {"leaf.toml", "leaf.h5"}


def test_values_set_on_the_command_line_are_run_and_recorded(here):
    changes = ["--seed", "9", "--set", "growth.final_length=30", "--set", "title=Short: 30 D"]
    assert main(["run", "leaf.toml", "--no-figure", "-q", *changes]) == 0
    with Timeline("leaf.h5") as timeline:
        assert timeline.seed == timeline.config["seed"] == 9
        assert timeline.config["title"] == "Short: 30 D"
        assert timeline.frame().blade.length == 30.0
        assert "final_length = 30\n" in timeline.config_toml
        assert "# set outside the file: seed = 9\n" in timeline.config_toml
    assert main(["verify", "leaf.h5"]) == 0


def test_a_title_tells_which_values_it_was_not_given_for(here, capsys):
    def shown():
        assert main(["show", "leaf.h5"]) == 0
        return capsys.readouterr().out.splitlines()[0]

    def recorded():
        assert main(["show", "leaf.h5", "--json"]) == 0
        found = json.loads(capsys.readouterr().out)
        return found["config"]["title"], found["changed"]

    run = ["run", "leaf.toml", "--no-figure", "-q", "--force", "--set", "stop.steps=2"]
    assert main([*run, "--seed", "9", "--set", "kind=open"]) == 0
    title = "A small leaf with loops"
    assert shown() == f'leaf.h5: {title}, with stop.steps = 2, kind = "open"'
    assert recorded() == (title, ["stop.steps = 2", 'kind = "open"', "seed = 9"])
    assert main([*run, "--set", "title=A short run"]) == 0
    assert shown() == "leaf.h5: A short run"


def test_an_unchanged_config_keeps_its_title_and_text(recorded, capsys):
    assert main(["show", str(recorded / "leaf.h5")]) == 0
    assert capsys.readouterr().out.splitlines()[0].endswith(": A small leaf with loops")
    with Timeline(recorded / "leaf.h5") as timeline:
        assert timeline.config_toml == (recorded / "leaf.toml").read_text()


def test_a_file_is_replaced_when_forced(here):
    arguments = ["run", "leaf.toml", "-q", "--set", "growth.final_length=25"]
    assert main(arguments) == 0
    before = (here / "leaf.h5").stat().st_ino
    assert main(arguments) == 2
    assert (here / "leaf.h5").stat().st_ino == before
    assert main([*arguments, "--force", "--seed", "8"]) == 0
    with Timeline("leaf.h5") as timeline:
        assert timeline.seed == 8


def test_a_run_of_some_steps_is_resumed_to_the_same_tables(here, recorded, capsys):
    assert main(["run", "leaf.toml", "--steps", "17", "--no-figure"]) == 0
    assert "not finished; `vasc resume leaf.h5` goes on" in capsys.readouterr().out
    assert main(["verify", "leaf.h5"]) == 0
    assert main(["show", "leaf.h5", "--check"]) == 0
    capsys.readouterr()
    assert main(["resume", "leaf.h5", "--steps", "5", "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert (summary["steps"], summary["complete"]) == (22, False)
    assert main(["resume", "leaf.h5"]) == 0
    assert "no source is left" in capsys.readouterr().out
    with h5py.File("leaf.h5") as resumed, h5py.File(recorded / "leaf.h5") as whole:
        assert resumed["complete"][0] == whole["complete"][0] == 1
        columns = []
        for group in ("frames", "nodes", "segments", "sources", "perceived", "states", "events"):
            columns += [f"{group}/{name}" for name in whole[group]]
        for column in columns:
            np.testing.assert_array_equal(resumed[column][()], whole[column][()], column)
        assert len(columns) > 20


def test_resume_replaces_the_picture_of_the_step_it_goes_on_from(here, recorded, capsys):
    assert main(["run", "leaf.toml", "--steps", "17", "-q"]) == 0
    early = (here / "leaf.png").read_bytes()
    assert main(["resume", "leaf.h5", "--steps", "9", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["files"] == ["leaf.h5", "leaf.png"]
    assert main(["render", "leaf.h5", "-o", "step.png"]) == 0
    assert early != (here / "leaf.png").read_bytes() == (here / "step.png").read_bytes()
    assert main(["resume", "leaf.h5", "-q"]) == 0
    assert (here / "leaf.png").read_bytes() == (recorded / "leaf.png").read_bytes()


def test_resume_leaves_another_picture_of_that_name_alone(here, capsys):
    assert main(["run", "leaf.toml", "--steps", "17", "-q", "--no-figure"]) == 0
    (here / "leaf.png").write_bytes(b"a photograph")
    capsys.readouterr()
    assert main(["resume", "leaf.h5", "--steps", "2"]) == 0
    assert (here / "leaf.png").read_bytes() == b"a photograph"
    assert "leaf.png is left as it is" in capsys.readouterr().err
    assert main(["resume", "leaf.h5", "--steps", "2", "--figure", "leaf.png"]) == 2
    assert main(["resume", "leaf.h5", "--steps", "2", "--no-figure", "-q"]) == 0
    assert (here / "leaf.png").read_bytes() == b"a photograph"
    assert main(["resume", "leaf.h5", "--steps", "2", "--force", "-q"]) == 0
    assert (here / "leaf.png").read_bytes().startswith(b"\x89PNG")


def test_a_complete_run_is_left_alone(recorded, capsys):
    before = (recorded / "leaf.h5").read_bytes()
    assert main(["resume", str(recorded / "leaf.h5")]) == 0
    assert "is complete" in capsys.readouterr().out
    assert main(["resume", str(recorded / "leaf.h5"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["complete"] is True
    assert (recorded / "leaf.h5").read_bytes() == before


def test_the_last_step_of_a_config_ends_a_run(here, capsys):
    assert main(["run", "leaf.toml", "--set", "stop.steps=4", "--no-figure"]) == 0
    assert "the last step of the config was reached" in capsys.readouterr().out
    with Timeline("leaf.h5") as timeline:
        assert timeline.is_complete
        assert timeline.last_step == 4


def test_a_number_out_of_the_useful_range_is_warned_of(here, capsys):
    change = ["--set", "growth.length_per_step=20"]
    assert main(["run", "leaf.toml", "--no-figure", *change]) == 0
    said = capsys.readouterr()
    assert "v = 20 (margin speed over vein speed): the margin outruns the veins" in said.out
    assert said.err.startswith("warning: v = 20 is not below 6")


@pytest.mark.parametrize("verb", ["resume", "verify", "show", "events", "stats"])
def test_what_is_no_timeline_is_refused(verb, here, capsys):
    for name, content in (("none.h5", None), ("text.h5", b"text"), ("empty.h5", b"")):
        if content is not None:
            (here / name).write_bytes(content)
        assert main([verb, name]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert name in line


LOBED = """kind = "open"

[domain]
points = [[-1, 0], [1, 0], [12, 30], [2, 30], [0.5, 8], [-0.5, 8], [-2, 30], [-12, 30]]
length = 30.0

[placement]
kind = "darts"
density = 0.05
birth_distance_sources = 2.0
birth_distance_veins = 2.0

[arrival]
kill_distance = 1.0
"""


def test_veins_across_a_sinus_are_warned_of_and_confined(here, capsys):
    (here / "lobed.toml").write_text(LOBED)
    arguments = ["run", "lobed.toml", "--no-figure", "--force"]
    assert main(arguments) == 0
    said = capsys.readouterr()
    assert "nodes lie outside the blade" in said.err
    assert 'extension.kind = "confined" keeps veins in' in said.err
    assert main([*arguments, "--set", "extension.kind=confined"]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert "nodes outside the blade  0" in said.out
