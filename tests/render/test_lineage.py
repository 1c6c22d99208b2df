"""Pictures of lineage: colours, places and forks are those of the tables."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from vasc.config import load
from vasc.errors import VascError
from vasc.events import EventKind
from vasc.experiment import run
from vasc.render import draw_births, draw_genealogy, draw_survival
from vasc.render.births import MOST_BINS, bin_width
from vasc.render.genealogy import MOST_TREES, _draw_trees, _shown
from vasc.timeline import Genealogy, Timeline
from vasc.timeline.life_table import life_table, median_life


@pytest.fixture(scope="module")
def timeline(tmp_path_factory):
    """The first leaf of Arabidopsis until its first loops are split."""
    path = tmp_path_factory.mktemp("leaf") / "leaf.h5"
    run(load("arabidopsis-first-leaf"), path, steps=300)
    with Timeline(path) as opened:
        yield opened


def collections(axes, kind):
    return [each for each in axes.collections if type(each) is kind]


def test_every_whole_areole_is_filled_and_every_life_is_a_line(timeline):
    tree = timeline.lineage.genealogy()
    blade, trees = draw_genealogy(timeline).axes
    (filled,) = collections(blade, PolyCollection)
    assert len(filled.get_paths()) == len(tree.boundaries)
    forks, lives = collections(trees, LineCollection)
    assert len(lives.get_segments()) == tree.n_areoles
    assert len(forks.get_segments()) == int((tree.parents >= 0).sum())
    starts = sorted(line[0, 0] for line in lives.get_segments())
    assert starts == sorted(tree.births.tolist())


def test_a_loop_has_one_hue_and_its_parts_are_paler(timeline):
    from matplotlib.colors import rgb_to_hsv, to_rgb

    tree = timeline.lineage.genealogy()
    shown = _shown(tree)
    hsv = rgb_to_hsv([to_rgb(color) for color in shown.colors])
    for areole, parent in enumerate(tree.parents.tolist()):
        if parent >= 0:
            # colours are of 8 bits
            assert hsv[areole, 0] == pytest.approx(hsv[parent, 0], abs=0.03)
            assert hsv[areole, 1] < hsv[parent, 1]


def test_parts_stand_beside_each_other_and_what_was_split_in_their_middle(timeline):
    tree = timeline.lineage.genealogy()
    heights = _shown(tree).heights
    whole = np.flatnonzero(tree.splits < 0)
    assert len(np.unique(heights[whole])) == len(whole)
    for areole in np.flatnonzero(tree.splits >= 0).tolist():
        parts = heights[tree.parents == areole]
        assert heights[areole] == pytest.approx(parts.mean())


def test_of_many_loops_those_with_most_parts_are_shown():
    n_loops = MOST_TREES + 10
    parents = np.array([-1] * n_loops + [n_loops - 1] * 2, dtype=np.int32)
    steps = np.arange(n_loops + 2, dtype=np.int32)
    splits = np.full(n_loops + 2, -1, dtype=np.int32)
    splits[n_loops - 1] = n_loops
    tree = Genealogy(steps, parents, steps, splits, {})
    shown = _shown(tree)
    assert len(shown.loops) == MOST_TREES
    assert n_loops - 1 in shown.loops
    assert np.isnan(shown.heights).sum() == n_loops - MOST_TREES


def test_without_a_loop_there_is_no_genealogy(timeline):
    with pytest.raises(VascError, match="no loop is closed at step 50"):
        draw_genealogy(timeline, 50)


def test_every_vein_is_a_dot_where_and_when_it_was_born(timeline):
    births = timeline.lineage.births()
    above, below = draw_births(timeline).axes
    dots = np.concatenate([line.get_xydata() for line in above.lines if line.get_marker() == "o"])
    expected = np.stack([births["step"], births["height"]], axis=1)
    order = np.lexsort(dots.T), np.lexsort(expected.T)
    assert dots[order[0]] == pytest.approx(expected[order[1]])
    counted = timeline.events.counts()["loop_closed"]
    assert f"loop closed ({counted})" in [t.get_text() for t in below.get_legend().get_texts()]
    # no vein is born above the tip
    tip = next(line for line in above.lines if line.get_marker() == "None").get_xydata()
    assert (expected[:, 1] <= np.interp(expected[:, 0], *tip.T) + 1e-6).all()


def test_births_up_to_a_step_and_by_other_orders(timeline):
    orders = np.full(timeline.n_rows("nodes"), 3)
    above, _ = draw_births(timeline, 100, orders=orders, order_name="vein order").axes
    (dots,) = (line for line in above.lines if line.get_marker() == "o")
    assert dots.get_xdata().max() <= 100
    assert above.get_legend().get_title().get_text() == "vein order (veins)"


def test_numbers_of_small_trees_do_not_cover_each_other():
    # one loop in 200 parts, and the others whole
    n_loops, n_parts = MOST_TREES, 200
    parents = np.array([-1] * n_loops + [0] * n_parts, dtype=np.int32)
    steps = np.arange(len(parents), dtype=np.int32)
    splits = np.full(len(parents), -1, dtype=np.int32)
    splits[0] = n_loops
    shown = _shown(Genealogy(steps, parents, steps, splits, {}))
    at = np.sort(shown.heights[shown.loops])
    # a number is 5 pt high, and 6.25 inches are there for all
    assert np.diff(at).min() / np.nanmax(shown.heights) * 6.25 * 72.0 > 5.0


def test_no_two_loops_have_one_colour_and_shades_have_a_key(timeline):
    figure = draw_genealogy(timeline)
    shown = _shown(timeline.lineage.genealogy())
    assert len({shown.colors[loop] for loop in shown.loops}) == len(shown.loops)
    trees = figure.axes[1]
    said = [text.get_text() for text in trees.get_legend().get_texts()]
    deepest = int(timeline.lineage.genealogy().generations.max())
    assert said[0] == "loop itself"
    assert said[-1].startswith(f"after {deepest} split")
    assert "step" in trees.get_xlabel()
    assert trees.get_ylabel()


def test_of_more_loops_than_colours_each_has_its_own():
    steps = np.arange(MOST_TREES + 3, dtype=np.int32)
    none = np.full(len(steps), -1, dtype=np.int32)
    shown = _shown(Genealogy(steps, none, steps, none, {}))
    assert len({shown.colors[loop] for loop in shown.loops}) == MOST_TREES


@pytest.mark.parametrize("last", [0, 1, 59, 60, 61, 640, 2464, 10**6])
def test_spans_of_births_are_whole_round_numbers_of_steps(last):
    width = bin_width(last)
    assert str(width).rstrip("0") in {"1", "2", "5"}
    assert (last + 1) / width <= MOST_BINS
    assert width == 1 or (last + 1) / width > MOST_BINS / 2.5 - 1


def test_events_are_counted_by_whole_steps(timeline):
    _, below = draw_births(timeline).axes
    width = bin_width(timeline.last_step)
    assert f"in {width} steps" in below.get_ylabel()
    events = timeline.events
    steps = events["step"][events["kind"] == EventKind.LOOP_CLOSED]
    counted = {tuple(patch.get_data().values) for patch in below.patches}
    n_spans = timeline.last_step // width + 1
    assert tuple(np.bincount(steps // width, minlength=n_spans)) in {
        values[:n_spans] for values in counted
    }


def test_names_of_what_changes_stand_above_the_veins(timeline, monkeypatch):
    monkeypatch.setattr("vasc.render.births.SPANS", {EventKind.LOOP_CLOSED: "a loop"})
    above, _ = draw_births(timeline).axes
    names = [text for text in above.texts if text.get_text() == "a loop"]
    assert names
    for name in names:
        assert name.xy[1] == 1.0
        assert name.xyann[1] > 0.0


def test_survival_is_the_life_table_with_marks_of_censoring(timeline):
    (axes,) = draw_survival(timeline).axes
    table = timeline.lineage.life_table()
    (curve,) = axes.patches
    assert curve.get_data().values.tolist() == table["survival"].tolist()
    marks = [line for line in axes.lines if line.get_marker() == "|"]
    is_censored = table["censored"] > 0
    assert bool(marks) == is_censored.any()
    for line in marks:
        assert line.get_xdata().tolist() == table["age"][is_censored].tolist()
    said = [text.get_text() for text in axes.get_legend().get_texts()]
    assert f"median: {timeline.lineage.median_life().age} steps" in said


class Watched:
    """A timeline whose sources live as they are told."""

    path = "watched.h5"

    def __init__(self, births, deaths, last_step):
        self.lineage = self
        self.columns = np.array(births, dtype=np.int32), np.array(deaths, dtype=np.int32), last_step

    def life_table(self):
        return life_table(*self.columns)

    def median_life(self):
        return median_life(self.life_table())


def test_a_median_that_is_not_reached_is_said_and_the_censored_are_marked():
    (axes,) = draw_survival(Watched([0, 0, 0, 5], [3, -1, -1, -1], 10)).axes
    said = [text.get_text() for text in axes.get_legend().get_texts()]
    assert "median: not reached" in said
    (marks,) = (line for line in axes.lines if line.get_marker() == "|")
    assert marks.get_xydata().tolist() == [[5.0, pytest.approx(0.75)], [10.0, pytest.approx(0.75)]]


def test_without_a_source_there_is_no_survival():
    with pytest.raises(VascError, match="no source appeared"):
        draw_survival(Watched([], [], 10))


@pytest.mark.parametrize("n_parts", [2, 40, 2000])
def test_numbers_of_the_outermost_trees_are_whole(n_parts):
    # a loop in parts between two that are whole
    n_loops = 3
    parents = np.array([-1] * n_loops + [1] * n_parts, dtype=np.int32)
    steps = np.arange(len(parents), dtype=np.int32)
    splits = np.full(len(parents), -1, dtype=np.int32)
    splits[1] = n_loops
    tree = Genealogy(steps, parents, steps, splits, {})
    figure = Figure(figsize=(5.0, 5.0))
    axes = figure.add_axes((0.1, 0.2, 0.85, 0.7))
    _draw_trees(axes, _shown(tree), len(parents))
    figure.draw_without_rendering()
    edges = axes.get_window_extent()
    numbers = [text for text in axes.texts if text.get_text() in {"0", "1", "2"}]
    assert len(numbers) == n_loops
    for text in numbers:
        extent = text.get_bbox_patch().get_window_extent()
        assert edges.y0 <= extent.y0
        assert extent.y1 <= edges.y1
