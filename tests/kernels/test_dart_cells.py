"""Darts against plain ones: cells that are covered, darts that find room, points kept apart."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from reference.darts import has_room, kept_apart

from vasc import kernels

SEEDS = st.integers(0, 2**32 - 1)
BOX = (0.0, 0.0, 8.0, 6.0)
SQUARE = np.array([[0.0, 0.0], [8.0, 0.0], [8.0, 6.0], [0.0, 6.0]])


def cells_over_the_box(side=0.5):
    """Cells over the whole box, all uncovered."""
    columns, rows = round(8.0 / side), round(6.0 / side)
    touched = np.ones(columns * rows, dtype=np.uint8)
    return kernels.darts.dart_cells(touched, (0.0, 0.0), side, columns)


def open_cells(cells):
    """The uncovered cells as a set, checked against their places in the list."""
    listed = cells.uncovered[: cells.n_uncovered[0]].tolist()
    assert [cells.place[cell] for cell in listed] == list(range(len(listed)))
    assert np.count_nonzero(cells.place >= 0) == len(listed)
    return set(listed)


def points_in(rng, n_points, is_on_lattice):
    """Points in and around the box."""
    points = rng.uniform(-1.0, 9.0, (n_points, 2))
    return np.round(2.0 * points) / 2.0 if is_on_lattice else points


@settings(max_examples=150)
@given(SEEDS, st.booleans(), st.sampled_from([0.3, 1.0, 2.1]))
def test_covered_cells_hold_no_place_that_is_far_from_all_nodes(seed, is_on_lattice, radius):
    rng = np.random.default_rng(seed)
    nodes, cells = points_in(rng, 25, is_on_lattice), cells_over_the_box()
    open_before = open_cells(cells)
    for start in range(0, 25, 5):
        kernels.darts.cover(cells, nodes, start, start + 5, radius)
        assert open_cells(cells) <= open_before
        open_before = open_cells(cells)
    corners = np.array([(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)])
    for cell in range(16 * 12):
        places = np.array([cell % 16, cell // 16]) * 0.5 + corners
        gaps = np.sqrt(((places[:, None] - nodes[None]) ** 2).sum(axis=2))
        # the farthest point of a cell from a node is a corner
        is_covered = (gaps.max(axis=0) < radius * (1.0 - 1e-6)).any()
        is_surely_open = (gaps.max(axis=0) > radius).all()
        assert not (cell in open_before and is_covered)
        assert cell in open_before or not is_surely_open


def test_the_order_of_uncovered_cells_depends_on_the_nodes_alone():
    nodes = points_in(np.random.default_rng(1), 30, False)
    at_once, by_parts = cells_over_the_box(), cells_over_the_box()
    kernels.darts.cover(at_once, nodes, 0, 30, 1.0)
    for start in range(0, 30, 3):
        kernels.darts.cover(by_parts, nodes, start, start + 3, 1.0)
    for one, other in zip(at_once, by_parts, strict=True):
        np.testing.assert_array_equal(one, other)


def test_darts_are_uniform_over_the_uncovered_cells():
    rng = np.random.default_rng(5)
    cells = cells_over_the_box()
    kernels.darts.cover(cells, np.array([[2.0, 2.0], [6.0, 4.0]]), 0, 2, 1.5)
    listed = open_cells(cells)
    assert len(listed) < 16 * 12
    darts = kernels.darts.aim(cells, rng.random((40_000, 3)))
    columns, rows = (darts / 0.5).astype(int).T
    counts = np.bincount(rows * 16 + columns, minlength=16 * 12)
    assert set(np.flatnonzero(counts).tolist()) == listed
    expected = 40_000 / len(listed)
    spread = ((counts[sorted(listed)] - expected) ** 2 / expected).sum()
    # chi-square has mean n - 1 and variance 2 (n - 1)
    assert abs(spread - (len(listed) - 1)) < 4.0 * np.sqrt(2.0 * len(listed))
    within = darts / 0.5 - np.stack([columns, rows], axis=1)
    assert abs(within.mean() - 0.5) < 4.0 * np.sqrt(1.0 / 12.0 / within.size)


@settings(max_examples=150)
@given(SEEDS, st.booleans(), st.sampled_from([0.5, 1.0, 1.5]), st.sampled_from([0.5, 1.0]))
def test_darts_become_sources_where_there_is_room(seed, is_on_lattice, to_sources, to_nodes):
    rng = np.random.default_rng(seed)
    nodes, darts = points_in(rng, 8, is_on_lattice), points_in(rng, 30, is_on_lattice)
    sources, is_live = np.zeros((40, 2)), np.zeros(40, dtype=np.uint8)
    sources[:6], is_live[:6] = points_in(rng, 6, is_on_lattice), rng.integers(0, 2, 6)
    node_grid = kernels.hash_grid.hash_grid(BOX, 0.8, 8)
    source_grid = kernels.hash_grid.hash_grid(BOX, 1.1, 40)
    kernels.hash_grid.insert(node_grid, nodes, 0, 8)
    kernels.hash_grid.insert(source_grid, sources, 0, 6)
    outline = kernels.polygon.edge_grid(SQUARE, np.array([0, 4], dtype=np.int32))
    live = [tuple(sources[s]) for s in range(6) if is_live[s]]
    expected = []
    for x, y in darts.tolist():
        is_in_blade = kernels.polygon.are_inside(outline, np.array([[x, y]]), 1.0)[0]
        if is_in_blade and has_room((x, y), live + expected, nodes, to_sources, to_nodes):
            expected.append((x, y))
    n_sources = kernels.darts.throw(
        darts, outline, 1.0, node_grid, nodes, source_grid, sources, is_live, 6,
        to_sources**2, to_nodes**2,
    )  # fmt: skip
    assert [tuple(p) for p in sources[6:n_sources].tolist()] == expected
    assert is_live[6:n_sources].all()


@given(SEEDS, st.booleans(), st.sampled_from([0.5, 1.0, 2.0]))
def test_points_are_kept_apart(seed, is_on_lattice, distance):
    points = points_in(np.random.default_rng(seed), 60, is_on_lattice)
    grid = kernels.hash_grid.hash_grid(BOX, distance, 60)
    kept = kernels.darts.keep_apart(points, grid, distance**2)
    assert kept.tolist() == kept_apart(points, distance)


def test_no_points_are_kept_of_none():
    grid = kernels.hash_grid.hash_grid(BOX, 1.0, 0)
    assert len(kernels.darts.keep_apart(np.empty((0, 2)), grid, 1.0)) == 0
