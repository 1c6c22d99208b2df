"""Spanning trees, distances to the nearest vein, and boxes: against other programs and by hand."""

import networkx as nx
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from reference.drawn_networks import binary_tree, without_seeds
from reference.networks import grid, network, random_planar

from vasc.analysis import find_sections
from vasc.analysis.spanning_tree import mst_ratio
from vasc.analysis.vein_distance import (
    box_dimension,
    distances_to_vein,
    enclosed_region,
    places_in,
)

seeds = st.integers(0, 2**32 - 1)


class TestSpanningTree:
    @given(seeds, st.floats(0.1, 1.0))
    def test_equals_networkx(self, seed, share):
        net = random_planar(np.random.default_rng(seed), 40, share)
        sections = find_sections(net)
        if not sections.n_sections:
            return
        graph = nx.MultiGraph()
        for (one, other), length in zip(sections.ends.tolist(), sections.lengths, strict=True):
            graph.add_edge(one, other, weight=length)
        tree = nx.minimum_spanning_edges(graph, data=True, keys=False)
        expected = sum(edge["weight"] for *_, edge in tree) / net.lengths.sum()
        assert mst_ratio(sections) == pytest.approx(expected)

    def test_a_tree_needs_all_of_itself(self):
        assert mst_ratio(find_sections(binary_tree(5))) == pytest.approx(1.0)

    def test_a_grid_without_its_corners(self):
        # 3 x 3 squares: 4 sections of two at the corners, 16 of one between 12 junctions
        assert mst_ratio(find_sections(without_seeds(grid(3, 3)))) == pytest.approx(11.0 / 24.0)

    def test_two_ways_between_the_same_ends(self):
        points = [(0, 0), (1, 0), (1, 1), (0, 1), (-1, 0), (2, 0)]
        pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 0), (1, 5)]
        assert mst_ratio(find_sections(network(points, pairs))) == pytest.approx(3.0 / 6.0)

    def test_nothing(self):
        assert np.isnan(mst_ratio(find_sections(network([], []))))


class TestDistance:
    @given(seeds, st.floats(0.2, 1.0))
    def test_equals_shapely(self, seed, share):
        rng = np.random.default_rng(seed)
        net = random_planar(rng, 40, share)
        places = rng.random((200, 2))
        veins = shapely.multilinestrings(net.positions[net.segments])
        found = distances_to_vein(find_sections(net), places)
        if net.n_segments:
            assert found == pytest.approx(shapely.distance(shapely.points(places), veins), abs=1e-9)
        else:
            assert found.shape == (0,)

    def test_in_squares_a_sixth_of_the_side(self):
        # in a square the distance to the side has the mean a / 6
        sections = find_sections(grid(4, 4, 3.0, 3.0))
        places = places_in(enclosed_region(sections))
        assert distances_to_vein(sections, places).mean() == pytest.approx(0.5, rel=0.005)

    def test_places_fill_the_region_evenly(self):
        triangle = shapely.Polygon([(0, 0), (4, 0), (0, 2)])
        places = places_in(triangle, 20_000)
        assert len(places) == pytest.approx(10_000, rel=0.01)
        assert places.mean(axis=0) == pytest.approx([4 / 3, 2 / 3], rel=0.01)
        assert shapely.contains_xy(triangle, places).all()

    def test_a_region_without_area_has_no_places(self):
        assert places_in(shapely.Polygon()).shape == (0, 2)
        assert enclosed_region(find_sections(binary_tree(3))).is_empty

    def test_the_region_is_all_areoles_together(self):
        region = enclosed_region(find_sections(grid(3, 2)))
        assert region.area == pytest.approx(6.0)
        assert region.geom_type == "Polygon"


class TestBoxes:
    def test_a_line_has_one_dimension(self):
        line = network([(0, 0), (3, 0)], [(0, 1)])
        assert box_dimension(find_sections(line)) == pytest.approx(1.0, abs=0.01)

    def test_a_fine_grid_has_two(self):
        assert box_dimension(find_sections(grid(150, 150))) == pytest.approx(2.0, abs=0.01)

    @given(seeds, st.floats(1e-3, 1e3))
    def test_size_does_not_matter(self, seed, size):
        net = random_planar(np.random.default_rng(seed), 20, 0.8)
        large = network(net.positions * size, net.segments)
        found = [box_dimension(find_sections(each)) for each in (net, large)]
        assert found[1] == pytest.approx(found[0], abs=0.01)

    def test_nothing(self):
        assert np.isnan(box_dimension(find_sections(network([], []))))
