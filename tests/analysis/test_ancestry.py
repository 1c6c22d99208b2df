"""The order of creation, with nodes that halve segments put where they lie."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from reference.halving import extended, halved, joined
from reference.networks import network, random_tree

from vasc.analysis.ancestry import creation_ranks, descent, grown_nodes

CHAIN = network(np.zeros((4, 2)), [(0, 1), (1, 2), (2, 3)])


def test_without_halving_ranks_are_ids():
    assert creation_ranks(CHAIN).tolist() == [0, 1, 2, 3]


def test_halving_nodes_rank_between_their_ends():
    # 4 halves 1-2; 5 halves 1-4 and 6 halves 4-2: 0 1 5 4 6 2 3
    halves = halved(CHAIN, {1})
    quarters = halved(halves, {1, 2})
    assert np.argsort(creation_ranks(quarters)).tolist() == [0, 1, 5, 4, 6, 2, 3]


@given(st.integers(0, 2**32 - 1))
def test_ranks_rise_along_every_vein(seed):
    rng = np.random.default_rng(seed)
    net = random_tree(rng, 25)
    for _ in range(4):
        net = halved(net, set(rng.choice(net.n_segments, 6, replace=False).tolist()))
        net = extended(net, int(rng.integers(net.n_nodes)), (0.5, 0.5))
    ranks = creation_ranks(net)
    assert sorted(ranks.tolist()) == list(range(net.n_nodes))
    assert (ranks[net.segments[:, 0]] < ranks[net.segments[:, 1]]).all()


@given(st.integers(0, 2**32 - 1))
def test_descent_has_no_circle(seed):
    rng = np.random.default_rng(seed)
    net = random_tree(rng, 25)
    net = halved(net, set(rng.choice(net.n_segments, 10, replace=False).tolist()))
    for _ in range(10):
        older, newer = sorted(rng.choice(net.n_nodes, 2, replace=False).tolist())
        net = joined(net, older, newer)
    directions = descent(net)
    assert (directions.ranks[directions.proximal] < directions.ranks[directions.distal]).all()
    assert (directions.n_parents == 0).sum() == 1


def test_halves_belong_to_the_node_they_lead_to():
    # 4 halves 1-2, 5 branches off 4 later, and 6 halves that branch
    net = extended(halved(CHAIN, {1}), 4, (1.0, 1.0))
    net = halved(net, {net.n_segments - 1})
    grown = grown_nodes(net, descent(net))
    found = {tuple(pair): node for pair, node in zip(net.segments.tolist(), grown, strict=True)}
    assert found == {(0, 1): 1, (1, 4): 2, (4, 2): 2, (2, 3): 3, (4, 6): 5, (6, 5): 5}
