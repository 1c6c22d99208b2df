"""Shapes that show what passes between cells: ends of walls, arrows across, bars along them."""

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Ids, Points
from vasc.domain.sides import FREE
from vasc.domain.tissue import Tissue

Shapes = NDArray[np.float64]
"""Polygons of equally many corners, shape (k, c, 2)."""


def wall_ends(tissue: Tissue) -> Shapes:
    """Give the two ends of every wall, as the corners of its cells tell them.

    Parameters
    ----------
    tissue : Tissue
        The cells.

    Returns
    -------
    ndarray of shape (w, 2, 2), float64
        In the order of the first cell's corners, which are counterclockwise; a wall whose
        side is not found among the corners lies across the middle between the centres.
    """
    sides, ends = tissue.sides, _across(tissue)
    shared = np.flatnonzero(sides.partners != FREE)
    owners, others = sides.cells[shared], sides.cells[sides.partners[shared]]
    asked = tissue.walls[:, 0].astype(np.int64) * tissue.n_cells + tissue.walls[:, 1]
    # of a wall of several sides the first is taken
    _, found, rows = np.intersect1d(asked, owners * tissue.n_cells + others, return_indices=True)
    chosen = shared[rows]
    # the same side begins, seen from the other cell, where it ends here
    ends[found] = np.stack([tissue.corners[chosen], tissue.corners[sides.partners[chosen]]], axis=1)
    return ends


def arrows(starts: Points, stops: Points, widths: Floats, length: float = 0.62) -> Shapes:
    """Give arrows on the middle part of the ways from one point each to another.

    Parameters
    ----------
    starts, stops : ndarray of shape (k, 2), float64
        Centres of the cells that auxin leaves, and that it enters.
    widths : ndarray of shape (k,), float64
        Widths of the shafts, in D.
    length : float
        Length of an arrow over the way.

    Returns
    -------
    ndarray of shape (k, 7, 2), float64
    """
    along = stops - starts
    ways = np.sqrt((along**2).sum(axis=1))
    along = along / np.maximum(ways, 1e-300)[:, None]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    shaft = widths / 2.0
    head = shaft + 0.07 * ways + 0.35 * widths
    heads = np.minimum(1.6 * head, 0.45 * length * ways)
    tip = length * ways / 2.0
    neck = tip - heads
    places = [(-tip, -shaft), (neck, -shaft), (neck, -head), (tip, 0.0 * tip)]
    places += [(neck, head), (neck, shaft), (-tip, shaft)]
    middle = (starts + stops) / 2.0
    return np.stack([middle + u[:, None] * along + v[:, None] * across for u, v in places], axis=1)


def bars(ends: Shapes, centres: Points, thicknesses: Floats, gap: float = 0.03) -> Shapes:
    """Give bars along walls, on the side of one cell each.

    Parameters
    ----------
    ends : ndarray of shape (k, 2, 2), float64
        Ends of the walls.
    centres : ndarray of shape (k, 2), float64
        Centres of the cells in which the bars lie.
    thicknesses : ndarray of shape (k,), float64
        Thicknesses, in D.
    gap : float
        Distance between wall and bar, in D.

    Returns
    -------
    ndarray of shape (k, 4, 2), float64
    """
    middle = ends.mean(axis=1)
    half = 0.8 * (ends[:, 1] - ends[:, 0]) / 2.0
    inward = np.stack([-half[:, 1], half[:, 0]], axis=1)
    inward /= np.maximum(np.sqrt((inward**2).sum(axis=1)), 1e-300)[:, None]
    is_out = (inward * (centres - middle)).sum(axis=1) < 0.0
    inward[is_out] *= -1.0
    near = middle + gap * inward
    far = near + thicknesses[:, None] * inward
    # the inner side is shorter, so that bars of two sides do not meet in a corner
    inner = half * np.maximum(1.0 - thicknesses, 0.4)[:, None]
    return np.stack([near - half, near + half, far + inner, far - inner], axis=1)


def leaves_from(walls: Ids, flux: Floats) -> tuple[Ids, Ids]:
    """Give for each wall the cell that auxin leaves, and the one it enters."""
    is_forth = flux >= 0.0
    return (
        np.where(is_forth, walls[:, 0], walls[:, 1]),
        np.where(is_forth, walls[:, 1], walls[:, 0]),
    )


def _across(tissue: Tissue) -> Shapes:
    """Give lines of the length of each wall across the middle of the way between centres."""
    first, second = (tissue.positions[tissue.walls[:, side]] for side in (0, 1))
    along = (second - first) / np.maximum(tissue.distances, 1e-300)[:, None]
    half = np.stack([-along[:, 1], along[:, 0]], axis=1) * tissue.lengths[:, None] / 2.0
    middle = (first + second) / 2.0
    return np.stack([middle - half, middle + half], axis=1)
