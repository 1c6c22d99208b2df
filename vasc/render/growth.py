"""How a leaf grows: its material grid at several steps, and maps of growth between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.units import LengthUnit
from vasc.arrays import Floats
from vasc.errors import VascError
from vasc.render.styles import INK, STRIP, TEXT_SIZE, LeafStyle
from vasc.render.surroundings import draw_blade, draw_scale_bar

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from vasc.domain import Blade

WIDTH = 10.0
"""Of the picture; all measures of the layout are in inches."""
LEFT, RIGHT = 0.45, 1.0
TALLEST, MAP_HEIGHT = 4.0, 2.4
TITLE, GAP = 0.3, 0.12
LINES = 16
"""Rows of the grid that are drawn; the columns are as dense at a leaf twice as long as wide."""
AREAL_COLORS, SHRINKING_COLORS, ANISOTROPY_COLORS = "viridis", "RdBu_r", "magma_r"
LEAST_RATIO = 1.03
"""Anisotropy from which a direction is drawn."""


@dataclass(frozen=True)
class GrownGrid:
    """A grid of material points at one step.

    Parameters
    ----------
    step : int
        The step.
    blade : Blade
        The blade at this step, in D.
    points : ndarray of shape (rows, columns, 2), float64
        Positions of the material points, in D.
    """

    step: int
    blade: Blade
    points: NDArray[np.float64]


@dataclass(frozen=True)
class GrowthMap:
    """Growth from a step to a later one, shown on the blade of the later one.

    Parameters
    ----------
    start : int
        The earlier step.
    grid : GrownGrid
        Step, blade and positions at the later one.
    areal : ndarray of shape (rows, columns), float64
        Relative growth rate of area, in 1/step.
    anisotropy : ndarray of shape (rows, columns), float64
        Greatest over least stretch.
    directions : ndarray of shape (rows, columns, 2), float64
        Unit vectors of the greatest stretch.
    """

    start: int
    grid: GrownGrid
    areal: Floats
    anisotropy: Floats
    directions: NDArray[np.float64]


@dataclass(frozen=True)
class _Place:
    """A rectangle of the picture, in inches from its lower left corner."""

    left: float
    bottom: float
    width: float
    height: float


def draw_growth(
    grids: Sequence[GrownGrid],
    maps: Sequence[GrowthMap],
    *,
    units: Mapping[str, Any] | None = None,
    style: LeafStyle | None = None,
) -> Figure:
    """Draw grids side by side at one scale, and under them growth between each and the next.

    Parameters
    ----------
    grids : sequence of GrownGrid
        At least one, in the order of their steps.
    maps : sequence of GrowthMap
        Growth from each grid to the next; all have one colour scale, and each leaf is
        drawn as large as there is room.
    units : mapping, optional
        The ``[units]`` table of the run's config, for the scale bars.
    style : LeafStyle, optional
        Colours.

    Returns
    -------
    Figure

    Raises
    ------
    VascError
        If there is no grid.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    if not grids:
        raise VascError("steps: expected at least one step, got none")
    style = LeafStyle() if style is None else style
    unit = LengthUnit.from_table(units)
    scale, top = _common_scale(grids)
    rows = [top, *([MAP_HEIGHT + TITLE] * (2 if maps else 0))]
    height = sum(rows) + GAP * (len(rows) + 1)
    figure = Figure(figsize=(WIDTH, height), facecolor=style.background)
    FigureCanvasAgg(figure)
    floor = height
    for row, room in enumerate(rows):
        floor -= room + GAP
        place = _Place(LEFT, floor, WIDTH - LEFT - (RIGHT if maps else 0.1), room)
        if row == 0:
            _draw_grids(figure, place, grids, scale, unit, style)
        else:
            _draw_maps(figure, place, maps, unit, style, is_areal=row == 1)
    return figure


def _common_scale(grids: Sequence[GrownGrid]) -> tuple[float, float]:
    """Give the scale at which all leaves fit side by side, in pt per D, and the row's height."""
    room = WIDTH - LEFT - RIGHT - GAP * len(grids)
    widths = np.array([grid.blade.width for grid in grids])
    tallest = max(_height(grid.blade) for grid in grids)
    # narrow leaves still need room for the number of their step
    scale = min(72.0 * room / float(widths.sum()), 72.0 * TALLEST / tallest)
    for _ in range(8):
        is_narrow = widths * scale < 72.0 * _narrowest(grids)
        rest = room - float(is_narrow.sum()) * _narrowest(grids)
        if not is_narrow.all():
            scale = min(72.0 * rest / float(widths[~is_narrow].sum()), 72.0 * TALLEST / tallest)
    return scale, tallest * scale / 72.0 + TITLE + STRIP / 72.0


