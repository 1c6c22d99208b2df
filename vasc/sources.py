"""Auxin sources: where they are, when they appeared, what became of them."""

from dataclasses import dataclass
from enum import IntEnum

from vasc.arrays import Codes, Column, Ids, Points, Steps


class Cause(IntEnum):
    """Why a source appeared."""

    DART = 0
    GIVEN = 1
    SPACE = 2
    """Centre of the largest empty circle, within the blade."""
    MARGIN = 3
    """Centre of the largest empty circle, on the margin."""
    PRIMORDIUM = 4
    """A leaf primordium, at the tip of a stem."""


SOURCE_COLUMNS = {
    "birth": Column("i4", "step of birth"),
    "cause": Column(
        "i1", "0 dart, 1 given, 2 largest empty circle, 3 the same, on the margin, 4 primordium"
    ),
    "position": Column("f8", "position at birth", unit="length", shape=(2,)),
    "material": Column("f8", "material coordinates", unit="length", shape=(2,)),
}

PERCEIVED_COLUMNS = {
    "step": Column("i4", "step at whose end the set holds"),
    "source": Column("i4", "source whose set of perceiving nodes changed"),
    "node": Column("i4", "one node of the new set, nearest first"),
}


@dataclass(frozen=True)
class SourceSet:
    """The sources alive at one step.

    Parameters
    ----------
    ids : ndarray of shape (s,), int32
        Rows of the sources table, ascending.
    positions : ndarray of shape (s, d), float64
        Where they are at this step.
    births : ndarray of shape (s,), int32
        Steps of birth.
    states : ndarray of shape (s,), int8
        Values of :class:`vasc.states.SourceState`, never ``DRAINED``.
    """

    ids: Ids
    positions: Points
    births: Steps
    states: Codes

    @property
    def n_sources(self) -> int:
        """Number of live sources."""
        return len(self.ids)
