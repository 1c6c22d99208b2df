"""Vein orders of segments and nodes are those of the sections they lie in."""

from dataclasses import replace

import numpy as np
from reference.drawn_networks import pinnate_leaf
from reference.halving import halved
from reference.networks import PlainMoment, network, sources, square_blade

from vasc.analysis import WidthParameters, run_node_orders, segment_orders
from vasc.analysis.segment_orders import node_orders
from vasc.network import Origin, SegmentKind


def test_segments_of_a_pinnate_leaf():
    net, widths, orders = pinnate_leaf()
    assert segment_orders(net, widths).tolist() == orders


def test_a_vein_that_another_crosses_is_still_one_segment():
    # two veins of the midvein cross without a node
    points = [(0, 0), (0, 4), (0, 9), (5, 4), (0, 2), (3, 6)]
    net = network(points, [(0, 4), (4, 1), (1, 2), (1, 3), (4, 5)])
    widths = np.array([9.0, 8.0, 7.0, 4.0, 1.0])
    assert segment_orders(net, widths).tolist() == [1, 1, 1, 2, 2]


def test_what_is_not_drawn_has_the_order_of_what_it_touches():
    net, widths, orders = pinnate_leaf()
    # a segment without length at the tip of a secondary vein, and one on the midvein
    points = np.vstack([net.positions, net.positions[4:5]])
    pairs = np.vstack([net.segments, [[4, net.n_nodes], [1, 0]]])
    found = segment_orders(network(points, pairs), np.append(widths, [2.0, 9.0])).tolist()
    assert found[: len(orders)] == orders
    assert found[len(orders) :] == [2, 1]


def test_strands_in_space_and_nothing():
    flat = network([(0, 0), (0, 1), (1, 2)], [(0, 1), (1, 2)])
    strands = replace(flat, positions=np.zeros((3, 3)))
    assert segment_orders(strands, np.array([1.0, 0.1])).tolist() == [1, 1]
    assert segment_orders(network(np.zeros((1, 2)), []), np.zeros(0)).shape == (0,)


def test_nodes_have_the_order_of_the_segment_that_leads_to_them():
    # the midvein 0 1 2 from a seed; 3 4 off node 1, joined to the tip; node 5 was replaced
    points = [(0, 0), (0, 2), (0, 6), (3, 3), (4, 6), (9, 9)]
    kinds = [SegmentKind.EXTENSION] * 4 + [SegmentKind.JOIN]
    net = network(
        points,
        [(0, 1), (1, 2), (1, 3), (3, 4), (2, 4)],
        kinds=kinds,
        origins=[Origin.SEED] + [Origin.EXTENSION] * 5,
    )
    orders = np.array([1, 1, 2, 2, 1], dtype=np.int32)
    assert node_orders(net, orders).tolist() == [1, 1, 1, 2, 2, -1]


def test_halving_changes_no_order():
    net, widths, orders = pinnate_leaf()
    halves = halved(net, {0, 3})
    by_middle = np.append(widths[[0, 0, 1, 2, 3, 3]], widths[4:])
    found = segment_orders(halves, by_middle).tolist()
    assert found == [1, 1, 1, 1, 2, 2, *orders[4:]]
    assert node_orders(halves, np.array(found, dtype=np.int32))[net.n_nodes :].tolist() == [1, 2]


def test_nodes_of_a_run_born_later_have_none_yet():
    net, _, _ = pinnate_leaf()
    moment = PlainMoment(net, square_blade(), sources(), step=4)
    found = run_node_orders(lambda step: moment, 4, WidthParameters(), net.n_nodes + 2)
    assert found[-2:].tolist() == [-1, -1]
    assert found[:2].tolist() == [1, 1]
