"""What the scripts share: tissues, canals that have come to rest, and panels."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from vasc.analysis.strands import Strand, read_strand
from vasc.domain import Blade
from vasc.domain.tissue import Tissue
from vasc.domain.voronoi import voronoi_in
from vasc.models.canalization import Canalization
from vasc.models.injection import GivenInjection
from vasc.models.settling import Settling
from vasc.models.transport import (
    FacilitatedDiffusion,
    PooledTransport,
    Transport,
)
from vasc.render import TissueStyle
from vasc.simulation import simulate
from vasc.state import State
from vasc.streams import Streams

MODELS: dict[str, tuple[Transport, float]] = {
    "facilitated diffusion": (FacilitatedDiffusion(), 0.0),
    "pool of carriers": (PooledTransport(), 0.0),
    "pool, background 0.5": (PooledTransport(), 0.5),
}
"""Transport and background production, by the name in pictures; defaults of vasc."""
GREEN, RED, ORANGE = TissueStyle.sink, TissueStyle.source, TissueStyle.arrow
INK, BLUE = "#202020", "#2b6cc4"


def options(help_of_size: str, size: int) -> argparse.Namespace:
    """Read where a figure goes, and how large its experiment is; small ones take seconds."""
    parser = argparse.ArgumentParser()
    parser.add_argument("-o", "--output", type=Path, default=Path(f"{Path(sys.argv[0]).stem}.png"))
    parser.add_argument("--size", type=int, default=size, help=help_of_size)
    return parser.parse_args()


# experiments


def tissue_in(ring: ArrayLike, seed: int = 1) -> Tissue:
    """Fill an outline with Voronoi cells."""
    corners = np.asarray(ring, dtype=float)
    lowest = corners[corners[:, 1].argmin()]
    blade = Blade.from_rings([corners], lowest[None])
    return voronoi_in(blade, Streams(seed, ("tissue",))["tissue"])


def settle(
    tissue: Tissue,
    transport: Transport,
    veins: Sequence[NDArray[np.int32]],
    sources: ArrayLike,
    *,
    background: float = 0.0,
    rounds: ArrayLike | None = None,
    tolerance: float = 1.0,
) -> State:
    """Let sources appear in cells, and wait until the canals of the last are at rest."""
    cells = np.asarray(sources, dtype=np.int32)
    numbers = np.ones(len(cells)) if rounds is None else np.asarray(rounds)
    model = Canalization(
        tissue=tissue,
        transport=transport,
        injection=GivenInjection(list(veins), background, cells, numbers.astype(np.int32)),
        settling=Settling(tolerance=tolerance),
        last_step=None,
    )
    for state in simulate(model, Streams(1, ("placement", "noise"))):
        last = state
    return last


def strand_of(
    state: State, transport: Transport, source: int, veins: Sequence[NDArray[np.int32]]
) -> Strand:
    """Read the strand of a source from a state at rest."""
    assert state.tissue is not None
    assert state.fields is not None
    return read_strand(
        state.tissue, state.fields, source, veins, transport.activation(state.tissue)
    )


# drawing


def row_of(
    n: int, size: tuple[float, float], titles: Sequence[str] = (), rows: int = 1
) -> tuple[Figure, list[Axes]]:
    """Make a figure of panels without axes, side by side."""
    figure = Figure(figsize=size, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    axes = list(np.ravel(figure.subplots(rows, n // rows)))
    for ax, title in zip(axes, titles or [""] * n, strict=True):
        ax.set_axis_off()
        ax.set_aspect("equal")
        ax.set_title(title, fontsize=9)
    return figure, axes


def draw_cells(ax: Axes, tissue: Tissue, colors: ArrayLike, edge: str = "#ffffff") -> None:
    """Draw all cells in colours of their own, or in one."""
    ax.add_collection(
        PolyCollection(tissue.polygons, facecolors=colors, edgecolors=edge, linewidths=0.3)
    )
    show_all(ax, tissue)


def show_all(ax: Axes, tissue: Tissue) -> None:
    """Show the whole tissue, and a little around."""
    low, high = tissue.corners.min(axis=0) - 0.5, tissue.corners.max(axis=0) + 0.5
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))


def draw_lines(ax: Axes, lines: Iterable[NDArray], widths: ArrayLike, color: str = INK) -> None:
    """Draw lines of given widths, with round ends."""
    ax.add_collection(
        LineCollection(list(lines), colors=color, linewidths=widths, capstyle="round", zorder=3)
    )


def draw_outline(ax: Axes, tissue: Tissue) -> None:
    """Draw the outline of a tissue."""
    for ring in tissue.blade.rings:
        ax.plot(*np.vstack([ring, ring[:1]]).T, color="#6f9463", linewidth=1.0, zorder=1)


def ring(ax: Axes, places: ArrayLike, color: str, size: float = 6.0) -> None:
    """Draw rings around places."""
    x, y = np.atleast_2d(np.asarray(places)).T
    ax.plot(x, y, "o", mfc="none", mec=color, mew=1.5, ms=size, zorder=6)


def plot(size: tuple[float, float], x: str, y: str) -> tuple[Figure, Axes]:
    """Make a figure of one diagram."""
    figure = Figure(figsize=size, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    ax = figure.add_subplot()
    ax.set_xlabel(x, fontsize=9)
    ax.set_ylabel(y, fontsize=9)
    ax.tick_params(labelsize=8)
    ax.spines[["top", "right"]].set_visible(False)
    return figure, ax
