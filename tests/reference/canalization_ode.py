"""Canalization without the assumption that concentrations settle at once: the full ODE.

Concentrations and walls change at the same time: V ds/dt = speed (production - outflow), and
dP/dt = target(flux) - P, in turnover times of a wall. With speed 1 transport is no faster than
adaptation; the faster it is, the better the assumption. Solved by scipy's BDF.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.sparse import lil_matrix


def shares_of_sinks(tissue, transport, sinks, production, until, speed=1.0):
    """Integrate to a time; gives the share of all that is made that each sink cell takes."""
    walls, n_cells, n_walls = tissue.walls, tissue.n_cells, tissue.n_walls
    is_sink = np.zeros(n_cells, dtype=bool)
    is_sink[sinks] = True

    def flow(values):
        concentration, carriers = values[:n_cells], values[n_cells:].reshape(n_walls, 2)
        forth, back = transport.conductances(tissue, carriers)
        return forth * concentration[walls[:, 0]] - back * concentration[walls[:, 1]], carriers

    def change(_, values):
        flux, carriers = flow(values)
        made = production.copy()
        np.subtract.at(made, walls[:, 0], flux)
        np.add.at(made, walls[:, 1], flux)
        made[is_sink] = 0.0
        adapted = transport.targets(tissue, flux) - carriers
        return np.concatenate([speed * made / tissue.volumes, adapted.ravel()])

    start = np.concatenate([np.zeros(n_cells), transport.resting(tissue).ravel()])
    found = solve_ivp(
        change,
        (0.0, until),
        start,
        method="BDF",
        rtol=1e-6,
        atol=1e-9,
        jac_sparsity=sparsity(tissue, is_local=not transport.is_polar),
    )
    assert found.success
    flux, _ = flow(found.y[:, -1])
    inflow = np.bincount(walls[:, 1], flux, n_cells) - np.bincount(walls[:, 0], flux, n_cells)
    return inflow[sinks] / production[~is_sink].sum()


def sparsity(tissue, is_local):
    """Which values the change of each value depends on.

    Walls of one cell compete in polar transport, so that each depends on all around it.
    """
    walls, n_cells, n_walls = tissue.walls, tissue.n_cells, tissue.n_walls
    pattern = lil_matrix((n_cells + 2 * n_walls,) * 2)
    around = [np.flatnonzero((walls == cell).any(axis=1)) for cell in range(n_cells)]
    for cell in range(n_cells):
        pattern[cell, cell] = 1
    for wall, (i, j) in enumerate(walls.tolist()):
        states = [n_cells + 2 * wall, n_cells + 2 * wall + 1]
        for cell in (i, j):
            pattern[cell, [i, j, *states]] = 1
        near = [wall] if is_local else np.union1d(around[i], around[j])
        columns = [n_cells + 2 * one + side for one in near for side in (0, 1)]
        cells = np.unique(walls[near])
        for row in states:
            pattern[row, cells] = 1
            pattern[row, columns] = 1
    return pattern.tocsr()
