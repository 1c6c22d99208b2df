"""Components: what hangs together by pairs."""

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Ids


def component_labels(pairs: NDArray[np.integer], size: int) -> Ids:
    """Give everything the number of the component that pairs connect it with.

    Parameters
    ----------
    pairs : ndarray of shape (m, 2), integer
        Rows of what is connected; the same pair may be there more than once.
    size : int
        How many rows there are.

    Returns
    -------
    ndarray of shape (size,), int32
        Labels 0 ... c-1; what is in no pair is a component of its own.

    Examples
    --------
    >>> component_labels(np.array([[0, 2]]), 4).tolist()
    [0, 1, 0, 2]
    """
    if size == 0:
        return np.zeros(0, dtype=np.int32)
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ones = np.ones(len(pairs), dtype=np.int8)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(size, size))
    labels: Ids = connected_components(graph, directed=False)[1]
    return labels
