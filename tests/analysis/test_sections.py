"""Veins cut at junctions and ends: held against a plain walk, and against drawings."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.drawn_networks import binary_tree, junction, without_seeds
from reference.networks import grid, network, random_planar, random_tree

from vasc.analysis import find_sections
from vasc.analysis.ways import ways

seeds = st.integers(0, 2**32 - 1)


def halved(net):
    """The same drawing with a node in the middle of every segment."""
    middles = net.positions[net.segments].mean(axis=1)
    added = np.arange(net.n_segments) + net.n_nodes
    first, second = net.segments.T
    pairs = np.concatenate([np.stack([first, added], 1), np.stack([added, second], 1)])
    return network(
        np.concatenate([net.positions, middles]), pairs, origins=[1] * (len(added) + net.n_nodes)
    )


class TestAgainstAPlainWalk:
    @given(seeds, st.floats(0.05, 1.0))
    def test_the_same_ways(self, seed, share):
        net = without_seeds(random_planar(np.random.default_rng(seed), 40, share))
        sections = find_sections(net)
        expected = sorted(tuple(sorted((way[0], way[-1]))) for way in ways(net.segments))
        found = sorted(tuple(sorted(pair)) for pair in sections.ends.tolist())
        # a ring may be cut anywhere
        assert [p for p in found if p[0] != p[1]] == [p for p in expected if p[0] != p[1]]
        assert len(found) == len(expected)

    @given(seeds, st.floats(0.05, 1.0))
    def test_every_segment_is_on_one_way(self, seed, share):
        net = random_planar(np.random.default_rng(seed), 40, share)
        sections = find_sections(net)
        assert sorted(sections.rows.tolist()) == list(range(net.n_segments))
        starts, stops = sections.points_walked.T
        is_inner = np.diff(sections.owners) == 0
        assert (stops[:-1] == starts[1:])[is_inner].all()
        assert sections.lengths.sum() == pytest.approx(net.lengths.sum())
        assert sections.spans == pytest.approx(sections.lengths)

    @given(seeds)
    def test_halving_segments_changes_nothing(self, seed):
        net = without_seeds(random_planar(np.random.default_rng(seed), 30, 0.6))
        plain, cut = find_sections(net), find_sections(halved(net))
        assert sorted(plain.lengths) == pytest.approx(sorted(cut.lengths))
        assert sorted(map(tuple, np.sort(plain.ends, axis=1).tolist())) == sorted(
            map(tuple, np.sort(cut.ends, axis=1).tolist())
        )


class TestKnown:
    def test_a_binary_tree(self):
        sections = find_sections(binary_tree(4, side=3))
        assert sections.n_sections == 15
        assert np.diff(sections.begins).tolist() == [3] * 15
        assert not sections.is_looped.any()

    def test_spurs_are_no_loops(self):
        points = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 1), (3, 3), (4, 3), (3, 4)]
        rings = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (2, 5), (5, 6), (5, 7)]
        sections = find_sections(without_seeds(network(points, rings)))
        spurs = {(0, 4), (2, 5), (5, 6), (5, 7)}
        ends = [tuple(sorted(pair)) for pair in sections.ends.tolist()]
        assert {
            end for end, loop in zip(ends, sections.is_looped, strict=True) if not loop
        } == spurs

    def test_a_seed_ends_sections(self):
        net = network([(0, 0), (1, 1), (-1, 1)], [(0, 1), (0, 2)])
        assert find_sections(net).n_sections == 2
        assert find_sections(net).seeds.tolist() == [0]
        assert find_sections(without_seeds(net)).n_sections == 1

    def test_a_ring_alone(self):
        net = without_seeds(network([(0, 0), (1, 0), (0, 1)], [(0, 1), (1, 2), (2, 0)]))
        sections = find_sections(net)
        assert sections.n_sections == 1
        assert sections.is_looped.all()

    def test_widths_are_means_along_the_way(self):
        net = without_seeds(network([(0, 0), (1, 0), (4, 0)], [(0, 1), (1, 2)]))
        sections = find_sections(net, np.array([4.0, 8.0]))
        assert sections.widths == pytest.approx([7.0])
        assert sorted(sections.end_widths[0].tolist()) == [4.0, 8.0]

    def test_lengths_along_the_course_are_kept_where_veins_cross(self):
        net = without_seeds(network([(-1, 0), (1, 0), (0, -1), (0, 1)], [(0, 1), (2, 3)]))
        sections = find_sections(net, np.array([3.0, 5.0]), np.array([4.0, 2.0]))
        assert sorted(sections.lengths) == pytest.approx([1.0, 1.0, 2.0, 2.0])
        assert sorted(zip(sections.lengths, sections.widths, strict=True))[0][1] == 5.0

    def test_directions_are_taken_some_way_along(self):
        bent = without_seeds(network([(0, 0), (1, 0), (1, 9)], [(0, 1), (1, 2)]))
        sections = find_sections(bent)
        assert sections.reach == pytest.approx(4.0)
        leaving = {tuple(v) for v in sections.leaving()[0].round(9).tolist()}
        assert leaving == {(1.0, 3.0), (0.0, -4.0)}

    def test_short_sections_are_taken_whole(self):
        net, _ = junction([0, 120, 240], [1, 1, 1])
        short = network(np.vstack([net.positions, [[5.5, 0.0]]]), net.segments)
        vectors = find_sections(short).leaving().reshape(-1, 2)
        assert np.hypot(*vectors.T) == pytest.approx([2.0] * 6)


class TestDegenerate:
    @pytest.mark.parametrize(
        "net",
        [
            network([], []),
            network([(1, 2)], []),
            network([(1, 1), (1, 1)], [(0, 1)]),
            network([(1, 1), (1, 1), (1, 1)], [(0, 1), (1, 2)]),
        ],
        ids=["nothing", "one node", "a segment without length", "two of them"],
    )
    def test_without_veins(self, net):
        sections = find_sections(net)
        assert sections.n_sections == 0
        assert sections.ends.shape == (0, 2)
        assert sections.leaving().shape == (0, 2, 2)
        assert (sections.reach, len(sections.lengths)) == (0.0, 0)

    def test_a_segment_twice_counts_once(self):
        net = network([(0, 0), (1, 0), (2, 1)], [(0, 1), (1, 0), (1, 2), (1, 2)])
        assert find_sections(net).lengths.sum() == pytest.approx(1.0 + np.sqrt(2.0))

    def test_pieces_are_kept(self):
        apart = grid(1, 1)
        both = network(
            np.concatenate([apart.positions, apart.positions + 10.0]),
            np.concatenate([apart.segments, apart.segments + 4]),
        )
        assert find_sections(both).lengths.sum() == pytest.approx(8.0)

    @given(seeds)
    def test_a_tangle(self, seed):
        rng = np.random.default_rng(seed)
        tangle = network(rng.random((15, 2)), random_tree(rng, 15).segments)
        assert find_sections(tangle).lengths.sum() == pytest.approx(tangle.lengths.sum())
