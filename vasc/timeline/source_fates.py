"""Fates of sources: when they were born, reached and removed, and by what."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids
from vasc.events import EventKind


class Recorded(Protocol):
    """What the fates of sources need of a timeline."""

    @property
    def events(self) -> Mapping[str, NDArray]:
        """Columns of the events."""

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table."""

    def table(self, name: str, column: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Read rows of a column."""


class Fate(IntEnum):
    """What had become of a source at the last recorded step."""

    ALIVE = 0
    """No vein had come within the kill distance."""
    TAGGED = 1
    """A vein had, and others were awaited."""
    REACHED = 2
    """Removed; its veins did not meet, and none of them ended there blindly."""
    ENDED = 3
    """Removed; a vein ended blindly because of it, though a later one may have grown on."""
    JOINED = 4
    """Veins joined where it was, or is: a primordium of a stem is never removed."""


@dataclass(frozen=True)
class SourceFate:
    """What became of one source.

    Parameters
    ----------
    source : int
        Its id.
    birth : int
        Step of birth.
    tagged : int
        Step at which the first vein came within the kill distance, -1 if none did.
    removed : int
        Step of its death, -1 if it lives.
    nearest : int
        The nearest node when it died, -1 if it lives.
    tags : ndarray of shape (k,), int32
        The nodes it waited for, ascending.
    joins : ndarray of shape (j,), int32
        The segments that joined veins where it was.
    nodes : ndarray of shape (m,), int32
        The nodes it caused, ascending.
    """

    source: int
    birth: int
    tagged: int
    removed: int
    nearest: int
    tags: Ids
    joins: Ids
    nodes: Ids


def fate_columns(timeline: Recorded) -> dict[str, Ids]:
    """Give ``birth, tagged, removed, nearest`` of each source, each of shape (s,), int32.

    Steps of birth, of the first tag and of death, and the nearest node at
    death; -1 for what did not happen.
    """
    births = timeline.table("sources", "birth")
    events = timeline.events
    columns = {"birth": births}
    for name, kind, value in (
        ("tagged", EventKind.SOURCE_TAGGED, "step"),
        ("removed", EventKind.SOURCE_REMOVED, "step"),
        ("nearest", EventKind.SOURCE_REMOVED, "object"),
    ):
        rows = np.flatnonzero(events["kind"] == kind)[::-1]
        # backwards, so that the first event of a source is the one that stays
        columns[name] = np.full(len(births), NULL, dtype=np.int32)
        columns[name][events["subject"][rows]] = events[value][rows]
    return columns


def source_fate(
    timeline: Recorded, fates: Mapping[str, Ids], source: int, nodes: Ids
) -> SourceFate:
    """Tell what became of a source that exists, of which ``nodes`` are known already."""
    events = timeline.events
    of_source = events["subject"] == source
    tags = events["object"][of_source & (events["kind"] == EventKind.SOURCE_TAGGED)]
    is_join = (events["kind"] == EventKind.VEIN_JOINED) & (events["object"] == source)
    return SourceFate(
        source=source,
        birth=int(fates["birth"][source]),
        tagged=int(fates["tagged"][source]),
        removed=int(fates["removed"][source]),
        nearest=int(fates["nearest"][source]),
        tags=np.unique(tags),
        joins=events["subject"][is_join],
        nodes=nodes,
    )


def fate_table(timeline: Recorded, fates: Mapping[str, Ids], causes: Ids) -> dict[str, NDArray]:
    """Give the fate of every source, one row a source.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    fates : mapping of str to ndarray
        Its :func:`fate_columns`.
    causes : ndarray of shape (n,), int32
        The source that caused each node, -1 if none.

    Returns
    -------
    dict of str to ndarray of shape (s,)
        ``source``; ``birth``, ``tagged``, ``removed`` and ``nearest`` as in
        :func:`fate_columns`; ``fate``, a value of :class:`Fate`; ``joins``, ``loops`` and
        ``blind_ends``, how many veins joined, loops were closed and veins ended blindly
        because of it; and ``nodes``, how many it caused.
    """
    n_sources = timeline.n_rows("sources")
    events = timeline.events

    def count(kind: EventKind) -> Ids:
        found = events["object"][(events["kind"] == kind) & (events["object"] >= 0)]
        return np.bincount(found, minlength=n_sources).astype(np.int32)

    joins, blind_ends = count(EventKind.VEIN_JOINED), count(EventKind.VEIN_ENDED_BLINDLY)
    is_removed = fates["removed"] != NULL
    codes = np.where(fates["tagged"] == NULL, Fate.ALIVE, Fate.TAGGED)
    codes[is_removed] = Fate.REACHED
    codes[is_removed & (blind_ends > 0)] = Fate.ENDED
    codes[joins > 0] = Fate.JOINED
    return {
        "source": np.arange(n_sources, dtype=np.int32),
        **fates,
        "fate": codes.astype(np.int8),
        "joins": joins,
        "loops": count(EventKind.LOOP_CLOSED),
        "blind_ends": blind_ends,
        "nodes": np.bincount(causes[causes >= 0], minlength=n_sources).astype(np.int32),
    }
