"""Orders of branches, counted from the base toward the tips."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Ids = NDArray[np.int32]


@njit(cache=True)
def count_turns(proximal: Ids, distal: Ids, is_main: NDArray[np.bool_], orders: Ids) -> None:
    """Give every distal node the order of its proximal one, plus 1 off the main vein.

    Parameters
    ----------
    proximal, distal : ndarray of shape (k,), int32
        Ends of the segments of a forest, sorted so that a node appears as
        ``distal`` before it appears as ``proximal``.
    is_main : ndarray of shape (k,), bool
        Whether the segment continues the vein it springs from.
    orders : ndarray of shape (n,), int32
        In: orders of the roots. Out: orders of all nodes.
    """
    for row in range(len(proximal)):
        orders[distal[row]] = orders[proximal[row]]
        if not is_main[row]:
            orders[distal[row]] += 1
