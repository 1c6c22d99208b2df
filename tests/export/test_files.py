"""Files appear whole or not at all, and replace nothing that is not theirs."""

import json
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from reference.export_configs import KINDS, LEAF

from vasc.cli import main
from vasc.config import load
from vasc.errors import OutputError, VascError
from vasc.experiment import run
from vasc.export import DOCUMENTS, MESH_SUFFIXES, SUFFIXES, export, specimen
from vasc.timeline import Timeline

trimesh = pytest.importorskip("trimesh")

ONE_FILE = [*DOCUMENTS, ".swc", ".mtg", *MESH_SUFFIXES]


@pytest.mark.parametrize("suffix", [*ONE_FILE, ".pvd"])
def test_a_file_says_of_what_it_is(runs, suffix, tmp_path):
    content = export(runs.open, tmp_path / f"a{suffix}", 30).read_bytes()
    for said in (b"open.h5", b"step 30", b"in um; D, the segment length of the model, is 4"):
        if suffix == ".pvd":
            said = said.replace(b"step 30", b"steps 0 to 30")
        assert said in content


@pytest.mark.parametrize("suffix", ONE_FILE)
def test_two_exports_are_the_same_bytes(runs, suffix, tmp_path):
    first = export(runs.open, tmp_path / f"a{suffix}", 30).read_bytes()
    assert export(runs.open, tmp_path / f"b{suffix}", 30).read_bytes() == first
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("suffix", ONE_FILE)
def test_a_file_is_replaced_when_forced_alone(runs, suffix, tmp_path):
    file = tmp_path / f"a{suffix}"
    file.write_text("mine")
    with pytest.raises(OutputError, match="exists already; use --force"):
        export(runs.open, file)
    assert file.read_text() == "mine"
    export(runs.open, file, force=True)
    assert file.read_bytes() != b"mine"
    assert [path.name for path in tmp_path.iterdir()] == [file.name]


