"""How a tissue is drawn: colours and measures, and what shades and widths stand for."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from vasc import kernels
from vasc.analysis.moment import Moment
from vasc.arrays import Floats
from vasc.domain.tissue import Tissue
from vasc.errors import VascError
from vasc.fields import Fields, Role

BLUES = ("#f7fbff", "#deebf7", "#c6dbef", "#9ecae1", "#6baed6", "#4292c6", "#2171b5", "#08306b")
"""From no auxin to most of it."""
ROLE_COLORS = {Role.GROUND: "#f4f4ef", Role.SOURCE: "#f3b2b2", Role.VEIN: "#bfe0bf"}
ROBUST = 99.5
"""Cells up to this percentile are told apart by shade; single cells above it are all darkest."""


@dataclass(frozen=True)
class TissueStyle:
    """Colours and measures of a picture of a tissue; sizes of marks in pt, of shapes in D.

    Parameters
    ----------
    outline, arrow, bar, vein, sink, source, background : str
        Colours of cell outlines, arrows, bars of carriers, veins, rings of vein cells and
        of sources, and the paper.
    smallest_outlined, smallest_detailed : float
        Width of a cell from which on its outline is drawn, and from which on arrows and bars
        are; where cells are finer, flux is drawn as lines as wide as it is.
    least_flux : float
        Flux that is drawn at least, over the largest.
    least_carriers : float
        Carriers that are drawn at least, over the most.
    over_rest : float
        Carriers that are drawn at least, over those of a wall in the middle of the order.
    widest_arrow, thickest_bar : float
        Width of the arrow of the largest flux, and thickness of the bar of most carriers.
    head_distance : float
        Distance of arrow heads along such lines, in pt.
    """

    outline: str = "#b9bec4"
    arrow: str = "#e8590c"
    bar: str = "#101010"
    vein: str = "#8fd19e"
    sink: str = "#1b9e3e"
    source: str = "#d3122e"
    background: str = "#ffffff"
    smallest_outlined: float = 3.5
    smallest_detailed: float = 6.5
    least_flux: float = 0.04
    least_carriers: float = 0.15
    over_rest: float = 1.8
    widest_arrow: float = 0.24
    thickest_bar: float = 0.17
    head_distance: float = 26.0


@dataclass(frozen=True)
class TissueScale:
    """What the darkest shade, the widest arrow and the thickest bar stand for.

    Parameters
    ----------
    shade : float
        The quantity that cells are shaded by.
    flux : float
        Flux through a wall.
    carriers : float
        Carriers of a wall.
    """

    shade: float
    flux: float
    carriers: float


def shades_of(moment: Moment, color: str) -> Floats:
    """Give the quantity that cells are shaded by, shape (n,).

    Parameters
    ----------
    moment : Frame or State
        One step of a run on a tissue.
    color : {"concentration", "flux", "carriers", "role"}
        Auxin; what passes each cell; the carriers that take auxin out of it (the
        permeability of its most permeable wall where that has no direction); what it does
        when the step is over, canals that became vein in it included.
    """
    tissue, fields = tissue_of_moment(moment)
    if color == "flux":
        return kernels.transport.through(tissue.walls, fields.flux, tissue.n_cells)
    if color == "carriers":
        if is_polar(fields):
            return kernels.transport.cell_sums(tissue.walls, fields.carriers, tissue.n_cells)
        most = np.zeros(tissue.n_cells)
        for side in (0, 1):
            np.maximum.at(most, tissue.walls[:, side], fields.carriers[:, side])
        return most
    if color == "role":
        roles = fields.roles.astype(np.float64)
        # a canal that became vein at the end of the step has nodes, but not yet the role
        roles[tissue.nearest_cells(moment.network.positions)] = Role.VEIN
        return roles
    return fields.concentration


def scale_of(moments: Iterable[Moment], color: str = "concentration") -> TissueScale:
    """Give a scale that suits some steps, to be used for all of them."""
    shade = flux = carriers = 0.0
    for moment in moments:
        _, fields = tissue_of_moment(moment)
        is_ground = fields.roles != Role.VEIN
        seen = shades_of(moment, color)[is_ground]
        shade = max(shade, float(np.percentile(seen, ROBUST)) if len(seen) else 0.0)
        flux = max(flux, float(np.abs(fields.flux).max(initial=0.0)))
        carriers = max(carriers, float(fields.carriers.max(initial=0.0)))
    return TissueScale(shade or 1.0, flux or 1.0, carriers or 1.0)


def tissue_of_moment(moment: Moment) -> tuple[Tissue, Fields]:
    """Give the tissue and the fields of a moment.

    Raises
    ------
    VascError
        If it has none.
    """
    if moment.tissue is None or moment.fields is None:
        raise VascError("this run has no cells; it is not one on a tissue")
    return moment.tissue, moment.fields


def is_polar(fields: Fields) -> bool:
    """Tell whether walls have carriers for each direction; a permeability is the same in both."""
    return not np.array_equal(fields.carriers[:, 0], fields.carriers[:, 1])
