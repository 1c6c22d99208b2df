"""Shapes of areoles: the half-edge walk held against shapely's polygons."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from reference.drawn_networks import honeycomb
from reference.halving import extended
from reference.networks import grid, network, random_planar

from vasc.analysis import find_areoles

seeds = st.integers(0, 2**32 - 1)


def polygons(net):
    """The areoles as shapely finds them."""
    lines = shapely.linestrings(net.positions[net.segments])
    return [
        shapely.geometry.polygon.orient(p) for p in shapely.get_parts(shapely.polygonize(lines))
    ]


def elongation(polygon):
    """Axis ratio by second moments, summed over triangles from one point to all sides."""
    points, weights = [], []
    middle = np.array([polygon.centroid.x, polygon.centroid.y])
    # rings of shapely's polygons turn one way, holes the other
    for ring in (polygon.exterior, *polygon.interiors):
        corners = shapely.get_coordinates(ring)
        for a, b in pairwise(corners):
            # the middles of the sides integrate squares exactly
            points += [(a + b) / 2.0, (b + middle) / 2.0, (a + middle) / 2.0]
            (x, y), (u, v) = a - middle, b - middle
            weights += [(x * v - u * y) / 6.0] * 3
    points, weights = np.array(points), np.array(weights)
    off = points - (weights[:, None] * points).sum(axis=0) / weights.sum()
    small, large = np.linalg.eigvalsh(
        (weights[:, None, None] * off[:, :, None] * off[:, None]).sum(0)
    )
    return np.sqrt(large / small)


@given(seeds, st.floats(0.3, 1.0))
def test_areas_and_perimeters_are_those_of_polygons(seed, share):
    net = random_planar(np.random.default_rng(seed), 40, share)
    expected = sorted((polygon.length, polygon.area) for polygon in polygons(net))
    areoles = find_areoles(net)
    found = sorted(zip(areoles.perimeters, areoles.areas, strict=True))
    assert np.array(found).reshape(-1, 2) == pytest.approx(
        np.array(expected).reshape(-1, 2), abs=1e-9
    )


@given(seeds)
def test_elongations_are_those_of_polygons(seed):
    net = random_planar(np.random.default_rng(seed), 30, 0.7)
    expected = sorted(elongation(polygon) for polygon in polygons(net))
    assert sorted(find_areoles(net).elongations) == pytest.approx(expected, rel=1e-5)


def test_a_grid():
    areoles = find_areoles(grid(3, 3, width=2.0, height=1.0))
    assert areoles.perimeters == pytest.approx([6.0] * 9)
    assert areoles.circularities == pytest.approx([4.0 * np.pi * 2.0 / 36.0] * 9)
    assert areoles.elongations == pytest.approx([2.0] * 9)
    # corners of the grid are no junctions
    assert sorted(areoles.corners.tolist()) == [3] * 4 + [4] * 5


def test_a_honeycomb():
    areoles = find_areoles(honeycomb(5, 5))
    assert areoles.n_areoles == 25
    assert areoles.areas == pytest.approx([1.5 * np.sqrt(3.0)] * 25)
    assert areoles.circularities == pytest.approx([np.pi / np.sqrt(12.0)] * 25)
    assert areoles.elongations == pytest.approx([1.0] * 25)
    assert np.bincount(areoles.corners).argmax() == 6


def test_a_vein_that_ends_inside_changes_nothing():
    square = grid(2, 1)
    spur = extended(square, 0, (0.5, 0.5))
    before, after = find_areoles(square), find_areoles(spur)
    for name in ("areas", "perimeters", "elongations", "corners"):
        assert sorted(getattr(after, name)) == pytest.approx(sorted(getattr(before, name)))


def test_a_network_within_makes_a_hole():
    outer, inner = grid(1, 1, 4.0, 4.0), grid(1, 1, 2.0, 2.0)
    net = network(
        np.concatenate([outer.positions, inner.positions + 1.0]),
        np.concatenate([outer.segments, inner.segments + 4]),
    )
    areoles = find_areoles(net)
    found = sorted(zip(areoles.areas, areoles.perimeters, areoles.elongations, strict=True))
    assert np.array(found) == pytest.approx(np.array([[4.0, 8.0, 1.0], [12.0, 24.0, 1.0]]))


def test_far_from_the_origin():
    near = honeycomb(3, 3)
    far = network(near.positions + 1e6, near.segments)
    assert find_areoles(far).elongations == pytest.approx(find_areoles(near).elongations, rel=1e-4)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e6])
@pytest.mark.parametrize(("height", "n_flat"), [(1e-14, 1), (1e-10, 0)])
def test_a_face_within_rounding_is_no_areole(size, height, n_flat):
    # a square, one side of which is drawn twice, but for a hair
    points = [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, height)]
    net = network(size * np.array(points), [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 1)])
    found = find_areoles(net)
    assert (found.n_areoles, found.n_flat) == (2 - n_flat, n_flat)
    assert found.areas.max() == pytest.approx(size**2)
