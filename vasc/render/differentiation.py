"""Tissue that is becoming vein: canals of the pattern before it, strands and where they end."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.ancestry import Descent
from vasc.analysis.moment import Moment
from vasc.arrays import NULL, Points
from vasc.canals import CanalSet
from vasc.render.styles import SOURCE_STATE_COLORS, STATE_COLORS, Key, Mark
from vasc.states import CanalState

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STRAND_WIDTH = 1.6
"""Width of a strand under way at least, in pt: of less, its colour would not be seen."""
CANAL_WIDTH = 0.9
ARREST_SIZE = 3.2
SOURCE_SIZE = 4.5
"""All in pt."""
UNDER_WAY = {"inbound": CanalState.INBOUND, "outbound": CanalState.OUTBOUND}


def segment_states(canals: CanalSet, directions: Descent) -> NDArray[np.int64]:
    """Tell which segments are vein, and which belong to a strand still under way.

    Parameters
    ----------
    canals : CanalSet
        The canals; there may be none.
    directions : Descent
        The segments of the network.

    Returns
    -------
    ndarray of shape (m,), int64
        Rows of ``STATE_COLORS``: vein, inbound or outbound.
    """
    rows = list(STATE_COLORS)
    states = np.full(len(directions.distal), rows.index("vein"), dtype=np.int64)
    if canals.n_canals == 0:
        return states
    current = np.full(int(canals.ids[-1]) + 1, NULL, dtype=np.int64)
    current[canals.ids] = canals.states
    strands = canals.strands[directions.distal]
    of_segments = np.where(strands == NULL, NULL, current[strands])
    for name, code in UNDER_WAY.items():
        states[of_segments == code] = rows.index(name)
    return states


def undifferentiated(canals: CanalSet, positions: Points) -> NDArray[np.float64]:
    """Give what of every canal is no vein yet, as straight lines.

    Parameters
    ----------
    canals : CanalSet
        The canals; there may be none.
    positions : ndarray of shape (n, 2), float64
        Where the nodes are.

    Returns
    -------
    ndarray of shape (k, 2, 2), float64
        Ends of the lines: from the source to the vein node where no strand has
        begun, else from the tip of the strand to where it grows.
    """
    sources, nodes = canals.source_positions, positions[canals.nodes]
    tips = positions[canals.tips]
    ends = {
        CanalState.PRE_PATTERN: (sources, nodes),
        CanalState.INBOUND: (tips, sources),
        CanalState.OUTBOUND: (tips, nodes),
    }
    return np.concatenate(
        [np.stack(pair, axis=1)[canals.states == state] for state, pair in ends.items()]
    )


def draw_canals(axes: Axes, moment: Moment) -> None:
    """Draw the canals that are no vein yet as dashed lines, and mark arrested strands.

    Parameters
    ----------
    axes : matplotlib Axes
        Where to draw.
    moment : Frame or State
        One step of a run.
    """
    from matplotlib.collections import LineCollection

    canals, positions = moment.canals, moment.network.positions
    axes.add_collection(
        LineCollection(
            list(undifferentiated(canals, positions)),
            colors=STATE_COLORS["pre-pattern"],
            linewidths=CANAL_WIDTH,
            linestyles=(0.0, (2.5, 1.8)),
            zorder=3.0,
        ),
        autolim=False,
    )
    ends = positions[canals.tips[canals.states == CanalState.ARRESTED]]
    axes.plot(
        *ends.T,
        linestyle="none",
        marker="o",
        markersize=ARREST_SIZE,
        markerfacecolor="white",
        markeredgecolor=STATE_COLORS["arrested"],
        markeredgewidth=0.8,
        zorder=3.5,
    )


def state_key(canals: CanalSet) -> Key:
    """Give the key of a picture whose colours tell states of differentiation."""
    colors = STATE_COLORS | {"source": SOURCE_STATE_COLORS["active"]}
    marks = {"pre-pattern": Mark.DASH, "arrested": Mark.RING, "source": Mark.DISC}
    # before the first source nothing but vein is there to be explained
    names = tuple(colors) if canals.n_canals else ("vein",)
    return Key(
        "state",
        names,
        tuple(colors[name] for name in names),
        marks=tuple(marks.get(name, Mark.SQUARE) for name in names),
    )
