"""A leaf on a pair of axes: blade, veins, sources, scale bar."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from vasc.analysis.ancestry import Descent, descent
from vasc.analysis.density import vein_length
from vasc.analysis.elongation import stretched_pipes
from vasc.analysis.moment import Moment, blade_of
from vasc.analysis.units import LengthUnit
from vasc.analysis.widths import Pipes, WidthParameters, pipes, radii
from vasc.arrays import Floats
from vasc.render.differentiation import SOURCE_SIZE, STRAND_WIDTH, draw_canals, state_key
from vasc.render.keys import draw_key, key_width, size_in_points
from vasc.render.looks import Coloring, Paint, Scale, color_segments, fit_widths, width_classes
from vasc.render.strokes import string_together
from vasc.render.styles import STRIP, LeafStyle
from vasc.render.surroundings import BAR_SHARE, Box, draw_blade, draw_scale_bar, draw_sources

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from vasc.domain import Blade
    from vasc.network import VeinNetwork

SIDE = 8.0
"""Longer side of a picture, in inches: 1600 pixels at 200 pixels per inch."""
NARROWEST = 1.2
"""Shorter side at least, in inches, so that a scale bar fits under a grass leaf."""
MAX_VECTORS = 600_000
"""Points of veins beyond which they are pixels even in an svg or pdf."""


@dataclass(frozen=True)
class View:
    """What part of the plane a picture shows, and how large.

    Parameters
    ----------
    box : tuple of float
        Left, bottom, right, top, in D; the strip for the scale bar included.
    points_per_length : float
        Scale of the drawing, pt per D.
    """

    box: Box
    points_per_length: float

    @property
    def inches(self) -> tuple[float, float]:
        """Width and height of the picture."""
        left, bottom, right, top = self.box
        scale = self.points_per_length / 72.0
        return (right - left) * scale, (top - bottom) * scale


def view_of(
    blade: Blade,
    style: LeafStyle,
    *,
    side: float = SIDE,
    with_strip: bool = True,
    narrowest: float = NARROWEST,
) -> View:
    """Give a view that holds a whole blade.

    Parameters
    ----------
    blade : Blade
        The blade, in real size.
    style : LeafStyle
        How much paper to leave around it.
    side : float
        Longer side of the picture, in inches.
    with_strip : bool
        Whether to keep a strip free under the blade, for scale bar and key.
    narrowest : float
        Width at least, in inches.

    Returns
    -------
    View
    """
    width, height = padded(blade, style)[2:]
    strip = STRIP if with_strip else 0.0
    scale = min(72.0 * side / width, (72.0 * side - strip) / height)
    return view_at(blade, style, scale, with_strip=with_strip, narrowest=narrowest)


def view_at(
    blade: Blade,
    style: LeafStyle,
    points_per_length: float,
    *,
    with_strip: bool = True,
    narrowest: float = NARROWEST,
) -> View:
    """Give a view of a whole blade at a given scale.

    Parameters
    ----------
    blade : Blade
        The blade, in real size.
    style : LeafStyle
        How much paper to leave around it.
    points_per_length : float
        Scale, pt per D.
    with_strip : bool
        Whether to keep a strip free under the blade, for scale bar and key.
    narrowest : float
        Width at least, in inches.

    Returns
    -------
    View
    """
    x, y, width, height = padded(blade, style)
    strip = (STRIP if with_strip else 0.0) / points_per_length
    half_width = max(width, 72.0 * narrowest / points_per_length) / 2.0
    half_height = max(height, 72.0 * NARROWEST / points_per_length - strip) / 2.0
    box = (x - half_width, y - half_height - strip, x + half_width, y + half_height)
    return View(box, points_per_length)


def draw_leaf(
    moment: Moment,
    ax: Axes | None = None,
    *,
    color: str = "width",
    widths: WidthParameters | None = None,
    node_widths: Floats | None = None,
    asked_widths: WidthParameters | None = None,
    sources: bool = False,
    scale_bar: bool = True,
    key: bool = True,
    units: Mapping[str, Any] | None = None,
    style: LeafStyle | None = None,
    view: View | None = None,
    last_step: int | None = None,
) -> Figure:
    """Draw a leaf: its blade, and its veins as wide as Murray's law or their elongation make them.

    Parameters
    ----------
    moment : Frame or State
        One step of a run.
    ax : matplotlib Axes, optional
        Where to draw; a figure of the right shape is made if left out.
    color : {"width", "order", "age", "source", "kind", "state"}
        What the colours of the veins tell (see
        :func:`vasc.render.looks.color_segments`).
    widths : WidthParameters, optional
        Exponent, radii and undrawn veinlets; radii left open are fitted to the picture.
    node_widths : ndarray of shape (n,), float64, optional
        Relative width of every node, as :mod:`vasc.analysis.elongation` gives it;
        Murray's law tells the widths if left out.
    asked_widths : WidthParameters, optional
        Those that the run asks for, by which vein orders are told, where ``widths`` were
        fitted to a picture; ``widths`` if left out.
    sources : bool
        Whether to draw the live sources.
    scale_bar : bool
        Whether to draw a scale bar.
    key : bool
        Whether to say what the colours mean, where that is needed.
    units : mapping, optional
        The run's ``[units]`` table, for the scale bar.
    style : LeafStyle, optional
        Colours and measures.
    view : View, optional
        What to show; the whole blade if left out.
    last_step : int, optional
        The step that the colour of the youngest veins stands for, to compare
        pictures; that of ``moment`` if left out.

    Returns
    -------
    Figure
        The figure that was made, or that ``ax`` is in.

    Raises
    ------
    VascError
        If ``color`` is none of the choices.
    """
    style = LeafStyle() if style is None else style
    has_strip = scale_bar or (key and color not in ("width", "source"))
    if ax is None:
        if view is None:
            narrowest = narrowest_of(moment, color)
            view = view_of(blade_of(moment), style, with_strip=has_strip, narrowest=narrowest)
        ax = new_axes(view, style)
    elif view is None:
        view = view_on(ax, blade_of(moment), style, has_strip)
    left, bottom, right, top = view.box
    ax.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    ax.set_axis_off()
    draw_blade(ax, blade_of(moment), style)
    painted = Paint(color, style, moment.step if last_step is None else last_step)
    if color == "state":
        painted = replace(painted, canals=moment.canals)
    widths = widths or WidthParameters()
    asked = widths if asked_widths is None else asked_widths
    coloring = _draw_veins(ax, moment, view, painted, (widths, asked), node_widths)
    if painted.canals.n_canals:
        draw_canals(ax, moment)
        style, sources = replace(style, source_size=SOURCE_SIZE), True
    if sources:
        draw_sources(ax, moment.sources, style, view.points_per_length)
    if scale_bar:
        draw_scale_bar(ax, view.box, LengthUnit.from_table(units), view.points_per_length)
    if key:
        draw_key(ax, coloring.key)
    figure = ax.get_figure(root=True)
    assert figure is not None
    return figure


def narrowest_of(moment: Moment, color: str) -> float:
    """Give the width of a picture at least, in inches, so that its key fits under the leaf."""
    if color != "state":
        return NARROWEST
    key = key_width(state_key(moment.canals)) / 72.0
    # beside it the longest scale bar of a picture of this width, or of one that is high and narrow
    return max(NARROWEST, key / (1.0 - BAR_SHARE), key + BAR_SHARE * SIDE / 2.0)


def fitted_widths(
    moment: Moment,
    widths: WidthParameters,
    style: LeafStyle,
    view: View,
    node_widths: Floats | None = None,
) -> WidthParameters:
    """Settle the radii left open for a picture, to use them in other pictures too.

    Parameters
    ----------
    moment : Frame or State
        The step that the widths are to suit, the last one as a rule.
    widths : WidthParameters
        Exponent, radii and undrawn veinlets.
    style : LeafStyle
        Limits of line widths.
    view : View
        How large the picture is.
    node_widths : ndarray of shape (n,), float64, optional
        As for :func:`draw_leaf`.

    Returns
    -------
    WidthParameters
        With a tip radius, so that it draws to scale.
    """
    return _fit(moment, _counted(moment.network, widths, node_widths), widths, style, view)


def padded(blade: Blade, style: LeafStyle) -> tuple[float, float, float, float]:
    """Give the middle (x, y), width and height of a blade with paper around it."""
    left, bottom, right, top = blade.bounds
    padding = 2.0 * style.padding * max(right - left, top - bottom)
    return (left + right) / 2, (bottom + top) / 2, right - left + padding, top - bottom + padding


def _counted(
    network: VeinNetwork,
    widths: WidthParameters,
    node_widths: Floats | None,
    directions: Descent | None = None,
) -> Pipes:
    """Count the pipes of a network, by its elongation where that is known."""
    if node_widths is None:
        return pipes(network, veinlets=widths.veinlets, directions=directions)
    return stretched_pipes(network, node_widths, widths.exponent)


def _widths_of(counted: Pipes, widths: WidthParameters) -> Floats:
    """Give the widths of segments, in D."""
    return 2.0 * radii(counted.segments, widths, float(counted.nodes.max(initial=1.0)))


def _fit(
    moment: Moment, counted: Pipes, widths: WidthParameters, style: LeafStyle, view: View
) -> WidthParameters:
    """Settle the radii left open."""
    length = vein_length(moment.network)
    spacing = float(blade_of(moment).area) / length if length > 0.0 else float("inf")
    scale = Scale(view.points_per_length, 72.0 * max(view.inches), spacing)
    return fit_widths(float(counted.nodes.max(initial=1.0)), widths, style, scale)


def new_axes(view: View, style: LeafStyle) -> Axes:
    """Make a figure filled by one pair of axes, without pyplot."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=view.inches, facecolor=style.background)
    FigureCanvasAgg(figure)
    return figure.add_axes((0.0, 0.0, 1.0, 1.0))


