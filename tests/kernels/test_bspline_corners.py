"""A place beyond a corner of the surface belongs to the nearest point of the margin."""

import numpy as np
import pytest
from reference.leaves import ARABIDOPSIS

from vasc import kernels

bspline = kernels.bspline


@pytest.mark.parametrize(
    ("time", "position", "near"),
    [
        (0.0, (0.719, 8.5), (0.8, 0.987)),
        (60.0, (2.336, 29.913), (0.921, 0.986)),
        (276.0, (5.323, 102.622), (0.769, 0.998)),
    ],
)
def test_beyond_the_tip_the_nearest_point_of_the_tip_edge_is_found(time, position, near):
    rows = np.array(ARABIDOPSIS[time]).T.copy()
    shape = bspline.surface(rows.shape[1], 5)
    found = bspline.invert(shape, rows, np.array([position]), np.array([near]))
    reached = np.hypot(*(bspline.evaluate(shape, rows, found)[0] - position))
    c = np.linspace(0.0, 1.0, 20001)
    edge = bspline.evaluate(shape, rows, np.stack([c, np.ones_like(c)], axis=1))
    nearest = np.sqrt(((edge - position) ** 2).sum(axis=1).min())
    assert reached <= nearest + 1e-3, f"stopped at {found[0]}"
