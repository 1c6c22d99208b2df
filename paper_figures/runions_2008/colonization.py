"""One step of space colonization, taken apart: the panels of Figures 3.5 and 4.10."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from panels import (
    INK,
    draw_arrows,
    draw_circles,
    draw_lines,
    draw_nodes,
    draw_points,
    draw_segments,
    nearest,
)

from vasc.network import VeinNetwork
from vasc.state import State

KILL_DISTANCE = 1.0


@dataclass(frozen=True)
class Step:
    """Two successive states, the sources between them, and the colours of a figure."""

    before: State
    after: State
    color: str
    sum_color: str

    @property
    def sources(self) -> NDArray[np.float64]:
        """The sources that pulled in this step: alive before, or born in it."""
        positions, births = (
            self.after.rows("sources", "position"),
            self.after.rows("sources", "birth"),
        )
        old = np.isin(np.arange(len(births)), self.before.live)
        return positions[old | (births == self.after.step)]

    @property
    def nearest(self) -> NDArray[np.int64]:
        """The node nearest to each source before the step."""
        return nearest(self.sources, self.before.network.positions)

    @property
    def units(self) -> NDArray[np.float64]:
        """The unit vectors from the nearest nodes to the sources."""
        vectors = self.sources - self.before.network.positions[self.nearest]
        return vectors / np.linalg.norm(vectors, axis=1)[:, None]

    @property
    def born(self) -> NDArray[np.bool_]:
        """Which nodes grew in this step."""
        return self.after.network.births == self.after.step


def draw_veins(ax: Axes, network: VeinNetwork) -> None:
    """Draw nodes and the segments between them."""
    draw_segments(ax, network)
    draw_nodes(ax, network.positions)


def draw_associations(ax: Axes, points: NDArray, network: VeinNetwork, color: str) -> None:
    """Draw a line from every source to the nearest node."""
    draw_lines(ax, points, network.positions[nearest(points, network.positions)], color)


def draw_sums(ax: Axes, step: Step) -> None:
    """Draw the normalized sums of the unit vectors, and the places of the new nodes."""
    network = step.after.network
    starts = network.positions[network.parents[step.born]]
    draw_arrows(ax, starts, network.positions[step.born] - starts, step.sum_color)
    draw_circles(ax, network.positions[step.born], 0.16, step.sum_color, linewidth=1.6)


def draw_neighbourhoods(ax: Axes, step: Step) -> None:
    """Draw the kill neighbourhoods, bold where a node is inside."""
    gaps = np.linalg.norm(step.sources[:, None] - step.after.network.positions, axis=2)
    entered = gaps.min(axis=1) < KILL_DISTANCE
    for is_bold, width in ((False, 1.0), (True, 2.6)):
        chosen = step.sources[entered == is_bold]
        if len(chosen):
            draw_circles(ax, chosen, KILL_DISTANCE, step.color, linewidth=width)


def draw_stages(axes: list[Axes], step: Step) -> None:
    """Draw the first seven panels: from the sources to the removal of those that were reached."""
    for ax in axes[:4]:
        draw_veins(ax, step.before.network)
    for ax in axes[4:7]:
        draw_veins(ax, step.after.network)
    for ax in axes[:6]:
        draw_points(ax, step.sources, step.color)
    draw_points(axes[6], step.after.sources.positions, step.color)
    draw_associations(axes[1], step.sources, step.before.network, step.color)
    starts = step.before.network.positions[step.nearest]
    for ax in axes[2:4]:
        draw_arrows(ax, starts, step.units, INK)
    draw_sums(axes[3], step)
    draw_neighbourhoods(axes[5], step)
