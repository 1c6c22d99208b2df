"""Blades: measures, scaling, seeds, and outlines that are refused with the place named."""

import numpy as np
import pytest
import shapely

from vasc.domain import Blade
from vasc.errors import OutlineError

SQUARE = [(-1, 0), (1, 0), (1, 2), (-1, 2)]
HOLE = [(-0.5, 0.5), (-0.5, 1.5), (0.5, 1.5), (0.5, 0.5)]
ISLAND = [(-0.1, 0.9), (0.1, 0.9), (0.1, 1.1), (-0.1, 1.1)]
BESIDE = [(2, 0), (3, 0), (3, 1)]


def test_measures_of_a_square():
    blade = Blade.from_rings([SQUARE])
    assert (blade.length, blade.width, blade.area) == (2.0, 2.0, 4.0)
    assert blade.bounds == (-1.0, 0.0, 1.0, 2.0)
    assert blade.seeds.tolist() == [[0.0, 0.0]]
    xy, starts = blade.flat
    assert xy.flags.c_contiguous
    assert xy.dtype == np.float64
    assert starts.dtype == np.int32
    assert starts.tolist() == [0, 4]


def test_lobes_below_the_attachment_do_not_count_for_length():
    heart = [(0, 0), (1, -1), (2, 1), (0, 3), (-2, 1), (-1, -1)]
    blade = Blade.from_rings([heart])
    assert blade.length == 3.0
    assert blade.bounds[1] == -1.0


@pytest.mark.parametrize("direction", [1, -1])
def test_area_follows_the_even_odd_rule_whatever_the_directions(direction):
    rings = [SQUARE, HOLE[::direction], ISLAND, BESIDE[::direction]]
    blade = Blade.from_rings(rings, [(0, 0), (0, 1), (2.8, 0.1)])
    assert blade.area == pytest.approx(4.0 - 1.0 + 0.04 + 0.5)
    assert blade.polygon.area == pytest.approx(blade.area)
    inside = blade.contains([(0, 0.2), (0.3, 1), (0, 1), (2.8, 0.3), (1.5, 0.5)])
    assert inside.tolist() == [True, False, True, True, False]


def test_a_scaled_blade_is_the_blade_of_scaled_rings():
    rings, seeds = [SQUARE, HOLE, ISLAND], np.array([(0.0, 0.0), (0.0, 1.0)])
    scaled = Blade.from_rings(rings, seeds).scaled(2.0).scaled(1.5)
    direct = Blade.from_rings([np.array(ring) * 3.0 for ring in rings], seeds * 3.0)
    assert scaled == direct
    assert scaled.area == direct.area
    assert scaled.length == direct.length
    assert scaled.bounds == direct.bounds
    points = np.random.default_rng(1).uniform(-4.0, 7.0, (500, 2))
    assert (scaled.contains(points) == direct.contains(points)).all()
    np.testing.assert_allclose(scaled.margin_distance(points), direct.margin_distance(points))
    assert scaled.polygon.area == pytest.approx(direct.polygon.area)


def test_scaling_copies_no_points():
    blade = Blade.from_rings([SQUARE])
    assert blade.scaled(3.0).edge_grid is blade.edge_grid


