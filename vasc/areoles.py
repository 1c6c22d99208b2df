"""Areoles: the regions that veins enclose, when they closed and what they were split from."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Column, Floats, Ids, Points, Steps
from vasc.events import EventKind

AREOLE_COLUMNS = {
    "birth": Column("i4", "step of birth"),
    "parent": Column("i4", "areole it was split from, -1 if born in tissue not enclosed"),
    "segment": Column("i4", "segment that closed it"),
}

BOUNDARY_COLUMNS = {
    "areole": Column("i4", "areole that the node is on the boundary of; never falls"),
    "node": Column("i4", "node on the boundary at birth, counterclockwise"),
}


@dataclass(frozen=True)
class AreoleSet:
    """The areoles at one step: those born and not yet split.

    Parameters
    ----------
    ids : ndarray of shape (a,), int32
        Rows of the areoles table, ascending.
    parents : ndarray of shape (a,), int32
        The areole each was split from, -1 if it was born in tissue not enclosed.
    births : ndarray of shape (a,), int32
        Steps of birth.
    segments : ndarray of shape (a,), int32
        The segment that closed each.
    boundaries : list of a ndarrays of shape (b,), int32
        Node ids around each when it was born, counterclockwise.
    areas : ndarray of shape (a,), float64
        Areas within the boundaries as they lie at this step, in square units of length.
    """

    ids: Ids
    parents: Ids
    births: Steps
    segments: Ids
    boundaries: list[Ids]
    areas: Floats

    @property
    def n_areoles(self) -> int:
        """Number of areoles."""
        return len(self.ids)


def areoles_from_columns(
    areoles: Mapping[str, NDArray],
    boundaries: Mapping[str, NDArray],
    events: Mapping[str, NDArray],
    positions: Points,
) -> AreoleSet:
    """Give the areoles that the first rows of the tables describe.

    Parameters
    ----------
    areoles, boundaries, events : mapping of str to ndarray
        Columns of the tables, cut to one step; of the events ``kind`` and ``subject``.
    positions : ndarray of shape (n, 2), float64
        Where the nodes are at that step.

    Returns
    -------
    AreoleSet
        Every areole without an event that tells of its split.
    """
    n_born = len(areoles["birth"])
    is_whole = np.ones(n_born, dtype=bool)
    is_whole[events["subject"][events["kind"] == EventKind.AREOLE_SPLIT]] = False
    ids = np.flatnonzero(is_whole).astype(np.int32)
    nodes = boundaries["node"]
    # rows are in the order of areoles, so that each boundary is a slice
    ends = np.cumsum(np.bincount(boundaries["areole"], minlength=n_born))
    starts = np.concatenate([[0], ends[:-1]]) if n_born else ends
    return AreoleSet(
        ids=ids,
        parents=areoles["parent"][ids],
        births=areoles["birth"][ids],
        segments=areoles["segment"][ids],
        boundaries=[nodes[starts[row] : ends[row]] for row in ids.tolist()],
        areas=polygon_areas(positions[nodes], boundaries["areole"], n_born)[ids],
    )


def polygon_areas(points: Points, polygons: Ids, n_polygons: int) -> Floats:
    """Give the areas of polygons, positive where their corners run counterclockwise.

    Parameters
    ----------
    points : ndarray of shape (p, 2), float64
        The corners of all polygons, one polygon after the other.
    polygons : ndarray of shape (p,), int32
        The polygon each corner belongs to; never falls.
    n_polygons : int
        How many polygons there are.

    Returns
    -------
    ndarray of shape (n_polygons,), float64
        Signed areas; 0 for a polygon without corners.

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    >>> polygon_areas(square, np.zeros(4, dtype=np.int32), 2)
    array([4., 0.])
    """
    if not n_polygons:
        # also for points in space, where there are none
        return np.empty(0)
    lengths = np.bincount(polygons, minlength=n_polygons)
    ends = np.cumsum(lengths)
    firsts = (ends - lengths)[polygons]
    following = np.arange(1, len(points) + 1)
    last = ends[lengths > 0] - 1
    following[last] = firsts[last]
    # seen from the first corner, so that far from the origin no digits cancel
    x, y = (points - points[firsts]).T
    doubled = x * y[following] - x[following] * y
    summed = np.bincount(polygons, weights=doubled, minlength=n_polygons)
    return np.asarray(0.5 * summed, dtype=np.float64)
