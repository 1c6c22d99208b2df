"""Measures of rings, on one with a notch."""

import numpy as np

from vasc.domain.rings import signed_area, surrounds

ARROW = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]])


def test_the_sign_of_an_area_is_the_sense_of_its_ring():
    assert signed_area(ARROW) == 10.0
    assert signed_area(ARROW[::-1]) == -10.0


def test_a_notch_is_outside():
    assert surrounds(ARROW, np.array([0.5, 2.0]))
    assert not surrounds(ARROW, np.array([2.0, 2.0]))
    assert not surrounds(ARROW, np.array([5.0, 2.0]))
