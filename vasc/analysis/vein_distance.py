"""How far tissue lies from the nearest vein, and how veins fill the plane."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.sections import Sections
from vasc.arrays import Floats, Points

if TYPE_CHECKING:
    import shapely

N_PLACES = 100_000
"""Places in the box around a region at which the distance is taken."""
N_NEAR = 8
"""Samples of veins around a place whose segments are looked at."""
FINEST, COARSEST = 7, 3
"""Boxes are L/8, L/16, ... L/128 wide, with L the longer side of the network."""


def enclosed_region(sections: Sections) -> "shapely.Geometry":
    """Give the region that veins enclose: all areoles together.

    Parameters
    ----------
    sections : Sections
        The veins of a network.

    Returns
    -------
    shapely.Geometry
        Empty if there is no areole.
    """
    import shapely

    faces = shapely.get_parts(shapely.polygonize(sections.lines()[sections.is_looped]))
    return shapely.coverage_union_all(faces)


def places_in(region: "shapely.Geometry", n_places: int = N_PLACES) -> Points:
    """Spread places evenly over a region, always the same ones.

    Parameters
    ----------
    region : shapely.Geometry
        Any region.
    n_places : int
        Places in the box around it; those outside the region are left out.

    Returns
    -------
    ndarray of shape (k, 2), float64
        Empty for an empty region.

    Notes
    -----
    The additive recurrence by powers of 1/g, with g^3 = g + 1 (Roberts, 2018, "The
    unreasonable effectiveness of quasirandom sequences"): more even than chance.
    """
    import shapely

    if region.is_empty or region.area == 0.0:
        return np.zeros((0, 2))
    left, bottom, right, top = region.bounds
    plastic = 1.324717957244746
    shares = np.arange(1, n_places + 1)[:, None] * [1.0 / plastic, 1.0 / plastic**2] % 1.0
    places = np.array([left, bottom]) + shares * [right - left, top - bottom]
    shapely.prepare(region)
    inside: Points = places[shapely.contains_xy(region, places)]
    return inside


def distances_to_vein(sections: Sections, places: Points) -> Floats:
    """Give the distance from places to the nearest vein.

    Parameters
    ----------
    sections : Sections
        The veins of a network.
    places : ndarray of shape (k, 2), float64
        Places in the tissue.

    Returns
    -------
    ndarray of shape (k,), float64
        To the middle line of the vein; empty without veins. Looked at are the
        segments with one of the eight nearest samples, a fifth of a mean section apart.
    """
    points, segments = sections.drawing.points, sections.drawing.segments
    if not len(segments) or not len(places):
        return np.zeros(0)
    from scipy.spatial import KDTree

    ends = points[segments]
    samples, rows = places_along(ends, sections.reach / 2.0)
    n_near = min(N_NEAR, len(samples))
    near = KDTree(samples).query(places, n_near)[1].reshape(len(places), n_near)
    # exact for the segments that have one of the nearest samples
    best = np.full(len(places), np.inf)
    for column in near.T:
        start, stop = ends[rows[column]].transpose(1, 0, 2)
        step, off = stop - start, places - start
        share = (off * step).sum(axis=1) / (step * step).sum(axis=1)
        rest = off - np.clip(share, 0.0, 1.0)[:, None] * step
        np.minimum(best, (rest * rest).sum(axis=1), out=best)
    return np.sqrt(best)


def places_along(ends: Points, spacing: float) -> tuple[Points, NDArray[np.int64]]:
    """Give places along segments, their ends among them.

    Parameters
    ----------
    ends : ndarray of shape (q, 2, 2), float64
        Ends of the segments.
    spacing : float
        Between the places of a segment at most, above 0.

    Returns
    -------
    tuple of ndarray
        The places, shape (k, 2), and the row of the segment of each, shape (k,).
    """
    steps = ends[:, 1] - ends[:, 0]
    n_steps = np.ceil(np.sqrt((steps**2).sum(axis=1)) / spacing).astype(np.int64)
    n_steps = np.maximum(n_steps, 1)
    rows = np.repeat(np.arange(len(ends)), n_steps + 1)
    first = np.cumsum(n_steps + 1) - (n_steps + 1)
    shares = (np.arange(len(rows)) - first[rows]) / n_steps[rows]
    return ends[rows, 0] + shares[:, None] * steps[rows], rows


def box_dimension(sections: Sections) -> float:
    """Give the box-counting dimension between L/8 and L/128.

    Parameters
    ----------
    sections : Sections
        The veins of a network.

    Returns
    -------
    float
        Slope of log(boxes that hold a vein) against log(1 / side), fitted by least
        squares; nan without veins. Boxes stand on the lower left corner of the
        network, so that turning it changes the number a little.
    """
    points, segments = sections.drawing.points, sections.drawing.segments
    if not len(segments):
        return float("nan")
    used = points[segments]
    corner = used.reshape(-1, 2).min(axis=0)
    side = float(np.ptp(used.reshape(-1, 2), axis=0).max())
    # closer than an eighth of the smallest box
    along = places_along(used, side / 8.0 / 2**FINEST)[0]
    places = (along - corner) / side
    powers = np.arange(COARSEST, FINEST + 1)
    counts = [_boxes(places, 2**power) for power in powers.tolist()]
    return float(np.polyfit(powers * np.log(2.0), np.log(counts), 1)[0])


def _boxes(places: Points, n_across: int) -> int:
    """Count the boxes that hold one of the places, which lie in the unit square."""
    cells = np.minimum((places * n_across).astype(np.int64), n_across - 1)
    return len(np.unique(cells[:, 0] * n_across + cells[:, 1]))
