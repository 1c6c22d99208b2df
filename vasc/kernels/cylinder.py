"""Places on the surface of a stem: the ring at its base, and primordia on a spiral above it.

With a period, places are arc, 0 and height on the unrolled surface instead of x, y, z.
"""

import numpy as np
from numpy.typing import NDArray

FULL_TURN = 2.0 * np.pi


def circumference(radius: float) -> float:
    """Give the period of the unrolled surface."""
    return FULL_TURN * radius


def ring(radius: float, length: float, period: float = 0.0) -> NDArray[np.float64]:
    """Give places on the circle at height 0, nearer to each other than a segment is long.

    Parameters
    ----------
    radius, length : float
        Radius of the stem and length of a segment.
    period : float
        Circumference, for places on the unrolled surface; 0 for places in space.

    Returns
    -------
    ndarray of shape (n, 3), float64
        The places, the first one at angle 0.
    """
    n_places = int(np.ceil(FULL_TURN * radius / length))
    angles = FULL_TURN * np.arange(n_places) / n_places
    flat = np.zeros(n_places)
    if period > 0.0:
        return np.stack((np.arange(n_places) * (period / n_places), flat, flat), axis=1)
    return np.stack((radius * np.cos(angles), radius * np.sin(angles), flat), axis=1)


def primordia(
    first: int, last: int, radius: float, rise: float, angle: float, period: float = 0.0
) -> NDArray[np.float64]:
    """Give the places of the primordia ``first`` to ``last``, on a spiral (Runions 2008, 6.2).

    Parameters
    ----------
    first, last : int
        Numbers, from 0; the last one is not among them.
    radius, rise : float
        Radius of the stem, and height of a primordium over the one before it (R, H);
        number 0 is as high above the ring.
    angle : float
        Divergence angle, in rad.
    period : float
        Circumference, for places on the unrolled surface; 0 for places in space.

    Returns
    -------
    ndarray of shape (last - first, 3), float64
        The places.
    """
    numbers = np.arange(first, last)
    angles = numbers * angle
    heights = (numbers + 1) * rise
    if period > 0.0:
        turns = angles / FULL_TURN
        arcs = (turns - np.floor(turns)) * period
        # a turn just below a whole one may round up to it
        arcs[arcs >= period] = 0.0
        return np.stack((arcs, np.zeros(len(numbers)), heights), axis=1)
    return np.stack((radius * np.cos(angles), radius * np.sin(angles), heights), axis=1)
