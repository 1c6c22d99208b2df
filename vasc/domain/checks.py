"""What an outline must be, and where it is not."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from vasc.arrays import Points, as_points
from vasc.domain.rings import distance_to_ring, surrounding, surrounds
from vasc.errors import OutlineError, ShapeError
from vasc.limits import OUTLINE_POINTS, OUTLINE_RINGS

LARGEST = 1e75
"""Of a coordinate: products of four still have a finite value."""
ON_MARGIN = 1e-9
"""A seed at most this share of the blade's extent off the margin is on it."""


def check_rings(rings: Sequence[ArrayLike]) -> tuple[Points, ...]:
    """Give rings as arrays, each of which bounds an area.

    Raises
    ------
    OutlineError
        If there is none, or one of them is no ring, is too large or does not
        bound an area; the message names ring and row, counted from 0.
    """
    if len(rings) == 0:
        raise OutlineError("outline: empty; it needs at least 3 points")
    if len(rings) > OUTLINE_RINGS:
        raise OutlineError(f"outline: {len(rings)} rings; at most {OUTLINE_RINGS} are allowed")
    checked = []
    for k, ring in enumerate(rings):
        name = "outline" if len(rings) == 1 else f"outline: ring {k}"
        try:
            points = as_points(ring, name).copy()
        except ShapeError as error:
            raise OutlineError(str(error)) from error
        _check_ring(points, name)
        checked.append(points)
    n_points = sum(len(ring) for ring in checked)
    if n_points > OUTLINE_POINTS:
        raise OutlineError(f"outline: {n_points:,} points; at most {OUTLINE_POINTS:,} are allowed")
    return tuple(checked)


def _check_ring(points: Points, name: str) -> None:
    """Refuse a ring that is too short, repeats a point or bounds no area."""
    if len(points) < 3:
        raise OutlineError(f"{name}: {len(points)} points; it needs at least 3")
    is_repeated = (points == np.roll(points, 1, axis=0)).all(axis=1)
    if is_repeated.any():
        row = int(np.flatnonzero(is_repeated)[-1])
        before = (row - 1) % len(points)
        raise OutlineError(
            f"{name}: rows {before} and {row} are the same point {place(points[row])};"
            " each point must differ from the one before, and the last from the first"
        )
    if (np.abs(points) > LARGEST).any():
        row = int(np.flatnonzero((np.abs(points) > LARGEST).any(axis=1))[0])
        raise OutlineError(
            f"{name}: row {row} is {place(points[row])}; numbers must be at most {LARGEST:g}"
        )
    offsets = points - points[0]
    squared = (offsets * offsets).sum(axis=1)
    far = offsets[np.argmax(squared)]
    # not the signed area, which is 0 for a figure of eight, too
    off_line = np.abs(offsets[:, 0] * far[1] - offsets[:, 1] * far[0]).max()
    if off_line <= 1e-12 * squared.max():
        raise OutlineError(
            f"{name}: area 0; the {len(points)} points from {place(points[0])} must not lie"
            " on one line"
        )


def check_crossings(rings: tuple[Points, ...]) -> None:
    """Make sure that no ring crosses or touches itself or another one.

    Raises
    ------
    OutlineError
        If one does; the message names the first place found.
    """
    if len(rings) == 1 and _winds_once(rings[0]):
        return
    import shapely

    lines = np.array([shapely.LinearRing(ring) for ring in rings])
    for k, line in enumerate(lines):
        if not line.is_simple:
            name = "outline" if len(rings) == 1 else f"outline: ring {k}"
            reason = shapely.is_valid_reason(shapely.Polygon(line))
            found = reason.partition("[")[2].rstrip("]").split()
            where = f" at ({', '.join(f'{float(v):.6g}' for v in found)})" if found else ""
            raise OutlineError(f"{name}: crosses or touches itself{where}; margins must not meet")
    if len(rings) == 1:
        return
    first, second = shapely.STRtree(lines).query(lines, predicate="intersects")
    for a, b in zip(first.tolist(), second.tolist(), strict=True):
        if a < b:
            point = shapely.get_coordinates(lines[a].intersection(lines[b]))[0]
            raise OutlineError(
                f"outline: rings {a} and {b} cross or touch at {place(point)};"
                " parts and holes must keep apart"
            )