def _narrowest(grids: Sequence[GrownGrid]) -> float:
    """Give the least width of a leaf's place in a row."""
    return min(0.75, 0.8 * (WIDTH - LEFT - RIGHT) / len(grids))


def _height(blade: Blade) -> float:
    """Give the extent along the axis."""
    return blade.bounds[3] - blade.bounds[1]


def _draw_grids(
    figure: Figure,
    place: _Place,
    grids: Sequence[GrownGrid],
    scale: float,
    unit: LengthUnit,
    style: LeafStyle,
) -> None:
    """Draw the row of grids, standing on one line."""
    widths = [max(grid.blade.width * scale / 72.0, _narrowest(grids)) for grid in grids]
    gap = (place.width - sum(widths)) / len(grids)
    ground = min(grid.blade.bounds[1] for grid in grids)
    left = place.left
    for grid, width in zip(grids, widths, strict=True):
        room = _Place(left, place.bottom, width + gap, place.height)
        axes = _axes(figure, room, grid.blade, scale, ground)
        draw_blade(axes, grid.blade, style)
        _draw_lines(axes, grid, scale, style)
        _write_title(axes, f"step {grid.step}", grid.blade.bounds[3])
        left += width + gap
    _draw_bar(figure.axes[0], unit, scale)
    _write_row(figure, place, "material grid")


