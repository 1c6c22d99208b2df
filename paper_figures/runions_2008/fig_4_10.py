"""
Figure 4.10: open venation, step by step
========================================

The algorithm for open venation, step by step.
"""

from pathlib import Path

import numpy as np
from colonization import KILL_DISTANCE, Step, draw_associations, draw_stages, draw_veins
from matplotlib.axes import Axes
from numpy.typing import NDArray
from panels import (
    RED,
    VIOLET,
    draw_circles,
    draw_margin,
    draw_points,
    given,
    grown,
    letters,
    output_of,
    panels,
)

from vasc.render import save
from vasc.state import State

GUIDE = (0.0, 2.5)
"""Source that lets the first three nodes grow, and is reached by the last of them."""
SOURCES = [(-1.15, 3.64), (1.21, 1.68), (-1.5, 1.45), (-1.75, 0.62)]
CANDIDATES = np.array([(-2.2, 2.15), (1.2, 3.6), (1.9, 0.95)])
BIRTH_DISTANCE = 1.4
LENGTH, GROWTH = 4.1, 0.62
BOX = (-3.7, -1.0, 3.7, 7.4)


def grown_states(added: NDArray) -> list[State]:
    """Grow four steps; the last one has the added sources."""
    points = [GUIDE, *SOURCES, *added.tolist()]
    births = [1] + [3] * len(SOURCES) + [4] * len(added)
    return grown(
        "open",
        domain={"shape": "ovate", "length": LENGTH, "width": 0.95, "seeds": [[0.0, 0.0]]},
        growth={"kind": "marginal", "final_length": LENGTH + 4 * GROWTH, "length_per_step": GROWTH},
        placement=given(points, births),
        extension={"stall_rule": False},  # equation 3.1 to the letter
        arrival={"kill_distance": KILL_DISTANCE},
        stop={"steps": 4},
    )


def has_room(candidates: NDArray, state: State) -> NDArray[np.bool_]:
    """Tell which candidates are farther than the birth distance from veins and sources."""
    others = np.concatenate([state.network.positions, state.sources.positions])
    gaps = np.linalg.norm(candidates[:, None] - others, axis=2)
    return gaps.min(axis=1) >= BIRTH_DISTANCE


def draw_growth(axes: list[Axes], before: State, accepted: NDArray) -> None:
    """Draw the last panels: new candidates, the one that is accepted, the next associations."""
    sources = [before.sources.positions] * 2 + [
        np.concatenate([before.sources.positions, accepted])
    ] * 2
    for ax, points in zip(axes, sources, strict=True):
        draw_veins(ax, before.network)
        draw_points(ax, points, RED)
    draw_points(axes[1], CANDIDATES, "#e79aa4")
    draw_circles(axes[1], CANDIDATES, BIRTH_DISTANCE, RED, linestyle=(0, (4, 3)))
    draw_associations(axes[3], sources[3], before.network, RED)


def main(output: Path) -> None:
    """Draw the figure."""
    before = grown_states(CANDIDATES[:0])[3]
    accepted = CANDIDATES[has_room(CANDIDATES, before)]
    states = grown_states(accepted)
    figure, axes = panels(3, 4, BOX)
    for ax in axes[:7]:
        draw_margin(ax, states[3].blade.rings[0])
    for ax in axes[7:11]:
        draw_margin(ax, states[4].blade.rings[0])
    draw_margin(axes[7], states[3].blade.rings[0], fill=False, linestyle=(0, (2, 2)))
    draw_stages(axes[:7], Step(states[2], states[3], RED, VIOLET))
    draw_growth(axes[7:11], states[3], accepted)
    letters(axes[:11])
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
