"""Segments between nodes, with a list of its segments for every node.

A segment has two ends, numbered twice its id and one more. ``newest`` gives the end
of a node's newest segment that lies at the node, ``following`` the next older one.
"""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import unowned


@unowned
def is_joined(
    edges: NDArray[np.int32],
    newest: NDArray[np.int32],
    following: NDArray[np.int32],
    a: int,
    b: int,
) -> bool:
    """Tell whether there is a segment between two nodes."""
    end = newest[a]
    while end >= 0:
        if edges[end >> 1, 1 - (end & 1)] == b:
            return True
        end = following[end]
    return False


@unowned
def join_nodes(
    edges: NDArray[np.int32],
    newest: NDArray[np.int32],
    following: NDArray[np.int32],
    n_edges: int,
    joints: NDArray[np.int32],
) -> int:
    """Join nodes by segments that are not there yet; gives the number of segments."""
    for row in range(len(joints)):
        a, b = joints[row, 0], joints[row, 1]
        if a == b or is_joined(edges, newest, following, a, b):
            continue
        edges[n_edges, 0], edges[n_edges, 1] = a, b
        following[2 * n_edges], following[2 * n_edges + 1] = newest[a], newest[b]
        newest[a], newest[b] = 2 * n_edges, 2 * n_edges + 1
        n_edges += 1
    return n_edges
