"""
Many sources, one base
======================

Many sources and one base in a leaf: canals, space colonization, minimum spanning tree.

Lines are as wide as the root of what flows through them, or of the sources that a branch serves.
"""

from pathlib import Path

import numpy as np
from fig_sequential_leaf import leaf_ring
from numpy.typing import NDArray
from scenes import (
    GREEN,
    RED,
    draw_lines,
    draw_outline,
    options,
    ring,
    row_of,
    settle,
    show_all,
    tissue_in,
)

from vasc.analysis.widths import pipes
from vasc.domain.tissue import Tissue
from vasc.models import MODELS
from vasc.models.transport import FacilitatedDiffusion
from vasc.network import VeinNetwork
from vasc.render import save
from vasc.simulation import simulate
from vasc.streams import Streams

N_SOURCES = 30
APART = 3.2
"""Distance between sources, and from the base, in D."""
GAIN = 1e6
"""Gain for the flux of all sources together."""
LEAST = 0.02
"""Flux that is drawn, over that of a source."""
WIDEST = 4.5
"""Line that carries all, in pt."""


def scattered(tissue: Tissue, base: int, seed: int = 2) -> NDArray[np.int32]:
    """Throw sources into a leaf, not near to each other."""
    generator = Streams(seed, ("darts",))["darts"]
    chosen = [base]
    for cell in generator.permutation(tissue.n_cells).tolist():
        apart = tissue.positions[chosen] - tissue.positions[cell]
        if ((apart**2).sum(axis=1) >= APART**2).all():
            chosen.append(cell)
    return np.array(chosen[1 : N_SOURCES + 1], dtype=np.int32)


def colonized(tissue: Tissue, sources: NDArray[np.int32], base: int) -> VeinNetwork:
    """Grow open venation to the same sources, from the same base."""
    points = tissue.blade.rings[0]
    height = float(np.ptp(points[:, 1]))
    parameters = MODELS["open"].model_validate(
        {
            "kind": "open",
            "domain": {
                "points": points.tolist(),
                "length": height,
                "seeds": (tissue.positions[[base]] / height).tolist(),
            },
            "placement": {"kind": "given", "points": tissue.positions[sources].tolist()},
            "arrival": {"kill_distance": 1.0},
        }
    )
    for state in simulate(parameters.model(), Streams(1)):
        last = state
    return last.network


def spanning_tree(points: NDArray) -> tuple[NDArray, NDArray]:
    """Give the minimum spanning tree: edges from point 0 on, and how many points each serves."""
    from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree
    from scipy.spatial.distance import pdist, squareform

    tree = minimum_spanning_tree(squareform(pdist(points)))
    order, parents = breadth_first_order(tree, 0, directed=False)
    served = np.ones(len(points))
    for node in order[:0:-1]:
        served[parents[node]] += served[node]
    return np.stack([parents[order[1:]], order[1:]], axis=1), served[order[1:]]


def main(output: Path, size: int = 34) -> None:
    """Draw the figure; ``size`` is the length of the leaf in cells."""
    tissue = tissue_in(leaf_ring(size))
    base = int(tissue.nearest_cells([(0.0, 0.0)])[0])
    sources = scattered(tissue, base)
    n = len(sources)
    titles = ["canals, all at once", "space colonization", "minimum spanning tree"]
    figure, axes = row_of(3, (7.0, 4.1), titles)
    for ax in axes:
        draw_outline(ax, tissue)
        show_all(ax, tissue)
        x, y = tissue.positions[sources].T
        ax.plot(x, y, "o", color=RED, ms=3.5, mew=0, zorder=5)
        ring(ax, tissue.positions[base], GREEN, 7.0)

    veins = [np.array([base], dtype=np.int32)]
    # walls saturate when all sources flow through them, so that canals gain by joining
    transport = FacilitatedDiffusion(gain=GAIN / n**2, saturation=GAIN)
    state = settle(tissue, transport, veins, sources)
    flux = np.abs(state.fields.flux)
    is_seen = flux >= LEAST
    lines = tissue.positions[tissue.walls[is_seen]]
    draw_lines(axes[0], lines, WIDEST * np.sqrt(np.minimum(flux[is_seen] / n, 1.0)))
    canals = float(tissue.distances[flux >= 0.5].sum())

    network = colonized(tissue, sources, base)
    served = pipes(network).segments
    draw_lines(axes[1], network.positions[network.segments], WIDEST * np.sqrt(served / n))

    points = tissue.positions[np.concatenate([[base], sources])]
    edges, served = spanning_tree(points)
    draw_lines(axes[2], points[edges], WIDEST * np.sqrt(served / n))
    lengths = [canals, float(network.lengths.sum())]
    lengths.append(float(np.linalg.norm(np.diff(points[edges], axis=1)[:, 0], axis=1).sum()))
    for ax, title, length in zip(axes, titles, lengths, strict=True):
        ax.set_title(f"{title}\nlength {length:.0f} D", fontsize=9)
        print(f"{title}: {length:.0f} D")
    print(f"{tissue.n_cells} cells, {n} sources, {state.step} steps")
    save(figure, output)


if __name__ == "__main__":
    asked = options("length of the leaf, in cells", 34)
    main(asked.output, asked.size)
