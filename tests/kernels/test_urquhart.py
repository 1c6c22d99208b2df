"""Urquhart neighbourhoods equal those by scipy's triangulation, and exact ones nearly always."""

import numpy as np
import pytest
from reference.relative_neighbors import relative_neighbors
from reference.urquhart import urquhart

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
    kernels.urquhart.perceive_new(grid, points, parents, places, live, perceived, cells, 6.0)
    for start in range(first, len(points), 7):
        stop = min(start + 7, len(points))
        kernels.hash_grid.insert(grid, points, start, stop)
        kernels.urquhart.update(points, parents, start, stop, places, live, perceived, cells)
    return [perceived.members[s, : perceived.n_members[s]].tolist() for s in live]


@pytest.mark.parametrize("first", [3, 60, 150])
def test_sets_equal_those_of_a_triangulation(first):
    rng = np.random.default_rng(first)
    nodes = [tuple(p) for p in rng.normal(size=(150, 2)).tolist()]
    sources = [tuple(p) for p in rng.normal(size=(80, 2)).tolist()]
    found = perceived_by_kernel(nodes, sources, first)
    assert found == [urquhart(place, nodes) for place in sources]


def test_the_approximation_is_seldom_wrong_and_never_too_small():
    rng = np.random.default_rng(1)
    nodes = [tuple(p) for p in rng.normal(size=(200, 2)).tolist()]
    sources = [tuple(p) for p in rng.normal(size=(200, 2)).tolist()]
    found = perceived_by_kernel(nodes, sources, 200)
    exact = [relative_neighbors(place, nodes) for place in sources]
    assert all(set(e) <= set(f) for e, f in zip(exact, found, strict=True))
    n_wrong = sum(e != f for e, f in zip(exact, found, strict=True))
    assert 1 <= n_wrong <= 12
