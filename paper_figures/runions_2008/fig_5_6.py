"""Figure 5.6: one corner cut: a node between two segments is replaced by two (equation 5.3)."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from panels import INK, draw_arrows, draw_nodes, letters, output_of, panels

from vasc.render import save

NODES = np.array([[0.0, 0.0], [2.0, 2.4], [4.6, 0.6]])
"""P1, P2 and P3."""
ALPHA = 0.6
YELLOW = "#d4a017"
BOX = (-0.8, -1.0, 5.4, 3.4)


def draw_line(ax: Axes, nodes: NDArray, names: tuple[str, ...], color: str = INK) -> None:
    """Draw nodes joined by segments, with their names."""
    ax.plot(*nodes.T, color=color, linewidth=1.6, zorder=3)
    draw_nodes(ax, nodes, size=8.0, color=color)
    middle = nodes.mean(axis=0)
    for (x, y), name in zip(nodes.tolist(), names, strict=True):
        side = "right" if x < middle[0] else "left"
        ax.annotate(name, (x, y), (0, 9), textcoords="offset points", ha=side, va="center")


def main(output: Path) -> None:
    """Draw the figure."""
    first, corner, last = NODES
    cut = np.array([(1 - ALPHA) * first + ALPHA * corner, (1 - ALPHA) * last + ALPHA * corner])
    figure, (before, after) = panels(1, 2, BOX)
    draw_line(before, NODES, ("$P_1$", "$P_2$", "$P_3$"))
    after.plot(*NODES.T, color="#b0b0b0", linewidth=1.0, linestyle="--", zorder=1)
    draw_nodes(after, corner, size=8.0, color="#b0b0b0")
    draw_line(after, np.stack([first, *cut, last]), ("$P_1$", "$P_{n1}$", "$P_{n2}$", "$P_3$"))
    # the weights of the two nodes that a new one lies between
    shift = np.array([0.35, -0.3])
    draw_arrows(after, np.stack([first, corner]) + shift, cut[:1] - [first, corner], YELLOW)
    shift = np.array([-0.2, -0.42])
    draw_arrows(after, np.stack([last, corner]) + shift, cut[1:] - [last, corner], YELLOW)
    for text, place in (
        (f"{1 - ALPHA:g}", first + cut[0]),
        (f"{ALPHA:g}", corner + cut[0]),
    ):
        after.text(*(place / 2 + [0.5, -0.45]), text, color=YELLOW, ha="left", fontsize=8)
    letters((before, after))
    save(figure, output)


if __name__ == "__main__":
    main(output_of(__file__))
