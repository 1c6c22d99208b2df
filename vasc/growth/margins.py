"""Outlines as material points: which part is the base, and dense enough at every step."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Points
from vasc.domain.normalization import counter_clockwise
from vasc.errors import ConfigError
from vasc.growth.base import MARGIN_SPACING
from vasc.limits import OUTLINE_POINTS

MIRROR = np.array([-1.0, 1.0])
MOST_CHECKS = 1000
"""Steps at which the spacing of an outline is looked at, spread over all of them."""
SPACING_KEPT = 0.95
"""Share of the greatest spacing that is used up: distances change between two checks."""


class Margin(NamedTuple):
    """Material points of an outline, counter-clockwise, first those of the attached base."""

    points: Points
    n_base: int


def from_base(ring: Points) -> Margin:
    """Begin an outline with its attached base, the points at height 0 around the axis.

    Parameters
    ----------
    ring : ndarray of shape (m, 2), float64
        An outline with the attachment at the origin.

    Returns
    -------
    Margin
        The same points, counter-clockwise; the base runs from left to right, both
        corners included. It is a single point where a blade is pointed or notched.

    Raises
    ------
    ConfigError
        If the outline does not pass through the attachment.
    """
    ring = counter_clockwise(ring)
    is_low = ring[:, 1] == 0.0
    # runs of points at height 0, each from the point after one that is not
    starts = np.flatnonzero(is_low & ~np.roll(is_low, 1))
    for start in starts.tolist():
        rolled = np.roll(ring, -start, axis=0)
        n_base = int(np.argmin(rolled[:, 1] == 0.0))
        if rolled[0, 0] <= 0.0 <= rolled[n_base - 1, 0]:
            return Margin(rolled, n_base)
    raise ConfigError(
        "domain: the outline does not pass through the attachment (0, 0);"
        " a leaf that is carried along by growth must be attached at its margin"
    )


def is_mirrored(margin: Margin) -> bool:
    """Tell whether an outline is its own mirror image, point by point."""
    n_points = len(margin.points)
    partners = (margin.n_base - 1 - np.arange(n_points)) % n_points
    return bool(np.array_equal(margin.points[partners] * MIRROR, margin.points))


def dense(
    margin: Margin, position: Callable[[Points, int], Points], steps: Sequence[int]
) -> Margin:
    """Add points to an outline, so that neighbors are near each other at every step.

    Parameters
    ----------
    margin : Margin
        Material points, from :func:`from_base`.
    position : callable
        Gives the positions of material points at a step, in D.
    steps : sequence of int
        All steps, ascending; of many, ``MOST_CHECKS`` are looked at.

    Returns
    -------
    Margin
        With points added on straight lines between the given ones. If those are
        mirror images of each other, all are, in every bit.

    Raises
    ------
    ConfigError
        If that takes more than ``OUTLINE_POINTS`` points.
    """
    rows = np.unique(np.linspace(0, len(steps) - 1, min(MOST_CHECKS, len(steps))).round())
    checked = [steps[int(row)] for row in rows]
    is_base = np.arange(len(margin.points)) < margin.n_base
    if is_mirrored(margin):
        line, is_base = _refined(*_right_half(margin), position, checked)
        n_half = int(is_base.sum())
        left = line[:0:-1] * MIRROR
        # from the left corner to the axis, and on around the blade
        ring = np.concatenate([line, left[1:]])
        return Margin(np.roll(ring, n_half - 1, axis=0), 2 * n_half - 1)
    closed = np.concatenate([margin.points, margin.points[:1]])
    line, is_base = _refined(closed, np.append(is_base, False), position, checked)
    return Margin(line[:-1], int(is_base.sum()))


def _right_half(margin: Margin) -> tuple[Points, NDArray[np.bool_]]:
    """Give the right half of a mirrored outline from axis to axis, and what of it is base."""
    points, n_base = margin
    n_right = n_base // 2 + (len(points) - n_base) // 2
    first = (n_base + 1) // 2
    half = np.take(points, np.arange(first, first + n_right), axis=0, mode="wrap")
    low, high = points[first - 1], points[(first + n_right) % len(points)]
    # where no point is on the axis, an edge crosses it at the height of its ends
    ends = [np.array([[0.0, low[1]]]), np.array([[0.0, high[1]]])]
    line = np.concatenate([ends[0], half, ends[1]])
    return line, np.arange(len(line)) <= n_base // 2


def _refined(
    line: Points,
    is_base: NDArray[np.bool_],
    position: Callable[[Points, int], Points],
    steps: Sequence[int],
) -> tuple[Points, NDArray[np.bool_]]:
    """Split the pieces of a line until none is too long at any step."""
    n_before = 0
    # a point added for one step may be far from its neighbors at another
    while n_before < len(line):
        n_before = len(line)
        for step in steps:
            while (n_parts := _parts(line, position, step)).max() > 1:
                line, is_base = _split(line, is_base, n_parts)
    return line, is_base


def _parts(line: Points, position: Callable[[Points, int], Points], step: int) -> NDArray[np.int64]:
    """Give in how many parts each piece of a line must be split at a step."""
    # what grows beyond all numbers is too long, too
    with np.errstate(over="ignore", invalid="ignore"):
        offsets = np.diff(position(line, step), axis=0)
        lengths = np.sqrt((offsets * offsets).sum(axis=1))
        n_parts = np.ceil(lengths / (SPACING_KEPT * MARGIN_SPACING))
    return np.nan_to_num(n_parts, nan=np.inf).clip(1.0, 1.0 + OUTLINE_POINTS).astype(np.int64)


def _split(
    line: Points, is_base: NDArray[np.bool_], n_parts: NDArray[np.int64]
) -> tuple[Points, NDArray[np.bool_]]:
    """Split each piece of a line into so many equal parts."""
    n_points = int(n_parts.sum()) + 1
    if n_points > OUTLINE_POINTS:
        raise ConfigError(
            f"growth: the outline would need {n_points:,} points, one every"
            f" {MARGIN_SPACING:g} D; allowed are {OUTLINE_POINTS:,}"
        )
    pieces = np.repeat(np.arange(len(n_parts)), n_parts)
    within = np.arange(len(pieces)) - (np.cumsum(n_parts) - n_parts)[pieces]
    share = (within / n_parts[pieces])[:, None]
    split = line[pieces] + share * (line[pieces + 1] - line[pieces])
    split[within == 0] = line[pieces[within == 0]]
    is_added_base = is_base[pieces] & is_base[pieces + 1]
    return (
        np.concatenate([split, line[-1:]]),
        np.append(np.where(within == 0, is_base[pieces], is_added_base), is_base[-1]),
    )
