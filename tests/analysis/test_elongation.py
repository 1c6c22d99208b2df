"""Widths by elongation: what growth stretches grows wider, and what is new begins thin."""

import numpy as np
from reference.networks import PlainMoment, network, sources
from reference.recordings import cross_leaf

from vasc.analysis.elongation import Elongation, stretched_pipes
from vasc.network import Origin

EXTENSION, REFINEMENT = Origin.EXTENSION, Origin.REFINEMENT


def widths_after(*networks, kappa=1.0):
    """The widths of all nodes after a run through these moments."""
    elongation = Elongation(kappa)
    for veins in networks:
        elongation.update(PlainMoment(veins, cross_leaf().blade, sources([])))
    return elongation.widths.tolist()


def path(*heights):
    """A vein along the axis."""
    return network([(0.0, y) for y in heights], [(k, k + 1) for k in range(len(heights) - 1)])


def test_no_width_before_the_first_moment_and_one_after_it():
    assert widths_after() == []
    assert widths_after(path(0.0, 1.0, 3.0)) == [1.0, 1.0, 1.0]


def test_a_node_widens_as_its_segments_together_lengthen():
    # the lower segment is stretched to 2, the upper one, of length 2, to 3: that is 5 over 3
    before, after = path(0.0, 1.0, 3.0), path(0.0, 2.0, 5.0)
    assert np.allclose(widths_after(before, after), [2.0, 5.0 / 3.0, 1.5])
    assert np.allclose(widths_after(before, after, kappa=0.5), [1.5, 4.0 / 3.0, 1.25])
    assert widths_after(before, after, kappa=0.0) == [1.0, 1.0, 1.0]


def test_growth_of_several_steps_multiplies():
    assert np.allclose(widths_after(path(0.0, 1.0), path(0.0, 2.0), path(0.0, 6.0)), [6.0, 6.0])


def test_a_node_that_extends_a_wide_vein_begins_thin():
    assert widths_after(path(0.0, 1.0), path(0.0, 2.0, 3.0)) == [2.0, 2.0, 1.0]


def test_a_half_inherits_from_its_thinner_end():
    # the third node is new and thin; node 3 halves the segment between it and the wide vein
    young, grown = path(0.0, 1.0), path(0.0, 2.0, 4.0)
    halved = network(
        [(0.0, 0.0), (0.0, 2.0), (0.0, 4.0), (0.0, 3.0)],
        [(0, 1), (1, 3), (3, 2)],
        parents=[-1, 0, 1, 1],
        origins=[Origin.SEED, EXTENSION, EXTENSION, REFINEMENT],
    )
    assert widths_after(young, grown, halved) == [2.0, 2.0, 1.0, 1.0]


def test_nodes_that_replace_one_inherit_its_width():
    young, grown = path(0.0, 1.0, 2.0), path(0.0, 2.0, 4.0)
    cut = network(
        [(0.0, 0.0), (0.0, 2.0), (0.0, 4.0), (0.0, 1.0), (0.0, 3.0)],
        [(0, 3), (3, 4), (4, 2)],
        parents=[-1, 0, 1, 1, 1],
        origins=[Origin.SEED, EXTENSION, EXTENSION, REFINEMENT, REFINEMENT],
        retired=[1],
    )
    assert widths_after(young, grown, cut) == [2.0] * 5


def test_a_segment_is_as_wide_as_the_thinner_of_its_nodes():
    pipes = stretched_pipes(path(0.0, 1.0, 2.0), np.array([3.0, 2.0, 1.0]), exponent=2.0)
    assert pipes.nodes.tolist() == [9.0, 4.0, 1.0]
    assert pipes.segments.tolist() == [4.0, 1.0]
