"""A tissue on a pair of axes: auxin in its cells, what passes their walls, veins and sources."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from vasc.analysis.moment import Moment, blade_of
from vasc.analysis.units import LengthUnit
from vasc.errors import VascError
from vasc.fields import Role
from vasc.network import Origin
from vasc.render.flows import draw_arrows, draw_carriers, draw_streams
from vasc.render.keys import draw_key, size_in_points
from vasc.render.leaf import SIDE, View, new_axes, padded, view_at, view_on
from vasc.render.looks import gradient
from vasc.render.styles import INK, STRIP, TEXT_SIZE, TISSUE_COLOR_CHOICES, Key, LeafStyle
from vasc.render.surroundings import draw_scale_bar
from vasc.render.tissue_style import (
    BLUES,
    ROLE_COLORS,
    TissueScale,
    TissueStyle,
    scale_of,
    shades_of,
    tissue_of_moment,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SMALLEST_RINGED = 5.0
"""Width of a cell from which on every cell of a vein has a ring, in pt."""
NARROWEST = 4.0
"""Width of a picture at least, in inches, so that scale bar and key fit."""
MAX_VECTOR_CELLS = 6000
"""Cells beyond which they are pixels even in an svg or pdf."""
SEAM = 0.3
"""Outline in a cell's own colour that covers the seam to the next, in pt."""
N_SHADES = 256
NAMES = {"concentration": "auxin", "flux": "flux through a cell", "carriers": "carriers"}


def draw_tissue(
    moment: Moment,
    ax: Axes | None = None,
    *,
    color: str = "concentration",
    unit: str = "",
    units: Mapping[str, Any] | None = None,
    scale: TissueScale | None = None,
    flows: bool = True,
    title: bool = True,
    scale_bar: bool = True,
    key: bool = True,
    style: TissueStyle | None = None,
    view: View | None = None,
) -> Figure:
    """Draw a tissue: auxin as shades of blue, flux as arrows, carriers as bars along walls.

    Green rings are vein cells, red ones sources; canals that have differentiated are lines.

    Parameters
    ----------
    moment : Frame or State
        One step of a run on a tissue.
    ax : matplotlib Axes, optional
        Where to draw; a figure of the right shape is made if left out.
    color : {"concentration", "flux", "carriers", "role"}
        What the shade of a cell tells (see :func:`vasc.render.tissue_style.shades_of`).
    unit : str
        Unit of that, for the key.
    units : mapping, optional
        The run's ``[units]`` table, for the scale bar.
    scale : TissueScale, optional
        What the darkest shade and the widest arrow stand for, to compare pictures; the
        most of this one if left out.
    flows : bool
        Whether to draw flux and carriers.
    title : bool
        Whether to write step and time above.
    scale_bar, key : bool
        Whether to draw a scale bar; whether to say what the shades mean.
    style : TissueStyle, optional
        Colours and measures.
    view : View, optional
        What to show; the whole tissue if left out.

    Returns
    -------
    Figure
        The figure that was made, or that ``ax`` is in.

    Raises
    ------
    VascError
        If ``color`` is none of the choices, or the run has no cells.
    """
    if color not in TISSUE_COLOR_CHOICES:
        raise VascError(f"color: {color!r} is not one of {', '.join(TISSUE_COLOR_CHOICES)}")
    style = TissueStyle() if style is None else style
    tissue, fields = tissue_of_moment(moment)
    scale = scale_of([moment], color) if scale is None else scale
    if ax is None:
        view = view_of_tissue(moment) if view is None else view
        ax = new_axes(view, LeafStyle(background=style.background))
    elif view is None:
        view = view_on(ax, blade_of(moment), LeafStyle(), scale_bar or key)
    left, bottom, right, top = view.box
    ax.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    ax.set_axis_off()
    cell = float(np.sqrt(np.median(tissue.volumes))) * view.points_per_length
    _shade(ax, moment, color, scale, style, cell)
    if flows and cell >= style.smallest_detailed:
        draw_carriers(ax, tissue, fields, scale, style)
        draw_arrows(ax, tissue, fields, scale, style)
    elif flows:
        draw_streams(ax, tissue, fields, scale, style, view.points_per_length)
    _draw_veins(ax, moment, style, cell)
    _draw_rings(ax, moment, style, cell)
    if scale_bar:
        draw_scale_bar(ax, view.box, LengthUnit.from_table(units), view.points_per_length)
    if key:
        draw_key(ax, key_of(color, scale, unit))
    if title:
        _write_title(ax, title_of(moment))
    figure = ax.get_figure(root=True)
    assert figure is not None
    return figure


