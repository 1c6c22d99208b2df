"""Every script of the gallery draws its figure."""

import ast
import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest

FOLDER = Path(__file__).resolve().parent.parent / "paper_figures"
SCRIPTS = sorted(FOLDER.glob("*/fig_*.py"))
FAST = ["3_2", "3_3", "3_4", "3_5", "4_9", "4_10", "4_11", "4_12", "4_13"]
FAST += ["5_2", "5_3", "5_5", "5_6", "5_9"]
FAST += ["6_2", "6_4", "6_6", "6_7"]
SLOW = [path.stem.removeprefix("fig_") for path in SCRIPTS if path.parent.name == "runions_2008"]
SLOW = [number for number in SLOW if number not in FAST]
SMALL = {
    "areoles": 7,
    "cost": 20,
    "hit_map": 40,
    "hit_rates": 4,
    "many_sources": 22,
    "phases": 6,
    "sequential_leaf": 20,
}
"""Figures of canalization, and a size at which they take a second or two."""


def script(number):
    return FOLDER / "runions_2008" / f"fig_{number}.py"


def load(path, monkeypatch):
    """Import a script as Python does when it is run: with its folder on the path."""
    monkeypatch.syspath_prepend(str(path.parent))
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def canal_script(name, monkeypatch):
    return load(FOLDER / "canalization" / f"fig_{name}.py", monkeypatch)


def check_picture(path):
    pixels = matplotlib.image.imread(path)[:, :, :3]
    assert 300 <= max(pixels.shape) <= 1400
    ink = (pixels.min(axis=2) < 0.9).mean()
    assert 0.005 < ink < 0.95


@pytest.mark.parametrize("number", FAST)
def test_a_diagram_is_drawn(number, tmp_path, monkeypatch):
    output = tmp_path / "figure.png"
    load(script(number), monkeypatch).main(output)
    check_picture(output)


def test_every_figure_of_canalization_has_a_small_size():
    names = [path.stem.removeprefix("fig_") for path in (FOLDER / "canalization").glob("fig_*.py")]
    assert sorted(names) == sorted(SMALL)


@pytest.mark.parametrize("name", SMALL)
def test_a_figure_of_canalization_is_drawn(name, tmp_path, monkeypatch):
    output = tmp_path / "figure.png"
    canal_script(name, monkeypatch).main(output, SMALL[name])
    check_picture(output)


@pytest.mark.slow
@pytest.mark.parametrize("number", SLOW)
def test_leaves_and_stems_are_drawn(number, tmp_path, monkeypatch):
    output = tmp_path / "figure.png"
    load(script(number), monkeypatch).main(output)
    check_picture(output)


