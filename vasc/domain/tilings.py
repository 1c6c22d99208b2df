"""Tilings: cells that share corners, and the tissue they make."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Ids, Points
from vasc.domain.blade import Blade
from vasc.domain.rings import signed_area
from vasc.domain.tissue import Tissue


def tissue_of(
    corners: Points, cells: Sequence[Sequence[int]], blade: Blade | None = None
) -> Tissue:
    """Make a tissue of cells that are given by the corners they share.

    Parameters
    ----------
    corners : ndarray of shape (k, 2), float64
        Corners, each once.
    cells : sequence of sequence of int
        Rows of ``corners`` around each cell, counterclockwise.
    blade : Blade, optional
        The outline; that of all cells together when not given.

    Returns
    -------
    Tissue
        A wall is an edge that two cells share; centres are centroids.
    """
    sides: dict[tuple[int, int], list[int]] = {}
    for cell, ring in enumerate(cells):
        for a, b in zip(ring, [*ring[1:], ring[0]], strict=True):
            sides.setdefault((min(a, b), max(a, b)), []).append(cell)
    shared = {side: pair for side, pair in sides.items() if len(pair) == 2}
    pairs = sorted((min(pair), max(pair), *side) for side, pair in shared.items())
    table = np.array(pairs, dtype=np.int32).reshape(-1, 4)
    polygons = [corners[list(ring)] for ring in cells]
    centres = np.array([_centroid(polygon) for polygon in polygons]).reshape(-1, 2)
    return Tissue(
        positions=centres,
        volumes=np.array([abs(signed_area(polygon)) for polygon in polygons]),
        walls=np.ascontiguousarray(table[:, :2]),
        lengths=_lengths(corners, table[:, 2:]),
        distances=_lengths(centres, table[:, :2]),
        corners=np.concatenate(polygons),
        starts=np.cumsum([0, *(len(polygon) for polygon in polygons)]).astype(np.int32),
        blade=_outline(polygons) if blade is None else blade,
    )


def rectangular(columns: int, rows: int) -> Tissue:
    """Give square cells of side 1 with centres at (0, 0), (1, 0), ...; ids go row by row."""
    x, y = np.meshgrid(np.arange(columns + 1) - 0.5, np.arange(rows + 1) - 0.5)
    corners = np.stack([x.ravel(), y.ravel()], axis=1)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    around = np.array([0, 1, columns + 2, columns + 1])
    return tissue_of(corners, (first[:, None] + around).tolist())


def _centroid(polygon: Points) -> NDArray[np.float64]:
    """Give the centroid of a polygon, counted from its first corner."""
    origin = polygon[0]
    x, y = (polygon - origin).T
    crosses = x * np.roll(y, -1) - np.roll(x, -1) * y
    sums = [((one + np.roll(one, -1)) * crosses).sum() for one in (x, y)]
    centre: NDArray[np.float64] = origin + np.array(sums) / (3.0 * crosses.sum())
    return centre


def _lengths(points: Points, pairs: Ids) -> NDArray[np.float64]:
    """Give the distances between pairs of points."""
    apart = points[pairs[:, 1]] - points[pairs[:, 0]]
    return np.sqrt((apart**2).sum(axis=1))


def _outline(polygons: list[Points]) -> Blade:
    """Give the outline of all cells together, attached where the lowest cell is."""
    import shapely

    union = shapely.unary_union([shapely.Polygon(polygon) for polygon in polygons])
    parts = list(getattr(union, "geoms", [union]))
    rings = [
        np.asarray(ring.coords)[:-1] for part in parts for ring in (part.exterior, *part.interiors)
    ]
    seeds = [polygons[0].mean(axis=0)]
    return Blade.from_rings(rings, seeds)
