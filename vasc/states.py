"""What tissue can be: states of nodes and sources, and the changes that are legal."""

from enum import IntEnum

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
    """State of the tissue between a source and one of its relative neighbours."""

    GROUND = 0
    """Not differentiated; every canal begins so."""
    PRE_PATTERN = 1
    """A polarized canal, induced by the source."""
    INBOUND = 2
    """Differentiating from the vein toward the source."""
    OUTBOUND = 3
    """Differentiating from the drained source toward the vein."""
    VEIN = 4
    """Differentiated along its whole length."""
    ARRESTED = 5
    """Ended blindly: the last cell stays pre-patterned."""


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


def check_transition(kind: Kind, before: int, after: int) -> None:
    """Assert that a change of state is legal.

    Raises
    ------
    AssertionError
        If it is not: the program is wrong, never its input.
    """
    assert (before, after) in TRANSITIONS[kind], f"{kind.name}: {before} -> {after} is not legal"


STATE_COLUMNS = {
    "step": Column("i4", "step of the change"),
    "what": Column("i1", "0 node, 1 source, 2 canal: a row of perceived"),
    "id": Column("i4", "row of the node, source or canal"),
    "state": Column("i1", "new state"),
}