def view_on(ax: Axes, blade: Blade, style: LeafStyle, has_strip: bool) -> View:
    """Give the view of a whole blade that fits axes made by somebody else."""
    width, height = size_in_points(ax)
    left, bottom, right, top = view_of(blade, style, with_strip=False).box
    strip = STRIP if has_strip else 0.0
    scale = min(width / (right - left), max(height - strip, 1.0) / (top - bottom))
    return View((left, bottom - strip / scale, right, top), scale)


def _draw_veins(
    ax: Axes,
    moment: Moment,
    view: View,
    paint: Paint,
    widths: tuple[WidthParameters, WidthParameters],
    node_widths: Floats | None,
) -> Coloring:
    """Draw all segments, the finest first, as wide as the first widths; the others tell orders."""
    network = moment.network
    directions = descent(network)
    drawn, asked = widths
    counted = _counted(network, asked, node_widths, directions)
    coloring = color_segments(network, paint, directions, _widths_of(counted, asked))
    counted = _counted(network, drawn, node_widths, directions)
    fitted = _fit(moment, counted, drawn, paint.style, view)
    lines = view.points_per_length * _widths_of(counted, fitted)
    if paint.color == "state":
        is_under_way = coloring.classes > 0
        lines[is_under_way] = np.maximum(lines[is_under_way], STRAND_WIDTH)
    classes, class_widths = width_classes(lines, paint.style.n_classes)
    looks = classes * len(coloring.palette) + coloring.classes
    _add_strokes(ax, moment, directions, looks, class_widths, coloring)
    return coloring


def _add_strokes(
    ax: Axes,
    moment: Moment,
    directions: Descent,
    looks: np.ndarray,
    class_widths: np.ndarray,
    coloring: Coloring,
) -> None:
    """Add lines of every look to the axes, as a few long paths each."""
    from matplotlib.collections import PathCollection
    from matplotlib.path import Path

    strokes = string_together(moment.network.positions, directions, looks)
    paths, numbers = [], []
    for look, points, is_start in strokes.batches():
        codes = np.where(is_start, Path.MOVETO, Path.LINETO).astype(np.uint8)
        paths.append(Path(points, codes))
        numbers.append(look)
    if not paths:
        return
    n_colors = len(coloring.palette)
    ax.add_collection(
        PathCollection(
            paths,
            facecolors="none",
            edgecolors=[coloring.palette[number % n_colors] for number in numbers],
            linewidths=[class_widths[number // n_colors] for number in numbers],
            capstyle="round",
            joinstyle="round",
            rasterized=len(strokes.points) > MAX_VECTORS,
            zorder=2.0,
        ),
        autolim=False,
    )