def test_a_blade_cannot_be_changed():
    given = np.array(SQUARE, dtype=float)
    blade = Blade.from_rings([given])
    given[0] = 9.0
    assert blade.length == 2.0
    assert blade.rings[0][0].tolist() == [-1.0, 0.0]
    for array in (blade.rings[0], blade.flat[0], blade.seeds, blade.scaled(2.0).rings[0]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


def test_margin_distance_is_that_to_the_nearest_edge():
    blade = Blade.from_rings([SQUARE])
    assert blade.margin_distance([(0, 1), (0, -3), (1, 1)]).tolist() == [1.0, 3.0, 0.0]


@pytest.mark.parametrize(
    ("ring", "is_star_shaped"),
    [
        (SQUARE, True),
        (SQUARE[::-1], True),
        # the attachment sees the flanks of a notch at the tip, but not behind a side lobe
        ([(-1, 0), (1, 0), (1, 2), (0, 1), (-1, 2)], True),
        ([(0, 0), (2, 0), (2, 3), (1, 3), (1.5, 1)], False),
        # the origin is outside
        ([(-1, 1), (1, 1), (1, 2), (-1, 2)], False),
    ],
)
def test_star_shaped_is_what_the_attachment_sees(ring, is_star_shaped):
    assert Blade.from_rings([ring], ring[:1]).is_star_shaped == is_star_shaped


def test_several_parts_are_not_star_shaped():
    assert not Blade.from_rings([SQUARE, BESIDE], [(0, 0), (2.8, 0.1)]).is_star_shaped


@pytest.mark.parametrize(
    "seed", [(0, 0), (1, 1), (-1, 2), (0.3, 0.0), (0, 0.1), (0.5, 1.0), (1 / 3, 2 + 1e-12)]
)
def test_seeds_inside_and_on_the_margin_are_taken(seed):
    Blade.from_rings([SQUARE, HOLE], [seed])


def test_the_polygon_has_the_points_of_the_rings():
    polygon = Blade.from_rings([SQUARE, HOLE]).polygon
    assert polygon.equals(shapely.Polygon(SQUARE, [HOLE]))


BOW_TIE = [(0, 0), (2, 2), (2, 0), (0, 2)]
REFUSED = {
    "no ring": ([], [(0, 0)], "outline: empty; it needs at least 3 points"),
    "empty ring": ([[]], [(0, 0)], "outline: 0 points; it needs at least 3"),
    "two points": ([[(0, 0), (1, 1)]], [(0, 0)], "outline: 2 points; it needs at least 3"),
    "second ring too short": ([SQUARE, [(0, 1)]], [(0, 0)], "outline: ring 1: 1 points"),
    "on a line": ([[(0, 0), (1, 1), (2, 2), (3, 3)]], [(0, 0)], "area 0; the 4 points"),
    "nan": ([[(0, 0), (1, float("nan")), (0, 1)]], [(0, 0)], "outline: row 1 is [1.0, nan]"),
    "inf": ([[(0, 0), (1, 1), (float("inf"), 1)]], [(0, 0)], "outline: row 2 is [inf, 1.0]"),
    "huge": ([[(0, 0), (1e200, 1), (0, 1)]], [(0, 0)], "row 1 is (1e+200, 1); numbers must be"),
    "three coordinates": ([[(0, 0, 0), (1, 1, 1), (0, 1, 2)]], [(0, 0)], "shape (n, 2)"),
    "text": ([["a", "b", "c"]], [(0, 0)], "expected pairs of numbers"),
    "repeated": (
        [[(0, 0), (1, 0), (1, 0), (0, 1)]],
        [(0, 0)],
        "outline: rows 1 and 2 are the same point (1, 0)",
    ),
    "closed twice": ([[*SQUARE, SQUARE[0]]], [(0, 0)], "the last from the first"),
    "bow tie": ([BOW_TIE], [(0, 0)], "crosses or touches itself at (1, 1)"),
    "touches itself": (
        [[(-2, 0), (2, 0), (2, 2), (0, 0), (-2, 2)]],
        [(0, 0)],
        "crosses or touches itself at (0, 0)",
    ),
    "runs back": (
        [[(0, 0), (2, 0), (2, 2), (2, 5), (2, 2), (0, 2)]],
        [(0, 0)],
        "crosses or touches itself",
    ),
    "hole across the margin": (
        [SQUARE, [(0, 1), (3, 1), (3, 1.5)]],
        [(0, 0)],
        "outline: rings 0 and 1 cross or touch at (1, 1",
    ),
    "hole on the margin": (
        [SQUARE, [(1, 1), (0.5, 1.2), (0.5, 0.8)]],
        [(0, 0)],
        "rings 0 and 1 cross or touch at (1, 1)",
    ),
    "same ring twice": ([SQUARE, SQUARE], [(0, 0)], "rings 0 and 1 cross or touch"),
    "nothing above": (
        [[(-1, -2), (1, -2), (0, 0)]],
        [(0, 0)],
        "the highest point is at y = 0; at least one must be above",
    ),
    "no seed": ([SQUARE], [], "seeds: none"),
    "seed outside": ([SQUARE], [(0, 0), (2, 1)], "seeds[1] = (2, 1): outside the outline, 1 from"),
    "seed in a hole": ([SQUARE, HOLE], [(0, 0.8)], "seeds[0] = (0, 0.8): in a hole, 0.3 from"),
    "seed is no number": ([SQUARE], [(0, float("nan"))], "seeds: row 0 is [0.0, nan]"),
    "part without seed": (
        [SQUARE, BESIDE],
        [(0, 0)],
        "seeds: none in the part (ring 1) between (2, 0) and (3, 1)",
    ),
    "island without seed": ([SQUARE, HOLE, ISLAND], [(0, 0)], "none in the part (ring 2)"),
    "too many rings": ([SQUARE] * 1001, [(0, 0)], "1001 rings; at most 1000"),
}


@pytest.mark.parametrize(("rings", "seeds", "said"), REFUSED.values(), ids=REFUSED)
def test_a_bad_outline_is_refused_with_its_place(rings, seeds, said):
    with pytest.raises(OutlineError) as caught:
        Blade.from_rings(rings, seeds)
    message = str(caught.value)
    assert said in message
    assert "\n" not in message


@pytest.mark.parametrize(("n_points", "is_allowed"), [(200_000, True), (200_001, False)])
def test_the_limit_of_points_is_exact(n_points, is_allowed):
    angles = np.arange(n_points) * (2.0 * np.pi / n_points)
    ring = np.stack([np.sin(angles), 1.0 - np.cos(angles)], axis=1)
    if is_allowed:
        assert len(Blade.from_rings([ring]).rings[0]) == n_points
    else:
        with pytest.raises(OutlineError, match="200,001 points; at most 200,000"):
            Blade.from_rings([ring])


def test_an_outline_that_winds_twice_is_refused_though_it_turns_one_way():
    angles = np.arange(5) * 4.0 * np.pi / 5.0 + 0.3
    star = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    with pytest.raises(OutlineError, match="cross"):
        Blade.from_rings([star], [(0.0, 0.0)])
