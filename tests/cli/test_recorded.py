"""Verbs that read a recorded run: figures as scripts rely on them, and as people read them."""

import csv
import io
import json
import shutil
import sys

import h5py
import pytest
from PIL import Image
from reference.stem_run import STEM

from vasc.cli import main
from vasc.timeline import Timeline


@pytest.fixture(scope="module")
def leaf(recorded):
    """Give the recorded run."""
    return str(recorded / "leaf.h5")


def output(arguments, capsys, code=0):
    """Give what a verb writes."""
    assert main(arguments) == code
    said = capsys.readouterr()
    assert said.err == ""
    return said.out


def test_show_for_scripts_has_the_keys_that_are_promised(leaf, capsys):
    shown = json.loads(output(["show", leaf, "--json"], capsys))
    promised = "format, version, model, growth, seed, steps, time, complete, nodes, segments"
    promised += ", sources_placed, sources_active, events, wall_seconds, config"
    assert set(promised.split(", ")) <= set(shown)
    with Timeline(leaf) as timeline:
        frame = timeline.frame()
        expected = {
            "format": "vasc-timeline",
            "version": "1.0",
            "model": "closed",
            "growth": "marginal",
            "seed": 3,
            "steps": timeline.last_step,
            "time": float(timeline.last_step),
            "complete": True,
            "nodes": frame.network.n_nodes,
            "segments": frame.network.n_segments,
            "sources_active": 0,
            "events": timeline.events.counts(),
            "config": timeline.config,
        }
    assert {key: shown[key] for key in expected} == expected
    assert shown["sources_placed"] == shown["events"]["source_placed"]
    assert shown["wall_seconds"] > 0


def test_show_counts_the_sources_that_live(here, capsys):
    assert main(["run", "leaf.toml", "--steps", "12", "--no-figure", "-q"]) == 0
    shown = json.loads(output(["show", "leaf.h5", "--json"], capsys))
    with Timeline("leaf.h5") as timeline:
        assert shown["sources_active"] == timeline.frame().sources.n_sources > 0
    assert shown["complete"] is False
    assert "goes on" in output(["show", "leaf.h5"], capsys)


def test_show_for_people_says_what_it_is_and_how_it_was_made(leaf, capsys):
    text = output(["show", leaf], capsys)
    for part in ("A small leaf with loops", "closed", "marginal", "loop_closed", "sessions"):
        assert part in text
    assert "  density = 0.02\n" in text


