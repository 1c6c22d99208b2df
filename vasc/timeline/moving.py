"""Where single nodes are at single steps, read without the rest of the steps."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Ids, Points, Steps
from vasc.timeline.access import OpenFile
from vasc.timeline.layout import MOTION, Motion


class Recorded(Protocol):
    """What positions of single nodes need of a timeline."""

    opened: OpenFile

    @property
    def motion(self) -> Motion:
        """How the file tells where everything is at a step."""

    @property
    def frames(self) -> dict[str, NDArray]:
        """Columns of ``frames``."""

    def table(self, name: str, column: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Read rows of a column."""


def positions_at(timeline: Recorded, nodes: Ids, steps: Steps) -> Points:
    """Give where each of some nodes was at a step of its own.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    nodes : ndarray of shape (k,), int32
        Node ids.
    steps : ndarray of shape (k,), int32
        A recorded step for each, not before its birth.

    Returns
    -------
    ndarray of shape (k, d), float64
        Positions, in real size; of shape (0, d) for no nodes.
    """
    if timeline.motion != Motion.EXPLICIT:
        places = timeline.table("nodes", "material")[nodes]
        if timeline.motion == Motion.NONE:
            return places
        maps = timeline.frames["motion"][steps]
        return np.einsum("kij,kj->ki", maps[:, :, :2], places) + maps[:, :, 2]
    # the positions of all nodes at a step follow those at the step before
    begins = np.concatenate([[0], np.cumsum(timeline.frames["n_nodes"])])
    found = np.empty((len(nodes), 2))
    order = np.argsort(steps, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(steps[order])) + 1):
        if not len(rows):
            continue
        first, last = int(nodes[rows].min()), int(nodes[rows].max())
        begin = int(begins[steps[rows[0]]])
        block = timeline.opened.read(f"{MOTION}/nodes", begin + first, begin + last + 1)
        found[rows] = block[nodes[rows] - first]
    return found
