"""
Figure 4.13: Urquhart's approximation
=====================================

A node excludes another from a neighborhood that it is not in itself.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from neighbourhood import attracted
from panels import (
    BLUE,
    RED,
    draw_lines,
    draw_margin,
    draw_nodes,
    draw_points,
    frame,
    letters,
    output_of,
    panels,
)
from scipy.spatial import Delaunay

from vasc.render import save

SOURCE = np.array([0.0, 0.0])
NODES = {"v": (40.0, 0.0), "a": (20.0, 32.8), "b": (-2.0, 10.0)}
BOX = (-16.0, -42.0, 60.0, 42.0)
TITLES = {"relative": "relative neighbourhood", "urquhart": "Urquhart neighbourhood"}


def draw_triangulation(ax: Axes) -> None:
    """Draw the Delaunay triangulation of nodes and source."""
    points = np.vstack([list(NODES.values()), SOURCE])
    for triangle in Delaunay(points).simplices.tolist():
        corners = points[[*triangle, triangle[0]]]
        ax.plot(*corners.T, color="#a0a0a0", linewidth=0.8, linestyle=(0, (4, 3)), zorder=1)


def draw_lune(ax: Axes) -> None:
    """Shade what must be empty if v is to be a relative neighbour of s."""
    x, y = NODES["v"]
    reach, turn = np.hypot(x, y), np.arctan2(y, x)
    angles = np.linspace(-np.pi / 3, np.pi / 3, 80)
    about_s = turn + angles
    about_v = turn + np.pi + angles
    ring = np.concatenate(
        [
            np.stack([reach * np.cos(about_s), reach * np.sin(about_s)], axis=1),
            np.stack([x + reach * np.cos(about_v), y + reach * np.sin(about_v)], axis=1),
        ]
    )
    draw_margin(ax, ring, facecolor="#cfe8bf", edgecolor="#909090")


def main(output: Path) -> None:
    """Draw the figure."""
    points = np.array(list(NODES.values()))
    figure, axes = panels(1, 2, BOX, width=6.4)
    for ax, (perception, title) in zip(axes, TITLES.items(), strict=True):
        found = sorted(attracted(points, SOURCE, perception))
        draw_triangulation(ax)
        draw_lune(ax)
        draw_lines(ax, np.repeat(SOURCE[None], len(found), axis=0), points[found], BLUE)
        draw_nodes(ax, points, size=8.0)
        draw_points(ax, SOURCE, RED, size=8.0)
        for name, (x, y) in {**NODES, "s": (0.0, 0.0)}.items():
            ax.text(x + 1.6, y + 1.8, name, fontsize=11, style="italic", zorder=9)
        ax.set_title(title, fontsize=8.0, y=0.01)
        frame(ax)
    letters(axes)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
