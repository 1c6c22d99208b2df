"""Tilings: cells that share corners, and the tissue they make."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Points
from vasc.domain.blade import Blade
from vasc.domain.parts import sound_cells
from vasc.domain.sides import CellRings, areas_of, outline_sides, rings_of, sides_of, walls_of
from vasc.domain.tissue import Tissue

SQUARE = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
"""Corners around a square, in units of half its side."""
SQUARE_UNIT = (0.5, 0.5)
HEXAGON = np.array([(0, -2), (1, -1), (1, 1), (0, 2), (-1, 1), (-1, -1)])
"""Corners around a hexagon that stands on one, in ``HEXAGON_UNIT``."""
HEXAGON_UNIT = (0.5, 0.5 / np.sqrt(3.0))
"""Half its width, 1 between parallel sides, and half its edge."""

Lattice = NDArray[np.int64]


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
        A wall is what two cells share; centres are centroids.

    Raises
    ------
    ValueError
        If more than two cells share a side, or the outline touches itself at a corner.
    OutlineError
        If no cell is above the origin, where a blade is attached.
    """
    return tissue_of_rings(rings_of(corners, [list(ring) for ring in cells]), blade)


def tissue_of_rings(rings: CellRings, blade: Blade | None = None) -> Tissue:
    """Make a tissue of cells; see :func:`tissue_of`."""
    sides = sides_of(rings)
    walls, lengths = walls_of(rings, sides)
    areas, centres = areas_of(rings)
    if blade is None:
        outlines = [sides.first[ring] for ring in outline_sides(sides)]
        blade = _blade([rings.corners[rows] for rows in outlines])
    return Tissue(
        positions=centres,
        volumes=areas,
        walls=walls,
        lengths=lengths,
        distances=np.hypot(*(centres[walls[:, 1]] - centres[walls[:, 0]]).T),
        corners=rings.corners[rings.rows],
        starts=rings.starts.astype(np.int32),
        blade=blade,
    )


def rectangular(columns: int, rows: int) -> Tissue:
    """Give square cells of side 1 with centres at (0, 0), (1, 0), ...; ids go row by row."""
    return tissue_of_rings(_tiles(_squares(range(columns), range(rows)), SQUARE, SQUARE_UNIT))


def hexagonal(columns: int, rows: int) -> Tissue:
    """Give hexagonal cells with centres 1 apart, every other row half a cell to the right.

    They stand on a corner; centres are at (0, 0), (1, 0), ...; ids go row by row.
    """
    return tissue_of_rings(_tiles(_hexagons(range(columns), range(rows)), HEXAGON, HEXAGON_UNIT))


def rectangular_in(blade: Blade) -> Tissue:
    """Give the square cells whose centres lie in a blade; one of the rows is at its attachment.

    Raises
    ------
    OutlineError
        If they make no tissue, or several; see :func:`~vasc.domain.parts.sound_cells`.
    """
    lattice = _squares(*_around(blade, SQUARE_UNIT[0] * 2.0, SQUARE_UNIT[1] * 2.0))
    return _masked(lattice, SQUARE, SQUARE_UNIT, blade)


def hexagonal_in(blade: Blade) -> Tissue:
    """Give the hexagonal cells whose centres lie in a blade; one of the rows is at its attachment.

    Raises
    ------
    OutlineError
        If they make no tissue, or several; see :func:`~vasc.domain.parts.sound_cells`.
    """
    lattice = _hexagons(*_around(blade, HEXAGON_UNIT[0] * 2.0, HEXAGON_UNIT[1] * 3.0))
    return _masked(lattice, HEXAGON, HEXAGON_UNIT, blade)


def _squares(columns: range, rows: range) -> Lattice:
    """Give the centres of squares in units of half a side, row by row, shape (n, 2)."""
    column, row = np.meshgrid(columns, rows)
    return np.stack([2 * column.ravel(), 2 * row.ravel()], axis=1)


def _hexagons(columns: range, rows: range) -> Lattice:
    """Give the centres of hexagons in ``HEXAGON_UNIT``, row by row, shape (n, 2)."""
    column, row = np.meshgrid(columns, rows)
    return np.stack([2 * column.ravel() + row.ravel() % 2, 3 * row.ravel()], axis=1)


def _around(blade: Blade, width: float, height: float) -> tuple[range, range]:
    """Give columns and rows of cells that cover a blade."""
    low_x, low_y, high_x, high_y = blade.bounds
    columns = range(int(np.floor(low_x / width)) - 1, int(np.ceil(high_x / width)) + 1)
    return columns, range(int(np.floor(low_y / height)), int(np.ceil(high_y / height)) + 1)


def _tiles(centres: Lattice, around: Lattice, unit: tuple[float, float]) -> CellRings:
    """Give equal cells around lattice points; corners are exactly those of neighbors."""
    if len(centres) == 0:
        return CellRings(np.zeros((0, 2)), np.zeros(0, dtype=np.int64), np.zeros(1, dtype=np.int64))
    places = (centres[:, None] + around).reshape(-1, 2)
    low = places.min(axis=0)
    height = int(np.ptp(places[:, 1])) + 1
    keys, rows = np.unique((places - low) @ np.array([height, 1]), return_inverse=True)
    corners = (np.stack(np.divmod(keys, height), axis=1) + low) * np.array(unit)
    return CellRings(corners, rows, np.arange(len(centres) + 1) * len(around))


def _masked(centres: Lattice, around: Lattice, unit: tuple[float, float], blade: Blade) -> Tissue:
    """Give the tissue of those cells whose centres lie in a blade."""
    is_inside = blade.contains(centres * np.array(unit))
    return tissue_of_rings(sound_cells(_tiles(centres[is_inside], around, unit)))


def _blade(rings: list[Points]) -> Blade:
    """Give the outline of cells, with its lowest point, where it needs one, as the seed."""
    points = np.concatenate(rings)
    lowest = points[np.lexsort((points[:, 0], points[:, 1]))[0]]
    return Blade.from_rings(rings, lowest[None])
