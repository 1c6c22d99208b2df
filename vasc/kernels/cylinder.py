"""The ring at the base of a stem, and the width of the stem's surface laid flat."""

import numpy as np
from numpy.typing import NDArray

FULL_TURN = 2.0 * np.pi


def circumference(radius: float) -> float:
    """Give the period of the unrolled surface."""
    return FULL_TURN * radius


def ring(radius: float, length: float) -> NDArray[np.float64]:
    """Give places on the circle at height 0, nearer to each other than a segment is long.

    Parameters
    ----------
    radius, length : float
        Radius of the stem and length of a segment, in one unit.

    Returns
    -------
    ndarray of shape (n, 3), float64
        x, y and height, in that unit; the first place is at angle 0.
    """
    n_places = int(np.ceil(FULL_TURN * radius / length))
    angles = FULL_TURN * np.arange(n_places) / n_places
    return np.stack((radius * np.cos(angles), radius * np.sin(angles), np.zeros(n_places)), axis=1)
