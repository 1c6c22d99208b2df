"""Half outlines of symmetric leaves: the mean of both sides, from the base to the tip."""

import numpy as np

from vasc.arrays import Floats, Points, as_points
from vasc.domain.rings import arc_lengths, at_lengths
from vasc.errors import OutlineError, ShapeError
from vasc.growth.margins import MIRROR, from_base

N_POINTS = 401
"""Points of a half outline."""


def half_outline(ring: Points) -> Points:
    """Give the mean of the right half of an outline and the mirror image of the left one.

    Parameters
    ----------
    ring : ndarray of shape (m, 2), float64
        An outline with the attachment at the origin and the tip upward.

    Returns
    -------
    ndarray of shape (401, 2), float64
        From the right corner of the attached base (or the attachment, where there
        is none) to the highest point, put on the axis; evenly spaced.

    Raises
    ------
    OutlineError
        If the ring is none.
    ConfigError
        If it does not pass through the attachment.
    """
    try:
        points, n_base = from_base(as_points(ring, "outline"))
    except ShapeError as error:
        raise OutlineError(str(error)) from error
    margin = points[n_base - 1 :]
    # the left corner again, or the attachment itself, ends the way around
    margin = np.concatenate([margin, points[:1]])
    highest = np.flatnonzero(margin[:, 1] == margin[:, 1].max())
    tip = int(highest[len(highest) // 2])
    right, left = margin[: tip + 1], margin[: tip - 1 : -1] * MIRROR
    half = 0.5 * (_even(right) + _even(left))
    half[-1, 0] = 0.0
    return half


def _even(line: Points) -> Points:
    """Spread points evenly over a line."""
    return at_lengths(line, np.linspace(0.0, float(arc_lengths(line)[-1]), N_POINTS))


def nearest_on(line: Points, points: Points) -> tuple[Points, Points]:
    """Give the nearest places of a line, and its unit normals there.

    Parameters
    ----------
    line : ndarray of shape (k, 2), float64
        An open line.
    points : ndarray of shape (n, 2), float64
        Any points.

    Returns
    -------
    tuple of ndarray of shape (n, 2), float64
        Places and normals, which point to the right of the line.
    """
    along = np.diff(line, axis=0)
    squared = np.maximum((along * along).sum(axis=1), 1e-300)
    offsets = points[:, None] - line[:-1]
    shares = ((offsets * along).sum(axis=2) / squared).clip(0.0, 1.0)
    gaps = offsets - shares[:, :, None] * along
    rows = (gaps * gaps).sum(axis=2).argmin(axis=1)
    each = np.arange(len(points))
    normals = np.stack([along[rows, 1], -along[rows, 0]], axis=1) / np.sqrt(squared[rows])[:, None]
    return points - gaps[each, rows], normals


def distances_to(line: Points, points: Points) -> Floats:
    """Give the distances of points to a line, shape (n,)."""
    offsets = points - nearest_on(line, points)[0]
    return np.sqrt((offsets * offsets).sum(axis=1))