def title_of(moment: Moment) -> str:
    """Give step and time in words."""
    time = f"{moment.time:.3g}" if moment.time < 1000.0 else f"{moment.time:,.0f}"
    return f"step {moment.step}, time {time}"


def view_of_tissue(moment: Moment, *, side: float = SIDE) -> View:
    """Give a view of a whole tissue, with room for a title; ``side`` is the longer, in inches."""
    blade, style = blade_of(moment), LeafStyle()
    _, _, width, height = padded(blade, style)
    above = 2.0 * TEXT_SIZE
    scale = min(72.0 * side / width, (72.0 * side - STRIP - above) / height)
    left, bottom, right, top = view_at(blade, style, scale, narrowest=min(NARROWEST, side)).box
    return View((left, bottom, right, top + above / scale), scale)


def key_of(color: str, scale: TissueScale, unit: str = "") -> Key:
    """Give the key of the shades."""
    if color == "role":
        names = tuple(role.name.lower() for role in ROLE_COLORS)
        return Key("cells", names, tuple(ROLE_COLORS.values()))
    last = f"{scale.shade:.2g} {unit}".strip()
    return Key(NAMES[color], ("0", last), BLUES, is_gradient=True)


def _shade(
    ax: Axes, moment: Moment, color: str, scale: TissueScale, style: TissueStyle, cell: float
) -> None:
    """Fill all cells, and draw their outlines where they are large enough to be seen."""
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import to_rgb

    tissue, _ = tissue_of_moment(moment)
    values = shades_of(moment, color)
    if color == "role":
        palette = np.array([to_rgb(shade) for shade in ROLE_COLORS.values()])
        classes = values.astype(np.int64)
    else:
        palette = np.array([to_rgb(shade) for shade in gradient(BLUES, N_SHADES)])
        shares = np.clip(values / scale.shade, 0.0, 1.0)
        classes = np.rint(shares * (N_SHADES - 1)).astype(np.int64)
    faces = palette[classes]
    is_outlined = cell >= style.smallest_outlined
    ax.add_collection(
        PolyCollection(
            tissue.polygons,
            facecolors=faces,
            # without an outline a hair of the cell's own colour covers the seams
            edgecolors=style.outline if is_outlined else faces,
            linewidths=min(0.04 * cell, 0.6) if is_outlined else SEAM,
            rasterized=tissue.n_cells > MAX_VECTOR_CELLS,
            zorder=1.0,
        ),
        autolim=False,
    )


def _draw_veins(ax: Axes, moment: Moment, style: TissueStyle, cell: float) -> None:
    """Draw veins as lines through the centres of their cells."""
    from matplotlib.collections import LineCollection

    network = moment.network
    if network.n_segments == 0:
        return
    ax.add_collection(
        LineCollection(
            list(network.positions[network.segments]),
            colors=style.vein,
            linewidths=min(max(0.2 * cell, 3.2), 6.0),
            capstyle="round",
            zorder=2.0,
        ),
        autolim=False,
    )


def _draw_rings(ax: Axes, moment: Moment, style: TissueStyle, cell: float) -> None:
    """Draw rings in the cells of veins that were there at first, and in those of sources."""
    tissue, fields = tissue_of_moment(moment)
    network = moment.network
    is_ringed = network.origins == Origin.SEED
    if cell < SMALLEST_RINGED:
        # rings of a line of fine cells would be one blot
        is_between = is_ringed[network.segments].all(axis=1)
        is_ringed = is_ringed.copy()
        is_ringed[network.segments[is_between]] = False
    seeds = network.positions[is_ringed]
    sources = tissue.positions[fields.roles == Role.SOURCE]
    size = max(0.74 * cell, 6.0)
    for places, color in ((seeds, style.sink), (sources, style.source)):
        ax.plot(
            *places.T,
            linestyle="none",
            marker="o",
            markersize=size,
            markerfacecolor="none",
            markeredgecolor=color,
            markeredgewidth=min(max(0.1 * cell, 1.1), 2.4),
            zorder=4.0,
        )


def _write_title(ax: Axes, text: str) -> None:
    """Write step and time over a tissue."""
    ax.text(
        0.5,
        1.0 - 0.5 * TEXT_SIZE / size_in_points(ax)[1],
        text,
        transform=ax.transAxes,
        ha="center",
        va="top",
        fontsize=TEXT_SIZE,
        color=INK,
    )
