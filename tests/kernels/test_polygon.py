"""The polygon kernels against shapely, and against the crossing rule written out."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from vasc import kernels

polygon = kernels.polygon

AWAY = 1e-9
SEEDS = st.integers(0, 2**32 - 1)


def star(rng, n, center=(0.0, 0.0), size=1.0):
    """Draw a polygon that is star-shaped about its center."""
    # no gap is as wide as a half turn, so that the center is inside
    angles = (np.arange(n) + rng.uniform(0.0, 0.4, n)) * 2.0 * np.pi / n
    radii = size * rng.uniform(0.2, 1.0, n)
    ring = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    return ring + np.array(center)


def flat(rings):
    return np.concatenate(rings), np.cumsum([0, *map(len, rings)]).astype(np.int32)


def even_odd(rings):
    geometry = shapely.Polygon()
    for ring in rings:
        geometry = geometry.symmetric_difference(shapely.Polygon(ring))
    return geometry


def drawn(seed, n):
    """Draw a part with a hole that holds a part, and a part beside them."""
    rng = np.random.default_rng(seed)
    even = np.arange(n) * 2.0 * np.pi / n
    outer = np.stack([np.cos(even), np.sin(even)], axis=1) * rng.uniform(0.7, 1.0, (n, 1))
    hole = np.stack([np.cos(even), np.sin(even)], axis=1) * rng.uniform(0.3, 0.4, (n, 1))
    island = star(rng, n, size=0.15)
    beside = star(rng, n, center=(1.7, 0.3), size=0.6)
    return [outer, hole, island, beside]


def crossing_rule(rings, x, y):
    """Count the edges right of a point, one by one."""
    inside = False
    for ring in rings:
        for (ax, ay), (bx, by) in zip(np.roll(ring, 1, axis=0), ring, strict=True):
            if ay == by:
                continue
            if ay > by:
                ax, ay, bx, by = bx, by, ax, ay
            if ay <= y < by and (x - ax) * (by - ay) < (bx - ax) * (y - ay):
                inside = not inside
    return inside


@given(SEEDS, st.integers(3, 60))
def test_contains_agrees_with_shapely_away_from_the_margin(seed, n):
    rng = np.random.default_rng(seed)
    ring = star(rng, n)
    shape = shapely.Polygon(ring)
    points = rng.uniform(-1.1, 1.1, (300, 2))
    is_away = shapely.distance(shape.exterior, shapely.points(points)) > AWAY
    found = polygon.contains(*flat([ring]), points, 1.0)
    expected = shapely.contains_xy(shape.buffer(0), points)
    assert (found == expected)[is_away].all()


@given(SEEDS, st.integers(5, 40), st.floats(1e-3, 1e3))
def test_contains_keeps_to_holes_parts_and_scale(seed, n, scale):
    rings = drawn(seed, n)
    shape = even_odd(rings)
    points = np.random.default_rng(seed + 1).uniform([-1.1, -1.1], [2.4, 1.1], (300, 2))
    is_away = shapely.distance(shape.boundary, shapely.points(points)) > AWAY
    found = polygon.contains(*flat(rings), points * scale, scale)
    assert (found == shapely.contains_xy(shape, points))[is_away].all()


@given(st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=12))
def test_the_grid_gives_the_crossing_rule_bit_for_bit_on_corners_and_edges(corners):
    # any polygon on a lattice, also one that crosses itself or is flat
    ring = np.array(corners, dtype=np.float64) / 3.0
    grid = polygon.edge_grid(*flat([ring]))
    at = np.arange(-1, 15) / 6.0
    for x in at:
        for y in at:
            assert polygon.is_inside(grid, x, y) == crossing_rule([ring], x, y)


@given(SEEDS)
def test_few_rows_give_the_same_answers(seed):
    rng = np.random.default_rng(seed)
    xy, starts = flat([star(rng, 40)])
    points = rng.uniform(-1.0, 1.0, (200, 2))
    expected = polygon.contains(xy, starts, points, 1.0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(polygon, "MOST_ROW_EDGES", 1)
        grid = polygon.edge_grid(xy, starts)
    assert grid.shape[1] < 60
    assert (polygon.are_inside(grid, points, 1.0) == expected).all()


def test_points_that_are_not_numbers_or_far_away_are_outside():
    grid = polygon.edge_grid(*flat([np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])]))
    for x, y in [(np.nan, 0.2), (0.2, np.nan), (np.inf, 0.2), (0.2, -np.inf), (1e300, 1e300)]:
        assert not polygon.is_inside(grid, x, y)
    assert polygon.is_inside(grid, 0.2, 0.2)


@given(SEEDS, st.integers(5, 30), st.floats(0.02, 0.5), st.floats(0.01, 100.0))
def test_the_raster_misses_no_cell_that_is_touched(seed, n, side, scale):
    rings = drawn(seed, n)
    shape = shapely.transform(even_odd(rings), lambda xy: xy * scale)
    rng = np.random.default_rng(seed)
    # a window that may cut the polygon
    x0, y0 = rng.uniform(-1.4, -0.6, 2) * scale
    nx, ny = (int(cells) for cells in rng.integers(1, int(3.0 / side) + 2, 2))
    side *= scale
    cells = polygon.raster(*flat(rings), scale, x0, y0, side, nx, ny)
    assert cells.shape == (nx * ny,)
    assert cells.dtype == np.uint8
    columns, rows = np.meshgrid(np.arange(nx), np.arange(ny))
    low_x, low_y = x0 + columns.ravel() * side, y0 + rows.ravel() * side
    boxes = shapely.box(low_x, low_y, low_x + side, low_y + side)
    touched = shapely.intersects(shape, boxes)
    assert (cells[touched] == 1).all()
    # and marks no cell that is off the blade by more than rounding
    marked = boxes[(cells == 1) & ~touched]
    assert (shapely.distance(shape, marked) < 1e-7 * side).all()


def test_the_raster_sees_what_is_smaller_than_a_cell():
    dot = np.array([[0.31, 0.32], [0.33, 0.32], [0.32, 0.34]])
    cells = polygon.raster(*flat([dot]), 1.0, 0.0, 0.0, 1.0, 2, 2)
    assert cells.tolist() == [1, 0, 0, 0]
    needle = np.array([[-5.0, 0.5], [5.0, 0.5], [5.0, 0.5 + 1e-12]])
    cells = polygon.raster(*flat([needle]), 1.0, 0.0, 0.0, 1.0, 3, 2)
    assert cells.tolist() == [1, 1, 1, 0, 0, 0]


def test_a_raster_of_two_million_cells_covers_the_disc():
    angles = np.arange(2000) * np.pi / 1000
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    cells = polygon.raster(*flat([ring]), 1.0, -1.0, -1.0, 2.0 / 1414, 1414, 1414)
    assert cells.mean() == pytest.approx(np.pi / 4.0, rel=0.01)


@given(SEEDS, st.integers(5, 30), st.floats(0.1, 10.0))
def test_margin_distances_agree_with_shapely(seed, n, scale):
    rings = drawn(seed, n)
    points = np.random.default_rng(seed).uniform(-2.0, 2.0, (50, 2)) * scale
    lines = shapely.union_all([shapely.LinearRing(ring * scale) for ring in rings])
    expected = shapely.distance(lines, shapely.points(points))
    found = polygon.margin_distances(*flat(rings), points, scale)
    np.testing.assert_allclose(found, expected, atol=1e-12 * scale)


def test_free_lengths_end_at_the_margin_opposite():
    # a square with a slot from above, 0.2 wide and 0.5 deep
    ring = np.array(
        [[0, 0], [1, 0], [1, 1], [0.6, 1], [0.6, 0.5], [0.4, 0.5], [0.4, 1], [0, 1]], dtype=float
    )
    directions = np.tile([[-1.0, 0.0]], (len(ring), 1))
    lengths = polygon.free_lengths(ring, directions, 5.0)
    # from the right lip of the slot straight across to the left one
    assert lengths[3] == pytest.approx(0.2)
    assert lengths[0] == 5.0
