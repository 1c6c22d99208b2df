"""Components, cycles, degrees, free ends."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.networks import grid, network, random_planar, random_tree

from vasc.analysis.topology import (
    count_components,
    count_cycles,
    free_ends,
    junction_degree,
    junctions,
)


@given(st.integers(0, 2**32 - 1))
def test_trees_have_no_cycle(seed):
    tree = random_tree(np.random.default_rng(seed), 30)
    assert (count_components(tree), count_cycles(tree)) == (1, 0)


def test_grid_has_a_cycle_per_areole():
    assert count_cycles(grid(5, 3)) == 15
    assert count_components(grid(5, 3)) == 1


@given(st.integers(0, 2**32 - 1), st.floats(0.1, 0.9))
def test_agrees_with_networkx(seed, share):
    import networkx

    net = random_planar(np.random.default_rng(seed), 40, share)
    graph = networkx.Graph(net.segments.tolist())
    graph.add_nodes_from(range(net.n_nodes))
    assert count_components(net) == networkx.number_connected_components(graph)
    assert count_cycles(net) == len(networkx.cycle_basis(graph))


def test_nodes_without_segments_are_components():
    net = network(np.zeros((4, 2)), [(0, 1)])
    assert (count_components(net), count_cycles(net)) == (3, 0)


def test_seeds_are_no_free_ends():
    net = network(np.zeros((5, 2)), [(0, 1), (1, 2), (1, 3), (3, 4)])
    assert free_ends(net).tolist() == [2, 4]


def test_junctions_of_a_grid():
    # 6 x 4 nodes: 4 corners of degree 2, 12 on the sides of degree 3, 8 inside of degree 4
    assert len(junctions(grid(5, 3))) == 20
    assert junction_degree(grid(5, 3)) == {3: pytest.approx(0.6), 4: pytest.approx(0.4)}


def test_empty():
    empty = network([], [])
    assert (count_components(empty), count_cycles(empty)) == (0, 0)
    assert junction_degree(empty) == {}
    assert free_ends(empty).shape == (0,)