def test_a_script_is_run_as_the_gallery_says(tmp_path):
    root = FOLDER.parent
    run = subprocess.run(
        [sys.executable, str(script("4_13")), "-o", str(tmp_path / "a.png")],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(root)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    check_picture(tmp_path / "a.png")


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_a_script_begins_with_the_title_of_its_page(path):
    text = ast.get_docstring(ast.parse(path.read_text()))
    title, rule, blank, sentence = text.split("\n")[:4]
    assert rule == "=" * len(title)
    assert not blank
    assert sentence
    number = path.stem.removeprefix("fig_").replace("_", ".")
    assert title.startswith(f"Figure {number}: ") or path.parent.name != "runions_2008"


def test_the_gallery_names_every_script_and_no_other():
    text = (FOLDER / "README.md").read_text()
    named = re.findall(r"\((\w+/fig_\w+\.py)\)", text)
    assert sorted(named) == [path.relative_to(FOLDER).as_posix() for path in SCRIPTS]


def test_the_configs_of_the_gallery_exist():
    text = (FOLDER / "README.md").read_text()
    named = re.findall(r"\(\.\./configs/([\w-]+)\.toml\)", text)
    assert named
    known = {path.stem for path in (FOLDER.parent / "configs").glob("*.toml")}
    assert set(named) <= known


def test_the_space_colonization_step_splits_a_pair_of_points(monkeypatch):
    from_colonization = load(script("3_5"), monkeypatch).colonization()
    assert from_colonization.before.network.n_nodes == 6
    before, after = from_colonization.nearest, from_colonization.after
    # the top and the right point attract one node, and two the step after (section 3.1.3)
    assert before[0] == before[1]
    left = after.sources.positions
    gaps = ((left[:, None] - after.network.positions) ** 2).sum(axis=2)
    assert len(left) == 2
    assert len(set(gaps.argmin(axis=1).tolist())) == 2


def test_urquhart_keeps_what_the_exact_neighbourhood_excludes(monkeypatch):
    figure = load(script("4_13"), monkeypatch)
    nodes = list(figure.NODES.values())
    attracted = figure.attracted
    exact = attracted(figure.np.array(nodes), figure.SOURCE)
    approximate = attracted(figure.np.array(nodes), figure.SOURCE, "urquhart")
    assert approximate - exact == {list(figure.NODES).index("v")}


def test_a_leaf_trace_and_the_ring_meet_in_the_middle(monkeypatch):
    figure = load(script("6_2"), monkeypatch)
    states = figure.grown(
        "stem",
        domain={"radius": figure.RADIUS},
        placement={"divergence": 137.5, "rise": figure.RISE, "primordia": 1, "first_step": 2},
    )
    network = states[-1].network
    above = network.positions[network.positions[:, 2] > 0.0]
    assert np.allclose(np.sort(above[:, 2]), [1.0, 2.0, 3.0, 4.0, 5.0])


def test_growth_of_internodes_keeps_the_order_of_heights(monkeypatch):
    figure = load(script("6_6"), monkeypatch)
    heights = np.linspace(0.0, 1.0, 50)
    grown = figure.grow_map(heights)
    assert grown[0] == 0.0
    assert grown[-1] == 1.0
    lengths = np.diff(grown)
    assert (lengths > 0.0).all()
    # the younger, the shorter
    assert (np.diff(lengths) < 0.0).all()


@pytest.mark.parametrize("transport", ["pool", "facilitated"])
def test_a_strand_leads_to_the_sink_that_is_nearer(transport, monkeypatch):
    figure = load(script("4_9"), monkeypatch)
    for source, sink in (
        (figure.SOURCES["c"], figure.SINKS[0]),
        (figure.SOURCES["d"], figure.SINKS[1]),
    ):
        network = figure.experiment(transport, source)[-1].network
        new = network.segments[network.causes[network.segments[:, 1]] >= 0]
        # one strand without branches, that begins in the sink and ends in the source
        assert network.positions[new[0, 0]].tolist() == list(sink)
        assert network.positions[new[-1, 1]].tolist() == list(source)
        assert (new[1:, 0] == new[:-1, 1]).all()


def test_canals_are_poor_in_auxin_by_facilitated_diffusion_and_rich_by_a_pool(monkeypatch):
    figure = load(script("4_9"), monkeypatch)
    means = {}
    for transport in ("pool", "facilitated"):
        state = figure.experiment(transport, figure.SOURCES["c"])[-1]
        canal = state.tissue.nearest_cells(state.network.positions[state.network.causes >= 0])
        means[transport] = state.fields.concentration[canal].mean() / np.median(
            state.fields.concentration
        )
    assert means["facilitated"] < 0.5
    assert means["pool"] > 1.5


def test_walls_that_saturate_later_lead_to_fewer_ends(monkeypatch):
    figure = canal_script("areoles", monkeypatch)
    tissue = figure.tissue_in(figure.RING * 0.7, seed=2)
    veins = [tissue.margins[0][:-1]]
    source = int(tissue.nearest_cells([(0.0, 0.0)])[0])
    ends = []
    for ratio in (1, 256):
        transport = figure.FacilitatedDiffusion(gain=figure.GAIN, saturation=figure.GAIN / ratio)
        state = figure.settle(tissue, transport, veins, [source])
        ends.append(figure.strand_of(state, transport, source, veins).n_landings)
    assert ends[0] == 1
    assert ends[1] > 1


def test_the_spanning_tree_serves_all_sources(monkeypatch):
    figure = canal_script("many_sources", monkeypatch)
    edges, served = figure.spanning_tree(np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]]))
    found = {tuple(edge): count for edge, count in zip(edges.tolist(), served, strict=True)}
    assert found == {(0, 1): 3.0, (1, 2): 1.0, (1, 3): 1.0}


def test_the_phases_are_told_apart(monkeypatch):
    figure = canal_script("phases", monkeypatch)
    found = {at: figure.phase("facilitated", *at) for at in ((10.0, 1.0), (1e4, 1.0), (1e4, 16.0))}
    assert list(found.values()) == ["no canal", "one file", "wide"]
    assert figure.phase("facilitated", 10.0, 64.0) is None
