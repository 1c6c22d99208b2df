"""
Figure 3.4: the bias of equation 3.3
====================================

The bias g of equation 3.3 and the path of a single branch.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from panels import (
    draw_nodes,
    draw_points,
    given,
    grown,
    letters,
    output_of,
    panels,
    rectangle,
)

from vasc.render import save

BIASES = (0.0, 0.35, 0.7, -0.35, -0.7)
FAN = np.linspace(0.8, -0.8, 17)
POINT = (100.0, 0.0)
BOX = (-12.0, -50.0, 112.0, 46.0)


def path(bias: float) -> NDArray[np.float64]:
    """Grow one branch from the origin to the point; gives its nodes in order."""
    states = grown(
        "open",
        domain=rectangle(-150.0, -300.0, 250.0, 300.0),
        placement=given([POINT]),
        extension={"bias": (0.0, bias)},
        arrival={"kill_distance": 1.0},
        stop={"steps": 1000},
    )
    return states[-1].network.positions


def draw_paths(ax: Axes, biases: NDArray) -> None:
    """Draw the branch of every bias between the node and the point."""
    for bias in biases.tolist():
        ax.plot(*path(bias).T, color="#202020", linewidth=1.2, zorder=3)
    draw_nodes(ax, (0.0, 0.0))
    draw_points(ax, POINT)


def main(output: Path) -> None:
    """Draw the figure."""
    figure, axes = panels(2, 3, BOX)
    for ax, bias in zip(axes, BIASES, strict=False):
        draw_paths(ax, np.array([bias]))
        ax.set_title(f"g = (0, {bias:g})", fontsize=8.0, y=0.02)
    draw_paths(axes[-1], FAN)
    axes[-1].set_title("g from (0, 0.8) to (0, -0.8)", fontsize=8.0, y=0.02)
    letters(axes)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
