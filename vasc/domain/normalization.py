"""From the coordinates of a file to a unit outline: attachment at the origin, tip at height 1."""

from collections.abc import Sequence
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator

from vasc.arrays import Points
from vasc.domain.checks import place
from vasc.domain.rings import signed_area
from vasc.errors import OutlineError


def _as_tuple(value: Any) -> Any:
    """Let a list stand for a tuple: a config has lists only."""
    return tuple(value) if isinstance(value, list) else value


Pair = Annotated[tuple[float, float], BeforeValidator(_as_tuple)]
Attachment = Literal["origin", "lowest"] | Pair
Tip = Literal["highest", "farthest"] | Pair

STEPS_PER_UNIT = 2.0**40
"""Coordinates are rounded to this fraction of the blade length.

Curves of files pass through functions whose last digit depends on the processor;
what is left of that after rounding is, almost always, nothing.
"""


def rounded(ring: Points) -> Points:
    """Give unit coordinates rounded to a grid far finer than any use of them."""
    return np.round(ring * STEPS_PER_UNIT) / STEPS_PER_UNIT


def normalized(
    rings: Sequence[Points], *, attachment: Attachment = "lowest", tip: Tip = "highest"
) -> list[Points]:
    """Move, turn and scale an outline, so that it hangs on the origin and is 1 high.

    Parameters
    ----------
    rings : sequence of ndarray of shape (n, 2), float64
        Outline, y upward.
    attachment : "origin", "lowest" or pair of float
        The point that goes to the origin; of several lowest points, the middle.
    tip : "highest", "farthest" or pair of float
        With "highest", nothing is turned. Otherwise the outline is turned until
        this point, or the one farthest from the attachment, is straight above it.

    Returns
    -------
    list of ndarray of shape (n, 2), float64
        The highest point is at y = 1.

    Raises
    ------
    OutlineError
        If the tip is the attachment, or nothing is above the attachment.
    """
    points = np.concatenate(list(rings))
    origin = _attachment(points, attachment)
    moved = [ring - origin for ring in rings]
    if tip != "highest":
        moved = _turned_upright(moved, origin, tip)
    height = float(max(ring[:, 1].max() for ring in moved))
    extent = float(np.ptp(points, axis=0).max())
    if height <= 1e-9 * extent:
        raise OutlineError(
            f"attachment {place(origin)}: no point of the outline is above it;"
            " the blade must reach upward from there"
        )
    return [ring / height for ring in moved]


def _attachment(points: Points, attachment: Attachment) -> Points:
    """Give the point that goes to the origin."""
    if attachment == "origin":
        return np.zeros(2)
    if attachment != "lowest":
        return np.array(attachment, dtype=np.float64)
    low = points[:, 1].min()
    lowest = points[points[:, 1] <= low + 1e-9 * np.ptp(points[:, 1])]
    return np.array([0.5 * (lowest[:, 0].min() + lowest[:, 0].max()), low])


def _turned_upright(rings: list[Points], origin: Points, tip: Tip) -> list[Points]:
    """Turn the outline about the origin until the tip is straight above it."""
    if tip == "farthest":
        points = np.concatenate(rings)
        end = points[np.argmax((points * points).sum(axis=1))]
    else:
        end = np.array(tip, dtype=np.float64) - origin
    distance = float(np.sqrt((end * end).sum()))
    if distance == 0.0:
        raise OutlineError(f"tip {place(end + origin)}: must not be the attachment")
    sine, cosine = end / distance
    turn = np.array([[cosine, -sine], [sine, cosine]])
    return [
        np.stack([(ring * turn[0]).sum(axis=1), (ring * turn[1]).sum(axis=1)], axis=1)
        for ring in rings
    ]


def smoothed(ring: Points, n_points: int) -> Points:
    """Draw a smooth closed curve through the corners of a ring.

    The pieces are centripetal Catmull-Rom curves: they pass through every
    corner and make no loops of their own.

    Parameters
    ----------
    ring : ndarray of shape (n, 2), float64
        Corners, n >= 3.
    n_points : int
        Points wanted; each piece gets at least two.

    Returns
    -------
    ndarray of shape (m, 2), float64
        Same direction as the ring, which it begins with.
    """
    steps = np.roll(ring, -1, axis=0) - ring
    chords = np.sqrt((steps * steps).sum(axis=1))
    knots = np.sqrt(chords)
    pieces = []
    for k in range(len(ring)):
        corners = ring[[(k + j) % len(ring) for j in (-1, 0, 1, 2)]]
        times = np.cumsum([0.0, *(knots[(k + j) % len(ring)] for j in (-1, 0, 1))])
        n_steps = max(2, round(n_points * float(chords[k]) / float(chords.sum())))
        at = times[1] + (times[2] - times[1]) * np.arange(n_steps) / n_steps
        pieces.append(_catmull_rom(corners, times, at[:, None]))
    return np.concatenate(pieces)


def _catmull_rom(corners: Points, times: Points, at: Points) -> Points:
    """Give the curve through the two middle ones of four corners, by repeated interpolation."""
    a = [_blend(corners[k], corners[k + 1], times[k], times[k + 1], at) for k in range(3)]
    b = [_blend(a[k], a[k + 1], times[k], times[k + 2], at) for k in range(2)]
    return _blend(b[0], b[1], times[1], times[2], at)


def _blend(a: Points, b: Points, start: float, stop: float, at: Points) -> Points:
    """Give the straight mean of two points (or rows of points) at times from start to stop."""
    return ((stop - at) * a + (at - start) * b) / (stop - start)


def counter_clockwise(ring: Points) -> Points:
    """Give a ring so that its inside is on its left."""
    return ring if signed_area(ring) > 0.0 else ring[::-1]