def test_a_folder_is_replaced_when_forced_and_an_older_export_alone(runs, tmp_path):
    folder = export(runs.open, tmp_path / "a.csv", 10)
    young = (folder / "nodes.csv").read_text()
    with pytest.raises(OutputError, match="the folder exists already; use --force"):
        export(runs.open, folder)
    assert (folder / "nodes.csv").read_text() == young
    export(runs.open, folder, force=True)
    assert len((folder / "nodes.csv").read_text()) > len(young)
    (folder / "notes.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"holds 'notes.txt', which is no part of an export"):
        export(runs.open, folder, force=True)
    assert (folder / "notes.txt").read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_a_series_replaces_no_folder_that_is_not_its_own(runs, tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "thesis.tex").write_text("mine")
    for force in (False, True):
        with pytest.raises(OutputError, match="the folder"):
            export(runs.open, tmp_path / "a.pvd", force=force)
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    export(runs.open, tmp_path / "b.pvd", every=30)
    export(runs.open, tmp_path / "b.pvd", every=40, force=True)
    named = (tmp_path / "b.pvd").read_text()
    assert all(path.name in named for path in (tmp_path / "b").iterdir())


def test_a_file_where_a_folder_should_be_is_kept(runs, tmp_path):
    for name, other in (("a.csv", "a.csv"), ("b.pvd", "b")):
        (tmp_path / other).write_text("mine")
        with pytest.raises(OutputError, match="a folder of that name is to be written"):
            export(runs.open, tmp_path / name, force=True)
        assert (tmp_path / other).read_text() == "mine"
    (tmp_path / "c.svg").mkdir()
    with pytest.raises(OutputError, match="is a folder"):
        export(runs.open, tmp_path / "c.svg", force=True)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_nothing_is_left_when_the_step_is_wrong(runs, suffix, tmp_path):
    with pytest.raises(VascError, match="step 9999 is not recorded"):
        export(runs.open, tmp_path / f"a{suffix}", 9999)
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_left_when_writing_fails(runs, tmp_path, monkeypatch):
    from vasc.export import files

    def fail(*_, **__):
        raise OSError("disk full")

    monkeypatch.setattr(files, "write_series", fail)
    monkeypatch.setattr(files, "write_tables", fail)
    monkeypatch.setattr(files, "publish", fail)
    for suffix in (".pvd", ".csv", ".wkt"):
        with pytest.raises((OSError, OutputError), match="disk full"):
            export(runs.open, tmp_path / f"a{suffix}")
    assert list(tmp_path.iterdir()) == []


def test_an_older_folder_is_back_when_its_place_cannot_be_taken(runs, tmp_path, monkeypatch):
    folder = export(runs.open, tmp_path / "a.csv", 10)
    nodes = (folder / "nodes.csv").read_text()
    rename = Path.rename

    def fail(self, target):
        if target == folder and (self / "nodes.csv").read_text() != nodes:
            raise OSError("not now")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", fail)
    with pytest.raises(OutputError, match=r"a\.csv: cannot be written: not now"):
        export(runs.open, folder, force=True)
    assert (folder / "nodes.csv").read_text() == nodes
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_a_link_to_a_folder_stays_one(runs, tmp_path):
    folder = export(runs.open, tmp_path / "a.csv", 10)
    link = tmp_path / "b.csv"
    link.symlink_to(folder)
    young = (folder / "nodes.csv").read_text()
    export(runs.open, link, force=True)
    assert link.is_symlink()
    assert len((folder / "nodes.csv").read_text()) > len(young)
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("suffix", [".graphml", ".svg", ".vtp", ".geojson", ".mtg"])
def test_a_strange_title_breaks_no_file(runs, suffix, tmp_path):
    (tmp_path / "a.toml").write_text(
        LEAF.format(**KINDS["open"]).replace("A leaf --", r"A\n\u0001\u001b]--> <!-- \ufffe")
    )
    run(load(str(tmp_path / "a.toml")), tmp_path / "--a.h5", steps=20)
    file = export(tmp_path / "--a.h5", tmp_path / f"a{suffix}")
    assert b"\x01" not in file.read_bytes()
    if suffix in (".graphml", ".svg", ".vtp"):
        ElementTree.parse(file)
    elif suffix == ".geojson":
        json.loads(file.read_text())
    else:
        lines = file.read_text().splitlines()
        assert lines[3] == "CODE:\tFORM-A"


def test_options_go_with_their_formats_alone(runs, tmp_path):
    with pytest.raises(OutputError, match=r"--every is for a series, \.pvd"):
        export(runs.open, tmp_path / "a.vtp", every=3)
    with pytest.raises(OutputError, match=r"--spanning-tree is for trees, \.swc, \.mtg"):
        export(runs.open, tmp_path / "a.svg", spanning_tree=True)


@pytest.mark.parametrize("suffix", MESH_SUFFIXES)
def test_veins_in_relief_are_closed_tubes(runs, suffix, tmp_path):
    with Timeline(runs.closed) as timeline:
        found = specimen(timeline)
    read = trimesh.load(export(runs.closed, tmp_path / f"a{suffix}"), force="mesh", process=False)
    assert read.is_watertight
    assert read.volume > 0.0
    axes = [2, 0, 1] if suffix in (".glb", ".gltf") else [0, 1, 2]
    low, high = read.bounds[:, axes]
    widest = found.widths.max() / 2.0
    assert (low[:2] <= found.positions.min(axis=0)).all()
    assert (high[:2] <= found.positions.max(axis=0) + widest + 1e-3).all()
    # half of a tube is above the blade; its corners are on a circle, one of them upward or beside
    assert high[2] == pytest.approx(widest, rel=0.08)
    assert low[2] == pytest.approx(-high[2], rel=1e-3)
    # a cylinder of every segment, with eight sides
    octagon = 2.0 * np.sqrt(2.0)
    expected = (octagon * (found.widths / 2.0) ** 2 * found.lengths).sum()
    assert read.volume == pytest.approx(expected, rel=0.1)


def test_without_trimesh_the_extra_is_named(runs, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(VascError, match=r"vasc\[mesh\]"):
        export(runs.open, tmp_path / "a.gltf")
    assert list(tmp_path.iterdir()) == []


def test_the_page_and_the_help_name_every_suffix(capsys):
    page = (Path(__file__).resolve().parents[2] / "docs" / "exports.md").read_text()
    table = "".join(line for line in page.splitlines() if line.startswith("| `."))
    assert {word.strip("`") for word in re.findall(r"`\.\w+`", table)} >= set(SUFFIXES)
    assert main(["export", "--help"]) == 0
    words = set(re.findall(r"\w+", capsys.readouterr().out))
    assert {suffix[1:] for suffix in SUFFIXES} <= words


def test_a_drawing_can_be_the_blade_of_another_run(runs, tmp_path):
    export(runs.open, tmp_path / "leaf.svg")
    text = LEAF.format(**KINDS["open"])
    domain = 'file = "leaf.svg"\nattachment = "origin"'
    (tmp_path / "again.toml").write_text(text.replace('shape = "ovate"', domain))
    run(load(str(tmp_path / "again.toml")), tmp_path / "again.h5", steps=1)
    with Timeline(tmp_path / "again.h5") as again, Timeline(runs.open) as first:
        areas = [timeline.frame(0).blade.area for timeline in (again, first)]
    assert areas[0] == pytest.approx(areas[1], rel=1e-6)
