"""Up-the-gradient polarization: carriers of a cell share themselves out by its neighbors' auxin.

P_ij = P_i b^A_j / sum_k b^A_k (Smith et al., 2006; Abley et al., 2016, equation 13), and
dA_i/dt = rho - mu A_i - sum_j l_ij phi_ij / R_i, by explicit Euler steps.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Ids
from vasc.kernels.compiled import unowned


class Exits(NamedTuple):
    """The walls of each cell, as exits to its neighbors."""

    starts: Ids
    """First exit of each cell, and the number of exits, shape (n + 1,)."""
    neighbors: Ids
    """The cell behind each exit, shape (2 w,)."""
    walls: Ids
    """Its wall."""
    sides: Ids
    """0 where the cell is the first of that wall, 1 where it is the second."""


class Rates(NamedTuple):
    """What auxin and carriers do, in one unit of length and one of time."""

    production: float
    """Production rho, amount by area and time."""
    decay: float
    """Decay mu, share by time."""
    diffusion: float
    """Passive permeation D, length by time."""
    transport: float
    """Efflux by carriers T, for one carrier by length of wall."""
    carriers: float
    """Carriers of a cell P_i."""
    base: float
    """Base b: how many times the carriers a wall gets for one unit of auxin more behind it."""


def exits(walls: Ids, n_cells: int) -> Exits:
    """List the exits of every cell, by ascending wall.

    Parameters
    ----------
    walls : ndarray of shape (w, 2), int32
        The two cells of each wall.
    n_cells : int
        Number of cells.

    Returns
    -------
    Exits
        Two a wall; none where there is no wall.
    """
    cells = walls.T.ravel()
    ids = np.tile(np.arange(len(walls)), 2)
    order = np.lexsort((ids, cells))
    starts = np.concatenate([[0], np.cumsum(np.bincount(cells, minlength=n_cells))])
    sides = (order >= len(walls)).astype(np.int32)
    found = ids[order]
    return Exits(
        starts.astype(np.int32),
        walls[found, 1 - sides].astype(np.int32),
        found.astype(np.int32),
        sides,
    )


def polarize(around: Exits, rates: Rates, auxin: Floats) -> NDArray[np.float64]:
    """Give the carriers of every wall, shape (w, 2), for the auxin of every cell, shape (n,)."""
    carriers = np.zeros((len(around.walls) // 2, 2))
    _polarize(around, rates, auxin, carriers)
    return carriers


def fluxes(walls: Ids, rates: Rates, auxin: Floats, carriers: NDArray[np.float64]) -> Floats:
    """Give the flux density through every wall, from its first cell to its second, shape (w,)."""
    flux = np.empty(len(walls))
    _flow(walls, rates, auxin, carriers, flux)
    return flux


def advance(
    walls: Ids,
    lengths: Floats,
    volumes: Floats,
    around: Exits,
    rates: Rates,
    auxin: Floats,
    time_step: float,
    n_steps: int,
) -> Floats:
    """Give the auxin of every cell after some explicit Euler steps, shape (n,).

    Parameters
    ----------
    walls : ndarray of shape (w, 2), int32
        The two cells of each wall.
    lengths : ndarray of shape (w,), float64
        Lengths of the walls.
    volumes : ndarray of shape (n,), float64
        Areas of the cells.
    around : Exits
        The walls of each cell.
    rates : Rates
        What auxin and carriers do.
    auxin : ndarray of shape (n,), float64
        Auxin per area; it is left as it is.
    time_step : float
        Length of a step.
    n_steps : int
        Number of steps.
    """
    now = auxin.copy()
    carriers, flux = np.zeros((len(walls), 2)), np.empty(len(walls))
    change = np.empty(len(auxin))
    for_cells = (walls, lengths, volumes, around, rates)
    _advance(*for_cells, now, carriers, flux, change, time_step, n_steps)
    return now


@unowned
def _polarize(around: Exits, rates: Rates, auxin: Floats, carriers: NDArray[np.float64]) -> None:
    """Share out the carriers of every cell."""
    growth = np.log(rates.base)
    for cell in range(len(auxin)):
        first, last = around.starts[cell], around.starts[cell + 1]
        # only differences count: counted from the largest, no power is too large
        most = -np.inf
        for row in range(first, last):
            most = max(most, auxin[around.neighbors[row]])
        total = 0.0
        for row in range(first, last):
            weight = np.exp(growth * (auxin[around.neighbors[row]] - most))
            carriers[around.walls[row], around.sides[row]] = weight
            total += weight
        for row in range(first, last):
            carriers[around.walls[row], around.sides[row]] *= rates.carriers / total


@unowned
def _flow(
    walls: Ids, rates: Rates, auxin: Floats, carriers: NDArray[np.float64], flux: Floats
) -> None:
    """Let auxin flow through every wall."""
    for wall in range(len(walls)):
        forth = (rates.diffusion + rates.transport * carriers[wall, 0]) * auxin[walls[wall, 0]]
        back = (rates.diffusion + rates.transport * carriers[wall, 1]) * auxin[walls[wall, 1]]
        flux[wall] = forth - back


@unowned
def _advance(
    walls: Ids,
    lengths: Floats,
    volumes: Floats,
    around: Exits,
    rates: Rates,
    auxin: Floats,
    carriers: NDArray[np.float64],
    flux: Floats,
    change: Floats,
    time_step: float,
    n_steps: int,
) -> None:
    """Make explicit Euler steps in place."""
    for _ in range(n_steps):
        _polarize(around, rates, auxin, carriers)
        _flow(walls, rates, auxin, carriers, flux)
        for cell in range(len(auxin)):
            change[cell] = 0.0
        for wall in range(len(walls)):
            passed = lengths[wall] * flux[wall]
            change[walls[wall, 0]] -= passed
            change[walls[wall, 1]] += passed
        for cell in range(len(auxin)):
            made = rates.production - rates.decay * auxin[cell]
            auxin[cell] += time_step * (made + change[cell] / volumes[cell])
