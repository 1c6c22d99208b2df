"""Slow obvious twins of the kernels of transport and trunks, and a tissue without kernels."""

import numpy as np


def dense_concentrations(walls, is_sink, forth, back, production, decay):
    """Concentrations from one dense matrix over all cells: what leaves less what arrives."""
    n_cells = len(is_sink)
    matrix = np.zeros((n_cells, n_cells))
    for (i, j), out, home in zip(walls.tolist(), forth.tolist(), back.tolist(), strict=True):
        matrix[i, i] += out
        matrix[i, j] -= home
        matrix[j, j] += home
        matrix[j, i] -= out
    matrix += np.diag(decay)
    right = production.copy()
    for cell in np.flatnonzero(is_sink):
        matrix[cell] = 0.0
        matrix[cell, cell] = 1.0
        right[cell] = 0.0
    return np.linalg.solve(matrix, right)


def inflows(walls, flux, n_cells):
    """Net inflow of every cell, and all that leaves it, wall by wall."""
    net, out = np.zeros(n_cells), np.zeros(n_cells)
    for (i, j), passed in zip(walls.tolist(), flux.tolist(), strict=True):
        net[i] -= passed
        net[j] += passed
        out[i if passed > 0 else j] += abs(passed)
    return net, out


def followed(walls, flux, start, is_end):
    """The trunk from a cell: step by step along the strongest exit of all walls."""
    cells, passed = [start], []
    while not is_end[cells[-1]]:
        best, most = -1, 0.0
        for wall, (i, j) in enumerate(walls.tolist()):
            leaving = flux[wall] if i == cells[-1] else -flux[wall] if j == cells[-1] else 0.0
            if leaving > most:
                best, most = wall, leaving
        if best < 0:
            return cells, passed, False
        i, j = walls[best].tolist()
        following = j if i == cells[-1] else i
        if following in cells:
            return cells, passed, True
        cells.append(following)
        passed.append(best)
    return cells, passed, False


def polarized(walls, n_cells, auxin, carriers, base):
    """Carriers of every wall, up the gradient, cell by cell."""
    found = np.zeros((len(walls), 2))
    for cell in range(n_cells):
        exits = [
            (wall, side, pair[1 - side])
            for wall, pair in enumerate(walls.tolist())
            for side in (0, 1)
            if pair[side] == cell
        ]
        total = sum(base ** auxin[other] for _, _, other in exits)
        for wall, side, other in exits:
            found[wall, side] = carriers * base ** auxin[other] / total
    return found


def euler(walls, lengths, volumes, rates, auxin, time_step, n_steps):
    """Auxin after explicit Euler steps up the gradient, wall by wall."""
    now = auxin.copy()
    for _ in range(n_steps):
        carriers = polarized(walls, len(now), now, rates.carriers, rates.base)
        change = (rates.production - rates.decay * now) * volumes
        for wall, (i, j) in enumerate(walls.tolist()):
            density = rates.diffusion * (now[i] - now[j]) + rates.transport * (
                carriers[wall, 0] * now[i] - carriers[wall, 1] * now[j]
            )
            change[i] -= lengths[wall] * density
            change[j] += lengths[wall] * density
        now = now + time_step * change / volumes
    return now