def test_a_check_of_what_is_no_timeline_is_bad_input(leaf, tmp_path, capsys):
    (tmp_path / "text.h5").write_text("not a run")
    (tmp_path / "empty.h5").write_bytes(b"")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = [1, 2]
    for name, said in (
        ("text.h5", "is not an HDF5 file"),
        ("empty.h5", "is not an HDF5 file"),
        ("other.h5", "is an HDF5 file, but not a timeline"),
        (".", "is a folder"),
        ("none.h5", "no such file"),
        ("text.h5/x", "cannot be opened"),
    ):
        assert main(["show", str(tmp_path / name), "--check"]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert said in line


def test_a_check_of_a_damaged_timeline_ends_with_1(leaf, tmp_path, capsys):
    damaged = str(shutil.copy(leaf, tmp_path / "damaged.h5"))
    with h5py.File(damaged, "r+") as file:
        del file.attrs["format"]
    assert "not a timeline" in output(["show", damaged, "--check"], capsys, code=1)
    cut = tmp_path / "cut.h5"
    cut.write_bytes((tmp_path / "damaged.h5").read_bytes()[:2000])
    assert "truncated" in output(["show", str(cut), "--check"], capsys, code=1)


def test_a_folder_is_no_run(tmp_path, capsys):
    assert main(["show", str(tmp_path)]) == 2
    assert "is a folder" in capsys.readouterr().err


def test_a_check_passes_or_ends_with_1(leaf, tmp_path, capsys):
    assert "keeps to its specification" in output(["show", leaf, "--check"], capsys)
    bad = str(shutil.copy(leaf, tmp_path / "bad.h5"))
    with h5py.File(bad, "r+") as file:
        file["nodes/parent"][5] = 10**6
    text = output(["show", bad, "--check"], capsys, code=1)
    assert "nodes/parent" in text
    found = json.loads(output(["show", bad, "--check", "--json"], capsys, code=1))
    assert found["pass"] is False
    assert len(found["findings"]) == text.count("\n")
    assert main(["show", "none.h5", "--check"]) == 2
    assert "none.h5: no such file" in capsys.readouterr().err


def test_stats_for_scripts_have_the_keys_that_are_promised(leaf, capsys):
    stats = json.loads(output(["stats", leaf, "--json"], capsys))
    promised = "step, time, blade_length, blade_area, nodes, segments, components, cycles"
    promised += ", vein_length, vein_density, areoles, areole_area_mean, areole_area_cv"
    promised += ", free_ends, junction_degree, areole_circularity_median, areole_elongation_median"
    promised += ", areole_corners_mean, free_ends_per_areole, mst_ratio, density_x_sqrt_areole"
    promised += ", distance_to_vein_mean, bohn_residual_median, bohn_residual_shuffled"
    promised += ", loop_asymmetry, loop_asymmetry_shuffled, orders"
    assert set(promised.split(", ")) <= set(stats)
    assert stats["components"] == 1
    assert stats["cycles"] == stats["segments"] - stats["nodes"] + 1 > 0
    # 60 D of 4 um
    assert stats["blade_length"] == pytest.approx(240.0)
    young = json.loads(output(["stats", leaf, "--json", "--step", "10"], capsys))
    assert young["step"] == 10
    assert young["nodes"] < stats["nodes"]
    shown = dict(line.split(maxsplit=1) for line in output(["stats", leaf], capsys).split("\n")[:8])
    assert shown["nodes"] == f"{stats['nodes']:,}"
    assert set(stats["orders"]["1"]) == {"length", "segments", "width_mean"}


def test_a_step_that_is_not_recorded_is_refused(leaf, capsys):
    for verb in (["stats", leaf], ["render", leaf, "-o", "x.png"]):
        assert main([*verb, "--step", "9999"]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert "step 9999 is not recorded" in line


def test_events_are_the_same_in_every_dress(leaf, capsys):
    found = json.loads(output(["events", leaf, "--json"], capsys))
    rows = list(csv.DictReader(io.StringIO(output(["events", leaf, "--csv"], capsys))))
    table = output(["events", leaf], capsys).splitlines()
    assert found["found"] == len(found["events"]) == len(rows) == len(table) - 1
    assert [{key: str(value) for key, value in row.items()} for row in found["events"]] == rows
    for_people = [["-" if one == "-1" else one for one in row.values()] for row in rows]
    assert [line.split() for line in table[1:]] == for_people
    with Timeline(leaf) as timeline:
        events = timeline.events
        assert [row["step"] for row in found["events"]] == events["step"].tolist()
        assert [row["object"] for row in found["events"]] == events["object"].tolist()
        assert {row["kind"] for row in found["events"]} == set(events.counts())


def test_events_are_chosen_by_kind_step_and_number(leaf, capsys):
    everything = json.loads(output(["events", leaf, "--json"], capsys))["events"]
    kinds = {"loop_closed", "source_removed"}
    asked = [event for event in everything if event["kind"] in kinds and 20 <= event["step"] <= 40]
    assert len(asked) > 3
    chosen = ["--kind", "loop_closed", "--kind", "source_removed", "--from", "20", "--to", "40"]
    found = json.loads(output(["events", leaf, "--json", *chosen], capsys))
    assert found == {"found": len(asked), "events": asked}
    found = json.loads(output(["events", leaf, "--json", "--limit", "2", *chosen], capsys))
    assert found == {"found": len(asked), "events": asked[:2]}
    text = output(["events", leaf, "--limit", "2", *chosen], capsys)
    assert text.endswith(f"... and {len(asked) - 2} more\n")


def test_an_unknown_kind_of_event_is_refused_with_the_known(leaf, capsys):
    assert main(["events", leaf, "--kind", "loops"]) == 2
    assert "loop_closed" in capsys.readouterr().err


def test_the_lineage_of_a_node_leads_to_a_seed(leaf, capsys):
    found = json.loads(output(["lineage", leaf, "--node", "60", "--json"], capsys))
    with Timeline(leaf) as timeline:
        parents = timeline.table("nodes", "parent").tolist()
        assert found["birth"] == timeline.table("nodes", "birth")[60]
        assert found["source"] == timeline.table("nodes", "source")[60]
    chain, node = [], parents[60]
    while node >= 0:
        chain.append(node)
        node = parents[node]
    assert found["ancestors"] == chain
    assert found["parent"] == parents[60]
    assert found["seed"] == chain[-1]
    children = [node for node, parent in enumerate(parents) if parent == 60]
    assert set(children) <= set(found["descendants"])
    seed = json.loads(output(["lineage", leaf, "--node", "0", "--json"], capsys))
    assert seed["parent"] is None
    assert seed["source"] is None
    assert seed["seed"] == 0
    assert len(seed["descendants"]) == len(parents) - 1


def test_the_fate_of_a_source_is_what_the_events_say(leaf, capsys):
    found = json.loads(output(["lineage", leaf, "--source", "4", "--json"], capsys))
    with Timeline(leaf) as timeline:
        fate = timeline.lineage.fate_of(4)
        assert found["nodes"] == timeline.lineage.nodes_of(4).tolist() != []
    assert found["birth"] == fate.birth
    assert found["removed"] == fate.removed > fate.birth
    assert found["awaited_nodes"] == fate.tags.tolist()
    text = output(["lineage", leaf, "--source", "4"], capsys)
    assert f"removed            {fate.removed}\n" in text


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        ([], "give one of --node ID, --source ID, --areole ID"),
        (
            ["--node", "1", "--source", "1"],
            "--node and --source are questions of their own: give one",
        ),
        (["--node", "999999"], "no node 999999"),
        (["--source", "999999"], "no source 999999"),
    ],
)
def test_a_wrong_question_of_lineage_is_refused(leaf, arguments, part, capsys):
    assert main(["lineage", leaf, *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert part in line


def test_a_picture_is_drawn_once_and_replaced_when_forced(leaf, tmp_path, capsys):
    picture = tmp_path / "leaf.svg"
    arguments = ["render", leaf, "-o", str(picture), "--step", "20", "--color", "age"]
    assert "leaf.svg" in output(arguments, capsys)
    assert "<svg" in picture.read_text()
    picture.write_text("mine")
    assert main(arguments) == 2
    assert picture.read_text() == "mine"
    assert "exists already" in capsys.readouterr().err
    output([*arguments, "--force"], capsys)
    assert "<svg" in picture.read_text()


def test_a_picture_of_an_unknown_color_or_suffix_is_refused(leaf, tmp_path, capsys):
    for arguments in (["-o", str(tmp_path / "a.png"), "--color", "taste"], ["-o", "a.bmp"]):
        assert main(["render", leaf, *arguments]) == 2
        assert capsys.readouterr().err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_growth_is_drawn_between_the_steps_asked_for(leaf, tmp_path, capsys):
    picture = tmp_path / "growth.svg"
    arguments = ["render", leaf, "-o", str(picture), "--growth"]
    assert "growth.svg" in output([*arguments, "--step", "20", "--step", "0"], capsys)
    two = picture.read_text()
    assert "<svg" in two
    output([*arguments, "--force"], capsys)
    assert len(picture.read_text()) > len(two)
    assert main([*arguments, "--force", "--step", "9999"]) == 2
    assert "step 9999 is not recorded" in capsys.readouterr().err
    assert main(["render", leaf, "-o", str(tmp_path / "a.bmp"), "--growth"]) == 2
    assert "'.bmp'" in capsys.readouterr().err


def test_several_steps_are_drawn_side_by_side(leaf, tmp_path, capsys):
    sizes = []
    for name, steps in (("one.png", ["40"]), ("two.png", ["20", "40"])):
        chosen = [word for step in steps for word in ("--step", step)]
        output(["render", leaf, "-o", str(tmp_path / name), *chosen], capsys)
        with Image.open(tmp_path / name) as picture:
            sizes.append(picture.size)
    assert sizes[1][0] > 1.3 * sizes[0][0]


def test_a_film_is_made(leaf, tmp_path, capsys):
    film = tmp_path / "leaf.gif"
    assert "leaf.gif" in output(["animate", leaf, "-o", str(film), "--every", "30"], capsys)
    assert film.read_bytes().startswith(b"GIF8")


def test_a_run_verifies_and_a_changed_bit_is_found(leaf, tmp_path, capsys):
    assert "bit for bit" in output(["verify", leaf], capsys)
    assert json.loads(output(["verify", leaf, "--json"], capsys)) == {
        "differences": [],
        "pass": True,
    }
    bad = str(shutil.copy(leaf, tmp_path / "bad.h5"))
    with h5py.File(bad, "r+") as file:
        birth = int(file["nodes/birth"][50])
        value = file["nodes/position"][50, 1]
        file["nodes/position"][50, 1] = value * (1.0 + 2.0**-52)
    text = output(["verify", bad], capsys, code=1)
    assert f"first difference: step {birth}, nodes/position row 50: recorded" in text
    found = json.loads(output(["verify", bad, "--json"], capsys, code=1))
    assert found["pass"] is False
    (difference,) = found["differences"]
    assert (difference["table"], difference["column"]) == ("nodes", "position")
    assert (difference["row"], difference["step"]) == (50, birth)


@pytest.mark.parametrize("arguments", [["show"], ["show", "--json"]])
def test_showing_a_run_loads_nothing_heavy(leaf, arguments):
    import subprocess
    import sys

    program = (
        "import sys; from vasc.cli import main; main(sys.argv[1:]);"
        "heavy = {'scipy', 'numba', 'matplotlib', 'shapely'};"
        "print('loaded', *sorted(heavy & {name.partition('.')[0] for name in sys.modules}))"
    )
    words = [sys.executable, "-c", program, arguments[0], leaf, *arguments[1:]]
    ended = subprocess.run(words, capture_output=True, text=True, check=True)
    assert ended.stdout.splitlines()[-1] == "loaded"


def test_a_stem_is_drawn_unrolled_by_run_and_in_space_by_render(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "stem.toml").write_text(STEM)
    assert main(["run", "stem.toml", "--quiet"]) == 0
    assert main(["render", "stem.h5", "-o", "flat.png", "--unroll"]) == 0
    assert main(["render", "stem.h5", "-o", "solid.png"]) == 0
    flat = (tmp_path / "stem.png").read_bytes()
    assert (tmp_path / "flat.png").read_bytes() == flat
    assert (tmp_path / "solid.png").read_bytes() != flat
    for words in (
        ["render", "stem.h5", "-o", "a.png", "--growth"],
        ["render", "stem.h5", "-o", "a.png", "--growth", "--unroll"],
        ["render", "stem.h5", "-o", "a.png", "--color", "age"],
        ["animate", "stem.h5", "-o", "a.gif"],
    ):
        capsys.readouterr()
        assert main(words) == 2
        told = capsys.readouterr().err
        assert "Traceback" not in told
        assert 0 < told.count("\n") <= 4
    assert not (tmp_path / "a.png").exists()


def test_a_leaf_is_not_unrolled(recorded, tmp_path, capsys):
    words = ["render", str(recorded / "leaf.h5"), "-o", str(tmp_path / "a.png"), "--unroll"]
    assert main(words) == 2
    assert "only a stem can be unrolled" in capsys.readouterr().err
    assert not (tmp_path / "a.png").exists()


def test_a_run_is_exported_once_and_again_when_forced(leaf, tmp_path, capsys):
    for name in ("a.graphml", "a.csv", "a.pvd"):
        words = ["export", leaf, "-o", str(tmp_path / name), "--step", "20"]
        assert name in output(words, capsys)
        assert main(words) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert "exists already; use --force" in line
        written = output([*words, "--force", "--json"], capsys)
        assert json.loads(written) == {"files": [str(tmp_path / name)]}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["-o", "a.bmp"], "'.bmp' is not one of .csv"),
        (["-o", "a"], "'' is not one of .csv"),
        (["-o", "none/a.svg"], "the folder 'none' does not exist"),
        (["-o", "a.svg", "--every", "2"], "--every is for a series"),
        (["-o", "a.swc"], "--spanning-tree leaves the joins out"),
        (["-o", "a.vtp", "--step", "9999"], "step 9999 is not recorded"),
    ],
)
def test_a_wrong_export_is_refused_in_a_line(words, said, leaf, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["export", leaf, *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert list(tmp_path.iterdir()) == []


def test_a_missing_package_is_named_in_a_line(leaf, tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    assert main(["export", leaf, "-o", str(tmp_path / "a.obj")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert 'pip install "vasc[mesh]"' in line
    assert list(tmp_path.iterdir()) == []
