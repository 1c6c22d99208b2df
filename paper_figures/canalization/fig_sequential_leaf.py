"""
Sources one after the other
===========================

Sources that appear one after the other in a leaf: canals beside the open geometric rule.

On the left every canal becomes a vein, a sink for the next. On the right the same sources are
connected, in the same order, with the vein node that is nearest to them.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scenes import (
    BLUE,
    INK,
    RED,
    draw_lines,
    draw_outline,
    options,
    row_of,
    settle,
    show_all,
    tissue_in,
)

from vasc.domain.tissue import Tissue
from vasc.models.transport import FacilitatedDiffusion
from vasc.render import save
from vasc.streams import Streams

N_SOURCES = 30
FAR, NEAR = 8.0, 3.0
"""Distance of the first source from all veins and sources, and of the last, in D."""


def leaf_ring(length: float) -> NDArray[np.float64]:
    """Give the outline of a leaf that stands on the origin."""
    t = np.linspace(0.0, 1.0, 60)
    width = 0.62 * length * np.sin(np.pi * t**0.75) ** 0.9 / 2.0 + 0.03 * length * (1 - t)
    right = np.stack([width, length * t], axis=1)
    return np.vstack([right, (right * [-1.0, 1.0])[-2::-1]])


def thrown(tissue: Tissue, taken: NDArray[np.int32]) -> list[int]:
    """Throw darts at the leaf, closer and closer to each other."""
    generator = Streams(5, ("darts",))["darts"]
    sources: list[int] = []
    for distance in np.geomspace(FAR, NEAR, N_SOURCES):
        held = tissue.positions[np.concatenate([taken, np.array(sources, dtype=np.int32)])]
        apart = np.linalg.norm(tissue.positions[:, None] - held, axis=2).min(axis=1)
        free = np.flatnonzero(apart >= distance)
        if len(free):
            sources.append(int(generator.choice(free)))
    return sources


def connected(
    tissue: Tissue, midvein: NDArray[np.int32], sources: list[int]
) -> tuple[list[NDArray], list[int]]:
    """Connect each source with the nearest vein cell; gives the lines, and which vein each meets.

    Vein 0 is the midvein, vein k that of the k-th source; nodes are cells, as in canals.
    """
    cells = midvein.copy()
    owners = np.zeros(len(midvein), dtype=int)
    lines, met = [], []
    for number, source in enumerate(sources, start=1):
        apart = np.linalg.norm(tissue.positions[cells] - tissue.positions[source], axis=1)
        nearest = int(apart.argmin())
        line = tissue.positions[[source, cells[nearest]]]
        way = tissue.cells_along(line)
        lines.append(tissue.positions[way])
        met.append(int(owners[nearest]))
        fresh = np.setdiff1d(way, cells)
        cells = np.concatenate([cells, fresh])
        owners = np.concatenate([owners, np.full(len(fresh), number)])
    return lines, met


def main(output: Path, size: int = 34) -> None:
    """Draw the figure; ``size`` is the length of the leaf in cells."""
    tissue = tissue_in(leaf_ring(size))
    midvein = tissue.cells_along(np.array([[0.0, 0.0], [0.0, 0.9 * size]]))
    sources = thrown(tissue, midvein)
    state = settle(
        tissue,
        FacilitatedDiffusion(gain=1e4),
        [midvein],
        sources,
        rounds=np.arange(1, len(sources) + 1),
    )
    network = state.network
    # a canal meets the vein whose node is the parent of its first node
    parents, causes = state.rows("nodes", "parent"), network.causes
    names = {-1: 0} | {k: k + 1 for k in range(len(sources))}
    first = {k: int(np.flatnonzero(causes == k)[0]) for k in range(len(sources)) if k in causes}
    met = {k + 1: names[int(causes[parents[node]])] for k, node in first.items()}
    lines, predicted = connected(tissue, midvein, sources)
    # a source in a cell that a canal has made vein by then has none of its own
    is_same = {k: met[k] == vein for k, vein in enumerate(predicted, start=1) if k in met}

    titles = ["canals", "nearest vein node"]
    figure, axes = row_of(2, (7.0, 5.6), titles)
    for ax in axes:
        draw_outline(ax, tissue)
        draw_lines(ax, [tissue.positions[midvein]], 2.6)
        show_all(ax, tissue)
        for k, same in is_same.items():
            x, y = tissue.positions[sources[k - 1]]
            ax.plot(x, y, "o", color=BLUE if same else RED, ms=4.5, mew=0, zorder=5)
    segments = network.positions[network.segments]
    draw_lines(axes[0], segments[network.causes[network.segments[:, 1]] >= 0], 1.5)
    draw_lines(axes[1], lines, 1.5)
    shares = f"{sum(is_same.values())} of {len(is_same)}"
    figure.supxlabel(
        f"blue: meets the same vein in both ({shares}); red: meets another", fontsize=8, color=INK
    )
    print(f"{tissue.n_cells} cells, {len(first)} canals, same vein {shares}, {state.step} steps")
    save(figure, output)


if __name__ == "__main__":
    asked = options("length of the leaf, in cells", 34)
    main(asked.output, asked.size)
