"""Tags, pulls, new nodes and arrivals against plain loops over plain lists."""

from math import inf, isclose, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference.relative_neighbors import relative_neighbors, square

from vasc import kernels

MAX = kernels.perceived.MAX_MEMBERS


def random_veins(rng, n_nodes, n_places=9):
    """Nodes on a lattice or off it, and parents and births as a run would have them."""
    points = rng.integers(0, n_places, (n_nodes, 2)).astype(float)
    points += rng.choice([0.0, 1.0]) * rng.normal(size=points.shape)
    parents = np.array([-1, *(int(rng.integers(0, v)) for v in range(1, n_nodes))], dtype=np.int32)
    births = np.zeros(n_nodes, dtype=np.int32)
    for v in range(1, n_nodes):
        births[v] = max(births[v - 1], births[parents[v]] + 1)
    return points, parents, births


def perceived_of(sets, distances):
    """What sources perceive, from lists."""
    perceived = kernels.perceived.perceived(len(sets))
    for s, (members, squares) in enumerate(zip(sets, distances, strict=True)):
        perceived.members[s, : len(members)] = members
        perceived.distances[s, : len(members)] = squares
        perceived.n_members[s] = len(members)
    return perceived


def random_moment(seed):
    """Veins, sources, what they perceive, and tags on some of them."""
    rng = np.random.default_rng(seed)
    points, parents, births = random_veins(rng, int(rng.integers(1, 40)))
    places = rng.uniform(-1.0, 9.0, (int(rng.integers(1, 12)), 2))
    n_on_lattice = int(rng.integers(0, 4))
    places[:n_on_lattice] = np.round(places[:n_on_lattice])
    nodes = [tuple(p) for p in points.tolist()]
    sets = [relative_neighbors(tuple(p), nodes) for p in places.tolist()]
    squares = [
        [square(nodes[v], p) for v in members]
        for members, p in zip(sets, places.tolist(), strict=True)
    ]
    tags = kernels.tags.tags(len(places))
    for s in np.flatnonzero(rng.random(len(places)) < 0.4):
        step = int(rng.integers(1, births[-1] + 2))
        older = np.flatnonzero(births < step)
        chosen = rng.choice(older, min(len(older), int(rng.integers(1, 4))), replace=False)
        tags.step[s], tags.n_nodes[s] = step, len(chosen)
        tags.nodes[s, : len(chosen)] = chosen
    return points, parents, births, places, sets, squares, tags


def inherited(tags, s, parents, births):
    """All nodes a source waits for: the tagged ones, handed down from parent to child."""
    tagged = set(tags.nodes[s, : tags.n_nodes[s]].tolist())
    for v in range(len(parents)):
        if births[v] >= tags.step[s] and parents[v] in tagged:
            tagged.add(v)
    return tagged


SEEDS = st.integers(0, 2**32 - 1)


@given(SEEDS)
def test_tags_are_inherited(seed):
    _, parents, births, _, _, _, tags = random_moment(seed)
    for s in np.flatnonzero(tags.step >= 0):
        expected = inherited(tags, s, parents, births)
        found = {
            v for v in range(len(parents)) if kernels.tags.is_tagged(tags, s, v, parents, births)
        }
        assert found == expected


@given(SEEDS)
def test_tags_put_back_are_the_tags_there_were(seed):
    *_, tags = random_moment(seed)
    rows = [
        (tags.step[s], s, tags.nodes[s, k])
        for s in range(len(tags.step))
        for k in range(tags.n_nodes[s])
    ]
    steps, sources, nodes = np.array(rows, dtype=np.int32).reshape(-1, 3).T.copy()
    again = kernels.tags.tags(len(tags.step))
    kernels.tags.retag(again, steps, sources, nodes)
    for column, expected in zip(again, tags, strict=True):
        np.testing.assert_array_equal(column, expected)


def pulls_of(seed, kill, influence):
    """Pullers of every node by a plain loop, and what the kernel sums."""
    points, parents, births, places, sets, squares, tags = random_moment(seed)
    pullers = {}
    for s, members in enumerate(sets):
        awaited = inherited(tags, s, parents, births) if tags.step[s] >= 0 else set(members)
        for v, gap in zip(members, squares[s], strict=True):
            if kill < gap <= influence and gap > 0.0 and v in awaited:
                pullers.setdefault(v, []).append(s)
    perceived = perceived_of(sets, squares)
    pulls = kernels.extension.pulls(MAX * len(sets))
    rank = np.full(len(points), -1, dtype=np.int32)
    live = np.arange(len(sets), dtype=np.int32)
    n_pulled = kernels.extension.sum_pulls(
        live, places, points, parents, births, perceived, tags, kill, influence, rank, pulls
    )
    assert (rank == -1).all()
    return points, places, pullers, pulls, n_pulled


@settings(max_examples=300)
@given(SEEDS, st.sampled_from([0.0, 1.0, 4.0]), st.sampled_from([inf, 9.0, 2.0]))
def test_pulls_are_sums_of_unit_vectors(seed, kill, influence):
    points, places, pullers, pulls, n_pulled = pulls_of(seed, kill, influence)
    assert sorted(pulls.nodes[:n_pulled].tolist()) == sorted(pullers)
    for row in range(n_pulled):
        v = int(pulls.nodes[row])
        offsets = places[pullers[v]] - points[v]
        gaps = np.sqrt((offsets**2).sum(axis=1))
        np.testing.assert_allclose(
            pulls.sums[row], (offsets / gaps[:, None]).sum(axis=0), atol=1e-13
        )
        assert pulls.n_sources[row] == len(pullers[v])
        closest = min(pullers[v], key=lambda s: (square(places[s], points[v]), s))
        assert pulls.nearest[row] == closest


