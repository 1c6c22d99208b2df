"""What tissue can be: states of nodes, sources and canals, and the changes that are legal."""

from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike

from vasc.arrays import Column


class Kind(IntEnum):
    """What a row of the states table speaks of."""

    NODE = 0
    SOURCE = 1
    CANAL = 2


class SourceState(IntEnum):
    """State of an auxin source."""

    ACTIVE = 0
    """Emits; veins extend toward it."""
    TAGGED = 1
    """A vein has come within the kill distance; the others are awaited."""
    DRAINED = 2
    """Reached by every awaited vein, or by the first in open venation; emits no more."""


class NodeState(IntEnum):
    """State of a vein node."""

    VEIN = 0
    """Differentiated vein."""


class CanalState(IntEnum):
    """State of a canal: the cells between a source and a vein that may become a strand."""

    GROUND = 0
    """Ground tissue; each canal begins in it."""
    PRE_PATTERN = 1
    """Chosen by the pattern that precedes the veins."""
    INBOUND = 2
    """Differentiates from the vein toward the source."""
    OUTBOUND = 3
    """Differentiates from the source toward the vein."""
    VEIN = 4
    """Differentiated vein from end to end."""
    ARRESTED = 5
    """Differentiates no further; its strand ends blindly."""


TRANSITIONS: dict[Kind, frozenset[tuple[int, int]]] = {
    Kind.SOURCE: frozenset(
        {
            (SourceState.ACTIVE, SourceState.TAGGED),
            (SourceState.ACTIVE, SourceState.DRAINED),
            (SourceState.TAGGED, SourceState.DRAINED),
        }
    ),
    Kind.NODE: frozenset(),
    Kind.CANAL: frozenset(
        {
            (CanalState.GROUND, CanalState.PRE_PATTERN),
            (CanalState.PRE_PATTERN, CanalState.INBOUND),
            (CanalState.PRE_PATTERN, CanalState.OUTBOUND),
            (CanalState.INBOUND, CanalState.VEIN),
            (CanalState.OUTBOUND, CanalState.VEIN),
            (CanalState.OUTBOUND, CanalState.ARRESTED),
        }
    ),
}
"""Legal changes (from, to) of each kind; a birth in the first state is no change."""

FIRST: dict[Kind, IntEnum] = {
    Kind.NODE: NodeState.VEIN,
    Kind.SOURCE: SourceState.ACTIVE,
    Kind.CANAL: CanalState.GROUND,
}
"""The state that each kind is born in."""

STATE_COLUMNS = {
    "step": Column("i4", "step of the change"),
    "what": Column("i1", "0 node, 1 source, 2 canal"),
    "id": Column("i4", "row of the node or source, or of the canal in perceived"),
    "state": Column("i1", "new state"),
}


def check_transitions(kind: Kind, before: ArrayLike, after: ArrayLike) -> None:
    """Make sure that changes of state are legal.

    Parameters
    ----------
    kind : Kind
        What changes.
    before, after : array_like of int
        The states of each before and after, of shapes that broadcast.

    Raises
    ------
    AssertionError
        If a change is not among ``TRANSITIONS``; a model that makes one is wrong.

    Examples
    --------
    >>> check_transitions(Kind.CANAL, CanalState.PRE_PATTERN, [2, 3])
    """
    pairs = np.stack(np.broadcast_arrays(before, after), axis=-1).reshape(-1, 2)
    for old, new in np.unique(pairs, axis=0).tolist():
        if (old, new) not in TRANSITIONS[kind]:
            # not by an assert statement, which python -O leaves out
            raise AssertionError(f"no {kind.name.lower()} may change from state {old} to {new}")
