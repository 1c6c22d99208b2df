"""The tree of cells finds what a look at every point finds, wherever the points are."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference.stem import squares

from vasc import kernels

coordinate = st.one_of(
    st.integers(-4, 4).map(float), st.floats(-300.0, 300.0), st.sampled_from([1e12, -1e12, -1e-9])
)
points_lists = st.lists(st.tuples(coordinate, coordinate, coordinate), min_size=1, max_size=40)


def tree_of(points, side, batch):
    """A tree that got its points in batches, with little room at first."""
    tree = kernels.octree.octree(side, 1)
    for start in range(0, len(points), batch):
        stop = min(start + batch, len(points))
        tree = kernels.octree.insert(tree, points, start, stop)
    return tree


@given(points_lists, st.sampled_from([0.5, 8.0]), st.integers(1, 9), st.floats(0.0, 50.0))
@settings(deadline=None)
def test_nearest_is_the_one_of_all_points(points, side, batch, reach):
    points = np.array(points)
    tree = tree_of(points, side, batch)
    for place in [*points, points[0] + 1.5]:
        to_place = squares(points, place)
        expected = int(np.argmin(to_place))
        if to_place[expected] > reach:
            expected = -1
        found, square = kernels.octree.nearest_within(tree, points, *place, reach)
        assert found == expected
        assert square == (to_place[expected] if expected >= 0 else reach)


@given(points_lists, st.sampled_from([0.5, 8.0]))
@settings(deadline=None)
def test_a_search_that_prunes_nothing_meets_every_point_once(points, side):
    points = np.array(points)
    tree = tree_of(points, side, 3)
    met = []
    for cell in range(tree.root[5]):
        point = tree.heads[cell]
        while point >= 0:
            box = tree.boxes[cell]
            assert np.all((box[:3] <= points[point]) & (points[point] <= box[3:]))
            met.append(int(point))
            point = tree.following[point]
    assert sorted(met) == list(range(len(points)))


def test_no_point_is_found_in_an_empty_tree():
    tree = kernels.octree.octree(1.0)
    points = np.zeros((1, 3))
    assert kernels.octree.nearest_within(tree, points, 0.0, 0.0, 0.0, 9.0)[0] == -1
    assert kernels.octree.insert(tree, points, 0, 0).root[0] == -1


@pytest.mark.parametrize("n_points", [1, 700])
def test_points_at_one_place_share_a_cell(n_points):
    points = np.full((n_points, 3), -0.25)
    tree = tree_of(points, 1.0, 50)
    assert tree.root[5] == 1
    assert kernels.octree.nearest_within(tree, points, 0.0, 0.0, 0.0, 1.0)[0] == 0
