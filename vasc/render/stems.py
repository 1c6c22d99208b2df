"""A stem in three dimensions: strands as tubes, primordia as spheres on the surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING

import numpy as np

from vasc.analysis.tubes import (
    BASE_RADIUS,
    PRIMORDIUM_OUTWARD,
    PRIMORDIUM_RADIUS,
    set_outward,
    strand_radii,
)
from vasc.analysis.units import LengthUnit
from vasc.arrays import Floats, Ids, Points
from vasc.config.changes import title_with_changes
from vasc.errors import VascError
from vasc.render.keys import size_in_points
from vasc.render.saving import PICTURE_SUFFIXES, checked_output, save
from vasc.render.styles import DPI, STRIP
from vasc.render.surroundings import Box, draw_scale_bar
from vasc.render.tubes import Spheres, paint, swept
from vasc.render.unrolled import draw_unrolled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from vasc.timeline import Timeline

LINE = 80
"""Characters of the line of values below a title."""
FINEST = 1.1
"""Radius of a tube at least, in pixels."""
N_ELLIPSE = 90
"""Points around the ends of the stem."""
NARROWEST = 1.2
"""Width of a picture at least, in inches."""


@dataclass(frozen=True)
class StemStyle:
    """Colours of a stem, and where it is seen from.

    Parameters
    ----------
    vein, primordium, body, background : str
        Colours of strands, of primordia, of the stem behind them, and of the paper.
    azimuth, elevation : float
        Direction of the viewer: around the stem from the first axis on, and above
        the horizon, in degrees.
    thickest_share : float
        Radius of a strand at the base at least, over the longer side of what is seen;
        all grow with it.
    padding : float
        Free paper around the stem over its longer side.
    """

    vein: str = "#2f7a3f"
    primordium: str = "#e0a030"
    body: str = "#f1f5ea"
    background: str = "#ffffff"
    azimuth: float = 35.0
    elevation: float = 14.0
    thickest_share: float = 0.0026
    padding: float = 0.02


@dataclass(frozen=True)
class _Sight:
    """What is seen of a stem: points across, up and towards the viewer, and the outline."""

    points: Points
    spheres: Points
    body: Points
    box: Box


def draw_stem(
    positions: Points,
    segments: Ids,
    primordia: Ids,
    axes: Axes | None = None,
    *,
    radii: Floats,
    scale_bar: bool = True,
    unit: LengthUnit | None = None,
    side: float = 8.0,
    style: StemStyle | None = None,
) -> Figure:
    """Draw a stem in three dimensions, seen from afar.

    Parameters
    ----------
    positions : ndarray of shape (n, 3), float64
        Vein nodes, in D; the stem stands along the third axis, around the origin.
    segments : ndarray of shape (m, 2), integer
        Node ids.
    primordia : ndarray of shape (p,), integer
        Node ids.
    axes : matplotlib Axes, optional
        Where to draw; a new figure if left out.
    radii : ndarray of shape (n,), float64
        Radius of the stem at the height of each node, in D.
    scale_bar : bool
        Whether to draw a scale bar.
    unit : LengthUnit, optional
        Its unit; D if left out.
    side : float
        Longer side of a new figure, in inches.
    style : StemStyle, optional
        Colours and direction.

    Returns
    -------
    Figure
        That of the axes.
    """
    from matplotlib.patches import Polygon

    style = StemStyle() if style is None else style
    sight = _sight(positions, primordia, radii, style)
    axes = _new_axes(sight.box, side, style) if axes is None else axes
    figure = axes.get_figure(root=True)
    assert figure is not None
    scale = _fit(axes, sight.box, with_strip=scale_bar)
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    axes.add_patch(Polygon(sight.body, facecolor=style.body, edgecolor="none", zorder=1.0))
    spheres = _spheres(sight, positions, segments, scale * DPI / 72.0, style)
    across, up = sight.box[::2], sight.box[1::2]
    picture = paint(spheres, sight.box, scale * DPI / 72.0)
    axes.imshow(picture, extent=(*across, *up), aspect="auto", zorder=2.0)
    axes.set(xlim=(left, right), ylim=(bottom, top))
    if scale_bar:
        draw_scale_bar(axes, (left, bottom, right, top), unit or LengthUnit(), scale)
    return figure


def render_stem(
    timeline: Timeline,
    output: str | Path,
    step: int = -1,
    *,
    unroll: bool = False,
    scale_bar: bool = True,
    pixels: int = 1600,
    style: StemStyle | None = None,
) -> Path:
    """Write a picture of a recorded stem.

    Parameters
    ----------
    timeline : Timeline
        The recorded run.
    output : path
        The picture; png, svg or pdf by its suffix. An old one is replaced.
    step : int
        The step to draw; -1 is the last.
    unroll : bool
        Draw the stem split along a line and laid flat, not in three dimensions.
    scale_bar, style
        See :func:`draw_stem`; not used for a stem laid flat.
    pixels : int
        Longer side of a picture in three dimensions.

    Returns
    -------
    Path
        The file written.
    """
    from vasc.timeline.stems import elongated, recorded_stem

    output = checked_output(output, PICTURE_SUFFIXES)
    stem = elongated(recorded_stem(timeline, step), timeline.config.get("internodes") or [])
    veins = stem.positions, stem.segments, stem.primordia
    if unroll:
        return draw_unrolled(*veins, output, radius=stem.radii, title=title_of(timeline))
    unit = LengthUnit.from_table(timeline.units)
    side = pixels / DPI
    figure = draw_stem(
        *veins, radii=stem.radii, scale_bar=scale_bar, unit=unit, side=side, style=style
    )
    save(figure, output)
    return output


def only_step(steps: Sequence[int], *, color: str, sources: bool) -> int:
    """Give the step at which a stem is drawn.

    Raises
    ------
    VascError
        If several steps are asked for, or none, or what is drawn of leaves alone.
    """
    if len(steps) != 1:
        raise VascError(f"steps: a stem is drawn at one step, not at {len(steps)}")
    if color != "width":
        raise VascError(f"color: veins of a stem are drawn in one colour, not by {color!r}")
    if sources:
        raise VascError("sources: of a stem every vein node is one; its primordia are drawn")
    return steps[0]


def title_of(timeline: Timeline) -> str:
    """Give the title of a config, and below it the values that were set outside of it."""
    title = str(timeline.config.get("title") or "")
    told = title_with_changes(title, timeline.config_toml).removeprefix(title).removeprefix(", ")
    return f"{title}\n{shorten(told, LINE, placeholder=' ...')}" if told else title


def _sight(positions: Points, primordia: Ids, radii: Floats, style: StemStyle) -> _Sight:
    """Turn a stem to the viewer."""
    turn, rise = np.radians([style.azimuth, style.elevation])
    across = np.array([-np.sin(turn), np.cos(turn), 0.0])
    toward = np.array([np.cos(turn) * np.cos(rise), np.sin(turn) * np.cos(rise), np.sin(rise)])
    axes = np.stack([across, np.cross(toward, across), toward], axis=1)
    spheres = set_outward(positions[primordia], PRIMORDIUM_OUTWARD) @ axes
    body = _outline(positions[:, 2], radii, float(np.sin(rise)), float(np.cos(rise)))
    edge = PRIMORDIUM_RADIUS + 1.0
    shown = np.concatenate([body, spheres[:, :2] - edge, spheres[:, :2] + edge])
    (left, bottom), (right, top) = shown.min(axis=0), shown.max(axis=0)
    free = style.padding * max(right - left, top - bottom)
    box = (float(left - free), float(bottom - free), float(right + free), float(top + free))
    return _Sight(positions @ axes, spheres, body, box)


def _outline(heights: Floats, radii: Floats, sine: float, cosine: float) -> Points:
    """Give the outline of the stem as it is seen: its sides, and the halves of two ellipses."""
    order = np.argsort(heights, kind="stable")
    levels, sides = heights[order] * cosine, radii[order]
    if not len(levels):
        return np.zeros((1, 2))
    half = np.linspace(0.0, np.pi, N_ELLIPSE)
    arc = np.stack([np.cos(half), np.sin(half) * sine], axis=1)
    right = np.stack([sides, levels], axis=1)
    top = sides[-1] * arc + [0.0, levels[-1]]
    base = -sides[0] * arc + [0.0, levels[0]]
    return np.concatenate([right, top, right[::-1] * [-1.0, 1.0], base])


def _spheres(
    sight: _Sight, positions: Points, segments: Ids, pixels_per_length: float, style: StemStyle
) -> Spheres:
    """Give what strands and primordia are painted of."""
    from matplotlib.colors import to_rgb

    left, bottom, right, top = sight.box
    larger = max(1.0, style.thickest_share * max(right - left, top - bottom) / BASE_RADIUS)
    finest = FINEST / pixels_per_length
    thick = np.maximum(larger * strand_radii(positions[:, 2]), finest)
    spacing = 0.5 / pixels_per_length
    tubes, tube_radii = swept(sight.points, thick, segments, spacing)
    n_tubes, n_spheres = len(tubes), len(sight.spheres)
    size = max(larger * PRIMORDIUM_RADIUS, 2.0 * finest)
    return Spheres(
        np.concatenate([tubes, sight.spheres]),
        np.concatenate([tube_radii, np.full(n_spheres, size)]),
        np.repeat([to_rgb(style.vein), to_rgb(style.primordium)], [n_tubes, n_spheres], axis=0),
        _nearness(np.concatenate([tubes, sight.spheres]), style),
    )


def _nearness(points: Points, style: StemStyle) -> Floats:
    """Give 0 for the far side of the stem and 1 for the near one, at any height."""
    rise = np.radians(style.elevation)
    # the part of the way to the viewer that is level
    toward = points[:, 2] * np.cos(rise) - points[:, 1] * np.sin(rise)
    lowest, highest = float(toward.min(initial=np.inf)), float(toward.max(initial=-np.inf))
    return np.asarray((toward - lowest) / max(highest - lowest, 1e-9))


def _new_axes(box: Box, side: float, style: StemStyle) -> Axes:
    """Make a figure that shows a box, with a strip below it for the scale bar."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    left, bottom, right, top = box
    strip = STRIP / 72.0
    scale = min(side / (right - left), (side - strip) / (top - bottom))
    width = max(scale * (right - left), NARROWEST)
    height = scale * (top - bottom) + strip
    # a hair more, since matplotlib before 3.11 cuts 399.9999 pixels to 399
    figure = Figure(figsize=(width + 1e-6, height + 1e-6), facecolor=style.background)
    FigureCanvasAgg(figure)
    return figure.add_axes((0.0, 0.0, 1.0, 1.0))


def _fit(axes: Axes, box: Box, *, with_strip: bool) -> float:
    """Let axes show a box as large as possible, on their ground; gives pt per D."""
    left, bottom, right, top = box
    width, height = size_in_points(axes)
    strip = STRIP if with_strip else 0.0
    scale = min(width / (right - left), (height - strip) / (top - bottom))
    middle = 0.5 * (left + right)
    axes.set_xlim(middle - 0.5 * width / scale, middle + 0.5 * width / scale)
    axes.set_ylim(bottom - strip / scale, bottom + (height - strip) / scale)
    axes.set_axis_off()
    return scale
