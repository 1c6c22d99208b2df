"""
Which sink is reached
=====================

Which of two sinks the canal of a source reaches, for sources all over a tissue.
"""

from pathlib import Path

import numpy as np
from scenes import (
    GREEN,
    INK,
    MODELS,
    draw_cells,
    options,
    ring,
    row_of,
    settle,
    strand_of,
    tissue_in,
)

from vasc.render import save

SINKS = np.array([[4.0, 8.5], [13.0, 4.0]])
BOX = [(0, 0), (18, 0), (18, 12), (0, 12)]
COLORS = ("#f4b183", "#9dc3e6")
"""Of sources whose canal reaches the first sink, and the second."""
DARKER = ("#c55a11", "#1f5fa8")
CLEARANCE = 2.0
"""Sources nearer than that to a sink say nothing, in D."""


def main(output: Path, size: int = 2) -> None:
    """Draw the figure; every ``size``-th cell is a source in turn."""
    tissue = tissue_in(BOX, seed=3)
    veins = [cells[None] for cells in tissue.nearest_cells(SINKS)]
    sinks = tissue.positions[np.concatenate(veins)]
    apart = np.linalg.norm(tissue.positions[:, None] - sinks, axis=2)
    far = np.flatnonzero(apart.min(axis=1) >= CLEARANCE)[::size]
    figure, axes = row_of(3, (7.0, 2.25), list(MODELS))
    for ax, (name, (transport, background)) in zip(axes, MODELS.items(), strict=True):
        colors = np.full(tissue.n_cells, "#f2f2f0", dtype=object)
        n_hits = n_formed = 0
        for source in far.tolist():
            state = settle(tissue, transport, veins, [source], background=background)
            strand = strand_of(state, transport, source, veins)
            is_hit = strand.main == apart[source].argmin()
            colors[source] = (COLORS if is_hit else DARKER)[strand.main]
            n_hits += is_hit
            n_formed += strand.is_formed
        print(f"{name}: {n_hits} of {len(far)} reach the nearest, {n_formed} are strands")
        draw_cells(ax, tissue, colors.tolist())
        draw_bisector(ax, sinks)
        ring(ax, sinks, GREEN, 7.0)
        ax.set_title(f"{name}\n{n_hits} of {len(far)} to the nearest", fontsize=8)
    figure.supxlabel(
        "colour: sink reached; dark: not the nearest; dashed: equally far from both", fontsize=8
    )
    save(figure, output)


def draw_bisector(ax, sinks: np.ndarray) -> None:
    """Draw the line of points equally far from both sinks."""
    middle, along = sinks.mean(axis=0), sinks[1] - sinks[0]
    across = np.array([-along[1], along[0]])
    ends = np.stack([middle - 2 * across, middle + 2 * across])
    left, right, bottom, top = *ax.get_xlim(), *ax.get_ylim()
    ax.plot(*ends.T, color=INK, linewidth=1.2, linestyle=(0, (4, 2)), zorder=5)
    ax.set(xlim=(left, right), ylim=(bottom, top))


if __name__ == "__main__":
    asked = options("every so many cells is a source; 1 for all", 2)
    main(asked.output, asked.size)
