"""Shapes of strands: what counts as one, its width and length, and the places where it ends."""

from dataclasses import dataclass

import numpy as np

from vasc.arrays import Floats, Ids
from vasc.domain import Tissue
from vasc.fields import VORTEX


@dataclass(frozen=True)
class StrandThresholds:
    """What counts as a strand; all of them are told with every result."""

    least_share: float = 0.1
    """Share of all auxin that a group of vein cells must get from a strand."""
    landing_inflow: float = 0.02
    """A vein cell where a strand may end gets more than that, in units of what a source makes."""
    landing_gap: float = 1.6
    """Such cells are one end of a strand if they are not farther apart, in D."""
    landing_total: float = 0.08
    """An end of a strand gets at least that, in units of what a source makes."""
    middle: tuple[float, float] = (0.25, 0.75)
    """Part of the way from source to vein in which a strand is measured."""
    vortex: float = VORTEX
    """A cell that passes more than that, over all that is made, is part of a vortex."""


THRESHOLDS = StrandThresholds()


def cell_steps(tissue: Tissue, start: int) -> Ids:
    """Give the number of walls between a cell and every other, shape (n,); -1 for no way."""
    from scipy.sparse.csgraph import dijkstra

    steps = dijkstra(tissue.adjacency, indices=start, unweighted=True)
    return np.where(np.isfinite(steps), steps, -1).astype(np.int32)


def path_length(tissue: Tissue, path: Ids) -> float:
    """Give the length of a path over the centres of its cells."""
    apart = np.diff(tissue.positions[path], axis=0)
    return float(np.sqrt((apart**2).sum(axis=1)).sum())


def participation(flux: Floats) -> float:
    """Give the number of walls that share a flux: (sum |f|)^2 / sum f^2, nan without any.

    Examples
    --------
    >>> participation(np.array([0.5, -0.5, 0.0]))
    2.0
    """
    squares = float((flux**2).sum())
    return float(np.abs(flux).sum()) ** 2 / squares if squares > 0.0 else np.nan


def strand_width(
    tissue: Tissue, flux: Floats, steps: Ids, n_steps: int, thresholds: StrandThresholds
) -> float:
    """Give the number of walls that share the flux, in the middle of a way.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    flux : ndarray of shape (w,), float64
        Net flux of each wall.
    steps : ndarray of shape (n,), int32
        Walls between the source and each cell.
    n_steps : int
        Walls between the source and the end of its way.
    thresholds : StrandThresholds
        Which part of the way is the middle.

    Returns
    -------
    float
        Median, over the cuts between cells of k and k + 1 steps in the middle of the way, of
        the participation ratio of the flux through the cut; nan where nothing flows.
    """
    first, second = steps[tissue.walls].T
    nearer = np.where(first == second, -1, np.minimum(first, second))
    low, high = (part * n_steps for part in thresholds.middle)
    # the cut after k steps lies half-way between k and k + 1
    cuts = [k for k in range(n_steps) if low <= k + 0.5 <= high]
    ratios = [participation(flux[nearer == k]) for k in cuts]
    ratios = [one for one in ratios if np.isfinite(one)]
    return float(np.median(ratios)) if ratios else np.nan


def landings(tissue: Tissue, inflow: Floats, thresholds: StrandThresholds) -> tuple[int, ...]:
    """Give the places where strands end on veins, as the cell of each that gets most.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    inflow : ndarray of shape (n,), float64
        What arrives in each vein cell, 0 in all others.
    thresholds : StrandThresholds
        How much a cell and an end get at least, and how far apart two ends are.

    Returns
    -------
    tuple of int
        Cells; empty where no strand ends on a vein.
    """
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    cells = np.flatnonzero(inflow > thresholds.landing_inflow)
    if len(cells) == 0:
        return ()
    tree = cKDTree(tissue.positions[cells])
    near = tree.sparse_distance_matrix(tree, thresholds.landing_gap, output_type="coo_matrix")
    labels = connected_components(near, directed=False)[1]
    totals = np.bincount(labels, weights=inflow[cells])
    found = []
    for label in np.flatnonzero(totals >= thresholds.landing_total):
        members = cells[labels == label]
        found.append(int(members[inflow[members].argmax()]))
    return tuple(found)
