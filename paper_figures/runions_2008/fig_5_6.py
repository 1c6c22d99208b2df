"""
Figure 5.6: one corner cut
==========================

One corner cut: a node between two segments is replaced by two (equation 5.3).
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from panels import INK, draw_nodes, letters, output_of, panels

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
    for (x, y), name in zip(nodes.tolist(), names, strict=True):
        # beside the ends, and below the corners, where no arrow passes
        shift = (0, 11)
        if name in ("$P_{n1}$", "$P_{n2}$"):
            shift = (20, -9) if "1" in name else (-20, -13)
        look = {"textcoords": "offset points", "va": "center"}
        ax.annotate(name, (x, y), shift, ha="center", **look)


def draw_weight(ax: Axes, start: NDArray, stop: NDArray, share: float, bend: float) -> None:
    """Draw a bent arrow from a node to one that it has a share in, labelled with the share."""
    look = {"arrowstyle": "-|>", "color": YELLOW, "lw": 1.4, "shrinkA": 6, "shrinkB": 6}
    bent = look | {"connectionstyle": f"arc3,rad={bend}"}
    ax.annotate("", tuple(stop), tuple(start), arrowprops=bent, zorder=7)
    x, y = stop - start
    label = (start + stop) / 2.0 + 0.36 * np.sign(bend) * np.array([y, -x]) / np.hypot(x, y) * 1.6
    ax.text(*label, f"{share:g}", color=YELLOW, ha="center", va="center", fontsize=8)


def main(output: Path) -> None:
    """Draw the figure."""
    first, corner, last = NODES
    cut = np.array([(1 - ALPHA) * first + ALPHA * corner, (1 - ALPHA) * last + ALPHA * corner])
    figure, (before, after) = panels(1, 2, BOX)
    draw_line(before, NODES, ("$P_1$", "$P_2$", "$P_3$"))
    after.plot(*NODES.T, color="#b0b0b0", linewidth=1.0, linestyle="--", zorder=1)
    draw_nodes(after, corner, size=8.0, color="#b0b0b0")
    draw_line(after, np.stack([first, *cut, last]), ("$P_1$", "$P_{n1}$", "$P_{n2}$", "$P_3$"))
    for start, stop, share, bend in (
        (first, cut[0], 1 - ALPHA, 0.35),
        (corner, cut[0], ALPHA, 0.35),
        (last, cut[1], 1 - ALPHA, -0.35),
        (corner, cut[1], ALPHA, -0.35),
    ):
        draw_weight(after, start, stop, share, bend)
    letters((before, after))
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
