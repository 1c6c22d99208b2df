"""Tissues: cells that fill their outline, and walls that two of them share."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference import tissue as slow

from vasc.domain import Blade, BladeParameters
from vasc.domain.sides import outline_sides, rings_of, sides_of
from vasc.domain.tilings import (
    hexagonal,
    hexagonal_in,
    rectangular,
    rectangular_in,
    tissue_of,
)
from vasc.domain.voronoi import voronoi, voronoi_in
from vasc.errors import OutlineError
from vasc.streams import Streams


def rng(seed=1):
    """Give the random numbers of a tissue."""
    return Streams(seed, ["tissue"])["tissue"]


SHAPES = ("elliptic", "ovate", "cordate", "reniform", "fan")
MAKERS = {
    "rectangular": lambda columns, rows, seed: rectangular(columns, rows),
    "hexagonal": lambda columns, rows, seed: hexagonal(columns, rows),
    "voronoi": lambda columns, rows, seed: voronoi(columns, rows, rng(seed)),
}
MASKS = {
    "rectangular": lambda blade, seed: rectangular_in(blade),
    "hexagonal": lambda blade, seed: hexagonal_in(blade),
    "voronoi": lambda blade, seed: voronoi_in(blade, rng(seed)),
}
CELL_AREA = {"rectangular": 1.0, "hexagonal": np.sqrt(0.75), "voronoi": 1.0}

boxes = st.tuples(
    st.sampled_from(sorted(MAKERS)), st.integers(2, 9), st.integers(2, 9), st.integers(0, 99)
).map(lambda one: MAKERS[one[0]](*one[1:]))
leaves = st.tuples(
    st.sampled_from(sorted(MASKS)),
    st.sampled_from(SHAPES),
    st.floats(8.0, 16.0),
    st.integers(0, 99),
).map(lambda one: MASKS[one[0]](BladeParameters(shape=one[1], length=one[2]).blade(), one[3]))
tissues = st.one_of(boxes, leaves)


@settings(max_examples=40)
@given(tissues)
def test_cells_fill_the_outline_and_are_the_tissue_of_euler(tissue):
    assert tissue.volumes.min() > 0.0
    assert tissue.volumes.sum() == pytest.approx(tissue.blade.area, rel=1e-6)
    sides = tissue.sides
    n_sides = len(sides.cells)
    n_edges = n_sides - int((sides.partners >= 0).sum()) // 2
    n_corners = len(np.unique(tissue.corners, axis=0))
    n_holes = len(outline_sides(sides)) - 1
    assert n_corners - n_edges + tissue.n_cells == 1 - n_holes
    # inside, three cells or more share every corner
    _, rows, counts = np.unique(tissue.corners, axis=0, return_inverse=True, return_counts=True)
    is_free = np.zeros(len(counts), dtype=bool)
    is_free[rows[np.isin(np.arange(n_sides), np.concatenate(outline_sides(sides)))]] = True
    assert (counts[~is_free] >= 3).all()


@settings(max_examples=40)
@given(tissues)
def test_walls_are_unique_and_have_a_length_and_a_distance(tissue):
    assert (tissue.walls[:, 0] < tissue.walls[:, 1]).all()
    assert len(np.unique(tissue.walls, axis=0)) == tissue.n_walls
    assert (np.lexsort(tissue.walls.T[::-1]) == np.arange(tissue.n_walls)).all()
    assert tissue.lengths.min() > 1e-6
    assert tissue.distances.min() > 0.05
    assert (tissue.hops(0) < np.inf).all()
    assert (tissue.adjacency != tissue.adjacency.T).nnz == 0


@settings(max_examples=15)
@given(tissues)
def test_walls_and_centres_are_those_of_the_slow_twin(tissue):
    expected = slow.walls(tissue)
    assert [tuple(pair) for pair in tissue.walls.tolist()] == sorted(expected)
    assert tissue.lengths == pytest.approx([expected[pair] for pair in sorted(expected)])
    centres = [slow.centroid(polygon) for polygon in tissue.polygons]
    assert tissue.positions == pytest.approx(np.array(centres), abs=1e-9)


@pytest.mark.parametrize(("make", "n_neighbors"), [(rectangular, 4), (hexagonal, 6)])
def test_cells_of_regular_tilings_have_as_many_neighbors_inside(make, n_neighbors):
    tissue = make(9, 7)
    counts = np.bincount(tissue.walls.ravel(), minlength=tissue.n_cells)
    assert (counts[~tissue.is_margin] == n_neighbors).all()
    assert (counts[tissue.is_margin] < n_neighbors).all()
    assert tissue.is_margin.sum() == 2 * (9 + 7) - 4
    assert tissue.distances == pytest.approx(1.0)
    assert tissue.volumes == pytest.approx(tissue.volumes[0])


def test_rows_of_hexagons_are_offset():
    tissue = hexagonal(3, 2)
    height = np.sqrt(0.75)
    expected = [(0, 0), (1, 0), (2, 0), (0.5, height), (1.5, height), (2.5, height)]
    assert tissue.positions == pytest.approx(np.array(expected), abs=1e-12)
    assert tissue.blade.bounds == pytest.approx((-0.5, -1 / np.sqrt(3), 3.0, height * 5 / 3))


def test_a_voronoi_tissue_follows_from_its_seed():
    one, same, other = (voronoi(8, 6, rng(seed)) for seed in (3, 3, 4))
    assert np.array_equal(one.corners, same.corners)
    assert np.array_equal(one.walls, same.walls)
    assert one.corners.shape != other.corners.shape or not np.array_equal(
        one.corners, other.corners
    )
    assert one.n_cells == 48
    assert one.volumes.mean() == pytest.approx(1.0)
    assert one.blade.bounds == (-0.5, -0.5, 7.5, 5.5)


def test_lloyd_steps_even_cells_out():
    spreads = [voronoi(20, 20, rng(), lloyd=lloyd).volumes.std() for lloyd in (0, 3, 30)]
    assert spreads[0] > 0.4
    assert spreads[1] < 0.7 * spreads[0]
    assert spreads[2] < 0.7 * spreads[1]


def test_voronoi_cells_are_the_ground_nearest_to_their_centres_nearly():
    tissue = voronoi(20, 20, rng(), lloyd=30)
    points = rng(2).uniform(0.0, 19.0, (2000, 2))
    nearest = tissue.nearest_cells(points)
    import shapely

    cells = np.array([shapely.Polygon(polygon) for polygon in tissue.polygons])
    assert shapely.contains_xy(cells[nearest], *points.T).mean() > 0.97


@pytest.mark.parametrize("kind", MASKS)
def test_cells_in_a_blade_cover_about_its_area(kind):
    blade = BladeParameters(shape="ovate", length=40.0).blade()
    tissue = MASKS[kind](blade, 1)
    assert tissue.n_cells * CELL_AREA[kind] == pytest.approx(blade.area, rel=0.02)
    if kind == "voronoi":
        assert tissue.blade == blade
    else:
        assert blade.contains(tissue.positions).all()
        assert (np.abs(tissue.positions[:, 0]) < 1e-9).any()


def test_a_hole_is_a_second_margin():
    turns = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    circle = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    centre = np.array([0.0, 10.0])
    blade = Blade.from_rings([centre + 10.0 * circle, centre + 3.0 * circle], [[0.0, 0.5]])
    for make in MASKS.values():
        tissue = make(blade, 1)
        assert len(tissue.margins) == len(tissue.blade.rings) == 2
        assert tissue.volumes.sum() == pytest.approx(tissue.blade.area, rel=1e-6)
    small = Blade.from_rings([centre + 10.0 * circle, centre + 0.01 * circle], [[0.0, 0.5]])
    with pytest.raises(OutlineError, match=r"the hole at .* lies in a single cell"):
        voronoi_in(small, rng())


def test_margins_go_around_by_walls():
    corner = Blade.from_rings(
        [[(-0.5, -0.5), (5.5, -0.5), (5.5, 2.5), (2.5, 2.5), (2.5, 5.5), (-0.5, 5.5)]], [[0.0, 0.0]]
    )
    blade = BladeParameters(shape="cordate", length=15.0).blade()
    made = [rectangular_in(corner), hexagonal(7, 5), *(make(blade, 2) for make in MASKS.values())]
    for tissue in made:
        (ring,) = tissue.margins
        assert ring[0] == ring[-1]
        pairs = {tuple(sorted(pair)) for pair in itertools.pairwise(ring)}
        assert pairs <= {tuple(pair) for pair in tissue.walls.tolist()}
        assert set(np.flatnonzero(tissue.is_margin)) <= set(ring.tolist())
    # where the margin turns in, the cell at the corner joins its neighbors
    (ring,) = made[0].margins
    between = made[0].nearest_cells([[2.0, 2.0]])[0]
    assert not made[0].is_margin[between]
    assert between in ring


def test_tips_are_taken_off_and_larger_parts_refused():
    # the neck has no cell of its own
    bar = [
        (-0.5, -0.5),
        (9.5, -0.5),
        (9.5, 4.4),
        (12.4, 4.4),
        (12.4, 4.0),
        (30.5, 4.0),
        (30.5, 9.5),
        (12.4, 9.5),
        (12.4, 4.6),
        (9.5, 4.6),
        (9.5, 9.5),
        (-0.5, 9.5),
    ]
    blade = Blade.from_rings([bar], [[0.0, 0.0]])
    with pytest.raises(OutlineError, match=r"falls apart: 100 cells around .* share no wall"):
        rectangular_in(blade)
    tip = [
        (-0.5, -0.5),
        (9.5, -0.5),
        (9.5, 4.4),
        (12.4, 4.4),
        (12.4, 3.6),
        (13.4, 3.6),
        (13.4, 5.4),
        (12.4, 5.4),
        (12.4, 4.6),
        (9.5, 4.6),
        (9.5, 9.5),
        (-0.5, 9.5),
    ]
    tissue = rectangular_in(Blade.from_rings([tip], [[0.0, 0.0]]))
    assert tissue.n_cells == 100


def test_a_cell_that_touches_others_by_a_corner_alone_is_taken_off():
    rhomb = Blade.from_rings([[(0, -4.1), (4.1, 0), (0, 4.1), (-4.1, 0)]], [[0.0, 0.0]])
    tissue = rectangular_in(rhomb)
    assert tissue.n_cells == 41
    assert len(tissue.blade.rings) == 1


@pytest.mark.parametrize("make", [rectangular_in, hexagonal_in])
def test_an_outline_without_room_is_refused(make):
    speck = Blade.from_rings([[(0.2, 0.2), (0.3, 0.2), (0.2, 0.3)]], [[0.2, 0.2]])
    with pytest.raises(OutlineError, match="has room for 0 cells"):
        make(speck)


def test_cells_that_share_too_much_or_too_little_are_refused():
    corners = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 1.0), (2.0, 2.0)])
    with pytest.raises(ValueError, match="more than two"):
        sides_of(rings_of(corners, [[0, 1, 2], [0, 1, 3], [1, 0, 4]]))
    with pytest.raises(ValueError, match="touches itself"):
        tissue_of(
            np.array([(0, 0), (1, 0), (1, 1), (0, 1), (2, 1), (2, 2), (1, 2.0)]),
            [[0, 1, 2, 3], [2, 4, 5, 6]],
        )


@pytest.mark.parametrize("make", [rectangular, hexagonal])
def test_forty_thousand_cells_are_made(make):
    assert make(200, 200).n_cells == 40_000


@pytest.mark.parametrize("kind", MASKS)
@pytest.mark.parametrize("length", [0.3, 1.0])
def test_a_blade_smaller_than_two_cells_is_refused(kind, length):
    blade = BladeParameters(shape="ovate", length=length).blade()
    with pytest.raises(OutlineError, match=r"has room for [01] cells? of width 1 D; at least 2"):
        MASKS[kind](blade, 1)


@pytest.mark.parametrize("kind", MASKS)
@pytest.mark.parametrize("shape", SHAPES)
def test_a_vein_may_begin_at_the_very_base_of_a_blade(kind, shape):
    tissue = MASKS[kind](BladeParameters(shape=shape, length=14.0).blade(), 1)
    assert not tissue.are_outside([(0.0, 0.0)]).any()
    assert tissue.are_outside([(0.0, -9.0)]).all()
