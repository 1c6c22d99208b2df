"""Measures of rings: area, nesting, lengths along them."""

import numpy as np

from vasc.arrays import Floats, Points


def signed_area(ring: Points) -> float:
    """Give the area of a ring, positive when its corners run counter-clockwise."""
    # from the first corner, so that a ring far from the origin keeps its digits
    x, y = (ring - ring[0]).T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def surrounds(ring: Points, point: Points) -> bool:
    """Tell whether a ring surrounds a point, by the crossing rule of the polygon kernel."""
    first, last = ring, np.roll(ring, -1, axis=0)
    is_down = (first[:, 1] > last[:, 1])[:, None]
    low, high = np.where(is_down, last, first), np.where(is_down, first, last)
    spans = (low[:, 1] <= point[1]) & (point[1] < high[:, 1])
    rise, run = high[:, 1] - low[:, 1], high[:, 0] - low[:, 0]
    is_left = (point[0] - low[:, 0]) * rise < run * (point[1] - low[:, 1])
    return bool(np.count_nonzero(spans & is_left) % 2)


def distance_to_ring(ring: Points, point: Points) -> float:
    """Give the distance of a point to the nearest edge of a ring."""
    along = np.roll(ring, -1, axis=0) - ring
    squared = np.maximum((along * along).sum(axis=1), 1e-300)
    offset = point - ring
    share = np.clip((offset * along).sum(axis=1) / squared, 0.0, 1.0)
    gap = offset - share[:, None] * along
    return float(np.sqrt((gap * gap).sum(axis=1).min()))


def surrounding(rings: tuple[Points, ...]) -> list[list[int]]:
    """Give, for every ring, the others that surround it; rings must not cross.

    A ring surrounded by an odd number of others is a hole, any other a part.
    """
    lows = np.array([ring.min(axis=0) for ring in rings])
    highs = np.array([ring.max(axis=0) for ring in rings])
    found = []
    for k, ring in enumerate(rings):
        is_larger = (lows <= lows[k]).all(axis=1) & (highs[k] <= highs).all(axis=1)
        others = [int(j) for j in np.flatnonzero(is_larger) if j != k]
        found.append([j for j in others if surrounds(rings[j], ring[0])])
    return found


def arc_lengths(line: Points) -> Floats:
    """Give the length along an open line up to each of its points, starting at 0."""
    steps = np.diff(line, axis=0)
    return np.concatenate([[0.0], np.cumsum(np.sqrt((steps * steps).sum(axis=1)))])


def at_lengths(line: Points, positions: Floats) -> Points:
    """Give the points of an open line at given lengths along it, shape (n, 2)."""
    lengths = arc_lengths(line)
    return np.stack([np.interp(positions, lengths, line[:, axis]) for axis in (0, 1)], axis=1)


def parts(rings: tuple[Points, ...]) -> list[int]:
    """Give the rings that are margins of parts, not of holes; rings must not cross."""
    return [k for k, others in enumerate(surrounding(rings)) if len(others) % 2 == 0]
