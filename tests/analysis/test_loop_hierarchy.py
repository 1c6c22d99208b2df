"""Loops within loops: known trees of merges, and a plain program with sets."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.networks import grid, network, random_planar

from vasc.analysis import find_sections
from vasc.analysis.areoles import looped_veins
from vasc.analysis.loop_hierarchy import borders, loop_hierarchy, shuffled_hierarchies

seeds = st.integers(0, 2**32 - 1)


def hierarchy(net, widths):
    sections = find_sections(net, widths)
    between = borders(looped_veins(sections), sections)
    return loop_hierarchy(between, sections.widths[between[:, 0]])


def row_of_areoles(inner):
    """Areoles in a row, with the widths of the veins between them from left to right."""
    net = grid(len(inner) + 1, 1)
    widths = np.full(net.n_segments, 9.0)
    x = net.positions[net.segments].mean(axis=1)
    for k, width in enumerate(inner, 1):
        widths[np.isclose(x[:, 0], k)] = width
    return net, widths


def plain(between, widths):
    """Merges by sets of faces: the larger, the smaller, for each."""
    parts = {face: frozenset([face]) for face in np.unique(between[:, 1:]).tolist()}
    merges = []
    for row in sorted(range(len(widths)), key=lambda k: (widths[k], k)):
        one, other = (parts[face] for face in between[row, 1:].tolist())
        if one != other:
            merges.append((max(len(one), len(other)), min(len(one), len(other))))
            parts |= dict.fromkeys(one | other, one | other)
    return merges


def test_one_after_the_other_is_most_uneven():
    # merges of 1+1, 2+1, 3+1 and 4+1
    found = hierarchy(*row_of_areoles([1.0, 2.0, 3.0, 4.0]))
    assert found.asymmetries == pytest.approx([0.0, 0.5, 2 / 3, 0.75])
    assert found.mean_asymmetry == pytest.approx((0.5 + 2 / 3 + 0.75) / 4)
    assert found.weighted_asymmetry == pytest.approx((2 * 0.5 + 3 * 2 / 3 + 4 * 0.75) / 10)
    assert found.order == 2


def test_halves_of_halves_are_even():
    found = hierarchy(*row_of_areoles([1.0, 3.0, 1.0, 5.0, 1.0, 3.0, 1.0]))
    assert found.mean_asymmetry == found.weighted_asymmetry == 0.0
    assert found.order == 4
    assert sorted(found.larger.tolist()) == [1, 1, 1, 1, 2, 2, 4]


@given(seeds, st.floats(0.3, 1.0))
def test_the_same_merges_as_with_sets(seed, share):
    rng = np.random.default_rng(seed)
    net = random_planar(rng, 40, share)
    sections = find_sections(net, rng.integers(1, 6, net.n_segments).astype(float))
    between = borders(looped_veins(sections), sections)
    widths = sections.widths[between[:, 0]]
    found = loop_hierarchy(between, widths)
    assert list(zip(found.larger.tolist(), found.smaller.tolist(), strict=True)) == plain(
        between, widths
    )


@given(seeds)
def test_any_rising_change_of_widths_keeps_the_tree(seed):
    rng = np.random.default_rng(seed)
    net = random_planar(rng, 30, 1.0)
    widths = rng.random(net.n_segments) + 0.1
    assert hierarchy(net, widths).mean_asymmetry == hierarchy(net, widths**3).mean_asymmetry


def test_free_ends_and_outer_veins_do_not_matter():
    net, widths = row_of_areoles([1.0, 2.0])
    spur = network(
        np.vstack([net.positions, [[0.5, 0.5]]]), np.vstack([net.segments, [[0, net.n_nodes]]])
    )
    before = hierarchy(net, widths)
    assert hierarchy(spur, np.append(widths, 0.1)).mean_asymmetry == before.mean_asymmetry
    outer = np.where(widths == 9.0, 0.01, widths)
    assert hierarchy(net, outer).mean_asymmetry == before.mean_asymmetry


def test_shuffles_are_of_a_seed():
    net, widths = row_of_areoles(list(range(1, 30)))
    sections = find_sections(net, widths)
    between = borders(looped_veins(sections), sections)
    inner = sections.widths[between[:, 0]]
    first, again, other = (shuffled_hierarchies(between, inner, seed=s) for s in (1, 1, 2))
    means = [[one.mean_asymmetry for one in each] for each in (first, again, other)]
    assert means[0] == means[1] != means[2]
    assert len(set(means[0])) > 1


@pytest.mark.parametrize("net", [network([], []), network([(0, 0), (1, 1)], [(0, 1)]), grid(1, 1)])
def test_without_anything_to_merge(net):
    found = hierarchy(net, np.ones(net.n_segments))
    assert np.isnan([found.mean_asymmetry, found.weighted_asymmetry]).all()
    assert found.order == 0
