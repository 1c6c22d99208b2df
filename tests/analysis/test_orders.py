"""Vein orders and stream orders of drawings whose orders are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.drawn_networks import binary_tree, junction, pinnate_leaf, without_seeds
from reference.networks import grid, network, random_planar, random_tree

from vasc.analysis import find_sections, vein_orders
from vasc.analysis.axes import find_axes
from vasc.analysis.strahler import stream_orders
from vasc.analysis.vein_orders import base_points

seeds = st.integers(0, 2**32 - 1)


def by_segment(net, widths, found):
    """Orders of the network's own segments."""
    sections = find_sections(net, widths)
    orders = np.zeros(net.n_segments, dtype=int)
    orders[sections.rows] = found(sections)[sections.owners]
    return orders.tolist()


class TestVeinOrders:
    @pytest.mark.parametrize("known", [True, False], ids=["seed", "no seed"])
    def test_a_pinnate_leaf(self, known):
        net, widths, orders = pinnate_leaf()
        net = net if known else without_seeds(net)
        assert by_segment(net, widths, vein_orders) == orders

    def test_a_main_vein_stays_one_through_a_fork(self):
        # nearly equal branches at 20 and 30 degrees: the straighter, thicker one goes on
        net, widths = junction([270, 110, 60], [3.0, 2.9, 2.0])
        assert by_segment(net, widths, vein_orders) == [1, 1, 2]

    def test_equal_veins_from_the_base_are_all_of_first_order(self):
        points = [(0, 0), (0, 5), (0, 9), (-6, 7), (6, 7), (2, 7)]
        net = network(points, [(0, 1), (1, 2), (0, 3), (0, 4), (1, 5)])
        assert by_segment(net, np.array([5, 4.8, 4.5, 4.4, 1]), vein_orders) == [1, 1, 1, 1, 2]

    def test_a_veinlet_on_the_midvein_is_no_secondary_vein(self):
        net, widths, orders = pinnate_leaf()
        points = np.vstack([net.positions, [[0.5, 1.5]]])
        pairs = np.vstack([net.segments, [[1, net.n_nodes]]])
        with_veinlet = network(points, pairs)
        assert by_segment(with_veinlet, np.append(widths, 0.5), vein_orders) == [*orders, 3]

    def test_every_piece_begins_anew(self):
        net, widths, orders = pinnate_leaf()
        both = network(
            np.concatenate([net.positions, net.positions + 20.0]),
            np.concatenate([net.segments, net.segments + net.n_nodes]),
        )
        assert by_segment(without_seeds(both), np.tile(widths, 2), vein_orders) == orders * 2

    @given(seeds, st.floats(0.1, 1.0), st.floats(0.0, 6.0), st.floats(0.1, 10.0))
    def test_every_section_has_an_order_and_turning_keeps_it(self, seed, share, angle, size):
        rng = np.random.default_rng(seed)
        net = without_seeds(random_planar(rng, 30, share))
        widths = rng.uniform(1.0, 9.0, net.n_segments)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        moved = without_seeds(network(size * net.positions @ turn.T, net.segments))
        orders = by_segment(net, widths, vein_orders)
        assert min(orders, default=1) == 1
        assert by_segment(moved, widths * size, vein_orders) == orders

    def test_a_star_of_very_many_veins(self):
        net, widths = junction(np.linspace(0.0, 359.9, 20_000), np.linspace(1.0, 9.0, 20_000))
        orders = by_segment(without_seeds(net), widths, vein_orders)
        assert orders[-1] == 1
        assert orders == sorted(orders, reverse=True)

    def test_nothing(self):
        assert vein_orders(find_sections(network([], []))).shape == (0,)


class TestAxes:
    @given(seeds, st.floats(0.2, 1.0))
    def test_axes_have_no_branches(self, seed, share):
        rng = np.random.default_rng(seed)
        sections = find_sections(random_planar(rng, 30, share))
        axes = find_axes(sections)
        for axis in range(axes.n_axes):
            ends = sections.ends[axes.of_sections == axis]
            # one section more than joints, or as many in a ring
            assert len(np.unique(ends)) <= len(ends) + 1
        assert sorted(set(axes.of_sections.tolist())) == list(range(axes.n_axes))

    def test_lines_of_a_grid_go_straight_on(self):
        sections = find_sections(without_seeds(grid(3, 3)))
        # 2 lines across, 2 upright, and 4 sides: no vein turns a corner of a junction
        assert find_axes(sections).n_axes == 5
        assert len(np.unique(find_axes(sections).of_sections[sections.lengths < 2.0])) >= 4

    def test_right_angles_are_no_continuation(self):
        net, widths = junction([0, 90], [1.0, 1.0])
        assert find_axes(find_sections(net, widths)).n_axes == 2

    def test_the_base_is_the_wide_end_of_the_main_vein(self):
        net, widths, _ = pinnate_leaf()
        sections = find_sections(without_seeds(net), widths)
        assert base_points(sections, find_axes(sections)).tolist() == [0]


