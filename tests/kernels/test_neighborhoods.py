"""The incremental neighbourhoods equal the obvious ones, whatever the order of the nodes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference.nearest import nearest
from reference.relative_neighbors import relative_neighbors, square

from vasc import kernels
from vasc.kernels.perceived import NO_CHANGE, OTHER_VEINS, SAME_VEINS

COARSE = st.tuples(st.integers(-4, 4), st.integers(-4, 4)).map(lambda p: (float(p[0]), float(p[1])))
FINE = st.tuples(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0))
LINE = st.integers(-6, 6).map(lambda x: (float(x), 0.0))
PLACES = st.one_of(COARSE, FINE, LINE)
LATTICES = {
    "square": [(float(x), float(y)) for x in range(-4, 5) for y in range(-4, 5)],
    "triangular": [(x + 0.5 * (y % 2), y * 0.75**0.5) for x in range(-4, 5) for y in range(-4, 5)],
    "line": [(float(x), 0.0) for x in range(-40, 41)],
    "ring": [(np.cos(a), np.sin(a)) for a in np.linspace(0.0, 6.0, 60).tolist()],
    "one place": [(0.5, 0.5)] * 20,
    "far outside the box": [(1e4 * np.cos(a), 1e4 * np.sin(a)) for a in range(1, 60)],
}


def follow(kernel, nodes, sources, first):
    """Perceive the sources among the first nodes, then offer the rest in small batches."""
    points = np.array(nodes, dtype=float).reshape(-1, 2)
    places = np.array(sources, dtype=float).reshape(-1, 2)
    parents = np.arange(-1, len(points) - 1, dtype=np.int32)
    grid = kernels.hash_grid.hash_grid((-3.0, -3.0, 3.0, 3.0), 0.9, len(points))
    perceived = kernels.perceived.perceived(len(places))
    live = np.arange(len(places), dtype=np.int32)
    kernels.hash_grid.insert(grid, points, 0, first)
    kernel.perceive_new(grid, points, places, live, perceived)
    yield first, perceived
    for start in range(first, len(points), 3):
        stop = min(start + 3, len(points))
        kernels.hash_grid.insert(grid, points, start, stop)
        kernel.update(grid, points, parents, start, stop, places, live, perceived)
        yield stop, perceived


def members(perceived, s):
    """The set of a source, as a list."""
    return perceived.members[s, : perceived.n_members[s]].tolist()


@pytest.mark.parametrize(
    ("name", "rule"),
    [("relative_neighbors", relative_neighbors), ("nearest", nearest)],
)
@settings(max_examples=500)
@given(
    nodes=st.lists(PLACES, min_size=1, max_size=40),
    sources=st.lists(PLACES, min_size=1, max_size=8),
    first=st.integers(1, 40),
)
def test_sets_follow_the_rule_after_every_batch(name, rule, nodes, sources, first):
    kernel = getattr(kernels, name)
    for n_nodes, perceived in follow(kernel, nodes, sources, min(first, len(nodes))):
        for s, place in enumerate(sources):
            assert members(perceived, s) == rule(place, nodes[:n_nodes])


@pytest.mark.parametrize("name", LATTICES)
@pytest.mark.parametrize("seed", range(3))
def test_sets_follow_the_rule_on_regular_nodes_in_any_order(name, seed):
    rng = np.random.default_rng(seed)
    nodes = [LATTICES[name][row] for row in rng.permutation(len(LATTICES[name]))]
    sources = [(0.0, 0.0), (0.5, 0.5), (0.25, 0.0), (-0.5, 0.375**0.5), (7.0, -9.0)]
    for n_nodes, perceived in follow(kernels.relative_neighbors, nodes, sources, 1):
        for s, place in enumerate(sources):
            assert members(perceived, s) == relative_neighbors(place, nodes[:n_nodes])


def expected_change(old, new, parents):
    """What a change of a set counts as: none, veins that went on, or others."""
    gone, come = set(old) - set(new), set(new) - set(old)
    if not gone and not come:
        return NO_CHANGE
    went_on = len(gone) == len(come) and all(parents[v] in old for v in come)
    return SAME_VEINS if went_on else OTHER_VEINS


@pytest.mark.parametrize(
    ("name", "rule"), [("relative_neighbors", relative_neighbors), ("nearest", nearest)]
)
@settings(max_examples=300)
@given(
    nodes=st.lists(PLACES, min_size=2, max_size=40),
    sources=st.lists(PLACES, min_size=1, max_size=8),
    seed=st.integers(0, 99),
)
def test_changes_are_told_from_the_sets_before_and_after(name, rule, nodes, sources, seed):
    points, places = np.array(nodes), np.array(sources)
    parents = np.array([-1, *np.random.default_rng(seed).integers(0, range(1, len(points)))])
    parents = parents.astype(np.int32)
    grid = kernels.hash_grid.hash_grid((-5.0, -5.0, 5.0, 5.0), 2.0, len(points))
    kernels.hash_grid.insert(grid, points, 0, 1)
    perceived, live = kernels.perceived.perceived(len(places)), np.arange(len(places))
    live, kernel = live.astype(np.int32), getattr(kernels, name)
    kernel.perceive_new(grid, points, places, live, perceived)
    assert (perceived.change == OTHER_VEINS).all()
    for start in range(1, len(points), 2):
        perceived.change[:] = NO_CHANGE
        before = [members(perceived, s) for s in live]
        stop = min(start + 2, len(points))
        kernels.hash_grid.insert(grid, points, start, stop)
        kernel.update(grid, points, parents, start, stop, places, live, perceived)
        for s, old in enumerate(before):
            new = members(perceived, s)
            assert new == rule(sources[s], nodes[:stop])
            if name == "relative_neighbors":
                assert perceived.change[s] == expected_change(old, new, parents)
                if old != new:
                    assert perceived.previous[s, : perceived.n_previous[s]].tolist() == old
            else:
                assert (perceived.change[s] != NO_CHANGE) == (old != new)


def test_many_random_nodes():
    rng = np.random.default_rng(3)
    nodes = [tuple(p) for p in rng.normal(size=(250, 2)).tolist()]
    sources = [tuple(p) for p in rng.normal(size=(60, 2)).tolist()]
    for n_nodes, perceived in follow(kernels.relative_neighbors, nodes, sources, 1):
        if n_nodes % 50 == 1 or n_nodes == len(nodes):
            for s, place in enumerate(sources):
                assert members(perceived, s) == relative_neighbors(place, nodes[:n_nodes])


def test_a_ring_of_five_has_five_members():
    angles = np.arange(5) * 2.0 * np.pi / 5.0
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    nodes = [tuple(p) for p in ring.tolist()]
    *_, (_, perceived) = follow(kernels.relative_neighbors, nodes, [(0.0, 0.0)], 2)
    assert sorted(members(perceived, 0)) == [0, 1, 2, 3, 4]


def test_no_source_and_no_new_node_change_nothing():
    points = np.zeros((1, 2))
    grid = kernels.hash_grid.hash_grid((0.0, 0.0, 1.0, 1.0), 1.0, 1)
    perceived = kernels.perceived.perceived(0)
    none = np.empty(0, dtype=np.int32)
    parents = np.array([-1], dtype=np.int32)
    kernels.relative_neighbors.update(
        grid, points, parents, 0, 1, np.empty((0, 2)), none, perceived
    )
    assert len(perceived.n_members) == 0


@settings(max_examples=200)
@given(points=st.lists(PLACES, max_size=40), place=PLACES, limit=st.floats(0.0, 9.0))
def test_grid_searches_equal_plain_ones(points, place, limit):
    array = np.array(points, dtype=float).reshape(-1, 2)
    grid = kernels.hash_grid.hash_grid((-2.0, -2.0, 2.0, 2.0), 0.7, len(points))
    kernels.hash_grid.insert(grid, array, 0, len(points))
    found, _ = kernels.hash_grid.nearest(grid, array, *place)
    assert [found] == (nearest(place, points) or [-1])
    expected = any(square(p, place) <= limit for p in points)
    assert kernels.hash_grid.any_within(grid, array, *place, limit) == expected
