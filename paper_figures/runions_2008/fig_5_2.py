"""
Figure 5.2: local-to-global growth
==================================

Local-to-global growth, from a young shape to a grown one by two functions.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray
from panels import INK, MARGIN, draw_margin, letters, output_of

from vasc.domain import BladeParameters
from vasc.growth import Growth, LocalToGlobalParameters
from vasc.growth.stretch import smooth_table
from vasc.growth.tensor import material_grid, positions_of
from vasc.render import save

# the thesis prints no numbers: this table makes a leaf with petiole and a round blade
HEIGHTS = [0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0]
G_X = [0.25, 0.3, 0.75, 1.0, 1.05, 1.05, 1.0, 0.9]
G_Y = [0.8, 0.85, 0.85, 0.85, 0.8, 0.75, 0.6, 0.5]
YOUNG, GROWN = 0, 300
SIZE = (7.0, 2.9)


def growth() -> Growth:
    """Give a young blade, and the growth that the two functions make of it."""
    blade = BladeParameters(shape="dome", length=8.0, width=0.5).blade()
    table = {"heights": HEIGHTS, "g_x": G_X, "g_y": G_Y}
    return LocalToGlobalParameters(**table, steps_per_unit=100, end=GROWN / 100).growth(blade)


def draw_shape(ax: Axes, growing: Growth, grid: NDArray, step: int) -> None:
    """Draw a blade, with lines of tissue that were straight and evenly spaced in the young one."""
    draw_margin(ax, growing.domain(step).rings[0])
    points = positions_of(growing, grid, step)
    lines = [*points[::8], *points[:, 1:-1].swapaxes(0, 1)]
    ax.add_collection(LineCollection(lines, colors=MARGIN, linewidths=0.5))
    x, _, width, height = growing.domain(GROWN).polygon.bounds
    ax.set(xlim=(1.06 * x, 1.06 * width), ylim=(-0.03 * height, 1.03 * height), aspect="equal")
    ax.set_axis_off()


def draw_function(ax: Axes, rates: list[float], name: str) -> None:
    """Draw what one of the functions is over the initial height."""
    at = np.linspace(0.0, 1.0, 400)
    ax.plot(at, smooth_table(np.array(HEIGHTS), np.array(rates), at), color=INK, linewidth=1.4)
    ax.plot(HEIGHTS, rates, "o", color=INK, markersize=3.5, clip_on=False)
    ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1.25), xticks=[0.0, 0.5, 1.0], yticks=[0.0, 0.5, 1.0])
    ax.set_xlabel("initial height", fontsize=8)
    ax.set_ylabel(name, fontsize=8)
    ax.tick_params(labelsize=8)
    ax.spines[["top", "right"]].set_visible(False)


def main(output: Path) -> None:
    """Draw the figure."""
    growing = growth()
    grid = material_grid(growing, YOUNG, GROWN, n_rows=97, n_columns=7)
    figure = Figure(figsize=SIZE, facecolor="white")
    FigureCanvasAgg(figure)
    boxes = [(0.01, 0.02, 0.28, 0.94), (0.27, 0.02, 0.28, 0.94)]
    boxes += [(0.64, 0.62, 0.34, 0.33), (0.64, 0.15, 0.34, 0.33)]
    axes = [figure.add_axes(box) for box in boxes]
    draw_shape(axes[0], growing, grid, YOUNG)
    draw_shape(axes[1], growing, grid, GROWN)
    draw_function(axes[2], G_X, "$g_x$")
    draw_function(axes[3], G_Y, "$g_y$")
    letters(axes)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
