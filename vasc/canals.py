"""Canals: the tissue between sources and veins that strands differentiate along."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Codes, Ids, Points
from vasc.events import EventKind
from vasc.network import Origin
from vasc.states import CanalState, Kind


@dataclass(frozen=True)
class CanalSet:
    """The canals at one step, those that have become vein or were arrested as well.

    Parameters
    ----------
    ids : ndarray of shape (c,), int32
        Rows of the perceived table, ascending.
    sources : ndarray of shape (c,), int32
        The source each canal begins at.
    source_positions : ndarray of shape (c, 2), float64
        Where these sources are at this step, or would be had no vein drained them.
    nodes : ndarray of shape (c,), int32
        The vein node each leads to at this step: refinement may have replaced the
        one it led to when its source was born. It is followed no further once
        the canal is vein or arrested.
    states : ndarray of shape (c,), int8
        Values of :class:`vasc.states.CanalState`.
    tips : ndarray of shape (c,), int32
        The node at the end of the strand of each, -1 if none has begun yet.
    strands : ndarray of shape (n,), int32
        For every node of the network the canal whose strand made it, -1 if none did.
    """

    ids: Ids
    sources: Ids
    source_positions: Points
    nodes: Ids
    states: Codes
    tips: Ids
    strands: Ids

    @property
    def n_canals(self) -> int:
        """Number of canals."""
        return len(self.ids)


NO_CANALS = CanalSet(
    ids=np.empty(0, dtype=np.int32),
    sources=np.empty(0, dtype=np.int32),
    source_positions=np.empty((0, 2)),
    nodes=np.empty(0, dtype=np.int32),
    states=np.empty(0, dtype=np.int8),
    tips=np.empty(0, dtype=np.int32),
    strands=np.empty(0, dtype=np.int32),
)
"""The canals of a model that has none."""

CANAL_TABLES = {
    "perceived": ("source", "node"),
    "states": ("what", "id", "state"),
    "events": ("kind", "subject", "object"),
    "nodes": ("parent", "origin", "source"),
}
"""The tables and columns that tell of canals."""


def canals_from_columns(
    tables: Mapping[str, Mapping[str, NDArray]], source_positions: Points
) -> CanalSet:
    """Give the canals that the first rows of the tables describe.

    Parameters
    ----------
    tables : mapping of str to mapping of str to ndarray
        The columns of ``CANAL_TABLES``, cut to one step.
    source_positions : ndarray of shape (s, 2), float64
        Where all sources are at that step.

    Returns
    -------
    CanalSet
        ``NO_CANALS`` where no state of a canal is recorded.
    """
    perceived, states, events = (tables[name] for name in ("perceived", "states", "events"))
    is_canal = states["what"] == Kind.CANAL
    if not is_canal.any():
        return NO_CANALS
    current = np.full(len(perceived["source"]), NULL, dtype=np.int8)
    # rows are in the order of time, so that the last change of a canal wins
    current[states["id"][is_canal]] = states["state"][is_canal]
    nodes = perceived["node"].copy()
    canals, replacements = _pairs(events, EventKind.CANAL_RETARGETED)
    nodes[canals] = replacements
    ids = np.flatnonzero(current != NULL).astype(np.int32)
    sources = perceived["source"][ids]
    return CanalSet(
        ids=ids,
        sources=sources,
        source_positions=source_positions[sources],
        nodes=nodes[ids],
        states=current[ids],
        tips=_tips(tables["nodes"], events, perceived, current)[ids],
        strands=_strands(tables["nodes"], events),
    )


def _pairs(events: Mapping[str, NDArray], kind: EventKind) -> tuple[Ids, Ids]:
    """Give subjects and objects of all events of a kind, in the order of time."""
    rows = events["kind"] == kind
    return events["subject"][rows], events["object"][rows]


def _tips(
    nodes: Mapping[str, NDArray],
    events: Mapping[str, NDArray],
    perceived: Mapping[str, NDArray],
    current: Codes,
) -> Ids:
    """Give the tip of the strand of each canal."""
    sources = perceived["source"]
    tips = np.full(len(sources), NULL, dtype=np.int32)
    # a strand that has just begun still stands at the vein or drained source it leaves
    is_inbound = current == CanalState.INBOUND
    tips[is_inbound] = perceived["node"][is_inbound]
    became = np.full(int(sources.max(initial=0)) + 1, NULL, dtype=np.int32)
    drained = np.flatnonzero(nodes["origin"] == Origin.SOURCE)
    became[nodes["source"][drained]] = drained
    has_left = np.isin(current, (CanalState.OUTBOUND, CanalState.ARRESTED, CanalState.VEIN))
    tips[has_left] = became[sources[has_left]]
    canals, made = _pairs(events, EventKind.STRAND_EXTENDED)
    tips[canals] = made
    return tips


def _strands(nodes: Mapping[str, NDArray], events: Mapping[str, NDArray]) -> Ids:
    """Give the canal whose strand made each node; nodes of refinement take after their parent."""
    n_nodes = len(nodes["parent"])
    canals, made = _pairs(events, EventKind.STRAND_EXTENDED)
    strands = np.full(n_nodes, NULL, dtype=np.int32)
    # backwards: where a strand went on from a vein it met, that vein keeps its own canal
    strands[made[::-1]] = canals[::-1]
    is_refined = (nodes["origin"] == Origin.REFINEMENT) & (nodes["parent"] != NULL)
    before = np.where(is_refined, nodes["parent"], np.arange(n_nodes))
    while not np.array_equal(farther := before[before], before):
        before = farther
    of_nodes: Ids = strands[before]
    return of_nodes
