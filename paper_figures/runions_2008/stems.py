"""What the figures of chapter 6 share: growing stems, and drawing them flat and in space."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from panels import INK

from vasc.config import load, parse_override
from vasc.network import Origin
from vasc.render import StemStyle, UnrolledStyle, draw_stem
from vasc.render.unrolled import draw_flat
from vasc.simulation import simulate
from vasc.streams import Streams

FLAT = UnrolledStyle(widths=(1.1, 0.7), text=(3.0, 5.0), strip=36.0)
SOLID = StemStyle(thickest_share=0.0065)
WORDS = 0.2
"""Height of the line above a stem, in inches."""
GAP = 0.12
"""Free paper around a stem, in inches."""
COLUMNS = 2
"""Stems side by side."""


@dataclass(frozen=True)
class Grown:
    """A stem: vein nodes, segments, ids of primordia, and its radius at every node."""

    positions: NDArray
    segments: NDArray
    primordia: NDArray
    radii: NDArray


def grown_stem(name: str, *overrides: str) -> Grown:
    """Grow a bundled stem to its end; prints how long it took."""
    experiment = load(name, [parse_override(text) for text in overrides])
    parameters = experiment.parameters
    start = time.perf_counter()
    for state in simulate(parameters.model(experiment.folder), Streams(parameters.seed)):
        last = state
    network = last.network
    seconds = time.perf_counter() - start
    print(f"{name}: {network.n_nodes} nodes, {last.step} steps, {seconds:.1f} s")
    return Grown(
        network.positions,
        network.segments,
        (network.origins == Origin.PRIMORDIUM).nonzero()[0],
        parameters.domain.radius_at(network.positions[:, 2]),
    )


def grown_pairs(
    names: Sequence[str], words: Sequence[str], n_primordia: Sequence[int]
) -> list[tuple[str, Grown]]:
    """Grow bundled stems up to numbers of primordia, each with its words."""
    return [
        (said, grown_stem(name, f"placement.primordia={number}"))
        for name, said, number in zip(names, words, n_primordia, strict=True)
    ]


def lifted(stem: Grown, heights: NDArray) -> Grown:
    """Give a stem whose nodes have moved to other heights."""
    positions = stem.positions.copy()
    positions[:, 2] = heights
    return replace(stem, positions=positions)


def flat(ax: Axes, stem: Grown, style: UnrolledStyle = FLAT) -> None:
    """Draw a stem split along a line and laid flat."""
    veins = stem.positions, stem.segments, stem.primordia
    draw_flat(ax, *veins, radius=stem.radii, style=style)
    ax.set_axis_off()


def solid(ax: Axes, stem: Grown, style: StemStyle = SOLID) -> None:
    """Draw a stem in space."""
    veins = stem.positions, stem.segments, stem.primordia
    draw_stem(*veins, ax, radii=stem.radii, scale_bar=False, style=style)


def draw_pairs(
    stems: Sequence[tuple[str, Grown]],
    *,
    sizes: tuple[float, float] = (2.35, 0.85),
    height: float = 1.95,
) -> Figure:
    """Draw stems with a line of words each, flat and beside it in space.

    ``sizes`` are the widths of both, in inches.
    """
    cell = GAP + sum(sizes) + GAP
    rows = -(-len(stems) // COLUMNS)
    width, tall = COLUMNS * cell + GAP, rows * (height + WORDS + GAP) + GAP
    figure = Figure(figsize=(width, tall), facecolor="white")
    FigureCanvasAgg(figure)
    for number, (words, stem) in enumerate(stems):
        row, column = divmod(number, COLUMNS)
        left = GAP + column * cell
        bottom = tall - (row + 1) * (height + WORDS + GAP)
        for draw, x, across in ((flat, left, sizes[0]), (solid, left + sizes[0] + GAP, sizes[1])):
            box = (x / width, bottom / tall, across / width, height / tall)
            draw(figure.add_axes(box), stem)
        letter = chr(ord("a") + number)
        at = (left / width, (bottom + height + 0.3 * WORDS) / tall)
        figure.text(*at, f"{letter}) {words}", fontsize=7.5, color=INK)
    return figure
