"""
How often the nearer sink is reached
====================================

How often a canal reaches the nearer of two sinks, against the ratio q of their distances.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from scenes import BLUE, GREEN, MODELS, ORANGE, options, plot, settle, strand_of

from vasc.domain.voronoi import voronoi
from vasc.render import save
from vasc.streams import Streams
from vasc.validation.canalization.rates import wilson

COLUMNS, ROWS = 19, 13
CLEARANCE = 3.0
"""A source is not nearer to a sink, and two sinks not to each other, in D."""
EDGES = np.array([0.2, 0.5, 0.7, 0.8, 0.9, 1.0])
"""Classes of q."""
COLORS = dict(zip(MODELS, (GREEN, ORANGE, BLUE), strict=True))


def trial(seed: int) -> tuple[float, dict[str, bool]]:
    """Draw a tissue, two sinks and a source; gives q, and which models reach the nearer sink."""
    generator = Streams(seed, ("scene",))["scene"]
    tissue = voronoi(COLUMNS, ROWS, generator)
    while True:
        first, second, source = generator.choice(tissue.n_cells, 3, replace=False).tolist()
        places = tissue.positions[[first, second]]
        apart = np.linalg.norm(places - tissue.positions[source], axis=1)
        if min(*apart, np.linalg.norm(places[1] - places[0])) >= CLEARANCE:
            break
    veins = [np.array([cell], dtype=np.int32) for cell in (first, second)]
    hits = {}
    for name, (transport, background) in MODELS.items():
        state = settle(tissue, transport, veins, [source], background=background)
        hits[name] = strand_of(state, transport, source, veins).main == apart.argmin()
    return float(apart.min() / apart.max()), hits


def draw_rates(ax: Axes, q: np.ndarray, hits: np.ndarray, color: str, shift: float) -> None:
    """Draw the rate of each class of q with its 95 % interval, and how many it counts."""
    classes = np.digitize(q, EDGES[1:-1])
    for number in range(len(EDGES) - 1):
        chosen = hits[classes == number]
        if len(chosen) == 0:
            continue
        rate = chosen.mean()
        low, high = wilson(int(chosen.sum()), len(chosen))
        x = (EDGES[number] + EDGES[number + 1]) / 2.0 + shift
        ax.errorbar(
            x,
            rate,
            [[max(rate - low, 0.0)], [max(high - rate, 0.0)]],
            fmt="o",
            color=color,
            markersize=5,
            capsize=2.5,
        )
        if shift == 0.0:
            ax.text(x, 0.03, f"n = {len(chosen)}", ha="center", fontsize=7, color="#606060")


def main(output: Path, size: int = 60) -> None:
    """Draw the figure from ``size`` trials."""
    trials = [trial(seed) for seed in range(size)]
    q = np.array([one for one, _ in trials])
    figure, ax = plot(
        (5.6, 3.6), "q = distance of the nearer sink / of the farther one", "hit rate"
    )
    for shift, (name, color) in zip((-0.012, 0.0, 0.012), COLORS.items(), strict=True):
        hits = np.array([found[name] for _, found in trials])
        draw_rates(ax, q, hits, color, shift)
        low, high = wilson(int(hits.sum()), len(hits))
        ax.plot([], [], "o", color=color, label=f"{name}: {hits.sum()} of {len(hits)}")
        print(f"{name}: {hits.mean():.2f} [{low:.2f}, {high:.2f}]")
    ax.set(xlim=(0.2, 1.0), ylim=(0.0, 1.04))
    ax.vlines(EDGES[1:-1], 0.0, 1.04, color="#dddddd", linewidth=0.7, zorder=0)
    ax.legend(fontsize=7, loc="lower left", bbox_to_anchor=(0.02, 0.1))
    save(figure, output)


if __name__ == "__main__":
    asked = options("trials", 60)
    main(asked.output, asked.size)