def strahler_plain(net):
    """Strahler's order of the vein below each node of a tree, by recursion."""
    children = {}
    for parent, child in net.segments.tolist():
        children.setdefault(parent, []).append(child)

    def order(node):
        below = sorted((order(child) for child in children.get(node, [])), reverse=True)
        if not below:
            return 1
        return below[0] + (len(below) > 1 and below[0] == below[1])

    return {child: order(child) for _, child in net.segments.tolist()}


class TestStreams:
    @pytest.mark.parametrize("depth", [1, 2, 3, 6])
    def test_a_binary_tree(self, depth):
        found = stream_orders(find_sections(binary_tree(depth)))
        assert found.counts() == {k: 2 ** (depth - k) for k in range(1, depth + 1)}
        if depth > 1:
            assert found.bifurcation_ratio() == pytest.approx(2.0)
        else:
            assert np.isnan(found.bifurcation_ratio())
        # a main stream from the base to a tip has one order by Horton
        assert (found.horton == depth).sum() == depth

    def test_a_comb_has_one_stream_of_second_order(self):
        points = [(0, k) for k in range(6)] + [(1, k + 0.3) for k in range(1, 5)]
        pairs = [(k, k + 1) for k in range(5)] + [(k, k + 5) for k in range(1, 5)]
        found = stream_orders(find_sections(network(points, pairs)))
        assert found.counts() == {1: 5, 2: 1}

    @given(seeds)
    def test_equals_recursion_on_trees(self, seed):
        rng = np.random.default_rng(seed)
        tree = random_tree(rng, 30)
        # laid out so that nothing crosses: a fan of depth against number of the leaf
        net = network(_laid_out(tree), tree.segments)
        found = by_segment(net, np.ones(net.n_segments), lambda s: stream_orders(s).orders)
        expected = strahler_plain(net)
        assert found == [expected[child] for _, child in net.segments.tolist()]

    def test_a_loop_is_cut_in_its_thinnest_vein(self):
        # a stalk, and a ring of two sides of which the left is thinner
        points = [(0, 0), (0, 1), (-1, 2), (1, 2), (0, 3), (0, 4)]
        pairs = [(0, 1), (1, 2), (2, 4), (1, 3), (3, 4), (4, 5)]
        sections = find_sections(network(points, pairs), np.array([5.0, 1, 1, 3, 3, 3]))
        found = stream_orders(sections)
        assert found.is_cut.sum() == 1
        assert sections.widths[found.is_cut] == pytest.approx([1.0])
        # the two halves, and the veinlet at the top
        assert found.counts() == {1: 3, 2: 1}

    @given(seeds, st.floats(0.0, 1.0))
    def test_streams_add_up(self, seed, share):
        rng = np.random.default_rng(seed)
        net = without_seeds(random_planar(rng, 30, share))
        sections = find_sections(net, rng.uniform(1.0, 9.0, net.n_segments))
        found = stream_orders(sections)
        # as many sections cut as there are independent cycles
        n_points = (sections.degrees > 0).sum()
        graph_pieces = len(np.unique(_pieces(sections)))
        assert found.is_cut.sum() == sections.n_sections - n_points + graph_pieces
        assert (found.horton >= found.orders).all()


def _pieces(sections):
    import networkx as nx

    graph = nx.MultiGraph(sections.ends.tolist())
    return [min(piece) for piece in nx.connected_components(graph)]


def _laid_out(tree):
    """Places for the nodes of a tree: right of the parent, leaves one above the other."""
    children = {}
    for parent, child in tree.segments.tolist():
        children.setdefault(parent, []).append(child)
    places, n_leaves = {}, 0
    depth = {0: 0}
    for parent, child in tree.segments.tolist():
        depth[child] = depth[parent] + 1

    def visit(node):
        nonlocal n_leaves
        own = children.get(node, [])
        if own:
            heights = [visit(child) for child in own]
            height = sum(heights) / len(heights)
        else:
            height, n_leaves = float(n_leaves), n_leaves + 1
        places[node] = (4.0 * depth[node], height)
        return height

    visit(0)
    return [places[node] for node in range(tree.n_nodes)]
