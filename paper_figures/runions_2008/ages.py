"""A leaf at several ages, drawn to one scale, with veins as wide as their elongation makes them."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from panels import INK

from vasc.analysis import WidthParameters
from vasc.analysis.elongation import Elongation
from vasc.arrays import Floats
from vasc.config import load
from vasc.config.overrides import Override
from vasc.growth import KeyframedGrowth
from vasc.render import draw_leaf
from vasc.render.leaf import View
from vasc.simulation import simulate
from vasc.state import State
from vasc.streams import Streams

LONGEST = 6.9
"""Longer side of a figure at most, in inches."""
PAPER = 0.16
"""Free paper around a leaf, in inches."""
WIDTHS = WidthParameters(tip_radius=0.1)


@dataclass(frozen=True)
class Aged:
    """A leaf at one age: its state, and the width of every node then."""

    state: State
    widths: Floats


def aged(name: str, steps: Sequence[int] = (), overrides: Sequence[Override] = ()) -> list[Aged]:
    """Grow a bundled leaf and keep it at some steps, or at its end; prints how long it took."""
    experiment = load(name, overrides)
    parameters = experiment.parameters
    start, elongation, found = time.perf_counter(), Elongation(), []
    for state in simulate(parameters.model(experiment.folder), Streams(parameters.seed)):
        elongation.update(state)
        if state.step in steps:
            found.append(Aged(state, elongation.widths))
        if steps and state.step >= max(steps):
            break
    if not steps:
        found.append(Aged(state, elongation.widths))
    seconds = time.perf_counter() - start
    print(f"{name}: {state.network.n_nodes} nodes, {state.step} steps, {seconds:.1f} s")
    return found


def keyframed_growth(name: str) -> KeyframedGrowth:
    """Give the growth of a bundled leaf that is given by key-frames."""
    experiment = load(name)
    growth = experiment.parameters.model(experiment.folder).growth
    assert isinstance(growth, KeyframedGrowth)
    return growth


def axes_to_scale(
    bounds: Sequence[Sequence[tuple[float, float, float, float]]], scales: Sequence[float]
) -> tuple[Figure, list[list[Axes]], list[list[View]]]:
    """Make axes for rows of boxes, each row drawn at its own share of one scale."""
    sizes = [
        [(scale * (b[2] - b[0]), scale * (b[3] - b[1])) for b in row]
        for row, scale in zip(bounds, scales, strict=True)
    ]
    n_columns = max(len(row) for row in sizes)
    wide = max(sum(w for w, _ in row) for row in sizes)
    high = sum(max(h for _, h in row) for row in sizes)
    room = (LONGEST - 2 * PAPER * n_columns, LONGEST - 2 * PAPER * len(sizes))
    per_length = min(room[0] / wide, room[1] / high)
    width = wide * per_length + 2 * PAPER * n_columns
    height = high * per_length + 2 * PAPER * len(sizes)
    figure = Figure(figsize=(width, height), facecolor="white")
    FigureCanvasAgg(figure)
    axes, views, top = [], [], height
    for row, boxes, scale in zip(sizes, bounds, scales, strict=True):
        tall = max(h for _, h in row) * per_length + 2 * PAPER
        gap = (width - sum(w for w, _ in row) * per_length) / len(row)
        inch, left, top = scale * per_length, 0.0, top - tall
        axes.append([])
        views.append([])
        for x0, y0, x1, _ in boxes:
            across = (x1 - x0) * inch + gap
            axes[-1].append(
                figure.add_axes((left / width, top / height, across / width, tall / height))
            )
            middle, half = 0.5 * (x0 + x1), 0.5 * across / inch
            bottom = y0 - PAPER / inch
            box = (middle - half, bottom, middle + half, bottom + tall / inch)
            views[-1].append(View(box, 72.0 * inch))
            axes[-1][-1].set(xlim=box[::2], ylim=box[1::2])
            axes[-1][-1].set_axis_off()
            left += across
    return figure, axes, views


def draw_ages(
    rows: Sequence[Sequence[Aged]], scales: Sequence[float], bars: Sequence[float], color: str
) -> Figure:
    """Draw leaves in rows, each row at its own scale, with a bar of a given length."""
    bounds = [[leaf.state.blade.bounds for leaf in row] for row in rows]
    figure, axes, views = axes_to_scale(bounds, scales)
    number = 0
    for leaves, on, seen, bar in zip(rows, axes, views, bars, strict=True):
        for leaf, ax, view in zip(leaves, on, seen, strict=True):
            draw_leaf(
                leaf.state,
                ax,
                color=color,
                key=False,
                scale_bar=False,
                widths=WIDTHS,
                node_widths=leaf.widths,
                view=view,
            )
            if sum(map(len, rows)) > 1:
                ax.text(0.03, 0.97, f"{chr(ord('a') + number)})", transform=ax.transAxes, va="top")
            number += 1
        draw_bar(on[0], seen[0], bar)
    return figure


def draw_bar(ax: Axes, view: View, length: float) -> None:
    """Draw a scale bar in the lower left corner."""
    left, bottom, _, _ = view.box
    inch = 72.0 / view.points_per_length
    x, y = left + 0.05 * inch, bottom + 0.05 * inch
    ax.plot([x, x + length], [y, y], color=INK, linewidth=1.5, solid_capstyle="butt", zorder=6)
    ax.text(x, y + 0.03 * inch, f"{length:g} D", fontsize=7, va="bottom", zorder=6)


def draw_surface(ax: Axes, growth: KeyframedGrowth, step: int) -> None:
    """Draw the lines of equal u and equal v of a surface."""
    ends, along = np.linspace(0.0, 1.0, 9), np.linspace(0.0, 1.0, 101)
    for value in ends.tolist():
        for column in (0, 1):
            points = np.empty((len(along), 2))
            points[:, column], points[:, 1 - column] = value, along
            points[:, 0] = 2.0 * points[:, 0] - 1.0
            is_edge = value in (0.0, 1.0)
            look = {"color": "#6f9463", "linewidth": 1.2 if is_edge else 0.5, "zorder": 2}
            ax.plot(*growth.position(points, step).T, **look)
