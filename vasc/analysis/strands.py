"""Strands: where the auxin of a source goes, told by thresholds that are the same for all models.

A strand is read from the fluxes and carriers of one step. Nothing here asks how they came
about, so that a diffuse pattern is read as readily as a canal, and told apart from it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.analysis.strand_shapes import (
    THRESHOLDS,
    StrandThresholds,
    cell_steps,
    landings,
    path_length,
    strand_width,
)
from vasc.arrays import NULL, Floats, Ids
from vasc.domain import Tissue
from vasc.fields import Fields, Role


@dataclass(frozen=True)
class Strand:
    """Where the auxin of one source goes.

    Parameters
    ----------
    source_cell : int
        The cell of the source.
    shares : ndarray of shape (g,), float64
        Net inflow of each group of vein cells, over that of all.
    main : int
        The group that gets most, -1 without any flux; of two the first.
    path : ndarray of shape (k,), int32
        Cells along the largest flux, from the source to where it ends.
    reached : int
        The group of the cell where the path ends, -1 if that is no vein.
    is_loop : bool
        Whether the path comes back to a cell that it has passed.
    is_formed : bool
        Whether activated walls lead from the source to a group that gets enough.
    groups : tuple of int
        The groups for which that holds.
    n_landings : int
        Places where strands end on veins, whichever group these are of.
    landings : tuple of int
        The vein cell of each place that gets most.
    width : float
        Files of cells that carry the flux, in the middle of the way: 1 for a single file,
        all there are if it is diffuse; nan without a way.
    length, straight, geodesic : float
        Length of the path over centres, the straight line between its ends, and the
        shortest way over cells between them, in D.
    distances, ways : ndarray of shape (g,), float64
        From the source to the nearest cell of each group, by Euclid and over cells.
    largest_through : float
        The most that passes a cell, over all that is made.
    thresholds : StrandThresholds
        What counted as a strand.
    """

    source_cell: int
    shares: Floats
    main: int
    path: Ids
    reached: int
    is_loop: bool
    is_formed: bool
    groups: tuple[int, ...]
    n_landings: int
    landings: tuple[int, ...]
    width: float
    length: float
    straight: float
    geodesic: float
    distances: Floats
    ways: Floats
    largest_through: float
    thresholds: StrandThresholds = THRESHOLDS

    @property
    def n_strands(self) -> int:
        """Number of groups that strands lead to."""
        return len(self.groups)

    @property
    def tortuosity(self) -> float:
        """Length of the path over the straight line between its ends; nan without a path."""
        return self.length / self.straight if self.straight > 0.0 else np.nan

    @property
    def detour(self) -> float:
        """Length of the path over the shortest way over cells; nan without a path."""
        return self.length / self.geodesic if self.geodesic > 0.0 else np.nan

    @property
    def excess(self) -> float:
        """Distance of the end of the path over that of the nearest vein cell; nan without one."""
        return self.straight / float(self.distances.min()) if self.reached >= 0 else np.nan

    @property
    def is_vortex(self) -> bool:
        """Whether more circulates than is made."""
        return self.largest_through > self.thresholds.vortex

    def is_nearest(self, group: int, *, by_cells: bool = False) -> bool:
        """Tell whether a group is the nearest, or one of equally near ones."""
        apart = self.ways if by_cells else self.distances
        return group >= 0 and bool(apart[group] <= apart.min() * (1.0 + 1e-9))


def read_strand(
    tissue: Tissue,
    fields: Fields,
    source_cell: int,
    groups: Sequence[Ids],
    activation: float,
    thresholds: StrandThresholds = THRESHOLDS,
) -> Strand:
    """Read where the auxin of a source goes.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    fields : Fields
        Fluxes, carriers and roles of one step; cells of the role vein are sinks.
    source_cell : int
        The cell of the source, which is no vein.
    groups : sequence of ndarray of int32
        The cells of every vein, no cell in two of them.
    activation : float
        Carriers from which on a wall counts as part of a canal: the geometric mean of what
        walls have at rest, on average, and of the most they can have.
    thresholds : StrandThresholds, optional
        What counts as a strand.

    Returns
    -------
    Strand

    Notes
    -----
    Shares are of all auxin, so that with several sources or background production the
    group that a source feeds need not get most. The width is that of all flux in rings of
    cells around the source, and means little where other sources are near.
    """
    member = _members(tissue.n_cells, groups)
    is_vein = fields.roles == Role.VEIN
    inflow = kernels.transport.arrivals(tissue.walls, fields.flux, tissue.n_cells)
    inflow[~is_vein] = 0.0
    total = float(inflow.sum())
    shares = np.array([inflow[cells].sum() for cells in groups]) / max(total, 1e-300)

    path, _, is_loop = kernels.trunks.trunk(tissue.walls, fields.flux, source_cell, is_vein)
    end = int(path[-1])
    is_fed = _fed_by_canal(tissue, fields, source_cell, member, activation)
    fed = np.unique(member[is_fed & (member >= 0)]).tolist()
    ends = landings(tissue, np.where(is_fed, inflow, 0.0), thresholds)
    passed = kernels.transport.through(tissue.walls, fields.flux, tissue.n_cells)
    ways = tissue.hops(source_cell)
    return _measured(
        tissue,
        fields.flux,
        Strand(
            source_cell=source_cell,
            shares=shares,
            main=int(shares.argmax()) if total > 0.0 else NULL,
            path=path,
            reached=int(member[end]) if is_vein[end] else NULL,
            is_loop=is_loop,
            is_formed=any(shares[one] >= thresholds.least_share for one in fed),
            groups=tuple(one for one in fed if shares[one] >= thresholds.least_share),
            n_landings=len(ends),
            landings=ends,
            width=np.nan,
            length=np.nan,
            straight=np.nan,
            geodesic=np.nan,
            distances=np.array([_apart(tissue, source_cell, cells).min() for cells in groups]),
            ways=np.array([ways[cells].min() for cells in groups]),
            largest_through=float(passed.max()) / total if total > 0.0 else 0.0,
            thresholds=thresholds,
        ),
        ways,
    )


def _members(n_cells: int, groups: Sequence[Ids]) -> Ids:
    """Give the group of each cell, -1 for none, shape (n,)."""
    member = np.full(n_cells, NULL, dtype=np.int32)
    for number, cells in enumerate(groups):
        member[cells] = number
    return member


def _measured(tissue: Tissue, flux: Floats, strand: Strand, ways: Floats) -> Strand:
    """Add the measures of the path, if it leads to a vein."""
    if strand.reached < 0:
        return strand
    end = strand.path[-1:]
    steps = cell_steps(tissue, strand.source_cell)
    return replace(
        strand,
        width=strand_width(tissue, flux, steps, int(steps[end[0]]), strand.thresholds),
        length=path_length(tissue, strand.path),
        straight=float(_apart(tissue, strand.source_cell, end)[0]),
        geodesic=float(ways[end[0]]),
    )


def _apart(tissue: Tissue, cell: int, others: Ids) -> Floats:
    """Give the distances between the centres of a cell and others."""
    apart = tissue.positions[others] - tissue.positions[cell]
    return np.asarray(np.sqrt((apart**2).sum(axis=1)), dtype=np.float64)


def _fed_by_canal(
    tissue: Tissue, fields: Fields, source_cell: int, member: Ids, activation: float
) -> NDArray[np.bool_]:
    """Tell which vein cells activated walls connect with the source, shape (n,).

    Veins end a canal: two canals that meet a vein in one cell are two. The walls between
    the last cell of a canal and one vein count together, as the vein may lie around it.
    """
    n, walls, carriers = tissue.n_cells, tissue.walls, fields.carriers.max(axis=1)
    is_vein = fields.roles == Role.VEIN
    inner = walls[(carriers >= activation) & ~is_vein[walls].any(axis=1)]
    labels = kernels.components.component_labels(inner, n)
    is_canal = (labels == labels[source_cell]) & ~is_vein

    fed = np.zeros(n, dtype=bool)
    for here, there in ((0, 1), (1, 0)):
        last = np.flatnonzero(is_canal[walls[:, here]] & is_vein[walls[:, there]])
        veins = walls[last, there]
        # one number for a cell and a vein; cells of no vein that is asked for are vein -1
        pairs = walls[last, here].astype(np.int64) * (n + 1) + member[veins] + 1
        _, number = np.unique(pairs, return_inverse=True)
        together = np.bincount(number, weights=carriers[last])
        fed[veins[together[number] >= activation]] = True
    return fed
