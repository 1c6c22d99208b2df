"""Stems and tissues are no larger than foreseen; what is large is told before it begins."""

from types import SimpleNamespace

import numpy as np
import pytest
from reference.stem_run import STEM

from vasc import experiment as experiments
from vasc.cli import main
from vasc.config import load, load_text
from vasc.config.expected import LARGE_MEMORY, ExpectedSize
from vasc.config.foreseen import foreseen, stem_size
from vasc.timeline.tissues import LEAST_STEPS, n_bytes_a_step

TISSUE = """kind = "canalization"
[domain]
kind = "{kind}"
columns = {n}
rows = {n}
[veins]
lines = [[[2.0, 2.0]]]
[placement]
kind = "given"
points = [[5.0, 5.0]]
[transport]
kind = "facilitated"
gain = 1e3
[stop]
steps = {steps}
"""
DOUBLING = """kind = "gottlieb"
doublings = 4
space = 8.0
longest = 2.0
[domain]
shape = "ovate"
length = 12.0
"""
DOUBLINGS = {
    "closest": DOUBLING,
    "in reach": DOUBLING.replace("longest", "reach = 40.0\nlongest"),
    "few spaces": DOUBLING.replace("space = 8.0", "space = 30.0"),
    "short segments": DOUBLING.replace("longest = 2.0", "longest = 0.5"),
}
STEMS = {
    "small": STEM,
    "wide": STEM.replace("radius = 12.0", "radius = 60.0").replace("= 8", "= 20"),
    "whorls": STEM.replace("primordia = 8", "primordia = 16\nper_level = 2"),
    "conical": STEM.replace("radius = 12.0", "radii = [[0.0, 20.0], [100.0, 10.0]]"),
    "short segments": STEM + "[extension]\nsegment_length = 0.5\n",
}


def with_memory(size, more):
    """Give a size of other memory."""
    return ExpectedSize(sources=1, nodes=1, memory=size + more, file=1)


@pytest.mark.parametrize("name", [*STEMS, *DOUBLINGS])
def test_a_run_is_no_larger_than_foreseen_and_no_less_than_a_twentieth(name, tmp_path):
    experiment = load_text((STEMS | DOUBLINGS)[name])
    size = foreseen(experiment.parameters, experiment.model())
    summary = experiments.run(experiment, tmp_path / "run.h5")
    file = (tmp_path / "run.h5").stat().st_size
    assert summary.nodes <= size.nodes <= 20 * summary.nodes
    assert summary.sources_placed <= size.sources
    assert file <= size.file <= 20 * file


def test_of_a_model_with_a_sentence_of_its_own_nothing_is_foreseen_but_the_program():
    size = foreseen(SimpleNamespace(kind="own"), object())
    assert (size.nodes, size.sources, size.is_large) == (0, 0, False)


def test_a_stem_of_more_primordia_or_longer_internodes_is_larger():
    def nodes(*pairs):
        text = STEM
        for old, new in pairs:
            assert old in text
            text = text.replace(old, new)
        return stem_size(load_text(text).parameters).nodes

    ring = 2.0 * np.pi * 12.0
    first = nodes()
    assert nodes(("primordia = 8", "primordia = 16")) == pytest.approx(2 * first - ring, rel=0.01)
    assert nodes(("rise = 10.0", "rise = 40.0")) == pytest.approx(2 * first - ring - 8, rel=0.01)


@pytest.mark.parametrize("kind", ["rectangular", "hexagonal", "voronoi"])
@pytest.mark.parametrize("steps", [5, 30])
def test_a_tissue_is_no_larger_than_foreseen(kind, steps, tmp_path):
    experiment = load_text(TISSUE.format(kind=kind, n=12, steps=steps))
    model = experiment.model()
    size = foreseen(experiment.parameters, model)
    assert size.cells == model.tissue.n_cells
    experiments.run(experiment, tmp_path / "tissue.h5")
    assert (tmp_path / "tissue.h5").stat().st_size <= size.file


def test_of_a_tissue_no_more_steps_are_counted_than_are_sure():
    experiment = load_text(TISSUE.format(kind="rectangular", n=12, steps=100_000))
    tissue = experiment.model().tissue
    size = foreseen(experiment.parameters, experiment.model())
    assert size.file < 2_100_000 + (LEAST_STEPS + 1) * n_bytes_a_step(144, tissue.n_walls)


@pytest.mark.parametrize("text", [STEM, TISSUE.format(kind="rectangular", n=12, steps=3)])
def test_what_memory_cannot_hold_is_refused_unless_asked_for(text, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("vasc.config.expected.memory_of_machine", lambda: 10**8)
    (tmp_path / "run.toml").write_text(text)
    run = ["run", str(tmp_path / "run.toml"), "-o", str(tmp_path / "run.h5"), "-q", "--no-figure"]
    assert main(run) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "144 cells" in line or "nodes and 8 sources" in line
    assert "at most 80% are allowed (--large runs it all the same)" in line
    assert not (tmp_path / "run.h5").exists()
    assert main([*run, "--large", "--steps", "1"]) == 0


def test_every_bundled_run_fits_a_machine_of_four_gigabytes():
    for name in ("stem-golden-5-8", "stem-lucas-7-11", "sequential-canals", "areole-canals"):
        experiment = load(name)
        assert foreseen(experiment.parameters, experiment.model()).memory < 3.2e9


@pytest.mark.parametrize(("more", "is_large"), [(-1, False), (0, True)])
def test_large_begins_at_a_gigabyte(more, is_large):
    assert with_memory(LARGE_MEMORY, more).is_large is is_large


@pytest.mark.parametrize("is_large", [False, True])
def test_a_large_run_says_so_before_it_begins(is_large, tmp_path, capsys, monkeypatch):
    if is_large:
        monkeypatch.setattr("vasc.config.expected.LARGE_FILE", 1000)
    (tmp_path / "run.toml").write_text(STEM)
    run = ["run", str(tmp_path / "run.toml"), "-o", str(tmp_path / "run.h5"), "--no-figure"]
    assert main([*run, "--steps", "1"]) == 0
    said = [line for line in capsys.readouterr().out.splitlines() if "of memory" in line]
    assert len(said) == is_large
    if is_large:
        assert said[0].startswith("  may have up to ")
        assert said[0].endswith("MB")
