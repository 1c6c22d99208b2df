"""Lineage: who descends from whom, what a source caused, and what became of it."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids
from vasc.errors import TimelineError
from vasc.events import EventKind
from vasc.timeline.areole_lineage import AreoleFate, areole_fate


class Recorded(Protocol):
    """What lineage needs of a timeline."""

    path: Path

    @property
    def events(self) -> Mapping[str, NDArray]:
        """Columns of the events."""

    @property
    def last_step(self) -> int:
        """The last recorded step."""

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table."""

    def table(self, name: str, column: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Read rows of a column."""


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


class Lineage:
    """Descent of nodes and fates of sources, over all steps of a timeline.

    Parameters
    ----------
    timeline : Timeline
        An open timeline; columns are read when first needed.
    """

    def __init__(self, timeline: Recorded) -> None:
        self._timeline = timeline

    @cached_property
    def parents(self) -> Ids:
        """The node each node extends, -1 for a seed; shape (n,)."""
        return self._timeline.table("nodes", "parent")

    @cached_property
    def causes(self) -> Ids:
        """The source that caused each node, -1 if none; shape (n,)."""
        return self._timeline.table("nodes", "source")

    def ancestors(self, node: int) -> Ids:
        """Give the nodes from the parent of ``node`` to its seed, nearest first.

        Raises
        ------
        TimelineError
            If there is no such node, or the parents run in a circle.
        """
        self._check("node", node, len(self.parents))
        found: list[int] = []
        parent = int(self.parents[node])
        while parent != NULL:
            if not 0 <= parent < len(self.parents) or len(found) > len(self.parents):
                raise TimelineError(f"{self._timeline.path}: the parents of node {node} are bad")
            found.append(parent)
            parent = int(self.parents[parent])
        return np.array(found, dtype=np.int32)

    def descendants(self, node: int) -> Ids:
        """Give the nodes that descend from ``node``, ascending, itself left out.

        Raises
        ------
        TimelineError
            If there is no such node.
        """
        self._check("node", node, len(self.parents))
        nobody = len(self.parents)
        # pointers are doubled: round k looks 2^k generations back, so that few are needed
        ahead = np.append(np.where(self.parents == NULL, nobody, self.parents), nobody)
        descends = ahead == node
        for _ in range(nobody.bit_length()):
            descends |= descends[ahead]
            ahead = ahead[ahead]
        return np.flatnonzero(descends[:nobody]).astype(np.int32)

    def source_of(self, node: int) -> int:
        """Give the source that caused a node (the nearest that pulled), -1 if none.

        Raises
        ------
        TimelineError
            If there is no such node.
        """
        self._check("node", node, len(self.causes))
        return int(self.causes[node])

    def nodes_of(self, source: int) -> Ids:
        """Give the nodes a source caused, ascending.

        Raises
        ------
        TimelineError
            If there is no such source.
        """
        self._check("source", source, self._timeline.n_rows("sources"))
        return np.flatnonzero(self.causes == source).astype(np.int32)

    def fate_of(self, source: int) -> SourceFate:
        """Tell what became of a source.

        Raises
        ------
        TimelineError
            If there is no such source.
        """
        nodes = self.nodes_of(source)
        fates, events = self.fates, self._timeline.events
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

    @cached_property
    def fates(self) -> dict[str, Ids]:
        """Per source, each of shape (s,), int32: ``birth, tagged, removed, nearest``.

        Steps of birth, of the first tag and of death, and the nearest node at
        death; -1 for what did not happen.
        """
        births = self._timeline.table("sources", "birth")
        events = self._timeline.events
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

    def areole(self, areole: int) -> AreoleFate:
        """Tell where an areole came from, and what became of it.

        Raises
        ------
        TimelineError
            If there is no such areole.
        """
        return areole_fate(self._timeline, areole)

    def life_table(self) -> dict[str, NDArray]:
        """Give the life table of the sources: one row an age, in steps since birth.

        Returns
        -------
        dict of str to ndarray
            ``age``; ``at_risk``, sources seen alive up to that age; ``deaths`` at
            that age; ``censored``, sources last seen alive at that age; and
            ``survival``, the share that lives longer (Kaplan and Meier, 1958). Empty
            columns when there is no source.

        References
        ----------
        E. L. Kaplan and P. Meier (1958). Nonparametric estimation from incomplete
        observations. Journal of the American Statistical Association 53, 457-481.
        """
        births, removed = self.fates["birth"], self.fates["removed"]
        is_dead = removed != NULL
        ages = np.where(is_dead, removed, self._timeline.last_step) - births
        n_ages = int(ages.max()) + 1 if ages.size else 0
        deaths = np.bincount(ages[is_dead], minlength=n_ages)
        censored = np.bincount(ages[~is_dead], minlength=n_ages)
        at_risk = len(ages) - np.cumsum(deaths + censored) + deaths + censored
        return {
            "age": np.arange(n_ages),
            "at_risk": at_risk,
            "deaths": deaths,
            "censored": censored,
            "survival": np.cumprod(1.0 - deaths / np.maximum(at_risk, 1)),
        }

    def _check(self, what: str, row: int, n_rows: int) -> None:
        """Refuse an id that does not exist."""
        if not 0 <= row < n_rows:
            raise TimelineError(
                f"{self._timeline.path}: there is no {what} {row}; ids are 0 to {n_rows - 1}"
            )
