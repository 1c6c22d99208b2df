"""What is drawn around the veins: blade, sources and scale bar."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from vasc.analysis.units import LengthUnit
from vasc.arrays import Points
from vasc.render.styles import CORNER, INK, SOURCE_STATE_COLORS, TEXT_SIZE, LeafStyle
from vasc.sources import SourceSet
from vasc.states import SourceState

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from vasc.domain import Blade

SMALLEST_DOT = 0.8
"""Diameter of a source at least, in pt."""
BAR_SHARE = 0.25
"""How much of a picture's width, or of half its height, a scale bar takes at most."""
Box = tuple[float, float, float, float]
"""Left, bottom, right, top, in lengths."""


def draw_blade(axes: Axes, blade: Blade, style: LeafStyle) -> None:
    """Draw a blade as a filled outline; holes stay empty.

    Parameters
    ----------
    axes : matplotlib Axes
        Where to draw.
    blade : Blade
        The blade, in real size.
    style : LeafStyle
        Colours and the width of the outline.
    """
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    rings = [np.vstack([ring, ring[:1]]) for ring in _turned(blade.rings)]
    codes = [
        np.r_[Path.MOVETO, np.full(len(ring) - 2, Path.LINETO), Path.CLOSEPOLY] for ring in rings
    ]
    outline = Path(np.concatenate(rings), np.concatenate(codes).astype(np.uint8))
    axes.add_patch(
        PathPatch(
            outline,
            facecolor=style.blade,
            edgecolor=style.margin,
            linewidth=style.margin_width,
            joinstyle="round",
            zorder=1.0,
        )
    )


def draw_sources(
    axes: Axes, sources: SourceSet, style: LeafStyle, points_per_length: float
) -> None:
    """Draw live sources as dots: one colour for active, another for tagged ones.

    Parameters
    ----------
    axes : matplotlib Axes
        Where to draw.
    sources : SourceSet
        The live sources; it may be empty.
    style : LeafStyle
        The size of the dots; they are smaller where sources are dense.
    points_per_length : float
        Scale of the drawing, pt per D.
    """
    size = min(style.source_size, 0.5 * _typical_distance(sources.positions) * points_per_length)
    for state in (SourceState.ACTIVE, SourceState.TAGGED):
        places = sources.positions[sources.states == state]
        axes.plot(
            *places.T,
            linestyle="none",
            marker="o",
            markersize=max(size, SMALLEST_DOT),
            markerfacecolor=SOURCE_STATE_COLORS[state.name.lower()],
            markeredgewidth=0.0,
            zorder=4.0,
        )


def bar_length(extent: float) -> float:
    """Give a round length, 1, 2 or 5 times a power of ten, of a tenth to a quarter of ``extent``.

    Examples
    --------
    >>> bar_length(430.0), bar_length(0.9), bar_length(3500.0)
    (100.0, 0.2, 500.0)
    """
    longest = BAR_SHARE * extent
    power = 10.0 ** math.floor(math.log10(longest))
    for factor in (5, 2):
        if factor * power <= longest:
            return factor * power
    return power


def draw_scale_bar(axes: Axes, box: Box, unit: LengthUnit, points_per_length: float) -> None:
    """Draw a scale bar in the lower left corner.

    Parameters
    ----------
    axes : matplotlib Axes
        Where to draw.
    box : tuple of float
        What the axes show.
    unit : LengthUnit
        The unit the bar is labelled in.
    points_per_length : float
        Scale of the drawing, pt per D.
    """
    left, bottom, right, top = box
    length = bar_length(max(right - left, (top - bottom) / 2.0) * unit.per_segment)
    shown = length / unit.per_segment
    x, y = left + CORNER / points_per_length, bottom + CORNER / points_per_length
    axes.plot([x, x + shown], [y, y], color=INK, linewidth=1.5, solid_capstyle="butt", zorder=5.0)
    axes.text(
        x + shown / 2.0,
        y + 3.0 / points_per_length,
        unit.label(length),
        ha="center",
        va="bottom",
        fontsize=TEXT_SIZE,
        color=INK,
        zorder=5.0,
    )


def _typical_distance(places: Points) -> float:
    """Give the median distance to the nearest other place, infinite for fewer than two."""
    if len(places) < 2:
        return math.inf
    from scipy.spatial import cKDTree

    return float(np.median(cKDTree(places).query(places, k=2)[0][:, 1]))


def _turned(rings: tuple[Points, ...]) -> list[Points]:
    """Give rings with holes turned against what they lie in, as filling needs it."""
    from matplotlib.path import Path

    turned = []
    for place, ring in enumerate(rings):
        others = (other for row, other in enumerate(rings) if row != place)
        depth = sum(bool(Path(other).contains_point(ring[0])) for other in others)
        x, y = ring.T
        is_left = float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) > 0.0
        turned.append(ring if is_left == (depth % 2 == 0) else ring[::-1])
    return turned
