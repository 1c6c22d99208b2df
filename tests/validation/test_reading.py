"""The story read from a recorded run, and what the report says of it."""

import json

import h5py
import numpy as np
import pytest

from vasc import Timeline, VascError, load, run
from vasc.network import Origin
from vasc.validation.arabidopsis import check_sequence, read_story
from vasc.validation.arabidopsis.features import mirror_distance, notch_depths
from vasc.validation.arabidopsis.loops import shortest_path
from vasc.validation.arabidopsis.reading import birth_distance, first_perceived, node_owners
from vasc.validation.arabidopsis.story import LoopStory

PROMISED = "events, order_ok, loops, symmetry, features, failures, pass, criteria, undecided"

DARTS = """kind = "closed"
seed = 3
title = "A small leaf that grows, with loops and halved segments"
reference = "none"

[domain]
shape = "ovate"
length = 20.0

[growth]
kind = "isogonic"
final_length = 60.0
length_per_step = 1.0

[placement]
kind = "darts"
density = 0.02
birth_distance_sources = 5.0
birth_distance_veins = 5.0

[refinement]
kind = "subdivision"

[arrival]
kill_distance = 1.0
"""


@pytest.fixture(scope="module")
def story(given):
    """Read the story of the leaf with given sources."""
    with Timeline(given) as timeline:
        return read_story(timeline)


@pytest.fixture(scope="module")
def darts(tmp_path_factory):
    """Run a leaf with sources at random."""
    folder = tmp_path_factory.mktemp("darts")
    (folder / "darts.toml").write_text(DARTS)
    run(load(folder / "darts.toml"), folder / "darts.h5")
    return folder / "darts.h5"


def test_births_places_and_neighbors_of_sources(story):
    births = [one.step for one in story.sources]
    assert births == [1, 80, 80, 110, 110, 140, 140, 170, 170, 200, 200]
    assert story.sources[0].y == pytest.approx(59.5 / 60.0)
    assert story.sources[3].x == pytest.approx(-9.5 / 60.0)
    assert [one.side for one in story.sources[:3]] == [0, -1, 1]
    neighbors = [one.neighbors for one in story.sources[:5]]
    assert neighbors == [{0}, {1}, {1}, {1, 2}, {1, 3}]
    assert story.sources[1].drained_step > 80


def test_sources_near_the_outline_are_on_the_margin(story):
    assert [one.is_on_margin for one in story.sources] == [True] * 9 + [False] * 2


def test_loops_know_their_owners_areas_and_what_appears_inside(story):
    found = {loop.source: loop for loop in story.loops}
    assert set(found) == {3, 4, 5, 6, 7, 8}
    # own vein, midvein, and the vein below or above
    assert found[3].owners == {1, 2, 4}
    assert found[6].owners == {1, 3, 7}
    assert found[7].owners == {1, 6, 8}
    assert (found[3].first_source, found[4].first_source) == (9, 10)
    assert found[5].first_source is None
    # nine to nine and a half D wide, and ten or eleven segments of the midvein high
    areas = [loop.areas[story.last_step] for loop in story.loops]
    assert min(areas) > 9.0 * 10.0
    assert max(areas) < 9.5 * 11.0
    assert found[3].areas[story.last_step] > found[5].areas[story.last_step]
    # nothing grows: the tissue keeps its area
    assert len({round(area, 9) for area in found[3].areas.values()}) == 1


def test_a_leaf_without_growth_keeps_the_order_and_fails_the_areas(given):
    report = check_sequence(given)
    assert report.failures == ["C15", "C16"]
    assert report.undecided == ["C20"]
    assert report.order_ok is True
    assert not report.passed


def test_the_json_of_the_report(given):
    found = check_sequence(given).as_json()
    assert set(PROMISED.split(", ")) <= set(found)
    assert json.loads(json.dumps(found, allow_nan=False))
    assert found["loops"] == 3
    assert found["features"] == {"a": True, "b": True, "c": True, "d": False}
    assert found["symmetry"] > 0.0
    names = [event["name"] for event in found["events"]]
    assert names[:2] == ["tip_source", "midvein"]
    assert {"pair_1", "upper_pair", "loop_1", "pair_2", "loop_2", "pair_3", "loop_3"} < set(names)
    steps = [event["step"] for event in found["events"]]
    assert steps == sorted(steps)
    assert {event["leaf_length"] for event in found["events"]} == {60.0}
    assert {row["threshold_from"] for row in found["criteria"]} == {"thesis", "ours"}
    assert found["final_areas"]["grown"] is False


