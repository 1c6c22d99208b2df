"""
Figure 5.3: the parameter space
===============================

A point of the parameter space, and where growth carries it.
"""

from pathlib import Path

import numpy as np
from ages import axes_to_scale, draw_bar, draw_surface, keyframed_growth
from matplotlib.axes import Axes
from panels import RED, draw_margin, draw_points, output_of

from vasc.render import save

POINT = (0.75, 0.6)
"""The point, as (u, v)."""
STEPS = (0, 60)
SIDE = 11.0
"""How large the parameter space is drawn, in D."""


def draw_parameters(ax: Axes) -> None:
    """Draw the unit square of (u, v), eight cells each way, and the point."""
    left, bottom = -SIDE / 2.0, 15.0
    for place in np.linspace(0.0, SIDE, 9).tolist():
        look = {"color": "#6f9463", "linewidth": 1.2 if place in (0.0, SIDE) else 0.5}
        ax.plot([left + place] * 2, [bottom, bottom + SIDE], **look)
        ax.plot([left, left + SIDE], [bottom + place] * 2, **look)
    draw_points(ax, (left + POINT[0] * SIDE, bottom + POINT[1] * SIDE), RED)
    ax.text(0.0, bottom - 0.3, "u", ha="center", va="top")
    ax.text(left - 0.3, bottom + SIDE / 2.0, "v", ha="right", va="center")


def main(output: Path) -> None:
    """Draw the figure."""
    growth = keyframed_growth("arabidopsis-first-leaf")
    boxes = [(-8.0, -0.5, 8.0, 30.5), (-9.0, -0.5, 9.0, 30.5)]
    figure, rows, views = axes_to_scale([boxes], [1.0])
    material = np.array([[2.0 * POINT[0] - 1.0, POINT[1]]])
    for step, ax in zip(STEPS, rows[0], strict=True):
        draw_margin(ax, growth.domain(step).rings[0])
        draw_surface(ax, growth, step)
        draw_points(ax, growth.position(material, step), RED)
    draw_parameters(rows[0][0])
    draw_bar(rows[0][0], views[0][0], 5.0)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
