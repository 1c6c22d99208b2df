"""Urquhart neighbourhoods equal those by scipy's triangulation, and exact ones nearly always."""

import numpy as np
import pytest
from reference.relative_neighbors import relative_neighbors
from reference.urquhart import delaunay_neighbors, urquhart, voronoi_neighbors

from vasc import kernels


def perceived_by_kernel(nodes, sources, first):
    """What the kernel finds when the nodes come in batches."""
    points, places = np.array(nodes), np.array(sources)
    parents = np.arange(-1, len(points) - 1, dtype=np.int32)
    grid = kernels.hash_grid.hash_grid((-3.0, -3.0, 3.0, 3.0), 0.4, len(points))
    perceived = kernels.perceived.perceived(len(places))
    cells = kernels.urquhart.voronoi_cells(len(places))
    live = np.arange(len(places), dtype=np.int32)
    kernels.hash_grid.insert(grid, points, 0, first)
    cells = kernels.urquhart.perceive_new(
        grid, points, parents, places, live, perceived, cells, 6.0
    )
    for start in range(first, len(points), 7):
        stop = min(start + 7, len(points))
        kernels.hash_grid.insert(grid, points, start, stop)
        cells = kernels.urquhart.update(
            points, parents, start, stop, places, live, perceived, cells
        )
    return [perceived.members[s, : perceived.n_members[s]].tolist() for s in live]


@pytest.mark.parametrize("first", [3, 60, 150])
def test_sets_equal_those_of_a_triangulation(first):
    rng = np.random.default_rng(first)
    nodes = [tuple(p) for p in rng.normal(size=(150, 2)).tolist()]
    sources = [tuple(p) for p in rng.normal(size=(80, 2)).tolist()]
    found = perceived_by_kernel(nodes, sources, first)
    assert found == [urquhart(place, nodes, delaunay_neighbors) for place in sources]


def test_the_approximation_is_seldom_wrong_and_never_too_small():
    rng = np.random.default_rng(1)
    nodes = [tuple(p) for p in rng.normal(size=(200, 2)).tolist()]
    sources = [tuple(p) for p in rng.normal(size=(200, 2)).tolist()]
    found = perceived_by_kernel(nodes, sources, 200)
    exact = [relative_neighbors(place, nodes) for place in sources]
    assert all(set(e) <= set(f) for e, f in zip(exact, found, strict=True))
    n_wrong = sum(e != f for e, f in zip(exact, found, strict=True))
    assert 1 <= n_wrong <= 12


@pytest.mark.parametrize("seed", range(4))
def test_bisectors_give_the_neighbors_of_a_triangulation(seed):
    rng = np.random.default_rng(seed)
    nodes = [tuple(p) for p in rng.normal(size=(60, 2)).tolist()]
    for place in rng.normal(size=(20, 2)).tolist():
        assert voronoi_neighbors(place, nodes) == sorted(delaunay_neighbors(place, nodes))


@pytest.mark.parametrize("n_nodes", [1, 2, 3, 9])
def test_nodes_on_a_line_are_no_exception(n_nodes):
    nodes = [(0.0, float(y)) for y in range(n_nodes)]
    rng = np.random.default_rng(n_nodes)
    sources = [tuple(p) for p in rng.uniform(-4.0, 9.0, (30, 2)).tolist()]
    sources += [(0.0, 0.25), (0.0, -1.5), (0.0, 20.0)]
    found = perceived_by_kernel(nodes, sources, 1)
    assert found == [urquhart(place, nodes) for place in sources]


@pytest.mark.parametrize("seed", range(6))
def test_sets_equal_those_by_bisectors_with_nodes_twice_and_in_curved_veins(seed):
    rng = np.random.default_rng(seed)
    turns = rng.normal(0.0, 0.3, (3, 25)).cumsum(axis=1) + rng.uniform(0.0, 6.0, (3, 1))
    veins = np.stack([np.cos(turns), np.sin(turns)], axis=2).cumsum(axis=1) / 4.0
    nodes = [tuple(p) for p in veins.reshape(-1, 2).tolist()]
    nodes += nodes[10:20]
    sources = [tuple(p) for p in rng.normal(size=(40, 2)).tolist()]
    found = perceived_by_kernel(nodes, sources, 5)
    assert found == [urquhart(place, nodes) for place in sources]


@pytest.mark.parametrize("first", [1, 100, 300])
def test_a_source_beside_a_long_vein_has_hundreds_of_delaunay_neighbors(first):
    # every node on a line is a Delaunay neighbour of a source beside it, and on an arc nearly
    turns = np.linspace(0.2, 2.9, 150)
    arc = np.stack([5.0 * np.cos(turns), 5.1 * np.sin(turns)], axis=1)
    line = np.stack([np.zeros(150), np.linspace(-9.0, -1.0, 150)], axis=1)
    nodes = [tuple(p) for p in np.concatenate([line, arc]).tolist()]
    nodes = [nodes[row] for row in np.random.default_rng(1).permutation(300)]
    sources = [(0.5, 0.0), (0.0, -0.5), (-4.0, -5.0), (4.0, -5.0), (0.1, -2.03)]
    found = perceived_by_kernel(nodes, sources, first)
    assert len(voronoi_neighbors(sources[2], nodes)) > 130
    assert found == [urquhart(place, nodes) for place in sources]


@pytest.mark.parametrize("first", [1, 4])
def test_nodes_on_the_source_are_perceived_once(first):
    nodes = [(3.0, 0.0), (0.0, 0.0), (0.0, 0.0), (-2.0, 0.5), (0.5, 4.0)]
    found = perceived_by_kernel(nodes, [(0.0, 0.0), (3.0, 0.0)], first)
    assert found == [relative_neighbors(place, nodes) for place in [(0.0, 0.0), (3.0, 0.0)]]
    assert found[0] == [1, 3, 0, 4]
