"""A tissue cut from a recorded leaf: its config is complete, and runs."""

import numpy as np
import pytest
from reference.stem_run import recorded_in

from vasc.cli import main
from vasc.config import load, load_text
from vasc.errors import OutputError, VascError
from vasc.experiment import run
from vasc.export import export_tissue, tissue_config
from vasc.timeline import Timeline

CELL = 2.0
LEAF = """kind = "closed"
[domain]
shape = "ovate"
length = 40.0
[growth]
kind = "none"
[placement]
kind = "darts"
density = 0.02
birth_distance_sources = 6.0
birth_distance_veins = 6.0
[arrival]
kill_distance = 1.0
[stop]
steps = 12
"""


@pytest.fixture(scope="module")
def leaf(tmp_path_factory):
    """Give the timeline of a small leaf with live sources."""
    path = tmp_path_factory.mktemp("leaf") / "leaf.h5"
    run(load_text(LEAF, name="leaf"), path)
    return path


def test_the_config_runs_and_is_the_leaf(leaf, tmp_path, capsys):
    file = tmp_path / "tissue.toml"
    arguments = ["export", str(leaf), "-o", str(file), "--step", "10", "--cell", "2"]
    assert main(arguments) == 0
    text = file.read_text()
    assert text.startswith("# A tissue cut from leaf.h5 at step 10 by vasc ")
    assert "# Cells are 2 D of that run wide" in text
    made = load(file)
    tissue = made.model().tissue
    with Timeline(leaf) as timeline:
        frame = timeline.frame(10)
        blade, places, sources = frame.blade, frame.positions, frame.sources.positions
        n_live = frame.sources.n_sources
    assert tissue.blade.area * CELL**2 == pytest.approx(blade.area, rel=1e-3)
    assert tissue.n_cells == pytest.approx(blade.area / CELL**2, abs=2)
    # every node of the leaf lies in a vein, or simplified lines pass it by
    cells = np.concatenate(made.parameters.veins.cells(tissue))
    near = np.hypot(*(places[:, None] / CELL - tissue.positions[cells]).T).min(axis=0)
    assert near.max() < 1.2
    points = np.array(made.parameters.placement.points)
    assert 0 < len(points) <= n_live
    assert (np.hypot(*(points[:, None] - sources / CELL).T).min(axis=0) < 1e-3).all()
    summary = run(made, tmp_path / "tissue.h5")
    assert summary.stop_reason == "at_rest"


def test_every_step_of_the_leaf_can_be_cut(leaf):
    with Timeline(leaf) as timeline:
        for step in range(timeline.last_step + 1):
            load_text(tissue_config(timeline, step), name="tissue").model()


def test_what_cannot_be_cut_is_refused(leaf, tmp_path, capsys):
    with pytest.raises(OutputError, match=r"not one of \.toml"):
        export_tissue(leaf, tmp_path / "tissue.json")
    with pytest.raises(VascError, match=r"cell = -1: must be a width greater than 0"):
        export_tissue(leaf, tmp_path / "tissue.toml", cell=-1.0)
    with pytest.raises(VascError, match=r"cells of 0\.01 D: domain\.blade\.length"):
        export_tissue(leaf, tmp_path / "tissue.toml", cell=0.01)
    stem = recorded_in(tmp_path)
    with pytest.raises(VascError, match="the run of a stem"):
        export_tissue(stem, tmp_path / "tissue.toml")
    assert main(["export", str(stem), "-o", str(tmp_path / "s.ply"), "--cell", "2"]) == 2
    assert "--cell is for a tissue" in capsys.readouterr().err
    assert not (tmp_path / "tissue.toml").exists()


def test_a_tissue_without_live_sources_warns_on_export_and_as_it_runs(leaf, tmp_path, capsys):
    file, output = tmp_path / "tissue.toml", tmp_path / "tissue.h5"
    with Timeline(leaf) as timeline:
        n_live = [timeline.frame(k).sources.n_sources for k in range(timeline.last_step + 1)]
    empty = n_live.index(0)
    assert main(["export", str(leaf), "-o", str(file), "--step", str(empty)]) == 0
    said = capsys.readouterr().err
    assert said.startswith(f"warning: {file}: no live source of that step")
    assert "--step" in said
    assert main(["run", str(file), "-o", str(output), "--no-figure"]) == 0
    assert "warning: placement.points is empty: no source appears" in capsys.readouterr().err
    alive = int(np.argmax(n_live))
    assert main(["export", str(leaf), "-o", str(file), "--step", str(alive), "--force"]) == 0
    assert "warning" not in capsys.readouterr().err
