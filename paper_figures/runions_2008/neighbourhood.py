"""Which nodes a source attracts, asked of the model itself."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from panels import given, grown, rectangle

ROOM = 100.0


def attracted(nodes: NDArray, source: NDArray, perception: str = "relative") -> set[int]:
    """Give the numbers of the nodes that a source attracts in the first step.

    Parameters
    ----------
    nodes : ndarray of shape (n, 2), float64
        Vein nodes, in D, within a hundred of the origin.
    source : ndarray of shape (2,), float64
        The only source.
    perception : {"relative", "urquhart"}
        Which neighbourhood.

    Returns
    -------
    set of int
        Rows of ``nodes``, as the record of the run tells them.
    """
    states = grown(
        "closed",
        domain=rectangle(-ROOM, -ROOM, ROOM, ROOM) | {"seeds": (nodes / ROOM).tolist()},
        placement=given([source]),
        perception={"kind": perception},
        arrival={"kill_distance": 1.0},
        record={"perceived": "nodes"},
        stop={"steps": 1},
    )
    is_first = states[1].rows("perceived", "step") == 1
    return set(np.asarray(states[1].rows("perceived", "node"))[is_first].tolist())
