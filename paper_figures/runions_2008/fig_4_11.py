"""
Figure 4.11: relative neighbors
===============================

The relative neighborhood of a source, and what one neighbor excludes.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from neighbourhood import attracted
from numpy.typing import NDArray
from panels import RED, draw_lines, draw_nodes, draw_points, frame, output_of, panels

from vasc.render import save

SOURCE = np.array([0.0, 0.0])
NODES = {
    "v": (26.0, 6.0),
    "a": (-10.0, 20.0),
    "b": (-6.0, -24.0),
    "c": (38.0, 16.0),
    "d": (44.0, -6.0),
    "e": (-24.0, -36.0),
}
NEIGHBOURS = ("v", "a", "b")
BOX = (-46.0, -46.0, 58.0, 40.0)
GREEN, PINK = "#cfe8bf", "#f6d3d8"


def draw_areas(ax: Axes, v: NDArray, s: NDArray) -> None:
    """Shade the lune, which must be empty (1), and what v excludes (2)."""
    left, bottom, right, top = BOX
    x, y = np.meshgrid(np.linspace(left, right, 800), np.linspace(bottom, top, 800))
    to_s, to_v = np.hypot(x - s[0], y - s[1]), np.hypot(x - v[0], y - v[1])
    reach = float(np.hypot(*(v - s)))
    lune = reach - np.maximum(to_s, to_v)
    beyond = to_s - np.maximum(reach, to_v)
    for values, color in ((lune, GREEN), (beyond, PINK)):
        ax.contourf(x, y, values, levels=[0.0, 1e9], colors=[color], zorder=0.6)
        ax.contour(x, y, values, levels=[0.0], colors=["#909090"], linewidths=0.7, zorder=0.7)


def main(output: Path) -> None:
    """Draw the figure."""
    points = np.array(list(NODES.values()))
    names = np.array(list(NODES))
    found = sorted(attracted(points, SOURCE))
    if set(names[found]) != set(NEIGHBOURS):
        raise ValueError(f"the neighbours are {names[found]}, not {NEIGHBOURS}")
    figure, (ax,) = panels(1, 1, BOX, width=4.5)
    draw_areas(ax, points[0], SOURCE)
    draw_lines(ax, np.repeat(SOURCE[None], len(found), axis=0), points[found], "#202020")
    draw_nodes(ax, points, size=8.0)
    draw_points(ax, SOURCE, RED, size=8.0)
    for name, (x, y) in {**NODES, "s": (0.0, 0.0)}.items():
        ax.text(x + 1.8, y + 1.8, name, fontsize=11, style="italic", zorder=9)
    ax.text(12.0, -8.0, "1", fontsize=11, color="#3f7a2a")
    ax.text(34.0, -30.0, "2", fontsize=11, color="#a83246")
    frame(ax)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
