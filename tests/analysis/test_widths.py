"""Murray's law: by hand, against exact fractions, and its law of conservation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from reference import murray
from reference.halving import extended, halved, joined
from reference.networks import network, random_tree

from vasc.analysis import WidthParameters, murray_radii, segment_radii
from vasc.analysis.ancestry import descent
from vasc.analysis.widths import TIP_RADIUS, pipes

# seed 0, stalk 1, two arms 2 and 3; arm 2 has tips 4 and 5
TREE = network(np.zeros((6, 2)), [(0, 1), (1, 2), (1, 3), (2, 4), (2, 5)])
TIP = WidthParameters(tip_radius=1.0)

seeds = st.integers(0, 2**32 - 1)


def random_network(seed, n_nodes=40, n_joins=8):
    """A random tree with some joins from older to newer nodes."""
    rng = np.random.default_rng(seed)
    tree = random_tree(rng, n_nodes)
    for _ in range(n_joins):
        older, newer = sorted(rng.choice(n_nodes, 2, replace=False).tolist())
        if not (tree.segments == (older, newer)).all(axis=1).any():
            tree = joined(tree, older, newer)
    return tree


def parents_of(net):
    directions = descent(net)
    parents = [[] for _ in range(net.n_nodes)]
    for parent, child in zip(directions.proximal.tolist(), directions.distal.tolist(), strict=True):
        parents[child].append(parent)
    return parents


class TestByHand:
    def test_tree_counts_its_tips(self):
        assert pipes(TREE).nodes.tolist() == [3, 3, 2, 1, 1, 1]
        assert pipes(TREE).segments.tolist() == [3, 2, 1, 1, 1]

    @pytest.mark.parametrize("exponent", [1.0, 2.0, 3.0])
    def test_radius_is_the_root_of_the_tips(self, exponent):
        radii = murray_radii(TREE, WidthParameters(tip_radius=2.0, exponent=exponent))
        assert radii == pytest.approx(2.0 * np.array([3, 3, 2, 1, 1, 1]) ** (1 / exponent))

    def test_exponent_one_adds_radii(self):
        a, b = 2.0, 1.0
        radii = murray_radii(TREE, WidthParameters(tip_radius=1.0, exponent=1.0))
        assert radii[1] == pytest.approx(a + b)

    def test_veinlets_enter_at_every_node_but_the_tips(self):
        # 2: 2 tips + 1; 1: 3 + 1 tip + 1; 0: 5 + 1
        assert pipes(TREE, veinlets=1.0).nodes.tolist() == [6, 5, 3, 1, 1, 1]

    def test_loop_splits_what_enters_it(self):
        # 0 - 1, arms 1-2 and 1-3, joined at 4 (grown from 3), which has tips 5 and 6:
        # 4 serves 2 and sends 1 to each arm
        loop = network(
            np.zeros((7, 2)),
            [(0, 1), (1, 2), (1, 3), (3, 4), (2, 4), (4, 5), (4, 6)],
            kinds=[0, 0, 0, 0, 1, 0, 0],
            parents=[-1, 0, 1, 1, 3, 4, 4],
        )
        assert pipes(loop).nodes.tolist() == [2, 2, 1, 1, 2, 1, 1]
        assert pipes(loop).segments.tolist() == [2, 1, 1, 1, 1, 1, 1]

    def test_node_with_three_parents_sends_thirds(self):
        three = network(
            np.zeros((5, 2)),
            [(0, 1), (0, 2), (0, 3), (1, 4), (2, 4), (3, 4)],
            kinds=[0, 0, 0, 0, 1, 1],
        )
        assert pipes(three).nodes == pytest.approx([1, 1 / 3, 1 / 3, 1 / 3, 1])
        assert murray_radii(three, TIP).tolist() == [1.0] * 5, "no vein thinner than a tip"

    def test_seeds_and_no_segments(self):
        lonely = network([(0, 0), (1, 0)], [])
        assert murray_radii(lonely).tolist() == [TIP_RADIUS] * 2
        assert segment_radii(lonely).shape == (0,)

    def test_empty(self):
        assert murray_radii(network([], [])).shape == (0,)

    def test_base_radius_takes_the_place_of_the_exponent(self):
        radii = murray_radii(TREE, WidthParameters(tip_radius=1.0, base_radius=9.0))
        assert radii[0] == pytest.approx(9.0)
        # still Murray's law, with n = ln 3 / ln 9 = 1/2
        assert radii[1] ** 0.5 == pytest.approx(radii[2] ** 0.5 + radii[3] ** 0.5)


class TestLaws:
    @given(seeds, st.integers(0, 3))
    def test_equals_exact_fractions(self, seed, veinlets):
        net = random_network(seed)
        exact = murray.pipes(net.n_nodes, parents_of(net), veinlets)
        assert pipes(net, veinlets=veinlets).nodes == pytest.approx([float(a) for a in exact])

    @given(seeds, st.floats(0, 5))
    def test_what_begins_reaches_the_base(self, seed, veinlets):
        net = random_network(seed)
        directions = descent(net)
        served = pipes(net, veinlets=veinlets).nodes
        n_tips = (directions.n_children == 0).sum()
        begun = n_tips + veinlets * (net.n_nodes - n_tips)
        assert served[directions.n_parents == 0].sum() == pytest.approx(begun)

    @given(seeds)
    def test_murray_holds_at_every_branching_of_a_tree(self, seed):
        tree = random_tree(np.random.default_rng(seed), 30)
        radii = murray_radii(tree, WidthParameters(exponent=3.0))
        for node in range(tree.n_nodes):
            children = tree.segments[tree.segments[:, 0] == node, 1]
            if len(children):
                assert radii[node] ** 3 == pytest.approx((radii[children] ** 3).sum())

    @given(seeds)
    def test_order_of_segments_does_not_matter(self, seed):
        net = random_network(seed)
        order = np.random.default_rng(seed).permutation(net.n_segments)
        mixed = network(
            net.positions,
            net.segments[order],
            kinds=net.segment_kinds[order],
            origins=net.origins,
            parents=net.parents,
        )
        assert murray_radii(mixed) == pytest.approx(murray_radii(net))
        assert segment_radii(mixed) == pytest.approx(segment_radii(net)[order])

    @given(seeds)
    def test_direction_of_a_stored_segment_does_not_matter(self, seed):
        net = random_network(seed)
        turned = network(
            net.positions,
            net.segments[:, ::-1],
            kinds=net.segment_kinds,
            origins=net.origins,
            parents=net.parents,
        )
        assert murray_radii(turned).tolist() == murray_radii(net).tolist()


class TestHalvedSegments:
    @given(seeds)
    def test_halving_changes_no_width(self, seed):
        net = random_network(seed)
        rng = np.random.default_rng(seed)
        halves = halved(net, set(rng.choice(net.n_segments, 15, replace=False).tolist()))
        quarters = halved(halves, set(rng.choice(halves.n_segments, 20, replace=False).tolist()))
        expected = murray_radii(net)
        assert murray_radii(halves)[: net.n_nodes] == pytest.approx(expected)
        assert murray_radii(quarters)[: net.n_nodes] == pytest.approx(expected)

    def test_a_branch_off_a_halving_node_flows_to_the_base(self):
        # 0 - 1 - 2; 3 halves 1-2 and carries the new tip 4
        net = extended(halved(network(np.zeros((3, 2)), [(0, 1), (1, 2)]), {1}), 3, (1.0, 1.0))
        assert pipes(net).nodes.tolist() == [2, 2, 1, 2, 1]

    def test_a_join_onto_a_halving_node_makes_no_circle(self):
        # 5 halves 0-1, the base of all; the old tip 4 is joined to it: 4 has two ways down
        chain = network(np.zeros((5, 2)), [(0, 1), (1, 2), (2, 3), (3, 4)])
        net = joined(halved(chain, {0}), 4, 5)
        assert pipes(net).nodes == pytest.approx([1, 0.5, 0.5, 0.5, 1, 1])


class TestParameters:
    @pytest.mark.parametrize(
        "wrong",
        [
            {"exponent": 0.5},
            {"tip_radius": 0.0},
            {"veinlets": -1.0},
            {"base_radius": 0.1},
            {"tip_radius": 2.0, "base_radius": 1.0},
            {"width": 3},
        ],
    )
    def test_nonsense_is_refused(self, wrong):
        with pytest.raises(ValidationError):
            WidthParameters(**wrong)
