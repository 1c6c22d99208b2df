"""
Figure 5.5: areole venation, step by step
=========================================

The areole model step by step, in one closed areole.
"""

from pathlib import Path

import numpy as np
from fig_4_12 import nodes_along
from matplotlib.axes import Axes
from matplotlib.path import Path as Outline
from numpy.typing import NDArray
from panels import (
    INK,
    RED,
    draw_circles,
    draw_lines,
    draw_nodes,
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
from vasc.state import State
from vasc.states import CanalState

ROOM = 30.0
GREEN = "#4f8a3c"
CORNERS = np.array([(-12, -9), (11, -11), (14, 8), (-4, 13)], dtype=float)
BOX = (-15.0, -13.5, 16.5, 15.0)


def largest_circle(ring: NDArray) -> tuple[NDArray[np.float64], float]:
    """Give centre and radius of the largest circle empty of nodes inside a ring of them."""
    low, high = ring.min(axis=0), ring.max(axis=0)
    axes = [np.linspace(a, b, 161) for a, b in zip(low, high, strict=True)]
    points = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    points = points[Outline(ring).contains_points(points)]
    gaps = np.linalg.norm(points[:, None] - ring, axis=2).min(axis=1)
    return points[gaps.argmax()], float(gaps.max())


def draw(ax: Axes, ring: NDArray, state: State) -> None:
    """Draw the areole, the veins in it, and what of the canals is no vein yet."""
    ax.plot(*np.vstack([ring, ring[:1]]).T, color=GREEN, linewidth=3.0, zorder=2)
    draw_segments(ax, state.network)
    new = state.network.positions[len(ring) :]
    if len(new):
        draw_nodes(ax, new, size=4.0)
    draw_points(ax, state.sources.positions, RED)
    canals, places = state.canals, state.network.positions
    waits = np.isin(canals.states, (CanalState.PRE_PATTERN, CanalState.INBOUND))
    draw_lines(ax, canals.source_positions[waits], places[canals.nodes[waits]], RED)
    leaves = canals.states == CanalState.OUTBOUND
    draw_lines(ax, places[canals.tips[leaves]], places[canals.nodes[leaves]], RED)


def main(output: Path) -> None:
    """Draw the figure."""
    ring = nodes_along(CORNERS)
    centre, radius = largest_circle(ring)
    states = grown(
        "areole",
        domain=rectangle(-ROOM, -ROOM, ROOM, ROOM) | {"seeds": (ring / ROOM).tolist()},
        placement=given([centre]),
        arrival={"kill_distance": 1.0},
    )
    drained = next(k for k, state in enumerate(states) if k and state.sources.n_sources == 0)
    chosen = [states[k] for k in (1, drained // 2, drained, drained + 3, -1)]
    figure, axes = panels(2, 4, BOX)
    for ax in axes[:3]:
        ax.plot(*np.vstack([ring, ring[:1]]).T, color=GREEN, linewidth=3.0, zorder=2)
    draw_nodes(axes[0], ring, size=3.0, color=GREEN)
    for ax in axes[1:3]:
        draw_points(ax, centre, RED)
    draw_circles(axes[1], centre, radius, INK, linestyle="--")
    canals = states[1].canals
    goals = states[1].network.positions[canals.nodes]
    draw_lines(axes[2], canals.source_positions, goals, RED)
    draw_nodes(axes[2], goals, size=5.0, color=GREEN)
    for ax, state in zip(axes[3:], chosen, strict=True):
        draw(ax, ring, state)
    letters(axes)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
