"""Gravelius orders."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from reference.halving import halved, joined
from reference.networks import network, random_tree

from vasc.analysis import gravelius_orders


def test_the_thicker_child_continues_the_vein():
    # midvein 0 1 2 3 4 5, side vein 2 6 7 with a veinlet 6 8
    net = network(
        np.zeros((9, 2)),
        [(0, 1), (1, 2), (2, 3), (3, 4), (3, 5), (4, 9 - 1), (2, 6), (6, 7)],
    )
    # 3 serves 2 tips (5 and 8): midvein; 6 serves one: second order
    assert gravelius_orders(net).tolist() == [1, 1, 1, 1, 2, 1, 2, 2]


def test_all_veins_from_a_seed_are_first_order():
    palmate = network(np.zeros((4, 2)), [(0, 1), (0, 2), (0, 3)])
    assert gravelius_orders(palmate).tolist() == [1, 1, 1]


def test_every_seed_begins_its_own_first_order():
    assert gravelius_orders(network(np.zeros((4, 2)), [(0, 2), (1, 3)])).tolist() == [1, 1]


def test_a_join_continues_the_vein_it_springs_from():
    net = joined(network(np.zeros((5, 2)), [(0, 1), (1, 2), (1, 3), (2, 4)]), 3, 4)
    orders = dict(
        zip(map(tuple, net.segments.tolist()), gravelius_orders(net).tolist(), strict=True)
    )
    assert orders[3, 4] == orders[1, 3]


def test_empty():
    assert gravelius_orders(network([(0, 0)], [])).shape == (0,)


@given(st.integers(0, 2**32 - 1))
def test_halving_changes_no_order(seed):
    rng = np.random.default_rng(seed)
    net = random_tree(rng, 30)
    rows = set(rng.choice(net.n_segments, 10, replace=False).tolist())
    halves = halved(net, rows)
    whole = dict(zip(net.segments[:, 1].tolist(), gravelius_orders(net).tolist(), strict=True))
    for (_, distal), order in zip(
        halves.segments.tolist(), gravelius_orders(halves).tolist(), strict=True
    ):
        if distal < net.n_nodes:
            assert order == whole[distal]
