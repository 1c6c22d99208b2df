"""What passes the walls of a tissue, and the carriers that let it pass."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vasc.domain.tissue import Tissue
from vasc.fields import Fields
from vasc.render.cells import Shapes, arrows, bars, leaves_from, wall_ends
from vasc.render.tissue_style import TissueScale, TissueStyle, is_polar

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FINEST_LINE, WIDEST_LINE = 0.5, 1.6
"""Widths of lines of flux where cells are too fine for arrows, in pt."""
HEAD = 2.6
"""Half the length of an arrow head on such a line, in pt."""


def draw_carriers(
    ax: Axes, tissue: Tissue, fields: Fields, scale: TissueScale, style: TissueStyle
) -> None:
    """Draw carriers: bars on the side of the cell that they take auxin out of.

    A permeability, which is the same in both directions, is drawn as a bar on either side:
    the wall itself is then thicker.

    Parameters
    ----------
    ax : matplotlib Axes
        Where to draw.
    tissue, fields
        The cells, and what is in them.
    scale : TissueScale
        What the thickest bar stands for.
    style : TissueStyle
        Colours and measures.
    """
    shares = fields.carriers / scale.carriers
    gap = 0.03 if is_polar(fields) else 0.0
    # square roots, so that walls with a tenth of the carriers can be seen
    thickness = style.thickest_bar * np.sqrt(np.minimum(shares, 1.0)) * (1.0 if gap else 0.6)
    # most walls are at rest, and are not drawn
    at_rest = float(np.median(shares)) if len(shares) else 0.0
    least = max(style.least_carriers, style.over_rest * at_rest)
    ends = wall_ends(tissue)
    for side in (0, 1):
        is_shown = shares[:, side] >= least
        centres = tissue.positions[tissue.walls[is_shown, side]]
        shapes = bars(ends[is_shown], centres, thickness[is_shown, side], gap)
        _add(ax, shapes, style.bar, 2.4)


def draw_arrows(
    ax: Axes, tissue: Tissue, fields: Fields, scale: TissueScale, style: TissueStyle
) -> None:
    """Draw arrows across walls, as wide as the flux through them.

    Parameters
    ----------
    ax, tissue, fields, scale, style
        As for :func:`draw_carriers`.
    """
    shares = np.abs(fields.flux) / scale.flux
    is_shown = shares >= style.least_flux
    starts, stops = (
        tissue.positions[cells]
        for cells in leaves_from(tissue.walls[is_shown], fields.flux[is_shown])
    )
    shapes = arrows(starts, stops, style.widest_arrow * np.minimum(shares[is_shown], 1.0))
    _add(ax, shapes, style.arrow, 2.6)


def draw_streams(
    ax: Axes,
    tissue: Tissue,
    fields: Fields,
    scale: TissueScale,
    style: TissueStyle,
    points_per_length: float,
) -> None:
    """Draw flux as lines as wide as it is, with some arrow heads, where cells are too fine.

    Parameters
    ----------
    ax, tissue, fields, scale, style
        As for :func:`draw_carriers`.
    points_per_length : float
        Scale of the drawing, pt per D.
    """
    from matplotlib.collections import LineCollection

    shares = np.abs(fields.flux) / scale.flux
    shown = np.flatnonzero(shares >= 1.5 * style.least_flux)
    shown = shown[np.argsort(shares[shown], kind="stable")]
    starts, stops = (
        tissue.positions[cells] for cells in leaves_from(tissue.walls[shown], fields.flux[shown])
    )
    widths = np.maximum(WIDEST_LINE * np.sqrt(np.minimum(shares[shown], 1.0)), FINEST_LINE)
    lines = np.stack([starts, stops], axis=1)
    ax.add_collection(
        LineCollection(
            list(lines), colors=style.arrow, linewidths=widths, capstyle="round", zorder=2.5
        ),
        autolim=False,
    )
    heads = _spread(starts, shares[shown], style.head_distance / points_per_length)
    size = HEAD / points_per_length
    along = stops[heads] - starts[heads]
    along *= size / np.maximum(np.sqrt((along**2).sum(axis=1)), 1e-300)[:, None]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    middle = (starts[heads] + stops[heads]) / 2.0
    grown = 0.7 + 0.6 * np.sqrt(shares[shown[heads]])[:, None]
    corners = [middle + grown * each for each in (1.4 * along, across - along, -across - along)]
    _add(ax, np.stack(corners, axis=1), style.arrow, 2.6)


def _spread(places: NDArray, weights: NDArray, distance: float) -> NDArray[np.int64]:
    """Choose places of the largest weight, no two of them nearer to each other than a distance."""
    chosen: list[int] = []
    for row in np.argsort(-weights, kind="stable").tolist():
        apart = places[chosen] - places[row]
        if ((apart**2).sum(axis=1) >= distance**2).all():
            chosen.append(row)
    return np.array(chosen, dtype=np.int64)


def _add(ax: Axes, shapes: Shapes, color: str, zorder: float) -> None:
    """Add filled polygons of one colour."""
    from matplotlib.collections import PolyCollection

    if len(shapes):
        ax.add_collection(
            PolyCollection(list(shapes), facecolors=color, linewidths=0.0, zorder=zorder),
            autolim=False,
        )
