"""Areoles: known areas, Euler's formula, and crossings."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from reference.halving import extended
from reference.networks import grid, network, random_planar, random_tree

from vasc.analysis import find_areoles
from vasc.analysis.faces import planar_drawing
from vasc.analysis.topology import count_components, count_cycles
from vasc.faces import face_walks

seeds = st.integers(0, 2**32 - 1)


def square(left, bottom, side):
    return [
        (left, bottom),
        (left + side, bottom),
        (left + side, bottom + side),
        (left, bottom + side),
    ]


RING = [(0, 1), (1, 2), (2, 3), (0, 3)]


class TestKnownAreas:
    def test_grid(self):
        areoles = find_areoles(grid(4, 3, width=2.0, height=0.5))
        assert areoles.n_areoles == 12
        assert areoles.areas == pytest.approx([1.0] * 12)
        assert areoles.area_variation == pytest.approx(0.0, abs=1e-12)

    def test_variation_is_standard_deviation_over_mean(self):
        # a unit square beside a 3 x 1 rectangle: mean 2, standard deviation 1
        net = network(
            [(0, 0), (1, 0), (1, 1), (0, 1), (4, 0), (4, 1)],
            [(0, 1), (1, 2), (2, 3), (0, 3), (1, 4), (4, 5), (2, 5)],
        )
        areoles = find_areoles(net)
        assert sorted(areoles.areas) == pytest.approx([1.0, 3.0])
        assert areoles.mean_area == pytest.approx(2.0)
        assert areoles.area_variation == pytest.approx(0.5)

    def test_free_ending_veins_divide_nothing(self):
        net = extended(extended(network(square(0, 0, 2), RING), 0, (1, 1)), 4, (1.5, 1))
        assert find_areoles(net).areas == pytest.approx([4.0])

    def test_trees_have_none(self):
        # a chain in the plane, so that nothing crosses
        chain = network(
            np.stack([np.arange(20.0), np.arange(20.0) ** 2], axis=1),
            [(k, k + 1) for k in range(19)],
        )
        areoles = find_areoles(chain)
        assert areoles.n_areoles == 0
        assert np.isnan(areoles.mean_area)

    @pytest.mark.parametrize("net", [network([], []), network([(0, 0)], [])])
    def test_empty(self, net):
        assert find_areoles(net).n_areoles == 0

    def test_far_from_the_origin(self):
        far = grid(3, 3)
        moved = network(far.positions + np.array([1e6, -1e6]), far.segments)
        assert find_areoles(moved).areas == pytest.approx([1.0] * 9)


class TestCrossings:
    def test_diagonals_that_cross_make_four(self):
        net = network(square(0, 0, 2), [*RING, (0, 2), (1, 3)])
        assert count_cycles(net) == 3
        assert find_areoles(net).areas == pytest.approx([1.0] * 4)

    def test_an_end_that_touches_a_vein_closes_an_areole(self):
        net = network([*square(0, 0, 2), (1, 0)], [*RING, (3, 4)])
        assert sorted(find_areoles(net).areas) == pytest.approx([1.0, 3.0])

    def test_veins_on_top_of_each_other_count_once(self):
        net = network([*square(0, 0, 2), (1, 0), (3, 0)], [*RING, (4, 5), (0, 4)])
        assert find_areoles(net).areas == pytest.approx([4.0])

    def test_twice_the_same_node(self):
        net = network([*square(0, 0, 2), (0, 0)], [*RING, (0, 4), (2, 4)])
        assert find_areoles(net).areas == pytest.approx([2.0, 2.0])

    @given(seeds)
    def test_equals_shapely_on_a_tangle(self, seed):
        rng = np.random.default_rng(seed)
        net = network(rng.random((12, 2)), random_tree(rng, 12).segments)
        lines = shapely.unary_union(shapely.multilinestrings(net.positions[net.segments]))
        expected = sorted(shapely.area(shapely.get_parts(shapely.polygonize([lines]))))
        assert sorted(find_areoles(net).areas) == pytest.approx(expected, abs=1e-12)


class TestIslands:
    def test_a_network_inside_an_areole_takes_its_area(self):
        net = network([*square(0, 0, 4), *square(1, 1, 1)], [*RING, (4, 5), (5, 6), (6, 7), (4, 7)])
        assert sorted(find_areoles(net).areas) == pytest.approx([1.0, 15.0])

    def test_only_the_innermost_areole_around_it_loses_area(self):
        points = [*square(0, 0, 9), *square(1, 1, 5), *square(2, 2, 1)]
        rings = [(a + shift, b + shift) for shift in (0, 4, 8) for a, b in RING]
        assert sorted(find_areoles(network(points, rings)).areas) == pytest.approx([1, 24, 56])

    def test_a_network_beside_another_takes_nothing(self):
        points = [*square(0, 0, 2), *square(5, 0, 1)]
        rings = [(a + shift, b + shift) for shift in (0, 4) for a, b in RING]
        assert sorted(find_areoles(network(points, rings)).areas) == pytest.approx([1.0, 4.0])


class TestLaws:
    @given(seeds, st.floats(0.05, 1.0))
    def test_euler(self, seed, share):
        net = random_planar(np.random.default_rng(seed), 60, share)
        drawing = planar_drawing(net)
        assert drawing.segments is net.segments, "nothing crosses"
        assert find_areoles(net).n_areoles == count_cycles(net)
        if net.n_segments:
            walks = face_walks(drawing)
            n_used = (net.degrees > 0).sum()
            n_pieces = count_components(net) - (net.n_nodes - n_used)
            assert len(walks.areas) == net.n_segments - n_used + 2 * n_pieces

    @given(seeds)
    def test_triangles_fill_the_hull(self, seed):
        net = random_planar(np.random.default_rng(seed), 40, 1.0)
        areas = find_areoles(net).areas
        assert (areas > 0).all()
        assert areas.sum() == pytest.approx(shapely.MultiPoint(net.positions).convex_hull.area)

    @given(seeds, st.floats(0.0, 6.0))
    def test_turning_changes_no_area(self, seed, angle):
        net = random_planar(np.random.default_rng(seed), 40, 0.7)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        turned = network(net.positions @ turn.T, net.segments)
        assert sorted(find_areoles(turned).areas) == pytest.approx(sorted(find_areoles(net).areas))
