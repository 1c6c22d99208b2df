"""What tissue can be: states of nodes and sources, and the changes that are legal."""

from enum import IntEnum

from vasc.arrays import Column


class Kind(IntEnum):
    """What a row of the states table speaks of."""

    NODE = 0
    SOURCE = 1


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


TRANSITIONS: dict[Kind, frozenset[tuple[int, int]]] = {
    Kind.SOURCE: frozenset(
        {
            (SourceState.ACTIVE, SourceState.TAGGED),
            (SourceState.ACTIVE, SourceState.DRAINED),
            (SourceState.TAGGED, SourceState.DRAINED),
        }
    ),
    Kind.NODE: frozenset(),
}
"""Legal changes (from, to) of each kind; a birth in the first state is no change."""

STATE_COLUMNS = {
    "step": Column("i4", "step of the change"),
    "what": Column("i1", "0 node, 1 source"),
    "id": Column("i4", "row of the node or source"),
    "state": Column("i1", "new state"),
}
