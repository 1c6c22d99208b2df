"""Room that veins and sources leave in a blade: where its largest empty circle is.

The circle is the largest around a place in the blade, or on its margin, with no vein and no
source in it (Runions 2008, section 5.2.2).
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import Floats, Ids, Points
from vasc.growth import MARGIN_SPACING
from vasc.placement.base import Moment
from vasc.vasculature import Vasculature

if TYPE_CHECKING:
    from vasc.kernels.hash_grid import HashGrid

CELLS_PER_DISTANCE = 5.0
"""Search cells on a birth distance; it decides the speed alone."""

TIE = 1e-6
"""Circles whose radii differ by less, in D, count as equally large."""

ROUNDING = 1e-9
"""Radii that differ by less, in D, differ by rounding."""

GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0
GOLDEN_STEPS = 30
"""Golden sections of a gap of the margin, to less than a millionth of it."""


class Circles(NamedTuple):
    """Candidates for the largest empty circle."""

    material: Points
    """Material points of the centres, shape (k, 2)."""
    places: Points
    """Their places."""
    radii: Floats
    """Distances to the nearest site, shape (k,)."""


class Room:
    """The room that veins and sources leave in the blade of one step.

    Every circle larger than the limit has its centre in an *open* cell: one that
    is not wholly within the limit of a site. Only the sites around open cells are
    triangulated; the centre of a largest circle is a corner of their Voronoi
    diagram, or on the margin.

    Parameters
    ----------
    veins : Vasculature
        Live nodes and live sources are the sites.
    moment : Moment
        The step.
    limit : float
        Least radius of a circle, in the unit of places.
    """

    def __init__(self, veins: Vasculature, moment: Moment, limit: float) -> None:
        self.moment = moment
        self.limit = limit
        is_vein = ~veins.is_retired[: veins.nodes.n_rows]
        nodes = veins.places("nodes")[: veins.nodes.n_rows][is_vein]
        self._sites = np.concatenate([nodes, veins.places("sources")[veins.live]])
        self._margin = moment.growth.margin_places(moment.step)
        low, high = self._margin.min(axis=0), self._margin.max(axis=0)
        side = limit / CELLS_PER_DISTANCE
        self._columns, rows = (np.ceil((high - low) / side).astype(int) + 2).tolist()
        self._corner = np.array([*(low - 0.5 * side), side])
        starts = np.array([0, len(self._margin)], dtype=np.int32)
        self._cells = kernels.polygon.raster(
            self._margin, starts, 1.0, self._corner[0], self._corner[1], side, self._columns, rows
        )
        self._box = (*low.tolist(), *high.tolist())
        self._margin_grid = self._grid_of(self._margin)
        kernels.empty_circles.cover(self._cells, self._corner, self._columns, self._sites, limit)

    def fill(self, place: Points) -> None:
        """Let a new source take room."""
        self._sites = np.concatenate([self._sites, place])
        kernels.empty_circles.cover(self._cells, self._corner, self._columns, place, self.limit)

    def largest_circle(self) -> tuple[Points, Points] | None:
        """Give material point and place of the centre of the largest circle, if it is large."""
        cells = np.flatnonzero(self._cells)
        if len(cells) == 0:
            return None
        side = self._corner[2]
        columns, rows = cells % self._columns, cells // self._columns
        centres = self._corner[:2] + side * (np.stack([columns, rows], axis=1) + 0.5)
        self._grid = self._grid_of(self._sites)
        bounds = kernels.empty_circles.open_cells(
            centres,
            side,
            self._grid,
            self._sites,
            self.moment.outline,
            self.moment.outline_size,
            self._margin_grid,
            self._margin,
            MARGIN_SPACING / self.moment.scale,
            self.limit,
        )
        is_open = bounds > 0.0
        self._cells[cells[~is_open]] = 0
        if not is_open.any():
            return None
        chosen = centres[is_open]
        within = float(bounds.max()) + side
        grid = self._grid_of(chosen)
        near = self._sites[kernels.empty_circles.are_near(grid, chosen, self._sites, within)]
        return self._best(self._interior(near), self._marginal())

    def _best(self, *candidates: Circles) -> tuple[Points, Points] | None:
        """Give the centre of the largest circle that is larger than the limit."""
        material, places, radii = (np.concatenate(parts) for parts in zip(*candidates, strict=True))
        if len(radii) == 0 or radii.max() <= self.limit:
            return None
        best = np.flatnonzero(radii >= radii.max() - TIE)
        # heights of mirrored centres may differ by rounding
        heights = np.round(places[best, 1] / TIE)
        row = best[np.lexsort((places[best, 0], heights))[0]]
        return material[[row]], places[[row]]

    def _interior(self, sites: Points) -> Circles:
        """Give the corners of the Voronoi diagram of some sites that lie in open cells."""
        from scipy.spatial import Delaunay, QhullError

        try:
            triangles = Delaunay(sites).simplices if len(sites) > 3 else np.empty((0, 3), int)
        except QhullError:
            triangles = np.empty((0, 3), dtype=int)  # all sites on a line
        centres = circumcentres(sites[triangles])
        centres = centres[self._are_open(centres)]
        radii = self._clearances(centres)
        centres, radii = centres[radii > self.limit], radii[radii > self.limit]
        moment = self.moment
        is_inside = kernels.polygon.are_inside(moment.outline, centres, moment.outline_size)
        centres, radii = centres[is_inside], radii[is_inside]
        if len(centres):
            largest = centres[radii >= radii.max() - TIE]
            centres = np.array([self._canonical(centre) for centre in largest])
            radii = self._clearances(centres)
        material, positions = moment.embed(centres)
        return Circles(material, positions / moment.scale, radii)

    def _are_open(self, points: Points) -> NDArray[np.bool_]:
        """Tell which points are in open cells."""
        columns = np.floor((points - self._corner[:2]) / self._corner[2])
        shape = np.array([self._columns, len(self._cells) // self._columns])
        is_open = ((columns >= 0) & (columns < shape)).all(axis=1)
        at = columns[is_open].astype(int)
        is_open[is_open] = self._cells[at[:, 1] * self._columns + at[:, 0]] != 0
        return is_open

    def _canonical(self, centre: Points) -> Points:
        """Give the centre of a circle through the nearest sites, taken in one order.

        Where more than three sites are equally near, triangulations differ between
        the two halves of a leaf, and so would the rounding.
        """
        gaps = np.sqrt(((self._sites - centre) ** 2).sum(axis=1))
        around = self._sites[gaps <= gaps.min() + TIE]
        order = np.lexsort((np.abs(around[:, 0]), np.round(around[:, 1] / TIE)))
        around = around[order]
        for third in range(2, len(around)):
            found = circumcentres(around[[0, 1, third]][None])
            if len(found) and np.abs(found[0] - centre).max() < 1e3 * TIE:
                found[0, 0] = 0.0 if abs(found[0, 0]) < ROUNDING else found[0, 0]
                return found[0]
        return centre

    def _marginal(self) -> Circles:
        """Give the places on the margin that have most room among their neighbors."""
        growth, step = self.moment.growth, self.moment.step
        ring = len(self._margin)
        # all of them: the best place of a gap may be in an open cell that no end of it is in
        radii = self._clearances(self._margin)
        is_free = np.arange(ring) >= growth.n_base - 1
        is_free[0] = True  # the corners of the base belong to the margin
        radii[~is_free] = -np.inf
        is_peak = (radii >= np.roll(radii, 1)) & (radii >= np.roll(radii, -1)) & is_free
        is_peak &= radii > self.limit - MARGIN_SPACING / self.moment.scale
        peaks = np.flatnonzero(is_peak).astype(np.int32)
        # the neighboring gaps of each peak, but for those of the base
        rows = np.unique(np.concatenate([peaks, (peaks - 1) % ring]))
        following = (rows + 1) % ring
        gaps = np.sqrt(((self._margin[following] - self._margin[rows]) ** 2).sum(axis=1))
        may_do = 0.5 * (radii[rows] + radii[following] + gaps) > self.limit
        rows = rows[is_free[rows] & is_free[following] & may_do]
        shares = self._refined(rows)
        material, places = growth.along_margin(rows, shares, step)
        refined = self._clearances(places)
        # a point of the margin, as that on the midline, is not left for rounding
        is_better = refined > np.maximum(radii[rows], radii[(rows + 1) % ring]) + ROUNDING
        at_peaks = growth.along_margin(peaks, np.zeros(len(peaks)), step)
        return Circles(
            np.concatenate([material[is_better], at_peaks[0]]),
            np.concatenate([places[is_better], at_peaks[1]]),
            np.concatenate([refined[is_better], radii[peaks]]),
        )

    def _refined(self, rows: Ids) -> Floats:
        """Give the share of each gap of the margin at which there is most room, shape (k,).

        Gaps left of the midline are searched backwards, as the mirror images of
        those on the right.
        """
        growth, step = self.moment.growth, self.moment.step
        if len(rows) == 0:
            return np.empty(0)
        is_left = self._margin[rows, 0] + self._margin[(rows + 1) % len(self._margin), 0] < 0.0

        def from_base(shares: Floats) -> Floats:
            # in steps of 2^-40, of which 1 - share is as exact as the share
            shares = np.round(shares * 2.0**40) / 2.0**40
            return np.where(is_left, 1.0 - shares, shares)

        def radii(shares: Floats) -> Floats:
            shares = from_base(shares)
            return self._clearances(growth.along_margin(rows, shares, step)[1])

        return from_base(golden_section(radii, len(rows)))

    def _clearances(self, points: Points) -> Floats:
        """Give the distance of points to the nearest site."""
        return kernels.empty_circles.clearances(self._grid, self._sites, points)

    def _grid_of(self, points: Points) -> "HashGrid":
        """Index points."""
        grid = kernels.hash_grid.hash_grid(self._box, 0.5 * self.limit, len(points))
        kernels.hash_grid.insert(grid, points, 0, len(points))
        return grid


def golden_section(values: Callable[[Floats], Floats], n: int) -> Floats:
    """Give the arguments from 0 to 1 at which functions with one peak each are greatest.

    Parameters
    ----------
    values : callable
        From one argument each, shape (n,), to the values of all functions.
    n : int
        Number of functions.

    Returns
    -------
    ndarray of shape (n,), float64
    """
    low, high = np.zeros(n), np.ones(n)
    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_inner, at_outer = values(inner), values(outer)
    for _ in range(GOLDEN_STEPS):
        is_lower = at_inner >= at_outer
        high, low = np.where(is_lower, outer, high), np.where(is_lower, low, inner)
        inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        at_inner, at_outer = values(inner), values(outer)
    return 0.5 * (low + high)


def circumcentres(triangles: Points) -> Points:
    """Give the centres of the circles through the corners of triangles, flat ones left out.

    Parameters
    ----------
    triangles : ndarray of shape (t, 3, 2), float64
        Corners.

    Returns
    -------
    ndarray of shape (k, 2), float64
        Mirrored for mirrored triangles, to the last bit.
    """
    if len(triangles) == 0:
        return np.empty((0, 2))
    order = np.lexsort((np.abs(triangles[..., 0]), triangles[..., 1]), axis=1)
    first, b, c = (
        np.take_along_axis(triangles, order[:, [k], None], axis=1)[:, 0] for k in range(3)
    )
    b, c = b - first, c - first
    twice = 2.0 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        b2, c2 = (b**2).sum(axis=1), (c**2).sum(axis=1)
        x = (c[:, 1] * b2 - b[:, 1] * c2) / twice
        y = (b[:, 0] * c2 - c[:, 0] * b2) / twice
    centres = first + np.stack([x, y], axis=1)
    return centres[np.isfinite(centres).all(axis=1)]
