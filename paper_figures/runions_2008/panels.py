"""What the scripts share: growing small scenes and whole leaves, and drawing panels."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon
from numpy.typing import ArrayLike, NDArray

from vasc.config import load, parse_override
from vasc.models import MODELS
from vasc.network import VeinNetwork
from vasc.simulation import simulate
from vasc.state import State
from vasc.streams import Streams

BLUE, RED, VIOLET, INK = "#2b6cc4", "#c8102e", "#7b3fa0", "#202020"
BLADE, MARGIN = "#e6f1dc", "#6f9463"
Box = tuple[float, float, float, float]


def output_of() -> Path:
    """Read where a figure goes from the command line; by default a PNG of the script's name."""
    parser = argparse.ArgumentParser()
    parser.add_argument("-o", "--output", type=Path, default=Path(sys.argv[0]).stem + ".png")
    return Path(parser.parse_args().output)


# growing


def grown(model: str, *, seed: int = 1, **tables: object) -> list[State]:
    """Run a small experiment given as tables; gives the states of all steps."""
    parameters = MODELS[model].model_validate({"kind": model, "seed": seed, **tables})
    return list(simulate(parameters.model(), Streams(seed)))


def rectangle(left: float, bottom: float, right: float, top: float) -> dict[str, object]:
    """Give the domain of a scene: a rectangle around the origin, measured in D."""
    corners = [[left, bottom], [right, bottom], [right, top], [left, top]]
    return {"points": corners, "length": top}


def given(points: ArrayLike, births: Sequence[int] | None = None) -> dict[str, object]:
    """Give a placement of sources at chosen places."""
    pairs = [tuple(map(float, point)) for point in np.asarray(points)]
    return {"kind": "given", "points": pairs, "births": births and list(births)}


def grown_leaf(name: str, *overrides: str) -> State:
    """Grow a bundled leaf to its end; prints how long it took."""
    experiment = load(name, [parse_override(text) for text in overrides])
    parameters = experiment.parameters
    start = time.perf_counter()
    for state in simulate(parameters.model(experiment.folder), Streams(parameters.seed)):
        last = state
    seconds = time.perf_counter() - start
    print(f"{name}: {last.network.n_nodes} nodes, {last.step} steps, {seconds:.1f} s")
    return last


def nearest(points: NDArray, nodes: NDArray) -> NDArray[np.int64]:
    """Give for each point the nearest node."""
    return np.linalg.norm(points[:, None] - nodes[None], axis=2).argmin(axis=1)


# drawing


def panels(
    rows: int, columns: int, boxes: Box | Sequence[Box], *, width: float = 7.0, gap: float = 0.02
) -> tuple[Figure, list[Axes]]:
    """Make a figure of equal panels that show a box each; ``gap`` is a share of the width."""
    all_boxes = [boxes] * (rows * columns) if isinstance(boxes[0], float | int) else list(boxes)
    left, bottom, right, top = all_boxes[0]
    side = width * (1.0 - gap * (columns + 1)) / columns
    height = side * (top - bottom) / (right - left)
    total = rows * height + (rows + 1) * gap * width
    figure = Figure(figsize=(width, total), facecolor="white")
    FigureCanvasAgg(figure)
    axes = []
    for number, (x0, y0, x1, y1) in enumerate(all_boxes):
        row, column = divmod(number, columns)
        x = gap + column * (side / width + gap)
        y = 1.0 - (row + 1) * (height + gap * width) / total
        ax = figure.add_axes((x, y, side / width, height / total))
        ax.set(xlim=(x0, x1), ylim=(y0, y1), xticks=[], yticks=[], aspect="equal")
        ax.set_axis_off()
        axes.append(ax)
    return figure, axes


def letter(ax: Axes, text: str, *, size: float = 10.0) -> None:
    """Write the letter of a panel into its upper left corner."""
    look = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5}
    at = {"transform": ax.transAxes, "va": "top", "ha": "left"}
    ax.text(0.015, 0.985, text, fontsize=size, zorder=9, bbox=look, **at)


def letters(axes: Iterable[Axes]) -> None:
    """Write a), b), ... into panels."""
    for number, ax in enumerate(axes):
        letter(ax, f"{chr(ord('a') + number)})")


def frame(ax: Axes) -> None:
    """Draw a thin frame around a panel."""
    left, right = ax.get_xlim()
    bottom, top = ax.get_ylim()
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    ax.add_patch(Polygon(corners, fill=False, edgecolor="#b0b0b0", linewidth=0.8, zorder=8))


def draw_margin(ax: Axes, ring: NDArray, **style: object) -> None:
    """Draw the outline of a blade."""
    look = {"facecolor": BLADE, "edgecolor": MARGIN, "linewidth": 1.0, "zorder": 0.5} | style
    ax.add_patch(Polygon(ring, **look))


def draw_segments(ax: Axes, network: VeinNetwork, *, width: float = 1.6) -> None:
    """Draw the segments of a network as plain lines."""
    lines = network.positions[network.segments]
    collection = LineCollection(lines, colors=INK, linewidths=width, capstyle="round", zorder=3)
    ax.add_collection(collection)


def draw_nodes(ax: Axes, points: ArrayLike, *, size: float = 6.0, color: str = INK) -> None:
    """Draw vein nodes: disks with white centres."""
    x, y = np.atleast_2d(np.asarray(points, dtype=float)).T
    ax.plot(x, y, "o", color=color, markersize=size, markeredgewidth=0, zorder=4)
    ax.plot(x, y, "o", color="white", markersize=0.45 * size, markeredgewidth=0, zorder=5)


def draw_points(ax: Axes, points: ArrayLike, color: str = BLUE, *, size: float = 6.0) -> None:
    """Draw attraction points or sources: plain disks."""
    x, y = np.atleast_2d(np.asarray(points, dtype=float)).T
    ax.plot(x, y, "o", color=color, markersize=size, markeredgewidth=0, zorder=6)


def draw_lines(ax: Axes, starts: ArrayLike, stops: ArrayLike, color: str = BLUE) -> None:
    """Draw a straight line for each pair of points."""
    lines = np.stack([np.asarray(starts), np.asarray(stops)], axis=1)
    ax.add_collection(LineCollection(lines, colors=color, linewidths=1.2, zorder=2))


def draw_arrows(
    ax: Axes, starts: NDArray, vectors: NDArray, color: str = INK, *, width: float = 1.4
) -> None:
    """Draw vectors as arrows."""
    for (x, y), (dx, dy) in zip(starts.tolist(), vectors.tolist(), strict=True):
        look = {"arrowstyle": "-|>", "color": color, "lw": width, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", (x + dx, y + dy), (x, y), arrowprops=look, zorder=7)


def draw_circles(
    ax: Axes, centres: ArrayLike, radius: float, color: str = BLUE, **style: object
) -> None:
    """Draw a circle about each centre."""
    look = {"fill": False, "edgecolor": color, "linewidth": 1.0, "zorder": 2.5} | style
    for centre in np.atleast_2d(np.asarray(centres, dtype=float)):
        ax.add_patch(Circle(tuple(centre), radius, **look))
