"""Genealogies of areoles: read and found, and the loops in which veins lie."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.networks import network
from shapely.geometry import Point, Polygon

from vasc.analysis.areoles import find_areoles
from vasc.areoles import polygon_areas
from vasc.config import load
from vasc.errors import TimelineError
from vasc.events import EventKind
from vasc.experiment import run
from vasc.timeline import Timeline
from vasc.timeline.run_genealogy import _found, _recorded, genealogy_of

RUNS = {
    "marginal": ("param-kill-distance-e", [], None),
    "refined": ("poplar-leaf", [(("refinement", "kind"), "subdivision")], 150),
}


@pytest.fixture(scope="module")
def areole_run(tmp_path_factory):
    """The first leaf of Arabidopsis until loops are split again; its areoles are recorded."""
    path = tmp_path_factory.mktemp("areole") / "leaf.h5"
    run(load("arabidopsis-first-leaf"), path, steps=360)
    with Timeline(path) as timeline:
        yield timeline


@pytest.fixture(scope="module", params=RUNS)
def closed_run(request, tmp_path_factory):
    """A run of the closed model, whose areoles have to be found."""
    name, changes, steps = RUNS[request.param]
    path = tmp_path_factory.mktemp(request.param) / "leaf.h5"
    run(load(name, changes), path, steps=steps)
    with Timeline(path) as timeline:
        yield timeline


class Drawn:
    """A frame of a network drawn by hand: a square whose inside is divided three times."""

    step = 9
    #  6---5---4     segments 0 to 6 go around, from node 0 to 1 ... 6 and 7; 7 closes the
    #  |   |   |     square at step 3, 8 divides it from 1 to 5 at step 5; 9 and 10 lead from
    #  7---9---3     3 to 9 and 8; 10 is the loop closed last, at step 7
    #  |   |   |
    #  0---1---2
    points = np.array(
        [[0, 0], [2, 0], [4, 0], [4, 2], [4, 4], [2, 4], [0, 4], [0, 2], [2, 2]], dtype=float
    )
    edges = (
        *((k, k + 1) for k in range(7)),
        (0, 7),
        (1, 8),
        (5, 8),
        (3, 8),
    )
    closed = ((7, 3), (9, 5), (10, 7))
    dimensions = 2
    path = "drawn"

    def __init__(self):
        self.network = network(self.points, list(self.edges))

    def frame(self, step=-1):
        return self

    def n_rows(self, table):
        return {"nodes": len(self.points), "segments": len(self.edges)}.get(table, 0)

    def rows(self, table, column):
        segments, steps = np.array(self.closed).T
        columns = {
            "step": steps,
            "kind": np.full(len(segments), EventKind.LOOP_CLOSED),
            "subject": segments,
            "object": np.full(len(segments), -1),
        }
        return columns[column]


def test_a_genealogy_by_hand():
    tree, loops = genealogy_of(Drawn())
    # the square; its halves; the right half is divided again
    assert tree.births.tolist() == [3, 5, 5, 7, 7]
    assert tree.segments.tolist() == [7, 9, 9, 10, 10]
    assert sorted(tree.splits.tolist()) == [-1, -1, -1, 5, 7]
    right = int(np.flatnonzero(tree.splits == 7)[0])
    assert tree.parents.tolist() == [-1, 0, 0, right, right]
    assert tree.roots.tolist() == [0, 0, 0, 0, 0]
    assert tree.generations.tolist() == [0, 1, 1, 2, 2]
    corners = {areole: set(ring.tolist()) for areole, ring in tree.boundaries.items()}
    left = 3 - right
    assert corners[left] == {0, 1, 8, 5, 6, 7}
    assert sorted(map(sorted, corners.values())) == [
        [0, 1, 5, 6, 7, 8],
        [1, 2, 3, 8],
        [3, 4, 5, 8],
    ]
    # node 4 is a corner of the upper right areole, and lay outside all at first
    (beside,) = {int(k) for k in loops.beside(np.array([4])).tolist() if k >= 0}
    assert corners[beside] == {3, 4, 5, 8}
    assert [tree.alive_before(beside, step) for step in (8, 7, 5, 3)] == [beside, right, 0, -1]


GRID = 4


def grid_edges():
    """Give the edges of a square grid of nodes."""
    rows, columns = np.divmod(np.arange(GRID * GRID), GRID)
    right = [(k, k + 1) for k in range(GRID * GRID) if columns[k] < GRID - 1]
    return right + [(k, k + GRID) for k in range(GRID * GRID) if rows[k] < GRID - 1]


def tree_and_chords(edges):
    """Divide edges into those that connect, in their order, and those that close loops."""
    group = list(range(GRID * GRID))
    tree, chords = [], []
    for a, b in edges:
        (chords if group[a] == group[b] else tree).append((a, b))
        group = [group[a] if label == group[b] else label for label in group]
    return tree, chords


class Grid(Drawn):
    """Part of a grid: a tree, and some chords, each of which closes a loop at its step."""

    points = np.stack(np.divmod(np.arange(GRID * GRID), GRID), axis=1).astype(float)

    def __init__(self, tree, chords):
        self.edges = tree + chords
        self.closed = tuple((len(tree) + k, k) for k in range(len(chords)))
        super().__init__()


@given(st.permutations(grid_edges()))
def test_areoles_of_any_grid_are_as_old_as_their_loops_and_add_up(edges):
    tree, chords = tree_and_chords(edges)
    grid = Grid(tree, chords)
    whole = genealogy_of(grid)[0]
    assert len(whole.boundaries) == len(chords) == (GRID - 1) ** 2
    areas = {}
    for n_closed in range(1, len(chords) + 1):
        # what is known after each chord is the beginning of what is known in the end
        known = genealogy_of(Grid(tree, chords[:n_closed]))[0]
        assert np.array_equal(known.births, whole.births[: known.n_areoles])
        assert np.array_equal(np.sort(known.parents), np.sort(whole.parents[: known.n_areoles]))
        areas |= {
            (n_closed, areole): Polygon(grid.points[ring]).area
            for areole, ring in known.boundaries.items()
        }
        parts = np.flatnonzero(known.splits == n_closed - 1)
        for areole in parts.tolist():
            children = np.flatnonzero(known.parents == areole).tolist()
            assert len(children) == 2
            # in the grid before this chord, the two were one
            before = sum(area for (n, _), area in areas.items() if n == n_closed - 1)
            after = sum(area for (n, _), area in areas.items() if n == n_closed)
            assert after == pytest.approx(before)
    assert sum(Polygon(grid.points[ring]).area for ring in whole.boundaries.values()) == (
        pytest.approx((GRID - 1) ** 2)
    )


def test_what_is_found_is_what_a_model_of_areoles_records(areole_run):
    for step in (120, 200, 240, 300, 360):
        frame = areole_run.frame(step)
        recorded, found = _recorded(frame)[0], _found(frame)[0]
        assert lives(found) == lives(recorded)
        assert len(found.boundaries) == len(recorded.boundaries)
        names = matched(recorded, found)
        assert {names[a]: names[p] for a, p in enumerate(recorded.parents.tolist())} == dict(
            enumerate(found.parents.tolist())
        )


def lives(tree):
    """Give birth, split, closing segment and generation of every areole, sorted."""
    columns = (tree.births, tree.splits, tree.segments, tree.generations)
    return sorted(zip(*(column.tolist() for column in columns), strict=True))


def matched(recorded, found):
    """Give the found areole of every recorded one, by the nodes around it and its descendants."""
    names = {-1: -1}
    rings = {frozenset(ring.tolist()): areole for areole, ring in found.boundaries.items()}
    for areole, ring in recorded.boundaries.items():
        # a boundary is recorded at birth; what has come between its corners since is left out
        corners = frozenset(ring.tolist())
        names[areole] = max(rings, key=lambda other, corners=corners: len(other & corners))
        names[areole] = rings[names[areole]]
    for areole in reversed(range(recorded.n_areoles)):
        child = np.flatnonzero(recorded.parents == areole)
        if len(child):
            names[areole] = int(found.parents[names[int(child[0])]])
    return names


def test_veins_lie_in_the_same_first_order_loop_either_way(areole_run):
    from vasc.timeline.vein_loops import loop_of

    veins = areole_run.lineage.veins
    frame = areole_run.frame()
    recorded, found = (_recorded(frame), _found(frame))
    names = matched(recorded[0], found[0])
    inside = 0
    for vein in np.unique(veins.firsts).tolist():
        read = loop_of(areole_run, veins, recorded, vein)
        seen = loop_of(areole_run, veins, found, vein)
        assert names[read.first_order] == seen.first_order
        inside += read.areole >= 0
    assert inside > 10


def test_an_areole_a_loop(closed_run):
    """At every step there are as many areoles as independent cycles (Euler)."""
    for step in np.linspace(0, closed_run.last_step, 6).astype(int).tolist():
        frame = closed_run.frame(step)
        tree = closed_run.lineage.genealogy(step)
        veins = frame.network
        n_seeds = int((veins.parents[: veins.n_nodes] == -1).sum())
        assert len(tree.boundaries) == veins.n_segments - veins.n_vein_nodes + n_seeds
        assert (tree.splits[tree.splits >= 0] <= step).all()
        # two parts of each that is split, and one for each in open tissue
        n_split = int((tree.splits >= 0).sum())
        assert tree.n_areoles == 2 * n_split + int((tree.parents < 0).sum())


def test_the_whole_areoles_are_those_that_are_measured(closed_run):
    frame, tree = closed_run.frame(), closed_run.lineage.genealogy()
    rings = list(tree.boundaries.values())
    owners = np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])
    areas = polygon_areas(frame.positions[np.concatenate(rings)], owners, len(rings))
    assert np.sort(areas) == pytest.approx(np.sort(find_areoles(frame.network).areas), rel=1e-9)


def test_genealogies_of_two_steps_agree_on_what_both_know(closed_run):
    early, late = (closed_run.lineage.genealogy(s) for s in (closed_run.last_step * 9 // 10, -1))
    known = early.n_areoles
    assert 0 < known < late.n_areoles
    assert np.array_equal(early.births, late.births[:known])
    assert np.array_equal(early.segments, late.segments[:known])
    assert np.array_equal(np.sort(early.roots), np.sort(late.roots[:known]))


def test_a_vein_lies_in_the_areole_around_its_first_node(closed_run):
    """Twin: the polygons of the step before the vein was born."""
    lineage = closed_run.lineage
    births = lineage.births()
    is_late = births["step"] > 0.6 * closed_run.last_step
    inside = 0
    for vein, step in zip(births["vein"][is_late], births["step"][is_late], strict=True):
        frame = closed_run.frame(int(step) - 1)
        place = closed_run.frame(int(step)).positions[vein]
        shift = closed_run.frame(int(step)).motion[0, 0] / frame.motion[0, 0]
        tree = lineage.genealogy(int(step) - 1)
        around = [
            (int(tree.births[areole]), int(tree.segments[areole]))
            for areole, ring in tree.boundaries.items()
            if Polygon(frame.positions[ring] * shift).contains(Point(place))
        ]
        found = lineage.loop_of(int(vein)).areole
        whole = lineage.genealogy()
        told = [] if found < 0 else [(int(whole.births[found]), int(whole.segments[found]))]
        assert told == around
        inside += len(around)
    # where growth is at the margin alone, veins are born there, outside all loops
    assert inside > 3 or closed_run.growth == "marginal"


def test_veins_that_cross_enclose_fewer_areoles_than_there_are_cycles(tmp_path):
    run(load("arabidopsis-closed"), tmp_path / "leaf.h5", steps=160)
    with Timeline(tmp_path / "leaf.h5") as timeline:
        veins, tree = timeline.frame().network, timeline.lineage.genealogy()
    assert len(find_areoles(veins).areas) == veins.n_segments - veins.n_vein_nodes + 1
    assert 0 < len(tree.boundaries) < len(find_areoles(veins).areas)


def test_a_stem_has_no_areoles(tmp_path):
    run(load("stem-golden-1-2"), tmp_path / "stem.h5", steps=10)
    with Timeline(tmp_path / "stem.h5") as timeline:
        for ask in (timeline.lineage.genealogy, lambda: timeline.lineage.loop_of(0)):
            with pytest.raises(TimelineError, match="is a stem; areoles are loops in the plane"):
                ask()
