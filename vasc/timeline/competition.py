"""Competition: which veins a source ever attracted, and which of them reached it."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Ids
from vasc.errors import TimelineError
from vasc.events import EventKind
from vasc.timeline.veins import Veins

BLOCK = 65536
"""Rows of ``perceived`` that are read at a time; the table may be the largest of a file."""


class Recorded(Protocol):
    """What competition needs of a timeline."""

    path: Path

    @property
    def dimensions(self) -> int:
        """2 in the plane, 3 in space."""

    @property
    def records_perceived(self) -> bool:
        """Whether the file holds which nodes each source attracts."""

    @property
    def events(self) -> Mapping[str, NDArray]:
        """Columns of the events."""

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table."""

    def table(self, name: str, column: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Read rows of a column."""


def competitors(timeline: Recorded, veins: Veins, source: int | None = None) -> dict[str, NDArray]:
    """Give the veins that a source, or each source, ever attracted.

    Parameters
    ----------
    timeline : Timeline
        An open timeline; ``perceived`` is read in blocks.
    veins : Veins
        The veins of its nodes.
    source : int, optional
        A source; all if left out.

    Returns
    -------
    dict of str to ndarray of shape (k,)
        One row a source and vein, by source, then by ``first``: ``source``; ``vein``, its
        first node; ``branching_order``; ``first`` and ``last``, the first and the last step at
        which a set with one of its nodes was recorded; ``nodes``, how many of its nodes were
        attracted; ``reached``, true if it, or a branch that it sent toward the source,
        was awaited there, was the nearest when the source died, or joined another
        there. Empty columns for a source that never attracted a vein.

    Raises
    ------
    TimelineError
        If the run does not record what sources perceive, or the source does not exist.
    """
    is_kept = timeline.dimensions == 2 or timeline.n_rows("perceived")
    if not (timeline.records_perceived and is_kept):
        raise TimelineError(
            f"{timeline.path}: does not hold which nodes sources attract; a run with "
            'record.perceived = "veins" does, a stem never'
        )
    n_sources = timeline.n_rows("sources")
    if source is not None and not 0 <= source < n_sources:
        raise TimelineError(f"{timeline.path}: there is no source {source}; there are {n_sources}")
    blocks = list(_perceived(timeline, source))
    steps, sources, nodes = (
        np.concatenate([np.empty(0, dtype=np.int32), *(block[k] for block in blocks)])
        for k in range(3)
    )
    firsts = veins.firsts[nodes]
    pairs, rows = np.unique(np.stack([sources, firsts], axis=1), axis=0, return_inverse=True)
    rows = rows.ravel()
    first, last = np.full(len(pairs), np.iinfo(np.int32).max), np.full(len(pairs), -1)
    np.minimum.at(first, rows, steps)
    np.maximum.at(last, rows, steps)
    distinct = np.unique(np.stack([rows, nodes], axis=1), axis=0)
    order = np.lexsort((pairs[:, 1], first, pairs[:, 0]))
    return {
        "source": pairs[order, 0],
        "vein": pairs[order, 1],
        "branching_order": veins.orders[pairs[order, 1]],
        "first": first[order].astype(np.int32),
        "last": last[order].astype(np.int32),
        "nodes": np.bincount(distinct[:, 0], minlength=len(pairs))[order].astype(np.int32),
        "reached": _reached(timeline, veins, pairs)[order],
    }


def _perceived(timeline: Recorded, source: int | None) -> Iterator[tuple[Ids, Ids, Ids]]:
    """Give the steps, sources and nodes of the rows asked for, block by block."""
    n_rows = timeline.n_rows("perceived")
    for start in range(0, n_rows, BLOCK):
        block = start, min(start + BLOCK, n_rows)
        sources = timeline.table("perceived", "source", *block)
        is_asked = np.ones(len(sources), dtype=bool) if source is None else sources == source
        if is_asked.any():
            columns = (timeline.table("perceived", name, *block) for name in ("step", "node"))
            steps, nodes = (column[is_asked] for column in columns)
            yield steps, sources[is_asked], nodes


def _reached(timeline: Recorded, veins: Veins, pairs: Ids) -> NDArray[np.bool_]:
    """Tell which pairs of a source and a vein met."""
    events, firsts = timeline.events, veins.firsts
    kinds = (EventKind.SOURCE_TAGGED, EventKind.SOURCE_REMOVED)
    is_end = np.isin(events["kind"], kinds) & (events["object"] >= 0)
    is_join = (events["kind"] == EventKind.VEIN_JOINED) & (events["object"] >= 0)
    joined = timeline.table("segments", "nodes")[events["subject"][is_join]]
    sources = np.concatenate([events["subject"][is_end], np.repeat(events["object"][is_join], 2)])
    arrived = firsts[np.concatenate([events["object"][is_end], joined.ravel()])]
    parents, n_nodes = timeline.table("nodes", "parent"), np.int64(len(firsts))
    attracted = pairs[:, 0] * n_nodes + pairs[:, 1]
    is_met = np.zeros(len(pairs), dtype=bool)
    while len(arrived):
        met = sources * n_nodes + arrived
        is_met |= np.isin(attracted, met)
        # a branch that was not attracted itself came from a vein that was
        climbs = ~np.isin(met, attracted) & (parents[arrived] >= 0)
        sources, arrived = sources[climbs], firsts[parents[arrived[climbs]]]
    return is_met
