"""How thick the strands of a stem are shown: they taper towards the apex."""

import numpy as np

from vasc.arrays import Floats, Points

BASE_RADIUS = 1.0
"""Of a strand at the base, in D."""
APEX_RADIUS = 0.45
"""Of a strand at the apex, in D."""
PRIMORDIUM_RADIUS = 2.4
"""Of the sphere that stands for a primordium, in D."""
PRIMORDIUM_OUTWARD = 0.6 * PRIMORDIUM_RADIUS
"""How far that sphere stands off the surface of the stem (Runions 2008, section 6.2.2), in D."""


def strand_radii(heights: Floats) -> Floats:
    """Give radii that fall evenly from the base of a stem to its apex.

    Parameters
    ----------
    heights : ndarray of shape (n,), float64
        Heights of all nodes of the stem, in D.

    Returns
    -------
    ndarray of shape (n,), float64
        In D; empty for none.

    Examples
    --------
    >>> strand_radii(np.array([0.0, 10.0, 20.0])).round(3).tolist()
    [1.0, 0.725, 0.45]
    """
    share = heights / max(float(heights.max(initial=0.0)), 1e-12)
    return np.asarray(BASE_RADIUS + (APEX_RADIUS - BASE_RADIUS) * np.clip(share, 0.0, 1.0))


def set_outward(positions: Points, distance: float) -> Points:
    """Give points moved straight away from the axis of a stem.

    Parameters
    ----------
    positions : ndarray of shape (n, 3), float64
        Points; the axis is the third one through the origin. A point on it stays.
    distance : float
        How far, in D.

    Returns
    -------
    ndarray of shape (n, 3), float64
    """
    radii = np.hypot(positions[:, 0], positions[:, 1])[:, None]
    moved = np.array(positions, dtype=np.float64)
    moved[:, :2] *= 1.0 + distance / np.where(radii > 0.0, radii, np.inf)
    return moved
