"""Which veins a reached source still waits for (Runions 2008, section 4.3)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import unowned
from vasc.kernels.perceived import MAX_MEMBERS, Perceived


class Tags(NamedTuple):
    """Per source (row = source id): the nodes tagged when the first vein came near."""

    step: NDArray[np.int32]
    """Step of tagging, -1 while untagged, shape (capacity,)."""
    nodes: NDArray[np.int32]
    """The tagged nodes, shape (capacity, 8)."""
    n_nodes: NDArray[np.int8]
    """How many there are, shape (capacity,)."""


def tags(capacity: int) -> Tags:
    """Make room for the tags of ``capacity`` sources."""
    return Tags(
        step=np.full(capacity, -1, dtype=np.int32),
        nodes=np.full((capacity, MAX_MEMBERS), -1, dtype=np.int32),
        n_nodes=np.zeros(capacity, dtype=np.int8),
    )


@unowned
def is_tagged(
    tags: Tags, s: int, v: int, parents: NDArray[np.int32], births: NDArray[np.int32]
) -> bool:
    """Tell whether node v is, or descends from, a node tagged by source s.

    Descendants inherit the tag: the first ancestor (or v itself) that is older
    than the tagging decides.
    """
    while v >= 0 and births[v] >= tags.step[s]:
        v = parents[v]
    for k in range(tags.n_nodes[s]):
        if tags.nodes[s, k] == v:
            return True
    return False


@unowned
def is_pulled(
    tags: Tags,
    perceived: Perceived,
    s: int,
    k: int,
    parents: NDArray[np.int32],
    births: NDArray[np.int32],
    kill: float,
    influence: float,
) -> bool:
    """Tell whether source s pulls its k-th perceiving node.

    It does from the kill distance to the influence radius (both squared), and
    once tagged only the lineages it waits for.
    """
    distance = perceived.distances[s, k]
    if distance <= kill or distance > influence:
        return False
    if tags.step[s] < 0:
        return True
    return is_tagged(tags, s, perceived.members[s, k], parents, births)


@unowned
def retag(
    tags: Tags,
    steps: NDArray[np.int32],
    sources: NDArray[np.int32],
    nodes: NDArray[np.int32],
) -> None:
    """Put recorded tags back: row by row, a step, a source and a node it tagged."""
    for row in range(len(steps)):
        s = sources[row]
        tags.step[s] = steps[row]
        tags.nodes[s, tags.n_nodes[s]] = nodes[row]
        tags.n_nodes[s] += 1
