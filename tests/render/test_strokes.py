"""Segments in long lines: each once, and lines of one look only."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from reference.networks import network, random_planar, random_tree

from vasc.analysis.ancestry import descent
from vasc.render.strokes import string_together

seeds = st.integers(0, 2**32 - 1)


def drawn(strokes):
    """Pairs of points that the lines connect, with the look, in any order."""
    pairs = []
    for look, points, is_start in strokes.batches(max_points=7):
        assert is_start[0]
        for row in range(1, len(points)):
            if not is_start[row]:
                ends = sorted([points[row - 1].tolist(), points[row].tolist()])
                pairs.append((look, ends))
    return sorted(pairs)


@given(seeds, st.integers(1, 4), st.booleans())
def test_every_segment_is_drawn_once_in_its_look(seed, n_looks, is_tree):
    rng = np.random.default_rng(seed)
    net = random_tree(rng, 30) if is_tree else random_planar(rng, 30, 0.6)
    looks = rng.integers(0, n_looks, net.n_segments)
    strokes = string_together(net.positions, descent(net), looks)
    ends = net.positions[net.segments]
    expected = [(look, sorted(pair)) for look, pair in zip(looks, ends.tolist(), strict=True)]
    assert drawn(strokes) == sorted(expected)


def test_a_chain_of_one_look_is_one_line():
    chain = network(np.random.default_rng(0).random((50, 2)), [(k, k + 1) for k in range(49)])
    strokes = string_together(chain.positions, descent(chain), np.zeros(49, dtype=np.int64))
    assert strokes.line_starts.tolist() == [0, 50]
    assert (strokes.points == chain.positions).all()


def test_lines_are_sorted_by_look():
    net = random_tree(np.random.default_rng(1), 60)
    looks = np.arange(59)[::-1] % 5
    strokes = string_together(net.positions, descent(net), looks)
    assert (np.diff(strokes.looks) >= 0).all()


def test_empty():
    lonely = network([(0, 0)], [])
    strokes = string_together(lonely.positions, descent(lonely), np.zeros(0, dtype=np.int64))
    assert list(strokes.batches()) == []
