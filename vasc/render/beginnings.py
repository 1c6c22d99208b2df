"""Where veins begin: seeds and the attachment, marked while there is little else to see."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from vasc.analysis.density import vein_length
from vasc.analysis.moment import Moment, blade_of
from vasc.network import Origin
from vasc.render.styles import INK, TEXT_SIZE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

EARLY = 0.1
"""Length of all veins, over that of the blade, below which they do not tell where they begin."""
SEED_COLOR = "#b3261e"
MARK = 7.0
"""Size of a mark, in pt."""


def mark_beginnings(ax: Axes, moment: Moment) -> None:
    """Mark every seed by a ring, and the attachment by a triangle below it, with their names.

    Nothing is marked once veins tell where they begin.

    Parameters
    ----------
    ax : matplotlib Axes
        The leaf, drawn.
    moment : Frame or State
        Its step.
    """
    network = moment.network
    if vein_length(network) >= EARLY * blade_of(moment).length:
        return
    seeds = network.positions[network.origins == Origin.SEED]
    ax.plot(
        *seeds.T,
        linestyle="none",
        marker="o",
        markersize=MARK,
        markerfacecolor="none",
        markeredgecolor=SEED_COLOR,
        markeredgewidth=1.2,
        zorder=6.0,
    )
    # the blade stands on it, at the origin
    ax.plot(0.0, 0.0, marker=_below(), markersize=2.4 * MARK, color=INK, markeredgewidth=0.0)
    names = [("attachment", (0.0, 0.0), (MARK, -MARK), INK)]
    if len(seeds):
        x, y = seeds[np.argmax(seeds[:, 1])].tolist()
        name = "seed" if len(seeds) == 1 else "seeds"
        names.append((name, (x, y), (MARK, MARK), SEED_COLOR))
    for name, place, offset, color in names:
        ax.annotate(
            name,
            place,
            xytext=offset,
            textcoords="offset points",
            fontsize=TEXT_SIZE,
            color=color,
            va="center",
            zorder=6.0,
        )


def _below() -> list[tuple[float, float]]:
    """Give a triangle whose tip touches the place that it marks from below."""
    return [(0.0, 0.0), (-0.7, -1.4), (0.7, -1.4), (0.0, 0.0)]