@settings(max_examples=300)
@given(
    SEEDS,
    st.sampled_from([(0.0, 0.0), (0.3, -0.2), (-1.0, 0.0)]),
    st.booleans(),
    st.sampled_from([0.5, 1.0]),
)
def test_children_follow_equations_3_1_and_3_3_and_the_stall_rule(seed, bias, is_resolved, length):
    points, places, pullers, pulls, n_pulled = pulls_of(seed, 1.0, inf)
    order = np.argsort(pulls.nodes[:n_pulled], kind="stable")
    parents, material, causes, is_stalled = kernels.extension.children(
        order, pulls, points, places, length, *bias, is_resolved
    )
    assert parents.tolist() == sorted(set(parents.tolist()))
    if is_resolved:
        assert parents.tolist() == sorted(pullers)
    for v, child, cause, stalled in zip(parents, material, causes, is_stalled, strict=True):
        offsets = places[pullers[v]] - points[v]
        gaps = np.sqrt((offsets**2).sum(axis=1))
        total = (offsets / gaps[:, None]).sum(axis=0)
        cosine, bound = np.hypot(*total) / len(gaps), length / (2.0 * gaps.min())
        assert cause == pullers[v][int(gaps.argmin())]
        if not isclose(cosine, bound, abs_tol=1e-12):
            assert stalled == (is_resolved and cosine < bound)
        assert isclose(np.hypot(*(child - points[v])), length, rel_tol=1e-12)
        if stalled:
            way = offsets[gaps.argmin()] / gaps.min()
        else:
            way = total / np.hypot(*total) + bias
            if np.hypot(*way) < 1e-9:
                continue
        np.testing.assert_allclose(child, points[v] + length * way / np.hypot(*way), atol=1e-9)
        if is_resolved and bias == (0.0, 0.0):
            # what the rule is for: some source that pulls is nearer to the child
            assert (np.hypot(*(places[pullers[v]] - child).T) < gaps).any()


@settings(max_examples=300)
@given(SEEDS, st.sampled_from([0.5, 1.0, 4.0]), st.sampled_from([inf, 4.0]))
def test_sources_are_tagged_and_wait(seed, kill, influence):
    _, parents, births, _, sets, squares, tags = random_moment(seed)
    rng = np.random.default_rng(seed)
    perceived = perceived_of(sets, squares)
    step, before = int(births[-1]) + 1, {}
    for s, members in enumerate(sets):
        before[s] = members
        if rng.random() < 0.5:
            before[s] = rng.permutation(len(parents))[:3].tolist()
            perceived.change[s] = rng.integers(1, 3)
            perceived.previous[s, : len(before[s])] = before[s]
            perceived.n_previous[s] = len(before[s])
    was_tagged = (tags.step >= 0).tolist()
    live = np.arange(len(sets), dtype=np.int32)
    tagged, reached = kernels.arrival.tag_and_wait(
        live, perceived, tags, parents, births, step, kill, influence
    )
    near = [s for s in live if squares[s] and squares[s][0] <= kill]
    assert tagged.tolist() == [s for s in near if not was_tagged[s]]
    for s in tagged:
        assert tags.step[s] == step
        assert tags.nodes[s, : tags.n_nodes[s]].tolist() == before[s]
    waiting = [
        s
        for s in np.flatnonzero(tags.step >= 0).tolist()
        if any(
            kill < gap <= influence and v in inherited(tags, s, parents, births)
            for v, gap in zip(sets[s], squares[s], strict=True)
        )
    ]
    assert reached.tolist() == sorted(set(np.flatnonzero(tags.step >= 0).tolist()) - set(waiting))


@pytest.mark.parametrize("kill", [0.0, 1.0, 2.0])
def test_open_sources_are_reached_at_and_within_the_kill_distance(kill):
    perceived = perceived_of([[3], [], [5], [7]], [[1.0], [], [0.25], [2.0]])
    live = np.array([0, 1, 2, 3], dtype=np.int32)
    found = kernels.arrival.reached_first(live, perceived, kill)
    assert found.tolist() == {0.0: [], 1.0: [0, 2], 2.0: [0, 2, 3]}[kill]


def test_nothing_pulled_has_no_children():
    none = np.empty(0, dtype=np.int64)
    pulls = kernels.extension.pulls(1)
    parts = kernels.extension.children(
        none, pulls, np.zeros((1, 2)), np.zeros((0, 2)), 1.0, 0.0, 0.0, True
    )
    assert [len(part) for part in parts] == [0, 0, 0, 0]


def test_pulls_that_cancel_exactly_give_no_child_without_the_rule():
    points, places = np.array([[0.0, 0.0]]), np.array([[3.0, 0.0], [-3.0, 0.0]])
    perceived = perceived_of([[0], [0]], [[9.0], [9.0]])
    pulls, live = kernels.extension.pulls(16), np.array([0, 1], dtype=np.int32)
    parents, births = np.array([-1], dtype=np.int32), np.array([0], dtype=np.int32)
    tags = kernels.tags.tags(2)
    rank = np.array([-1], dtype=np.int32)
    n_pulled = kernels.extension.sum_pulls(
        live, places, points, parents, births, perceived, tags, 1.0, inf, rank, pulls
    )
    order = np.arange(n_pulled)
    literal = kernels.extension.children(order, pulls, points, places, 1.0, 0.0, 0.0, False)
    assert len(literal[0]) == 0
    cured = kernels.extension.children(order, pulls, points, places, 1.0, 0.0, 0.0, True)
    assert cured[1].tolist() == [[1.0, 0.0]]
    assert cured[2].tolist() == [0]
    assert sqrt(square(cured[1][0], points[0])) == 1.0