def _winds_once(ring: Points) -> bool:
    """Tell whether a ring turns about the origin in one direction and once, hence crosses nothing.

    Most outlines do, and need no geometry library, which takes longer to load
    than a small leaf to grow.
    """
    following = np.roll(ring, -1, axis=0)
    turns = ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]
    is_at_origin = (ring == 0.0).all(axis=1) | (following == 0.0).all(axis=1)
    turns = turns[~is_at_origin]
    if not ((turns > 0.0).all() or (turns < 0.0).all()) or is_at_origin.sum() > 2:
        return False
    # edges that cross the ray toward positive x: one a turn
    is_low, is_next_low = ring[:, 1] < 0.0, following[:, 1] < 0.0
    crosses = (is_low != is_next_low) & ((ring[:, 0] > 0.0) | (following[:, 0] > 0.0))
    first, last = ring[crosses], following[crosses]
    with np.errstate(invalid="ignore", divide="ignore"):
        at = first[:, 0] - first[:, 1] * (last[:, 0] - first[:, 0]) / (last[:, 1] - first[:, 1])
    return int((at > 0.0).sum()) <= 1


def check_seeds(rings: tuple[Points, ...], seeds: Points) -> None:
    """Make sure that every seed is in the blade, and that every part has one.

    Raises
    ------
    OutlineError
        If a seed is outside or in a hole, or a part has none.
    """
    if len(seeds) == 0:
        raise OutlineError("seeds: none; at least one is needed in each part of the outline")
    around = surrounding(rings)
    extent = float(max(np.ptp(np.concatenate(rings), axis=0)))
    seeded = {_part_of(seed, k, rings, around, ON_MARGIN * extent) for k, seed in enumerate(seeds)}
    for k, ring in enumerate(rings):
        if len(around[k]) % 2 == 0 and k not in seeded:
            low, high = ring.min(axis=0), ring.max(axis=0)
            raise OutlineError(
                f"seeds: none in the part (ring {k}) between {place(low)} and {place(high)};"
                " each part needs at least one"
            )


def _part_of(
    seed: Points, k: int, rings: tuple[Points, ...], around: list[list[int]], tolerance: float
) -> int:
    """Give the ring of the part that a seed is in or on the margin of."""
    distances = [distance_to_ring(ring, seed) for ring in rings]
    nearest = int(np.argmin(distances))
    if distances[nearest] <= tolerance:
        if len(around[nearest]) % 2 == 0:
            return nearest
        return max(around[nearest], key=lambda ring: len(around[ring]))
    holders = [j for j, ring in enumerate(rings) if surrounds(ring, seed)]
    if len(holders) % 2 == 1:
        return max(holders, key=lambda ring: len(around[ring]))
    kind = "in a hole" if holders else "outside the outline"
    raise OutlineError(
        f"seeds[{k}] = {place(seed)}: {kind}, {distances[nearest]:.4g} from the margin;"
        " seeds must be inside or on the margin"
    )


def closed_ring(points: Any, name: str) -> Points:
    """Give a ring of a file without its repeated last point.

    Raises
    ------
    OutlineError
        If it is open: the last point is not the first one.
    """
    ring = as_points(points, name)
    if len(ring) > 1 and not np.array_equal(ring[0], ring[-1]):
        raise OutlineError(
            f"{name}: open; it starts at {place(ring[0])} and ends at {place(ring[-1])},"
            " which must be the same point"
        )
    return ring[:-1]


def without_repeats(ring: Points) -> Points:
    """Give a ring without points that repeat the one before."""
    keep = [0, *(k for k, (a, b) in enumerate(pairwise(ring), 1) if (a != b).any())]
    if len(keep) > 1 and (ring[keep[-1]] == ring[0]).all():
        keep.pop()
    return ring[keep]


def place(point: Points) -> str:
    """Write a point for a message."""
    return f"({point[0]:.6g}, {point[1]:.6g})"
