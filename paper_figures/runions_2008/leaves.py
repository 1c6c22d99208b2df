"""Whole leaves on panels of one figure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from panels import RED, letter

from vasc.render import draw_leaf
from vasc.render.leaf import View
from vasc.state import State

LONGEST = 7.0
"""Longer side of a figure at most, in inches."""
GAP = 0.03


def leaf_axes(
    states: Sequence[State], columns: int, *, square_rows: Sequence[int] = ()
) -> tuple[Figure, list[Axes]]:
    """Make a figure with a panel for each leaf, row by row; rows are as high as they need."""
    rows = [states[start : start + columns] for start in range(0, len(states), columns)]
    side = 1.0 / columns
    heights = [
        side * (1.0 if number in square_rows else max(map(_height_over_width, row)))
        for number, row in enumerate(rows)
    ]
    total = sum(heights) + GAP * len(rows)
    inches = LONGEST / max(1.0, total)
    figure = Figure(figsize=(inches, inches * total), facecolor="white")
    FigureCanvasAgg(figure)
    axes, bottom = [], total
    for row, height in zip(rows, heights, strict=True):
        bottom -= height + GAP
        for column in range(len(row)):
            box = (column * side, (bottom + GAP / 2) / total, side, height / total)
            axes.append(figure.add_axes(box))
    return figure, axes


def draw_leaves(states: Sequence[State], columns: int, labels: Sequence[str] = ()) -> Figure:
    """Draw leaves side by side, each as large as its panel."""
    figure, axes = leaf_axes(states, columns)
    return _filled(figure, axes, states, labels)


def draw_in_line(states: Sequence[State], labels: Sequence[str] = ()) -> Figure:
    """Draw leaves of different proportions in one line, all of them equally high."""
    widths = np.array([1.0 / _height_over_width(state) for state in states])
    n_gaps = len(states) + 1
    height = LONGEST * (1.0 - n_gaps * GAP) / max(1.0, float(widths.sum()))
    inches = float(widths.sum()) * height + n_gaps * GAP * LONGEST
    figure = Figure(figsize=(inches, height), facecolor="white")
    FigureCanvasAgg(figure)
    shares, gap = widths * height / inches, GAP * LONGEST / inches
    lefts = np.cumsum(shares + gap) - shares
    axes = [figure.add_axes((x, 0.0, w, 1.0)) for x, w in zip(lefts, shares, strict=True)]
    return _filled(figure, axes, states, labels)


def _filled(
    figure: Figure, axes: Sequence[Axes], states: Sequence[State], labels: Sequence[str]
) -> Figure:
    """Draw a leaf on every panel."""
    for state, ax in zip(states, axes, strict=True):
        draw_leaf(state, ax, scale_bar=False)
    for text, ax in zip(labels, axes, strict=False):
        letter(ax, text)
    return figure


def draw_inset(ax: Axes, state: State, centre: tuple[float, float], half: float) -> None:
    """Draw a square part of a leaf enlarged; ``centre`` and ``half`` are in blade lengths."""
    length = state.blade.length
    x, y = np.array(centre) * length
    reach = half * length
    box = (float(x - reach), float(y - reach), float(x + reach), float(y + reach))
    figure = ax.get_figure(root=True)
    if figure is None:
        raise ValueError("the axes are in no figure")
    width = ax.get_position().width * figure.get_size_inches()[0] * 72.0
    draw_leaf(state, ax, scale_bar=False, view=View(box, width / (2.0 * reach)))


def mark(ax: Axes, state: State, centre: tuple[float, float], half: float) -> None:
    """Draw a square around the part that :func:`draw_inset` enlarges."""
    (x, y), length = centre, state.blade.length
    corner = ((x - half) * length, (y - half) * length)
    side = 2.0 * half * length
    look = {"fill": False, "edgecolor": RED, "linewidth": 1.0, "zorder": 9}
    ax.add_patch(Rectangle(corner, side, side, **look))


def _height_over_width(state: State) -> float:
    """Give the proportions of a blade, with paper around it."""
    left, bottom, right, top = state.blade.bounds
    padding = 0.04 * max(right - left, top - bottom)
    return float((top - bottom + padding) / (right - left + padding))
