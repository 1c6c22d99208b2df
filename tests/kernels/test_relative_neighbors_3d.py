"""Relative neighbours in space equal those by definition, ties and points at one place included."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference.stem import relative_neighbors, squares
from reference.stem_driver import spiral
from scipy.spatial import Delaunay

from vasc import kernels
from vasc.kernels import cylinder

NO_PAIRS = np.empty((0, 2), dtype=np.int32)
seeds = st.integers(0, 10**6)


def spread(rng, n_points):
    """Points anywhere in a long box."""
    return rng.uniform(-1.0, 1.0, (n_points, 3)) * [20.0, 20.0, 100.0]


def on_lattice(rng, n_points):
    """Exact ties, points in lines and in planes, and several points at one place."""
    return rng.integers(0, 4, (n_points, 3)) * 2.0


def on_line(rng, n_points):
    """Points of one line, some at one place."""
    return rng.integers(-20, 20, (n_points, 1)) * np.array([1.0, 0.5, -2.0])


def at_one_place(rng, n_points):
    """Points at two places only."""
    return rng.integers(0, 2, (n_points, 1)) * np.array([3.0, 4.0, 12.0])


def on_cylinder(rng, n_points):
    """Points of a surface, almost on one sphere with many others."""
    turns = rng.uniform(0.0, 2.0 * np.pi, n_points)
    heights = rng.integers(0, 30, n_points) * 1.0
    return np.stack((30.0 * np.cos(turns), 30.0 * np.sin(turns), heights), axis=1)


def almost_tied(rng, n_points):
    """Ties missed by less than the margin, by about the margin, and by more."""
    off = rng.choice([0.0, 1e-13, 5e-10, 1e-9, 2e-9, 1e-8], (n_points, 3))
    return on_lattice(rng, n_points) + off * rng.choice([-1.0, 1.0], (n_points, 3))


def far_away(rng, n_points):
    """Veins of short segments at the top of a high stem."""
    walk = rng.normal(size=(n_points, 3)).cumsum(axis=0)
    return walk + np.array([115.0, 0.0, 1e5])


KINDS = [spread, on_lattice, on_line, at_one_place, on_cylinder, almost_tied, far_away]


@pytest.mark.parametrize("points_of", KINDS)
@given(seed=seeds, n_points=st.integers(1, 60), side=st.sampled_from([0.7, 8.0, 200.0]))
@settings(deadline=None, max_examples=25)
def test_sets_equal_those_by_definition(points_of, seed, n_points, side):
    points = points_of(np.random.default_rng(seed), n_points)
    tree = kernels.octree.insert(kernels.octree.octree(side), points, 0, n_points)
    for x in range(n_points):
        found = kernels.relative_neighbors_3d.relatives(tree, points, x)
        assert found.tolist() == relative_neighbors(points, x)


@pytest.mark.parametrize("points_of", KINDS)
@given(seed=seeds, n_points=st.integers(1, 50), batch=st.integers(1, 20))
@settings(deadline=None, max_examples=15)
def test_pairs_of_new_points_are_found_whatever_the_search_begins_with(
    points_of, seed, n_points, batch
):
    rng = np.random.default_rng(seed)
    points = points_of(rng, n_points)
    tree = kernels.octree.octree(8.0)
    parents = np.array([rng.integers(-1, max(i, 1)) for i in range(n_points)], dtype=np.int32)
    for start in range(0, n_points, batch):
        stop = min(start + batch, n_points)
        tree = kernels.octree.insert(tree, points, start, stop)
        pairs = rng.integers(0, stop, (30, 2)).astype(np.int32)
        found = kernels.relative_neighbors_3d.relatives_of_new(
            tree, points, parents, pairs, start, stop
        )
        expected = [
            [x, v]
            for x in range(start, stop)
            for v in relative_neighbors(points[:stop], x)
            if v < x
        ]
        assert found.tolist() == expected


def test_any_number_of_points_can_be_at_one_place():
    points = np.zeros((300, 3))
    tree = kernels.octree.insert(kernels.octree.octree(1.0), points, 0, 300)
    parents = np.full(300, -1, dtype=np.int32)
    found = kernels.relative_neighbors_3d.relatives_of_new(tree, points, parents, NO_PAIRS, 0, 300)
    assert len(found) == 300 * 299 // 2
    assert kernels.relative_neighbors_3d.relatives(tree, points, 7).tolist() == [
        v for v in range(300) if v != 7
    ]


@given(seed=seeds, n_points=st.integers(1, 40), start=st.integers(0, 39))
@settings(deadline=None, max_examples=40)
def test_neighbors_on_the_surface_equal_those_by_definition(seed, n_points, start):
    rng = np.random.default_rng(seed)
    period, start = 16.0, min(start, n_points)
    points = np.zeros((n_points, 3))
    points[:, 0] = rng.integers(0, 8, n_points) * 2.0
    points[:, 2] = rng.integers(0, 8, n_points) * 2.0
    points[n_points // 2 :, 0] = rng.uniform(0.0, period, n_points - n_points // 2)
    for around in (period, 0.0):
        found = kernels.unrolled.relatives_on_surface(points, start, n_points, around)
        assert found.tolist() == [
            [x, v]
            for x in range(start, n_points)
            for v in relative_neighbors(points, x, around)
            if v < x
        ]


def urquhart_by_definition(points):
    """Delaunay pairs without a common Delaunay neighbour in their lune."""
    neighbors = {i: set() for i in range(len(points))}
    for corners in Delaunay(points).simplices.tolist():
        for a, b in itertools.permutations(corners, 2):
            neighbors[a].add(b)
    pairs = []
    for a, b in itertools.combinations(range(len(points)), 2):
        if b not in neighbors[a]:
            continue
        limit = squares(points[a][None], points[b])[0] * (1.0 - 1e-9)
        common = np.array(sorted(neighbors[a] & neighbors[b]))
        is_near = squares(points[common], points[a]) < limit
        if not np.any(is_near & (squares(points[common], points[b]) < limit)):
            pairs.append([a, b])
    return pairs


@pytest.mark.parametrize("seed", range(5))
def test_urquhart_pairs_equal_those_by_definition_and_are_never_too_few(seed):
    points = spread(np.random.default_rng(seed), 80)
    found = kernels.urquhart_3d.urquhart_pairs(points).tolist()
    assert found == urquhart_by_definition(points)
    exact = [[x, v] for x in range(80) for v in relative_neighbors(points, x) if v > x]
    assert all(pair in found for pair in exact)


@pytest.mark.parametrize("points_of", [on_line, at_one_place])
def test_urquhart_pairs_of_points_without_a_triangulation_are_exact(points_of):
    points = points_of(np.random.default_rng(1), 20)
    found = kernels.urquhart_3d.urquhart_pairs(points).tolist()
    assert found == [[x, v] for x in range(20) for v in relative_neighbors(points, x) if v > x]


TABLE = [  # angle, R, H, by straight distances, and by those along the surface
    (137.5, 115, 10, (5, 8), (5, 8)),
    (137.5, 115, 23, (3, 5), (3, 5)),
    (137.5, 115, 33, (2, 3), (3, 5)),
    (137.5, 115, 96, (1,), (1, 2)),
    (137.5, 50, 10, (3, 5), (3, 5)),
    (137.5, 35, 10, (2, 3), (3, 5)),
    (137.5, 12, 10, (1,), (1, 2)),
    (99.5, 180, 10, (7, 11), (7, 11)),
    (99.5, 115, 10, (4, 7), (4, 7)),
    (99.5, 50, 10, (3, 4), (3, 4)),
    (99.5, 25, 10, (1, 3), (3, 4)),
    (99.5, 12, 10, (1,), (1, 3)),
]


@pytest.mark.parametrize(("degrees", "radius", "rise", "straight", "along"), TABLE)
def test_neighbors_of_primordia_are_those_that_the_lattice_predicts(
    degrees, radius, rise, straight, along
):
    angle, middle = np.deg2rad(degrees), 40
    points = spiral(0, 81, radius, rise, angle)
    tree = kernels.octree.insert(kernels.octree.octree(8.0), points, 0, 81)
    above = kernels.relative_neighbors_3d.relatives(tree, points, middle) - middle
    # thesis: (1, 1) for a single neighbour above
    assert tuple(m for m in above.tolist() if m > 0) == straight
    period = cylinder.circumference(radius)
    unrolled = spiral(0, 81, radius, rise, angle, period)
    rows = kernels.unrolled.relatives_on_surface(unrolled, 0, 81, period)
    assert tuple((rows[rows[:, 1] == middle, 0] - middle).tolist()) == along
