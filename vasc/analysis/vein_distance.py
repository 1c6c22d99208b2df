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
        To the middle line of the vein; empty without veins.

    Notes
    -----
    Exact: the nearest of eight samples of veins are looked at, and more where the
    nearest vein may have none among them.
    """
    points, segments = sections.drawing.points, sections.drawing.segments
    if not len(segments) or not len(places):
        return np.zeros(0)
    from scipy.spatial import KDTree

    ends = points[segments]
    samples, rows, longest = places_along(ends, sections.reach / 2.0)
    tree = KDTree(samples)
    distances = np.full(len(places), np.inf)
    open_places, n_near = np.arange(len(places)), N_NEAR
    while len(open_places):
        n_near = min(n_near, len(samples))
        off, near = tree.query(places[open_places], [*range(1, n_near + 1)])
        for column in near.T:
            found = _to_segments(places[open_places], ends[rows[column]])
            distances[open_places] = np.minimum(distances[open_places], found)
        # a segment without a sample among the nearest is farther than the last of them,
        # less half a piece
        is_open = (distances[open_places] > off[:, -1] - longest / 2.0) & (n_near < len(samples))
        open_places, n_near = open_places[is_open], 4 * n_near
    return distances


def _to_segments(places: Points, ends: Points) -> Floats:
    """Give the distance from each place to a segment of its own."""
    start, stop = ends[:, 0], ends[:, 1]
    step, off = stop - start, places - start
    share = (off * step).sum(axis=1) / (step * step).sum(axis=1)
    rest = off - np.clip(share, 0.0, 1.0)[:, None] * step
    return np.sqrt((rest * rest).sum(axis=1))


def places_along(ends: Points, spacing: float) -> tuple[Points, NDArray[np.int64], float]:
    """Cut segments into even pieces and give the middles of these.

    Parameters
    ----------
    ends : ndarray of shape (q, 2, 2), float64
        Ends of the segments, at least one.
    spacing : float
        Length of a piece at most, above 0.

    Returns
    -------
    tuple of ndarray, ndarray and float
        The middles, shape (k, 2), the row of the segment of each, shape (k,), and the
        length of the longest piece.
    """
    steps = ends[:, 1] - ends[:, 0]
    lengths = np.sqrt((steps**2).sum(axis=1))
    n_pieces = np.maximum(np.ceil(lengths / spacing).astype(np.int64), 1)
    rows = np.repeat(np.arange(len(ends)), n_pieces)
    first = np.cumsum(n_pieces) - n_pieces
    shares = (np.arange(len(rows)) - first[rows] + 0.5) / n_pieces[rows]
    longest = float((lengths / n_pieces).max())
    return ends[rows, 0] + shares[:, None] * steps[rows], rows, longest


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
