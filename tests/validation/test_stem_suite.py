"""Recorded stems: read by the checks, told by the command line, and the suite of the thesis."""

import json

import numpy as np
import pytest

from vasc.cli import main
from vasc.config import load, load_text
from vasc.errors import TimelineError
from vasc.experiment import run, verify
from vasc.timeline import Timeline, validate
from vasc.timeline.stems import elongated, recorded_stem
from vasc.validation.stem_phyllotaxis import check_connectivity
from vasc.validation.stem_phyllotaxis.reading import read_stem
from vasc.validation.stem_references import STEM_PATTERNS, StemPattern
from vasc.validation.stem_suite import config_of, grown, validate_stem
from vasc.validation.stem_transitions import swept_stem, thresholds

STEM = """kind = "stem"

[domain]
radius = 12.0

[placement]
divergence = 137.5
rise = 10.0
primordia = 26
plastochron = 5
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A recorded stem whose primordia are connected with the next one."""
    path = tmp_path_factory.mktemp("stem") / "stem.h5"
    run(load_text(STEM), path)
    return path


def test_a_recorded_stem_is_sound_and_repeats(path):
    assert validate(path) == []
    assert verify(path) == []


def test_a_stem_is_read_as_it_was_recorded(path):
    with Timeline(path) as timeline:
        graph = read_stem(timeline)
        assert graph.ring.tolist() == list(range(int(np.ceil(2 * np.pi * 12))))
        heights = graph.positions[graph.primordia, 2]
        np.testing.assert_allclose(heights, 10.0 * np.arange(1, 27))
        assert (graph.rise, graph.radius, graph.per_level) == (10.0, 12.0, 1)
        assert graph.radius_range is None
        report = check_connectivity(graph)
    assert report.pair == (1, 1)
    assert report.fraction == 1.0
    assert report.passed


def test_a_stem_whose_radius_changes_is_judged_by_its_middle(tmp_path):
    wider = STEM.replace("radius = 12.0", "radii = [[0.0, 10.0], [100.0, 20.0]]")
    run(load_text(wider), tmp_path / "wider.h5", steps=60)
    with Timeline(tmp_path / "wider.h5") as timeline:
        graph = read_stem(timeline)
        # primordia are at heights of 10, 20, ...; eleven have appeared
        assert len(graph.primordia) == 11
        assert graph.radius == pytest.approx(16.0)
        assert graph.radius_range == pytest.approx((11.0, 20.0))


def test_internodes_grow_in_pictures_alone(path):
    with Timeline(path) as timeline:
        stem = recorded_stem(timeline)
        grown_up = elongated(stem, [(0.0, 0.0), (0.5, 0.8), (1.0, 1.0)])
        assert elongated(stem, []) is stem
    top = stem.positions[:, 2].max()
    order = np.argsort(stem.positions[:, 2])
    before, after = stem.positions[order, 2], grown_up.positions[order, 2]
    assert (np.diff(after) >= 0.0).all()
    np.testing.assert_allclose(np.interp(0.5 * top, before, after), 0.8 * top, rtol=0.01)
    assert after[-1] == pytest.approx(top)
    np.testing.assert_array_equal(grown_up.positions[:, :2], stem.positions[:, :2])


def test_a_leaf_is_no_stem(tmp_path):
    run(load("arabidopsis-first-leaf"), tmp_path / "leaf.h5", steps=3)
    with (
        Timeline(tmp_path / "leaf.h5") as timeline,
        pytest.raises(TimelineError, match="is no stem, but a run of the kind 'areole'"),
    ):
        read_stem(timeline)


def test_the_command_line_tells_the_pair(path, capsys):
    assert main(["check", "connectivity", str(path)]) == 0
    shown = capsys.readouterr().out
    assert "connected                 (1, 1)" in shown
    assert "stem.h5: pass" in shown
    assert main(["check", "connectivity", str(path), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    wanted = {"divergence", "rise", "radius", "ratio", "primordia", "links", "pair", "fraction"}
    assert wanted | {"predicted", "exceptions", "pass"} <= set(told)
    assert told["divergence"] == pytest.approx(137.5)
    assert told["pass"] is True


def test_a_suite_that_is_none_is_refused(capsys):
    assert main(["validate", "roots"]) == 2
    assert "must be one of growth, stem, transitions" in capsys.readouterr().err


@pytest.mark.parametrize(("factor", "turn"), [(1.0, -1.0), (2.0, 1.0), (0.5, 1.0)])
def test_mirrored_and_rescaled_stems_connect_alike(factor, turn):
    # R/H = 2.5; the apex rises as far in a step as in the stem it is the twin of
    twin = StemPattern(turn * 137.5, factor * 50.0, factor * 20.0, (2, 3), round(10 * factor), "")
    report = grown(config_of(twin))
    assert report.pair == report.prediction.pair == (2, 3)
    assert report.fraction == 1.0


def test_veins_along_the_surface_fail(path):
    # distances along the surface predict, and make, (1, 2) where the thesis has (1, 1)
    tables = config_of(STEM_PATTERNS[-6])
    assert tables["domain"]["radius"] == 12.0
    report = grown(tables | {"perception": {"metric": "surface"}})
    assert not report.passed
    assert report.pair != (1, 1)


@pytest.mark.parametrize(
    ("divergence", "radius", "pair", "plastochron"),
    [
        (137.5, 28.0, (2, 3), 10),
        (77.96, 30.0, (1, 4), 5),
        (151.14, 45.0, (2, 5), 5),
        (64.08, 38.0, (1, 5), 5),
    ],
)
def test_stems_that_no_paper_shows_connect_as_predicted(divergence, radius, pair, plastochron):
    pattern = StemPattern(divergence, radius, 10.0, pair, plastochron, "")
    report = grown(config_of(pattern))
    # far from both thresholds
    assert report.interval.margin(radius / 10.0) > 0.2
    assert report.pair == report.prediction.pair == pair
    assert report.fraction == 1.0


@pytest.mark.slow
def test_the_stems_of_the_thesis_connect_as_it_says():
    suite = validate_stem()
    assert len(suite["checks"]) == 14
    assert [check["name"] for check in suite["checks"] if not check["pass"]] == []


def test_one_stem_of_the_sweep_connects_as_predicted():
    stem = swept_stem(137.5, 1.2)
    assert stem.pair == stem.predicted == (1, 1)
    assert stem.fraction == 1.0
    found = [(one["low"], one["pair"]) for one in thresholds(137.5)]
    assert found[2] == (pytest.approx(1.724, abs=0.001), [2, 3])


@pytest.mark.slow
def test_the_sweep_over_radius_and_rise_finds_the_predicted_pairs(tmp_path, capsys):
    picture = tmp_path / "transitions.png"
    assert main(["validate", "transitions", "-o", str(picture)]) == 0
    assert picture.stat().st_size > 10_000
    assert capsys.readouterr().out.count("pass") == 27