def _draw_maps(
    figure: Figure,
    place: _Place,
    maps: Sequence[GrowthMap],
    unit: LengthUnit,
    style: LeafStyle,
    *,
    is_areal: bool,
) -> None:
    """Draw a row of maps, each as large as its place lets it be."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    values = [100.0 * each.areal if is_areal else each.anisotropy for each in maps]
    low, high, colors = _range(values, is_areal=is_areal)
    norm = Normalize(low, high)
    width = place.width / len(maps)
    for number, (each, value) in enumerate(zip(maps, values, strict=True)):
        room = _Place(place.left + number * width, place.bottom, width, place.height)
        blade = each.grid.blade
        scale = min(
            72.0 * (width - GAP) / blade.width,
            (72.0 * (place.height - TITLE) - STRIP) / _height(blade),
        )
        axes = _axes(figure, room, blade, scale, blade.bounds[1])
        draw_blade(axes, blade, style)
        mesh = axes.pcolormesh(
            *np.moveaxis(each.grid.points, 2, 0),
            value,
            norm=norm,
            cmap=colors,
            shading="gouraud",
            rasterized=True,
            zorder=2.0,
        )
        mesh.set_clip_path(axes.patches[0])
        if not is_areal:
            _draw_directions(axes, each)
        _write_title(axes, f"steps {each.start} to {each.grid.step}", blade.bounds[3])
        _draw_bar(axes, unit, scale)
    _write_row(figure, place, "growth of area" if is_areal else "anisotropy")
    label = "growth of area (% per step)" if is_areal else "greatest / least stretch"
    _draw_colors(figure, place, ScalarMappable(norm, colors), label)


def _range(values: Sequence[Floats], *, is_areal: bool) -> tuple[float, float, str]:
    """Give the ends of a colour scale, and its colours."""
    found = np.concatenate([value.ravel() for value in values])
    low, high = np.quantile(found, [0.005, 0.995]).tolist()
    if not is_areal:
        return 1.0, max(high, 1.05), ANISOTROPY_COLORS
    # below a thousandth of a percent a step it is rounding that shrinks
    if low < -1e-3:
        reach = max(-low, high)
        return -reach, reach, SHRINKING_COLORS
    return 0.0, max(high, 0.01), AREAL_COLORS


def _axes(figure: Figure, place: _Place, blade: Blade, scale: float, ground: float) -> Axes:
    """Make axes in which a leaf stands at a scale, over a strip for the scale bar."""
    width, height = (float(side) for side in figure.get_size_inches())
    axes = figure.add_axes(
        (place.left / width, place.bottom / height, place.width / width, place.height / height)
    )
    axes.set_axis_off()
    middle = 0.5 * (blade.bounds[0] + blade.bounds[2])
    half = 36.0 * place.width / scale
    bottom = ground - STRIP / scale
    axes.set_xlim(middle - half, middle + half)
    axes.set_ylim(bottom, bottom + 72.0 * place.height / scale)
    return axes


def _draw_lines(axes: Axes, grid: GrownGrid, scale: float, style: LeafStyle) -> None:
    """Draw rows and columns of a grid, as far as the blade reaches."""
    from matplotlib.collections import LineCollection

    n_rows, n_columns = grid.points.shape[:2]
    rows = np.linspace(0, n_rows - 1, LINES + 1).round().astype(np.int64)
    columns = np.linspace(0, n_columns - 1, LINES // 2 + 1).round().astype(np.int64)
    lines = [*grid.points[rows], *grid.points[:, columns].swapaxes(0, 1)]
    # a seventh of the distance of rows at most: a small leaf must not drown in ink
    width = min(0.45, _height(grid.blade) * scale / LINES / 7.0)
    drawn = LineCollection(lines, colors=style.vein, linewidths=width, zorder=2.0)
    axes.add_collection(drawn, autolim=False)
    drawn.set_clip_path(axes.patches[0])


def _draw_directions(axes: Axes, each: GrowthMap) -> None:
    """Draw short lines in the direction of the greatest stretch."""
    from matplotlib.collections import LineCollection

    n_rows, n_columns = each.anisotropy.shape
    rows = np.linspace(0, n_rows - 1, LINES + 1)[1:-1].round().astype(np.int64)
    columns = np.linspace(0, n_columns - 1, LINES // 2 + 1)[1:-1].round().astype(np.int64)
    some = np.ix_(rows, columns)
    is_drawn = each.anisotropy[some] > LEAST_RATIO
    reach = 0.35 * _height(each.grid.blade) / LINES * each.directions[some][is_drawn]
    middles = each.grid.points[some][is_drawn]
    lines = np.stack([middles - reach, middles + reach], axis=1)
    # light over dark and dark over light colours: a line with a pale rim
    for color, width in (("#ffffff", 1.3), (INK, 0.6)):
        drawn = LineCollection(list(lines), colors=color, linewidths=width, zorder=3.0)
        axes.add_collection(drawn, autolim=False)


def _draw_colors(figure: Figure, place: _Place, colors: Any, label: str) -> None:
    """Draw a colour bar at the right end of a row."""
    width, height = (float(side) for side in figure.get_size_inches())
    left, bottom = place.left + place.width + GAP, place.bottom + 0.35
    axes = figure.add_axes(
        (left / width, bottom / height, 0.14 / width, (place.height - TITLE - 0.45) / height)
    )
    bar = figure.colorbar(colors, cax=axes)
    bar.set_label(label, fontsize=TEXT_SIZE, color=INK)
    bar.ax.tick_params(labelsize=TEXT_SIZE, colors=INK, width=0.5)
    bar.outline.set_linewidth(0.5)


def _draw_bar(axes: Axes, unit: LengthUnit, scale: float) -> None:
    """Draw a scale bar in the lower left corner of axes."""
    box = (*axes.get_xlim(), *axes.get_ylim())
    draw_scale_bar(axes, (box[0], box[2], box[1], box[3]), unit, scale)


def _write_title(axes: Axes, text: str, top: float) -> None:
    """Write over a leaf."""
    middle = 0.5 * sum(axes.get_xlim())
    where: Any = {"textcoords": "offset points", "ha": "center", "va": "bottom"}
    axes.annotate(text, (middle, top), (0.0, 5.0), fontsize=TEXT_SIZE, color=INK, **where)


def _write_row(figure: Figure, place: _Place, text: str) -> None:
    """Write what a row shows at its left end."""
    width, height = (float(side) for side in figure.get_size_inches())
    x, y = 0.5 * LEFT / width, (place.bottom + 0.5 * place.height) / height
    where: Any = {"rotation": 90, "ha": "center", "va": "center"}
    figure.text(x, y, text, fontsize=TEXT_SIZE + 1.0, color=INK, **where)
