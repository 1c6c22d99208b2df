"""
Figure 3.5: one step of space colonization
==========================================

The space colonization algorithm, step by step.
"""

from pathlib import Path

import numpy as np
from colonization import KILL_DISTANCE, Step, draw_associations, draw_stages, draw_veins
from panels import (
    BLUE,
    RED,
    draw_points,
    frame,
    given,
    grown,
    letters,
    output_of,
    panels,
    rectangle,
)

from vasc.render import save

GUIDE = (0.0, 5.5)
"""Source that lets the axis of six nodes grow, and is reached by the last of them."""
POINTS = [(-1.15, 6.64), (1.21, 4.68), (-1.5, 3.45), (-1.75, 2.6)]
BOX = (-3.1, -0.6, 2.6, 7.9)


def colonization() -> Step:
    """Grow six nodes, then the step that is shown."""
    states = grown(
        "open",
        domain=rectangle(-20.0, -20.0, 20.0, 20.0),
        placement=given([GUIDE, *POINTS], [1, 6, 6, 6, 6]),
        extension={"stall_rule": False},  # equation 3.1 to the letter
        arrival={"kill_distance": KILL_DISTANCE},
        stop={"steps": 6},
    )
    return Step(states[5], states[6], BLUE, RED)


def main(output: Path) -> None:
    """Draw the figure."""
    step = colonization()
    figure, axes = panels(2, 4, BOX)
    draw_stages(axes[:7], step)
    left = step.after.sources.positions
    draw_associations(axes[7], left, step.after.network, BLUE)
    draw_veins(axes[7], step.after.network)
    draw_points(axes[7], np.asarray(left), BLUE)
    for ax in axes:
        frame(ax)
    letters(axes)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
