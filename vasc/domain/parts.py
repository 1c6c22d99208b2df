"""Parts of a tissue: cells that hang together by walls."""

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.domain.sides import FREE, CellRings, areas_of, sides_of, walls_of
from vasc.errors import OutlineError

SMALLEST_PART = 0.05
"""A part with a smaller share of all cells is taken off, as tips of an outline leave some."""


def sound_cells(rings: CellRings) -> CellRings:
    """Give the cells of one tissue: those that hang together by walls.

    Cells that meet others at the margin by a corner alone are taken off, and so are parts
    without a wall to the rest that have less than a twentieth of all cells.

    Raises
    ------
    OutlineError
        If fewer than two cells are left, or a larger part has no wall to the rest; the
        message names the place.
    """
    while rings.n_cells and len(pinched := pinched_cells(rings)):
        is_kept = np.ones(rings.n_cells, dtype=np.bool_)
        is_kept[pinched] = False
        rings = rings.only(is_kept)
    if rings.n_cells:
        parts = parts_of(rings)
        counts = np.bincount(parts)
        is_kept = counts >= SMALLEST_PART * rings.n_cells
        is_kept[counts.argmax()] = True
        if is_kept.sum() > 1:
            raise OutlineError(_apart(rings, parts, np.where(is_kept, counts, 0)))
        rings = rings.only(is_kept[parts])
    check_room(rings.n_cells)
    return rings


def check_room(n_cells: int) -> None:
    """Refuse an outline with room for less than two cells.

    Raises
    ------
    OutlineError
        If it has no room for two.
    """
    if n_cells < 2:
        raise OutlineError(
            f"outline: has room for {n_cells} cell{'' if n_cells == 1 else 's'} of width 1 D;"
            " at least 2 are needed"
        )


def pinched_cells(rings: CellRings) -> NDArray[np.int64]:
    """Give the cells to take off where the outline touches itself at a corner.

    At every such corner it is the cell with most free sides, the lower id of two.
    """
    sides = sides_of(rings)
    is_free = sides.partners == FREE
    exits = np.bincount(sides.first[is_free], minlength=len(rings.corners))
    is_pinch = exits > 1
    if not is_pinch.any():
        return np.zeros(0, dtype=np.int64)
    n_free = np.bincount(sides.cells[is_free], minlength=rings.n_cells)
    at = np.flatnonzero(is_pinch[sides.first] & (n_free[sides.cells] > 0))
    order = np.lexsort((sides.cells[at], -n_free[sides.cells[at]], sides.first[at]))
    _, leading = np.unique(sides.first[at][order], return_index=True)
    return np.unique(sides.cells[at][order][leading])


def parts_of(rings: CellRings) -> NDArray[np.int64]:
    """Give the part that each cell is of, shape (n,)."""
    walls, _ = walls_of(rings, sides_of(rings))
    return kernels.components.component_labels(walls, rings.n_cells).astype(np.int64)


def _apart(rings: CellRings, parts: NDArray[np.int64], counts: NDArray[np.int64]) -> str:
    """Describe the second largest part of cells."""
    second = int(np.argsort(-counts, kind="stable")[1])
    _, centres = areas_of(rings.only(parts == second))
    x, y = centres[0].tolist()
    return (
        f"outline: falls apart: {counts[second]} cells around ({x:.4g}, {y:.4g}) share no wall"
        " with the others; a tissue must hang together, also where it is narrowest"
    )
