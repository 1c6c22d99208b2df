"""A leaf blade: an outline with one or more attachments, at some size."""

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vasc import kernels
from vasc.arrays import Points, as_points
from vasc.errors import OutlineError, ShapeError

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


class Blade:
    """A blade: rings under the even-odd rule, and the seeds where veins begin.

    Attachment at the origin, tip toward positive y. A scaled blade shares the
    rings of the one it was scaled from, so that scaling costs nothing.

    Parameters
    ----------
    rings : tuple of ndarray of shape (n, 2), float64
        Outline, holes and further parts, closed implicitly, at scale 1.
    seeds : ndarray of shape (k, 2), float64
        First vein nodes, at scale 1.
    scale : float
        Factor from these to real size.
    """

    def __init__(self, rings: Sequence[Points], seeds: Points, scale: float = 1.0) -> None:
        self._rings = tuple(rings)
        self._seeds = seeds
        self._scale = scale

    @classmethod
    def from_rings(cls, rings: Sequence[ArrayLike], seeds: ArrayLike) -> "Blade":
        """Make a blade of rings and seeds in real size.

        Raises
        ------
        OutlineError
            If there is no ring, or one has fewer than three points.
        """
        if not rings:
            raise OutlineError("domain: the outline is empty; it needs at least three points")
        try:
            points = [as_points(ring, f"domain: ring {k}") for k, ring in enumerate(rings)]
            starts = as_points(seeds, "domain.seeds")
        except ShapeError as error:
            raise OutlineError(str(error)) from error
        for k, ring in enumerate(points):
            if len(ring) < 3:
                raise OutlineError(f"domain: ring {k} has {len(ring)} points; at least 3 are needed")
        return cls(points, starts)

    def scaled(self, factor: float) -> "Blade":
        """Give the blade scaled about the origin."""
        return Blade(self._rings, self._seeds, self._scale * factor)

    @cached_property
    def rings(self) -> tuple[Points, ...]:
        """Outline, holes and further parts in real size, closed implicitly."""
        return tuple(ring * self._scale for ring in self._rings)

    @cached_property
    def seeds(self) -> Points:
        """First vein nodes in real size, shape (k, 2)."""
        return self._seeds * self._scale

    @cached_property
    def flat(self) -> tuple[Points, NDArray[np.int32]]:
        """All rings in one array, shape (n, 2), and the first row of each, shape (r + 1,)."""
        counts = [0, *(len(ring) for ring in self._rings)]
        xy = np.concatenate(self._rings) * self._scale
        return xy, np.cumsum(counts, dtype=np.int32)

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Lower x, lower y, upper x, upper y."""
        xy = self.flat[0]
        low, high = xy.min(axis=0).tolist(), xy.max(axis=0).tolist()
        return low[0], low[1], high[0], high[1]

    @cached_property
    def length(self) -> float:
        """Blade length: from the attachment to the height of the tip (basal lobes not counted)."""
        return float(max(ring[:, 1].max() for ring in self._rings)) * self._scale

    @cached_property
    def area(self) -> float:
        """Area under the even-odd rule: a ring inside an odd number of others is a hole."""
        total = 0.0
        for k, ring in enumerate(self._rings):
            others = [r for j, r in enumerate(self._rings) if j != k]
            depth = sum(_holds(other, ring[0]) for other in others)
            x, y = ring[:, 0], ring[:, 1]
            size = 0.5 * abs(float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)))
            total += size if depth % 2 == 0 else -size
        return total * self._scale * self._scale

    @cached_property
    def is_star_shaped(self) -> bool:
        """Whether every point of the blade is in sight of the origin.

        Only such a blade grows by scaling its outline without leaving places it covered.
        """
        if len(self._rings) != 1:
            return False
        ring = self._rings[0]
        following = np.roll(ring, -1, axis=0)
        turns = ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]
        slack = 1e-9 * float(np.abs(ring).max()) ** 2
        return bool((turns >= -slack).all() or (turns <= slack).all())

    def contains(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Tell which points, shape (n, 2), lie in the blade."""
        xy, starts = self.flat
        return kernels.polygon.contains(xy, starts, as_points(points, "points"), 1.0)

    def margin_distance(self, points: ArrayLike) -> NDArray[np.float64]:
        """Give the distance of points, shape (n, 2), to the margin, at least 0."""
        xy, starts = self.flat
        return kernels.polygon.margin_distances(xy, starts, as_points(points, "points"), 1.0)

    @cached_property
    def polygon(self) -> "BaseGeometry":
        """The blade as a shapely geometry."""
        from shapely import Polygon
        from shapely.ops import unary_union

        polygon: BaseGeometry = Polygon()
        for ring in sorted(self.rings, key=lambda ring: -Polygon(ring).area):
            polygon = polygon.symmetric_difference(Polygon(ring))
        return unary_union(polygon)


def _holds(ring: Points, point: Points) -> bool:
    """Tell whether a ring surrounds a point."""
    x, y = point.tolist()
    following = np.roll(ring, -1, axis=0)
    low = ring[:, 1] <= y
    crosses = low != (following[:, 1] <= y)
    first, last = ring[crosses], following[crosses]
    at = first[:, 0] + (y - first[:, 1]) * (last[:, 0] - first[:, 0]) / (last[:, 1] - first[:, 1])
    return int((at > x).sum()) % 2 == 1