def test_a_timeline_that_is_open_stays_open(given):
    with Timeline(given) as timeline:
        report = check_sequence(timeline)
        assert timeline.frame().n_rows("sources") == 11
    assert report.as_json() == check_sequence(given).as_json()


def test_a_leaf_with_sources_at_random_is_judged_without_a_crash(darts):
    report = check_sequence(darts)
    assert {"C1", "C2", "C3", "C19"} <= set(report.failures)
    assert {"C5", "C10", "C11", "C12", "C13", "C14", "C20"} <= set(report.undecided)
    reasons = {row.criterion.id: row.verdict.reason for row in report.criteria}
    assert "no event of mesophyll differentiation" in reasons["C20"]
    assert [name for name in report.undecided if not reasons[name]] == []


def test_nodes_of_refinement_belong_to_a_vein(darts):
    with Timeline(darts) as timeline:
        owners = node_owners(timeline)
        is_seed = timeline.table("nodes", "parent") == -1
        assert (timeline.table("nodes", "origin") == Origin.REFINEMENT).any()
    assert owners[is_seed].tolist() == [0]
    # a half of a segment between seed and first node is of the vein, not of the seed
    assert (owners[~is_seed] > 0).all()


def test_the_first_set_of_a_source_is_that_of_its_birth(darts):
    with Timeline(darts) as timeline:
        sets = first_perceived(timeline)
        births = timeline.table("sources", "birth")
        node_births = timeline.table("nodes", "birth")
        assert set(sets) <= set(range(len(births)))
        assert sets
        for source, nodes in sets.items():
            assert len(set(nodes.tolist())) == len(nodes)
            assert (node_births[nodes] <= births[source]).all()


def test_the_birth_distance_is_the_config_s_or_an_estimate(darts, given):
    with Timeline(darts) as timeline:
        assert birth_distance(timeline) == 5.0
    with Timeline(given) as timeline:
        # sources are given some nine and a half to ten D from the veins they attract
        assert birth_distance(timeline) == pytest.approx(9.5, abs=0.6)


def test_a_run_without_sources_has_no_sequence(tmp_path):
    leaf = DARTS.replace("density = 0.02", "density = 1e-12")
    (tmp_path / "none.toml").write_text(leaf)
    run(load(tmp_path / "none.toml"), tmp_path / "none.h5", steps=2)
    with pytest.raises(VascError, match="no source was placed"):
        check_sequence(tmp_path / "none.h5")


def test_a_file_of_another_kind_is_refused(tmp_path):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1
    with pytest.raises(VascError, match=r"other\.h5"):
        check_sequence(tmp_path / "other.h5")


def test_the_shortest_way_is_by_length_and_not_by_number():
    places = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 5.0], [9.0, 9.0]])
    segments = np.array([[0, 1], [1, 2], [0, 3], [3, 2]])
    assert shortest_path(segments, places, 0, 2).tolist() == [0, 1, 2]
    assert shortest_path(segments[2:], places, 0, 2).tolist() == [0, 3, 2]
    assert shortest_path(segments, places, 0, 4).tolist() == []


def test_nodes_at_one_place_do_not_cut_a_way():
    places = np.array([[0.0, 0.0], [0.0, 0.0], [1.0, 0.0]])
    assert shortest_path(np.array([[0, 1], [1, 2]]), places, 0, 2).tolist() == [0, 1, 2]


def test_mirror_distances():
    points = np.array([[-2.0, 1.0], [2.0, 1.0], [0.0, 5.0]])
    assert mirror_distance(points) == 0.0
    points[1, 0] += 0.25
    assert mirror_distance(points) == 0.25
    assert mirror_distance(np.zeros((0, 2))) == 0.0


def loop(*corners):
    """Give a loop of some outline."""
    return LoopStory(0, 0, 0.0, frozenset(), {}, outline=corners)


def test_notches_between_loops():
    upper = loop((0, 10), (0, 20), (6, 20), (8, 15), (6, 10))
    lower = loop((0, 0), (0, 10), (6, 10), (8, 5), (6, 0))
    # both bulge to 8 and meet at 6
    assert notch_depths([upper, lower], closing=0.05) == pytest.approx([2.0], abs=0.1)
    straight = [loop((0, 10), (0, 20), (6, 20), (6, 10)), loop((0, 0), (0, 10), (6, 10), (6, 0))]
    assert notch_depths(straight, closing=0.05) == [0.0]


def test_final_areas_of_a_run_that_was_stopped_are_open(tmp_path):
    run(load("arabidopsis-first-leaf"), tmp_path / "young.h5", steps=274)
    report = check_sequence(tmp_path / "young.h5")
    assert {"C15", "C17"} <= set(report.undecided)
    assert report.failures == []
    assert report.features["c"].passed is not False
