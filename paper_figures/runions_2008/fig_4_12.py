"""
Figure 4.12: boundary curves
============================

Boundary curves of existing veins, and what grows to one source inside of them.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from neighbourhood import ROOM
from numpy.typing import NDArray
from panels import (
    INK,
    RED,
    draw_points,
    draw_segments,
    given,
    grown,
    letters,
    output_of,
    panels,
    rectangle,
)

from vasc.render import save

CURVES = (
    [(-32, -26), (30, -30), (34, 24), (-28, 30)],
    [(-38, -16), (0, -24), (40, -14), (36, 18), (-4, 22), (-38, 16)],
    [(-24, -30), (26, -26), (22, 8), (2, 36), (-20, 14)],
)
SOURCES = ((1.0, -1.0), (3.0, 0.0), (1.0, -8.0))
BOX = (-46.0, -40.0, 46.0, 42.0)


def nodes_along(corners: NDArray, roundness: float = 0.12) -> NDArray[np.float64]:
    """Give nodes one segment apart along a closed curve with slightly rounded corners."""
    following, previous = np.roll(corners, -1, axis=0), np.roll(corners, 1, axis=0)
    share = np.linspace(0.0, 1.0, 12)[None, :, None]
    start = (corners + roundness * (previous - corners))[:, None]
    stop = (corners + roundness * (following - corners))[:, None]
    middle = corners[:, None]
    bends = (1 - share) ** 2 * start + 2 * share * (1 - share) * middle + share**2 * stop
    closed = np.vstack([bends.reshape(-1, 2), bends.reshape(-1, 2)[:1]])
    along = np.r_[0.0, np.cumsum(np.hypot(*np.diff(closed, axis=0).T))]
    at = np.arange(0.0, along[-1], along[-1] / round(along[-1]))
    return np.stack([np.interp(at, along, column) for column in closed.T], axis=1)


def draw_boundary(ax: Axes, nodes: NDArray) -> None:
    """Draw the existing veins."""
    ring = np.vstack([nodes, nodes[:1]])
    ax.plot(*ring.T, color=INK, linewidth=3.0, solid_capstyle="round", zorder=3)


def main(output: Path) -> None:
    """Draw the figure."""
    figure, axes = panels(2, 3, BOX)
    for column, (curve, source) in enumerate(zip(CURVES, SOURCES, strict=True)):
        nodes = nodes_along(np.array(curve, dtype=float))
        states = grown(
            "closed",
            domain=rectangle(-ROOM, -ROOM, ROOM, ROOM) | {"seeds": (nodes / ROOM).tolist()},
            placement=given([source]),
            arrival={"kill_distance": 1.0},
        )
        above, below = axes[column], axes[column + 3]
        draw_boundary(above, nodes)
        draw_points(above, source, RED)
        draw_boundary(below, nodes)
        draw_segments(below, states[-1].network)
    letters(axes)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
