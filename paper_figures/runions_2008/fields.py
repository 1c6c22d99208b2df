"""The sum of distances E (equation 3.2), its directions, and branches grown in them."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from panels import (
    draw_nodes,
    draw_points,
    draw_segments,
    frame,
    given,
    grown,
    letters,
    panels,
    rectangle,
)

from vasc.state import State

BOX = (-60.0, -15.0, 60.0, 105.0)


def grid(n: int) -> tuple[NDArray, NDArray]:
    """Give places spread evenly over the box."""
    left, bottom, right, top = BOX
    margin = 0.5 / n
    share = np.linspace(margin, 1.0 - margin, n)
    return np.meshgrid(left + share * (right - left), bottom + share * (top - bottom))


def pulls(x: NDArray, y: NDArray, points: NDArray) -> tuple[NDArray, NDArray, NDArray]:
    """Give E and the sum of the unit vectors toward the points (equations 3.1 and 3.2)."""
    dx, dy = points[:, 0] - x[..., None], points[:, 1] - y[..., None]
    distance = np.hypot(dx, dy)
    near = np.where(distance > 0.0, distance, 1.0)
    return distance.sum(axis=-1), (dx / near).sum(axis=-1), (dy / near).sum(axis=-1)


def draw_field(ax: Axes, points: NDArray) -> None:
    """Draw E: dark where the sum of distances is small, with lines of equal height."""
    x, y = grid(240)
    height = pulls(x, y, points)[0]
    ax.contourf(x, y, height, levels=40, cmap="Greys_r")
    ax.contour(x, y, height, levels=16, colors="white", linewidths=0.5, alpha=0.7)


def draw_directions(ax: Axes, points: NDArray) -> None:
    """Draw the normalized direction of the sum of pulls."""
    x, y = grid(19)
    _, u, v = pulls(x, y, points)
    length = np.hypot(u, v)
    kept = length > 1e-9
    ax.quiver(
        x[kept],
        y[kept],
        u[kept] / length[kept],
        v[kept] / length[kept],
        angles="xy",
        scale=26.0,
        width=0.005,
        headwidth=4.0,
        color="#444444",
        pivot="mid",
    )


def branches(points: NDArray) -> State:
    """Grow branches from a node at the origin toward the points, without a limit of influence."""
    states = grown(
        "open",
        domain=rectangle(*BOX),
        placement=given(points),
        arrival={"kill_distance": 1.0},
    )
    return states[-1]


def field_figure(points: NDArray) -> Figure:
    """Draw the three panels of Figures 3.2 and 3.3."""
    figure, axes = panels(1, 3, BOX)
    draw_field(axes[0], points)
    draw_directions(axes[1], points)
    network = branches(points).network
    draw_segments(axes[2], network)
    draw_nodes(axes[2], network.positions[0])
    for ax in axes:
        draw_points(ax, points)
        frame(ax)
    letters(axes)
    return figure
