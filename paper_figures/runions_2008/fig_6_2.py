"""
Figure 6.2: a leaf trace
========================

A leaf trace and the vein nodes of a stem grow towards each other.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from panels import INK, RED, draw_nodes, draw_points, frame, grown, letters, output_of, panels

from vasc.network import Origin
from vasc.render import save
from vasc.state import State

RADIUS, RISE = 12.0, 5.0
BOX = (-4.6, -1.0, 4.6, 6.8)
"""What is seen of the stem, from the side of the primordium, in D."""


def seen(positions: np.ndarray) -> np.ndarray:
    """Give points as seen from the side of the primordium; those behind the axis are left out."""
    return np.where(positions[:, :1] > 0.0, positions[:, 1:], np.nan)


def draw(ax: Axes, state: State) -> None:
    """Draw nodes, and the segments between them."""
    network = state.network
    points = seen(network.positions)
    for start, end in network.segments:
        ax.plot(*points[[start, end]].T, color=INK, linewidth=1.4, zorder=3)
    draw_nodes(ax, points)
    draw_points(ax, points[network.origins == Origin.PRIMORDIUM], RED, size=7.0)


def main(output: Path) -> None:
    """Draw the figure."""
    states = grown(
        "stem",
        domain={"radius": RADIUS},
        placement={"divergence": 137.5, "rise": RISE, "primordia": 1, "first_step": 2},
    )
    before, after, last = states[1], states[2], states[-1]
    # where the primordium appears, before anything has grown towards it
    leaf = np.array([0.0, RISE])
    figure, axes = panels(1, 4, BOX)
    for ax in axes[:2]:
        draw(ax, before)
        draw_points(ax, leaf, RED, size=7.0)
    axes[1].plot([0.0, 0.0], [0.0, RISE], color=INK, linestyle="--", linewidth=1.2, zorder=2)
    draw(axes[2], after)
    draw(axes[3], last)
    for ax in axes:
        frame(ax)
    letters(axes)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
