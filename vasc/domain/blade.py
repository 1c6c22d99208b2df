"""The leaf blade: an outline attached at the origin, scaled at no cost while it grows."""

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vasc import kernels
from vasc.arrays import Points, as_points
from vasc.domain.checks import check_crossings, check_rings, check_seeds
from vasc.domain.rings import signed_area, surrounding
from vasc.errors import OutlineError, ShapeError

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

    from vasc.kernels.polygon import EdgeGrid


class _Outline:
    """Checked rings and seeds at the size they were given, and what is computed from them once."""

    def __init__(self, rings: tuple[Points, ...], seeds: Points) -> None:
        self.rings = rings
        self.seeds = seeds
        self.xy = np.concatenate(rings)
        self.starts = np.cumsum([0, *(len(ring) for ring in rings)]).astype(np.int32)
        for points in (*rings, seeds, self.xy):
            points.flags.writeable = False
        self.low, self.high = self.xy.min(axis=0), self.xy.max(axis=0)

    @cached_property
    def polygon(self) -> "Polygon | MultiPolygon":
        """The outline as a shapely geometry."""
        import shapely

        # even-odd: what two rings share is a hole of the outer one
        geometry = shapely.Polygon(self.rings[0])
        for ring in self.rings[1:]:
            geometry = geometry.symmetric_difference(shapely.Polygon(ring))
        return geometry

    @cached_property
    def area(self) -> float:
        """Area under the even-odd rule; a ring within an odd number of others is a hole."""
        total = 0.0
        for ring, around in zip(self.rings, surrounding(self.rings), strict=True):
            total += abs(signed_area(ring)) * (1 if len(around) % 2 == 0 else -1)
        return total

    @cached_property
    def edge_grid(self) -> "EdgeGrid":
        """The edges, sorted for the point-in-polygon kernel."""
        return kernels.polygon.edge_grid(self.xy, self.starts)

    @cached_property
    def is_star_shaped(self) -> bool:
        """Whether every straight line from the origin to a point of the blade stays in it."""
        if len(self.rings) != 1:
            return False
        ring = self.rings[0]
        following = np.roll(ring, -1, axis=0)
        turns = ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]
        # a simple ring around its kernel, or with a point of it on the margin, turns one way only
        slack = 1e-12 * float(np.abs(ring).max()) ** 2
        return bool((turns >= -slack).all() or (turns <= slack).all())


