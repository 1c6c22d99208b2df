"""Pipes added up from the veinlets to the base (Murray's law)."""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ids = NDArray[np.int32]

FEW = 20_000
"""Segments up to which the compiled loop would take longer to load than it saves."""


def add_pipes(proximal: Ids, distal: Ids, n_parents: Ids, amounts: Floats) -> Floats:
    """Add to every node what its children send; give what every segment carries.

    Parameters
    ----------
    proximal, distal : ndarray of shape (m,), int32
        Ends of the segments, sorted so that a node appears as ``distal`` only
        after every segment in which it is ``proximal``.
    n_parents : ndarray of shape (n,), int32
        How often each node is ``distal``: it sends an equal share to each parent.
    amounts : ndarray of shape (n,), float64
        In: what begins at each node. Out: what passes through it.

    Returns
    -------
    ndarray of shape (m,), float64
        What each segment carries, in the order given.
    """
    carried = np.empty(len(proximal))
    walk = _walk if len(proximal) < FEW else _compiled_walk()
    walk(proximal, distal, n_parents, amounts, carried)
    return carried


def _walk(proximal: Ids, distal: Ids, n_parents: Ids, amounts: Floats, carried: Floats) -> None:
    """Send shares along the segments, one after the other."""
    for row in range(len(proximal)):
        carried[row] = amounts[distal[row]] / n_parents[distal[row]]
        amounts[proximal[row]] += carried[row]


@cache
def _compiled_walk() -> Callable[[Ids, Ids, Ids, Floats, Floats], None]:
    """Compile the walk; numba is loaded only now."""
    from numba import njit

    compiled: Callable[[Ids, Ids, Ids, Floats, Floats], None] = njit(cache=True)(_walk)
    return compiled
