"""Whether a straight way from a node to a point meets any segment."""

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Ids, Points


def is_crossed(points: Points, segments: Ids, node: int, place: Points) -> bool:
    """Tell whether the way from a node to a place crosses, touches or overlaps a segment.

    Parameters
    ----------
    points : ndarray of shape (n, 2), float64
        Places of the nodes.
    segments : ndarray of shape (m, 2), int32
        The two nodes of each segment.
    node : int
        Where the way begins; segments that end there are met only where they overlap it.
    place : ndarray of shape (2,), float64
        Where it ends.

    Examples
    --------
    >>> points = np.array([[0.0, 0.0], [1.0, -1.0], [1.0, 1.0]])
    >>> pair = np.array([[1, 2]])
    >>> is_crossed(points, pair, 0, np.array([2.0, 0.0]))
    True
    >>> is_crossed(points, pair, 0, np.array([0.5, 0.0]))
    False
    """
    start = points[node]
    along = place - start
    firsts, seconds = points[segments[:, 0]], points[segments[:, 1]]
    # on which side of the way the ends of a segment are, and the other way round
    to_first, to_second = _turn(along, firsts - start), _turn(along, seconds - start)
    across = seconds - firsts
    to_start, to_place = _turn(across, start - firsts), _turn(across, place - firsts)
    is_met = (to_first * to_second <= 0.0) & (to_start * to_place <= 0.0)
    # boxes tell apart what lies on one line
    low, high = np.minimum(start, place), np.maximum(start, place)
    is_met &= (np.maximum(firsts, seconds) >= low).all(axis=1)
    is_met &= (np.minimum(firsts, seconds) <= high).all(axis=1)
    is_at = (segments == node).any(axis=1)
    others = np.where((segments[:, 0] == node)[:, None], seconds, firsts)[is_at] - start
    is_met[is_at] = (_turn(along, others) == 0.0) & ((others * along).sum(axis=1) > 0.0)
    return bool(is_met.any())


def _turn(along: Points, to: Points) -> NDArray[np.float64]:
    """Give twice the signed areas of triangles with two given sides: positive to the left."""
    return np.asarray(along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0])