class Blade:
    """A leaf blade: closed rings under the even-odd rule, with the attachment at the origin.

    Immutable; made by :meth:`from_rings`, :class:`~vasc.domain.BladeParameters`
    or :meth:`scaled`. A scaled blade shares the outline of the one it came from.
    The tip points to positive y.
    """

    def __init__(self, outline: _Outline, factor: float) -> None:
        self._outline = outline
        self._factor = factor

    @classmethod
    def from_rings(cls, rings: Sequence[ArrayLike], seeds: ArrayLike = ((0.0, 0.0),)) -> "Blade":
        """Make a blade from rings in real size.

        Parameters
        ----------
        rings : sequence of array_like of shape (n_r, 2)
            Corners of every ring; the first is not repeated at the end. Several
            parts and holes are allowed, also a part within a hole.
        seeds : array_like of shape (k, 2)
            Positions of the first vein nodes; at least one in each part.

        Returns
        -------
        Blade
            With the arrays copied.

        Raises
        ------
        OutlineError
            If a ring is empty, has fewer than three points, crosses or touches
            itself or another one, has no area, numbers that are not finite or a
            point twice in a row; if no point is above the attachment; if a seed
            is outside or a part has none. The message names the place.

        Examples
        --------
        >>> blade = Blade.from_rings([[(-1, 0), (1, 0), (1, 4), (-1, 4)]])
        >>> blade.length, blade.area, blade.scaled(2.0).area
        (4.0, 8.0, 32.0)
        >>> blade.contains(np.array([[0.5, 1.0], [3.0, 1.0]]))
        array([ True, False])
        """
        checked = check_rings(rings)
        check_crossings(checked)
        try:
            outline = _Outline(checked, as_points(seeds, "seeds").copy())
        except ShapeError as error:
            raise OutlineError(str(error)) from error
        if outline.high[1] <= 0.0:
            raise OutlineError(
                f"outline: the highest point is at y = {outline.high[1]:.6g}; at least one must "
                "be above the attachment, y = 0"
            )
        check_seeds(checked, outline.seeds)
        return cls(outline, 1.0)

    @classmethod
    def sound(cls, rings: Sequence[Points], seeds: Points) -> "Blade":
        """Make a blade from rings that are known to be sound, as images of sound ones are.

        Nothing is checked and nothing copied; the arrays become read-only.
        """
        return cls(_Outline(tuple(rings), seeds), 1.0)

    def scaled(self, factor: float) -> "Blade":
        """Give the blade scaled about the attachment, without touching a point."""
        return Blade(self._outline, self._factor * factor)

    @property
    def factor(self) -> float:
        """Size over that of the outline the blade was first made from."""
        return self._factor

    @cached_property
    def rings(self) -> tuple[Points, ...]:
        """Corners of every ring in real size, the first not repeated."""
        return tuple(self._real(ring) for ring in self._outline.rings)

    @cached_property
    def seeds(self) -> Points:
        """Positions of the first vein nodes, shape (k, 2)."""
        return self._real(self._outline.seeds)

    @property
    def length(self) -> float:
        """Height of the highest point above the attachment; lobes below it do not count."""
        return float(self._outline.high[1]) * self._factor

    @property
    def width(self) -> float:
        """Extent across the blade."""
        return float(self._outline.high[0] - self._outline.low[0]) * self._factor

    @property
    def area(self) -> float:
        """Area in real size; holes do not count."""
        return self._outline.area * (self._factor * self._factor)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Lower x, lower y, upper x, upper y."""
        low, high = self._outline.low * self._factor, self._outline.high * self._factor
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    @cached_property
    def flat(self) -> tuple[Points, NDArray[np.int32]]:
        """All corners in one array in real size, and the first row of every ring."""
        return self._real(self._outline.xy), self._outline.starts

    @property
    def edge_grid(self) -> "EdgeGrid":
        """The edges of the outline at ``factor`` 1, made once for all scaled blades."""
        return self._outline.edge_grid

    @cached_property
    def polygon(self) -> "Polygon | MultiPolygon":
        """The blade as a shapely geometry in real size."""
        import shapely

        return shapely.transform(self._outline.polygon, lambda xy: xy * self._factor)

    @property
    def is_star_shaped(self) -> bool:
        """Whether the attachment sees every point of the blade.

        Only then does a blade that is scaled about its attachment never lose
        ground that it had: marginal growth needs it.
        """
        return self._outline.is_star_shaped

    def contains(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Tell which points are inside, shape (n,), by the rule of the polygon kernel."""
        return kernels.polygon.are_inside(
            self._outline.edge_grid, as_points(points, "points"), self._factor
        )

    def margin_distance(self, points: ArrayLike) -> NDArray[np.float64]:
        """Give the distance of every point to the outline, shape (n,), never negative."""
        outline = self._outline
        return kernels.polygon.margin_distances(
            outline.xy, outline.starts, as_points(points, "points"), self._factor
        )

    def __repr__(self) -> str:
        return (
            f"Blade(length={self.length:.6g}, width={self.width:.6g}, rings="
            f"{len(self._outline.rings)}, seeds={len(self._outline.seeds)})"
        )

    def __eq__(self, other: Any) -> bool:
        if not isinstance(other, Blade):
            return NotImplemented
        return len(self.rings) == len(other.rings) and all(
            np.array_equal(a, b)
            for a, b in zip((*self.rings, self.seeds), (*other.rings, other.seeds), strict=True)
        )

    __hash__ = None  # type: ignore[assignment]

    def _real(self, points: Points) -> Points:
        """Give points of the shared outline in real size, read-only."""
        real = points if self._factor == 1.0 else points * self._factor
        real.flags.writeable = False
        return real
