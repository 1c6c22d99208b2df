"""What canals need, against the sentence written out and against shapely."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from reference import canals as slow
from reference.relative_neighbors import relative_neighbors as by_equation

from vasc import kernels

SEEDS = st.integers(0, 2**32 - 1)


def found(source, nodes):
    """Rows of the relative neighbours among nodes in any order."""
    order = slow.in_order(source, nodes.tolist())
    distances = np.sqrt(((nodes[order] - source) ** 2).sum(axis=1))
    rows = kernels.canals.ordered_neighbors(np.ascontiguousarray(nodes[order]), distances)
    assert (np.diff(rows) > 0).all()
    return [order[row] for row in rows.tolist()]


@given(SEEDS, st.integers(1, 60))
def test_relative_neighbors_of_the_sentence(seed, n_nodes):
    rng = np.random.default_rng(seed)
    nodes, source = rng.uniform(-5.0, 5.0, (n_nodes, 2)), rng.uniform(-3.0, 3.0, 2)
    assert found(source, nodes) == slow.relative_neighbors(source.tolist(), nodes.tolist())
    # where no two are equally near, an order decides nothing
    assert set(found(source, nodes)) == set(by_equation(source.tolist(), nodes.tolist()))


@given(SEEDS, st.integers(3, 12))
def test_nodes_on_a_circle_around_the_source(seed, n_nodes):
    rng = np.random.default_rng(seed)
    angles = rng.choice(24, n_nodes, replace=False) * np.pi / 12.0
    nodes = 10.0 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    nodes = np.concatenate([nodes, rng.uniform(11.0, 20.0, (5, 2))])
    expected = slow.relative_neighbors([0.0, 0.0], nodes.tolist())
    assert found(np.zeros(2), nodes) == expected
    # two on the circle within a sixth of it cannot both be neighbours, two farther apart can
    gaps = [np.hypot(*(nodes[a] - nodes[b])) for a in expected for b in expected if a < b < n_nodes]
    assert min(gaps, default=10.0) >= 10.0 * (1.0 - 1e-6)
    assert len(expected) >= 1


def test_mirrored_nodes_have_mirrored_neighbors():
    rng = np.random.default_rng(2)
    mirror = np.array([-1.0, 1.0])
    for _ in range(100):
        half = np.round(rng.uniform(0.0, 5.0, (12, 2)), 1)
        nodes = np.concatenate([half, half * mirror])
        source = np.round(rng.uniform(0.5, 5.0, 2), 1)
        right = nodes[found(source, nodes)].tolist()
        left = (nodes[found(source * mirror, nodes)] * mirror + 0.0).tolist()
        assert right == [[x + 0.0, y] for x, y in left]


def test_no_nodes_and_one():
    none = kernels.canals.ordered_neighbors(np.empty((0, 2)), np.empty(0))
    assert none.tolist() == []
    assert found(np.ones(2), np.zeros((1, 2))) == [0]


def drawn(rng, n_nodes, n_segments, is_on_lattice):
    """Nodes, segments between them, some of them refined, and a step from a node."""
    places = rng.uniform(-5.0, 5.0, (n_nodes, 2))
    if is_on_lattice:
        places = np.round(places)
    segments = np.array(
        [rng.choice(n_nodes, 2, replace=False) for _ in range(n_segments)], dtype=np.int32
    )
    refined = rng.random(n_segments + 3) < 0.3
    end = rng.uniform(-5.0, 5.0, 2)
    return places, segments, refined, int(rng.integers(n_nodes)), end


def is_crossed(places, tip, end, p, q):
    """Whether a step and a segment pass through each other."""
    step, segment = shapely.LineString([places[tip], end]), shapely.LineString(places[[p, q]])
    return tip not in (p, q) and step.crosses(segment)


@pytest.mark.parametrize("n_segments", [1, 5, 40])
def test_the_first_live_segment_in_the_way(n_segments):
    rng = np.random.default_rng(n_segments)
    n_crossed = n_free = 0
    for _ in range(150):
        places, segments, refined, tip, end = drawn(rng, 25, n_segments, is_on_lattice=False)
        in_the_way = [
            row
            for row, (p, q) in enumerate(segments.tolist())
            if not refined[row] and is_crossed(places, tip, end, p, q)
        ]
        expected = in_the_way[0] if in_the_way else -1
        row = kernels.canals.first_crossed(places, segments, refined, n_segments, tip, *end)
        assert row == expected
        n_crossed += row >= 0
        n_free += row < 0
    assert n_crossed > 10
    assert n_free >= 1


def test_segments_that_are_not_there_yet_are_not_crossed():
    places = np.array([[0.0, 0.0], [-1.0, 1.0], [1.0, 1.0]])
    segments, refined = np.array([[1, 2]], dtype=np.int32), np.zeros(1, dtype=bool)
    first_crossed = kernels.canals.first_crossed
    assert first_crossed(places, segments, refined, 1, 0, 0.0, 2.0) == 0
    assert first_crossed(places, segments, refined, 0, 0, 0.0, 2.0) == -1
    assert first_crossed(places, segments, ~refined, 1, 0, 0.0, 2.0) == -1
    # short of it, and from one of its ends
    assert first_crossed(places, segments, refined, 1, 0, 0.0, 0.999) == -1
    assert first_crossed(places, segments, refined, 1, 1, 3.0, 0.5) == -1
