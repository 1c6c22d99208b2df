"""Auxin transport between cells: quasi-steady concentrations, and the fluxes they drive.

All fluxes are linear in the concentrations: a wall from cell i to cell j passes
``forth * s_i - back * s_j``. With sinks at concentration 0 the balance of the other
cells is a linear system with an M-matrix, solved directly by scipy's SuperLU.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Ids


class Balance(NamedTuple):
    """The pattern of the linear system of a tissue, made once for a set of sinks."""

    walls: Ids
    """The two cells of each wall, shape (w, 2)."""
    unknown: Ids
    """Row of each cell in the system, -1 for a sink, shape (n,)."""
    indptr: Ids
    """Columns of the matrix, in compressed form."""
    indices: Ids
    """Rows of its entries, ascending in each column."""
    slots: Ids
    """Where each of the four parts of a wall is added, -1 for none, shape (4, w)."""


def balance(walls: Ids, is_sink: NDArray[np.bool_]) -> Balance:
    """Lay out the linear system of a tissue.

    Parameters
    ----------
    walls : ndarray of shape (w, 2), int32
        The two cells of each wall.
    is_sink : ndarray of shape (n,), bool
        Cells that keep the concentration 0.

    Returns
    -------
    Balance
        An empty system where all cells are sinks.
    """
    from scipy.sparse import coo_array

    unknown = np.where(is_sink, -1, np.cumsum(~is_sink) - 1).astype(np.int32)
    first, second = unknown[walls[:, 0]], unknown[walls[:, 1]]
    # what leaves a cell is on the diagonal, what arrives in its neighbor in the same column
    rows = np.stack([first, second, second, first])
    columns = np.stack([first, first, second, second])
    is_in = (rows >= 0) & (columns >= 0)
    n = int((~is_sink).sum())
    pattern = coo_array(
        (np.ones(int(is_in.sum())), (rows[is_in], columns[is_in])), shape=(n, n)
    ).tocsc()
    pattern.sum_duplicates()
    pattern.sort_indices()
    keys = np.repeat(np.arange(n), np.diff(pattern.indptr)) * n + pattern.indices
    slots = np.full(rows.shape, -1, dtype=np.int32)
    slots[is_in] = np.searchsorted(keys, columns[is_in].astype(np.int64) * n + rows[is_in])
    return Balance(walls, unknown, pattern.indptr, pattern.indices, slots)


def concentrations(
    system: Balance, forth: Floats, back: Floats, production: Floats, decay: Floats | float = 0.0
) -> Floats:
    """Solve for the concentrations at which every cell passes on what it gets and makes.

    Parameters
    ----------
    system : Balance
        The tissue and its sinks.
    forth, back : ndarray of shape (w,), float64
        What each wall passes from its first cell to its second, and back, at
        concentration 1.
    production : ndarray of shape (n,), float64
        What each cell makes.
    decay : ndarray of shape (n,), float64, or float
        What each cell destroys at concentration 1.

    Returns
    -------
    ndarray of shape (n,), float64
        Concentrations, 0 in sinks.

    Raises
    ------
    ArithmeticError
        If the system has no solution: some cells have no way to a sink.
    """
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    n = len(system.indptr) - 1
    result = np.zeros(len(system.unknown))
    if n == 0:
        return result
    parts = np.stack([forth, -forth, back, -back])
    is_in = system.slots >= 0
    data = np.bincount(system.slots[is_in], weights=parts[is_in], minlength=len(system.indices))
    is_unknown = system.unknown >= 0
    data[_diagonal(system)] += np.broadcast_to(decay, len(result))[is_unknown]
    matrix = csc_array((data, system.indices, system.indptr), shape=(n, n))
    made = production[is_unknown]
    options = {"SymmetricMode": True}
    try:
        factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    except RuntimeError as error:
        raise ArithmeticError("some cells have no way to a sink") from error
    solved = factors.solve(made)
    # once more for what rounding has left
    solved += factors.solve(made - matrix @ solved)
    result[is_unknown] = solved
    return result


def fluxes(walls: Ids, concentration: Floats, forth: Floats, back: Floats) -> Floats:
    """Give the net flux of each wall, from its first cell to its second, shape (w,)."""
    return forth * concentration[walls[:, 0]] - back * concentration[walls[:, 1]]


def arrivals(walls: Ids, flux: Floats, n_cells: int) -> Floats:
    """Give the net inflow of each cell, shape (n,)."""
    inflow = np.bincount(walls[:, 1], weights=flux, minlength=n_cells)
    outflow = np.bincount(walls[:, 0], weights=flux, minlength=n_cells)
    return np.asarray(inflow - outflow, dtype=np.float64)


def through(walls: Ids, flux: Floats, n_cells: int) -> Floats:
    """Give what passes each cell: the sum of all that leaves it for neighbors, shape (n,)."""
    leaves = np.where(flux > 0.0, walls[:, 0], walls[:, 1])
    sums = np.bincount(leaves, weights=np.abs(flux), minlength=n_cells)
    return np.asarray(sums, dtype=np.float64)


def cell_sums(walls: Ids, of_sides: NDArray[np.float64], n_cells: int) -> Floats:
    """Add up over the walls of each cell what belongs to its side of them, shape (n,).

    Parameters
    ----------
    walls : ndarray of shape (w, 2), int32
        The two cells of each wall.
    of_sides : ndarray of shape (w, 2), float64
        What belongs to the first cell of each wall, and to the second.
    n_cells : int
        Number of cells.
    """
    sums = np.zeros(n_cells)
    for side in (0, 1):
        sums += np.bincount(walls[:, side], weights=of_sides[:, side], minlength=n_cells)
    return sums


def _diagonal(system: Balance) -> Any:
    """Give where the diagonal entries are."""
    n = len(system.indptr) - 1
    columns = np.repeat(np.arange(n), np.diff(system.indptr))
    return np.flatnonzero(system.indices == columns)
