"""Arrival: which sources the veins have reached, and which are still awaited."""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled
from vasc.kernels.perceived import Perceived
from vasc.kernels.tags import Tags, is_tagged


@compiled
def reached_first(live: NDArray[np.int32], perceived: Perceived, kill: float) -> NDArray[np.int32]:
    """Give the sources with a node within the kill distance, ascending (open venation)."""
    reached = np.empty(len(live), dtype=np.int32)
    n_reached = 0
    for s in live:
        if perceived.n_members[s] > 0 and perceived.distances[s, 0] <= kill:
            reached[n_reached] = s
            n_reached += 1
    return reached[:n_reached]


@compiled
def tag_and_wait(
    live: NDArray[np.int32],
    perceived: Perceived,
    tags: Tags,
    parents: NDArray[np.int32],
    births: NDArray[np.int32],
    step: int,
    kill: float,
    influence: float,
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Tag the sources that a vein has come near, and find those that wait no more.

    A source whose nearest node is within the kill distance tags the nodes it
    attracted in this step. It is reached when each lineage so tagged is within
    the kill distance, or is no relative neighbour any more (section 4.3), or is
    beyond the influence radius, from where no pull brings it nearer.

    Parameters
    ----------
    live : ndarray of shape (n_live,), int32
        Live sources, ascending.
    perceived, tags : Perceived, Tags
        Of the sources; ``tags`` gains the new ones.
    parents, births : ndarray of shape (capacity,), int32
        Of the nodes.
    step : int
        The step that is being made.
    kill, influence : float
        Squared kill distance and influence radius, in material units.

    Returns
    -------
    tagged, reached : ndarray of int32
        Sources tagged now, and sources that die now; both ascending.
    """
    tagged = np.empty(len(live), dtype=np.int32)
    reached = np.empty(len(live), dtype=np.int32)
    n_tagged = n_reached = 0
    for s in live:
        n_members = perceived.n_members[s]
        if tags.step[s] < 0:
            if n_members == 0 or perceived.distances[s, 0] > kill:
                continue
            tags.step[s] = step
            if perceived.change[s] != 0:
                tags.n_nodes[s] = perceived.n_previous[s]
                tags.nodes[s] = perceived.previous[s]
            else:
                tags.n_nodes[s] = n_members
                tags.nodes[s] = perceived.members[s]
            tagged[n_tagged] = s
            n_tagged += 1
        is_waiting = False
        for k in range(n_members):
            distance = perceived.distances[s, k]
            if kill < distance <= influence and is_tagged(
                tags, s, perceived.members[s, k], parents, births
            ):
                is_waiting = True
                break
        if not is_waiting:
            reached[n_reached] = s
            n_reached += 1
    return tagged[:n_tagged], reached[:n_reached]
