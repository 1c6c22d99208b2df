"""Voronoi tissue: the ground nearest to each of some random points that repel each other."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import Points
from vasc.domain.blade import Blade
from vasc.domain.parts import check_room, sound_cells
from vasc.domain.sides import CellRings, areas_of
from vasc.domain.tilings import tissue_of_rings
from vasc.domain.tissue import Tissue
from vasc.errors import OutlineError

SHORTEST_WALL = 1e-6
"""Corners closer than that are one: the wall between them is none."""
FRAME = 10.0
"""Distance of far points, over the extent of the tissue, that make all its cells finite."""
LLOYD = 3
"""Steps that even out random cells."""


def voronoi(columns: int, rows: int, rng: np.random.Generator, *, lloyd: int = LLOYD) -> Tissue:
    """Give ``columns * rows`` random cells of mean area 1 in a box, placed as square cells are.

    Parameters
    ----------
    columns, rows : int
        Width and height of the box, whose lower left corner is (-0.5, -0.5).
    rng : numpy.random.Generator
        What points are drawn from.
    lloyd : int
        How many times points move to the centroids of their cells (Lloyd 1982).

    Returns
    -------
    Tissue
        Cells go from low to high.
    """
    low, high = np.array([-0.5, -0.5]), np.array([columns - 0.5, rows - 0.5])
    box = np.array([low, (high[0], low[1]), high, (low[0], high[1])])
    return voronoi_in(Blade.from_rings([box], low[None]), rng, lloyd=lloyd)


def voronoi_in(blade: Blade, rng: np.random.Generator, *, lloyd: int = LLOYD) -> Tissue:
    """Give random cells of mean area about 1 that fill a blade; those at the margin are cut.

    A cell that a notch of the outline cuts into pieces becomes several.

    Parameters
    ----------
    blade : Blade
        The outline.
    rng : numpy.random.Generator
        What points are drawn from.
    lloyd : int
        How many times points move to the centroids of their cells (Lloyd 1982).

    Raises
    ------
    OutlineError
        If the blade has no room for two cells, a hole lies in one cell, or the cells make no
        tissue, or several; see :func:`~vasc.domain.parts.sound_cells`.
    """
    import shapely

    n_cells = round(blade.area)
    check_room(n_cells)
    points = _random_points(blade, n_cells, rng)
    shapely.prepare(blade.polygon)
    for _ in range(lloyd):
        points = _moved(points, _cut(_polygons(points), blade.polygon), blade)
    # neighbors get ids that are not far apart
    points = points[np.lexsort((points[:, 0], np.floor(points[:, 1])))]
    pieces, _ = _cut(_polygons(points), blade.polygon)
    _check_holes(pieces)
    rings = _joined(pieces)
    kept = sound_cells(rings)
    return tissue_of_rings(kept, blade if kept.n_cells == rings.n_cells else None)


def _random_points(blade: Blade, n_points: int, rng: np.random.Generator) -> Points:
    """Draw points of a blade, evenly."""
    low_x, low_y, high_x, high_y = blade.bounds
    low, extent = np.array([low_x, low_y]), np.array([high_x - low_x, high_y - low_y])
    points = np.zeros((0, 2))
    while len(points) < n_points:
        drawn = low + extent * rng.random((2 * n_points, 2))
        points = np.concatenate([points, drawn[blade.contains(drawn)]])
    return points[:n_points]


def _polygons(points: Points) -> NDArray[Any]:
    """Give the ground nearest to each point, as far as to a frame far around all."""
    import shapely
    from scipy.spatial import Voronoi

    low, high = points.min(axis=0), points.max(axis=0)
    turns = 2.0 * np.pi * np.arange(8) / 8
    reach = FRAME * (1.0 + float((high - low).max()))
    frame = 0.5 * (low + high) + reach * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    diagram = Voronoi(np.concatenate([points, frame]))
    regions = [diagram.regions[region] for region in diagram.point_region[: len(points)]]
    cells = np.repeat(np.arange(len(points)), [len(region) for region in regions])
    rows = np.concatenate(regions)
    # cells are convex: their corners are in order of direction from within
    apart = diagram.vertices[rows] - points[cells]
    order = np.lexsort((np.arctan2(apart[:, 1], apart[:, 0]), cells))
    rings = shapely.linearrings(diagram.vertices[rows[order]], indices=cells)
    return np.asarray(shapely.polygons(rings))


def _cut(cells: NDArray[Any], outline: Any) -> tuple[NDArray[Any], NDArray[np.int64]]:
    """Cut cells at an outline; give the pieces, and which cell each is of."""
    import shapely

    is_cut = ~shapely.contains_properly(outline, cells)
    cells = cells.copy()
    cells[is_cut] = shapely.intersection(cells[is_cut], outline)
    # an intersection may hold lines where cells touch the outline
    pieces, owners = shapely.get_parts(cells, return_index=True)
    is_area = shapely.area(pieces) > SHORTEST_WALL**2
    return pieces[is_area], owners[is_area]


def _moved(points: Points, cut: tuple[NDArray[Any], NDArray[np.int64]], blade: Blade) -> Points:
    """Move points to the centroids of their cells, but not out of the blade."""
    import shapely

    pieces, owners = cut
    areas = shapely.area(pieces)
    weights = np.bincount(owners, areas, minlength=len(points))
    centroids = shapely.get_coordinates(shapely.centroid(pieces))
    sums = [np.bincount(owners, areas * axis, minlength=len(points)) for axis in centroids.T]
    means = np.stack(sums, axis=1) / np.maximum(weights, 1e-300)[:, None]
    return np.where((blade.contains(means) & (weights > 0.0))[:, None], means, points)


def _joined(pieces: NDArray[Any]) -> CellRings:
    """Give cells by the corners they share; corners that hardly differ are one."""
    import shapely
    from scipy.spatial import cKDTree

    oriented = shapely.orient_polygons(pieces)
    points, cells = shapely.get_coordinates(shapely.get_exterior_ring(oriented), return_index=True)
    pairs = cKDTree(points).query_pairs(SHORTEST_WALL, output_type="ndarray")
    groups = kernels.components.component_labels(pairs, len(points))
    _, leading = np.unique(groups, return_index=True)
    # the first corner of a ring is its last, too: what repeats the one before goes
    is_new = np.ones(len(points), dtype=np.bool_)
    is_new[1:] = (groups[1:] != groups[:-1]) | (cells[1:] != cells[:-1])
    is_last = np.append(cells[1:] != cells[:-1], True)
    is_new[is_last] = False
    rows, owners = groups[is_new], cells[is_new]
    counts = np.bincount(owners, minlength=len(pieces))
    rings = CellRings(points[leading], rows.astype(np.int64), np.cumsum([0, *counts.tolist()]))
    rings = rings.only(counts > 2)
    areas, _ = areas_of(rings)
    return rings.only(areas > SHORTEST_WALL**2)


def _check_holes(pieces: NDArray[Any]) -> None:
    """Refuse a hole of the outline that lies in one cell."""
    import shapely

    is_holed = shapely.get_num_interior_rings(pieces) > 0
    if is_holed.any():
        hole = shapely.get_interior_ring(pieces[is_holed][0], 0)
        x, y = shapely.get_coordinates(hole)[0].tolist()
        raise OutlineError(
            f"outline: the hole at ({x:.4g}, {y:.4g}) lies in a single cell; holes must be"
            " larger than a cell, 1 D wide"
        )
