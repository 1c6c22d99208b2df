"""The nodes, segments and primordia of a stem, as rows of the tables of its run."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import NULL, Ids
from vasc.events import EventKind, StopReason
from vasc.models.stem_perception import StemPerception
from vasc.network import Origin, SegmentKind
from vasc.placement import Phyllotaxis
from vasc.sources import Cause
from vasc.state import Tables

if TYPE_CHECKING:
    from vasc.kernels.stem import Stem

MOST_RING_NODES = 1_000_000
"""Nodes of the ring at most; each takes about 200 bytes, and one segment."""


class StrandRecord:
    """A stem in growth, and its record.

    Parameters
    ----------
    tables : Tables
        Empty tables of three dimensions.
    phyllotaxis : Phyllotaxis
        The primordia.
    stem : Stem
        A stem without nodes, see :mod:`vasc.kernels.stem`.

    Attributes
    ----------
    ring : ndarray of shape (k,), int32
        Ids of the nodes at the base.
    """

    def __init__(
        self,
        tables: Tables,
        phyllotaxis: Phyllotaxis,
        stem: "Stem",
    ) -> None:
        self.tables = tables
        self.phyllotaxis = phyllotaxis
        self.stem = stem
        self.ring: Ids = np.empty(0, dtype=np.int32)
        self._primordia: dict[int, int] = {}
        self._roots: list[int] = []

    def add_ring(self, radius: float, length: float, perception: StemPerception) -> None:
        """Begin with the ring of the hypocotyl: nodes not farther apart than a segment is long.

        Parameters
        ----------
        radius, length : float
            Radius of the ring and length of a segment, in D.
        perception : StemPerception
            Tells the places between which distances are taken.
        """
        positions = kernels.cylinder.ring(radius, length)
        self.stem = kernels.stem.place(self.stem, perception.places(positions), None)
        self.ring = np.arange(len(positions), dtype=np.int32)

    def add_primordia(
        self, step: int, numbers: NDArray[np.intp], perception: StemPerception
    ) -> None:
        """Let primordia appear; each is a source and a node.

        Parameters
        ----------
        step : int
            The step in which they appear.
        numbers : ndarray of shape (k,), integer
            Which primordia, in the order of birth; none if empty.
        perception : StemPerception
            Tells the places between which distances are taken.
        """
        if len(numbers) == 0:
            return
        places = self.phyllotaxis.places[numbers]
        start = self.stem.n_nodes
        self.stem = kernels.stem.place(self.stem, perception.places(places), None)
        rows = self.tables["sources"].append(
            birth=step, cause=Cause.PRIMORDIUM, position=places, material=places
        )
        ids = range(rows.start, rows.stop)
        self._primordia.update(zip(range(start, start + len(numbers)), ids, strict=True))
        self._log(step, EventKind.SOURCE_PLACED, np.array(ids, dtype=np.int32), NULL)

    def write(self, step: int, perception: StemPerception) -> None:
        """Append the rows of the nodes and segments that are not in the tables yet."""
        nodes, segments = self.tables["nodes"], self.tables["segments"]
        first = nodes.n_rows
        fresh = np.arange(first, self.stem.n_nodes)
        parents = self.stem.parents[fresh]
        is_primordium = np.array([node in self._primordia for node in fresh.tolist()], dtype=bool)
        origins = np.where(parents >= 0, Origin.EXTENSION, Origin.SEED)
        origins[is_primordium] = Origin.PRIMORDIUM
        positions = perception.positions(self.stem.positions[fresh])
        nodes.append(
            birth=np.full(len(fresh), step),
            parent=parents,
            origin=origins,
            source=np.full(len(fresh), NULL),
            position=positions,
            material=positions,
        )
        sources = nodes.arrays["source"]
        # a parent is an earlier row
        for node, parent in zip(fresh.tolist(), parents.tolist(), strict=True):
            own = self._primordia.get(node, NULL)
            sources[node] = sources[parent] if parent >= 0 else own
        self._roots.extend(fresh.tolist())
        self._write_segments(step, segments.n_rows)

    def _write_segments(self, step: int, first: int) -> None:
        """Append new segments, and note which of them joined strands and closed loops."""
        ends = self.stem.edges[first : self.stem.n_edges]
        parents = self.stem.parents
        is_extension = parents[ends[:, 1]] == ends[:, 0]
        kinds = np.where(is_extension, SegmentKind.EXTENSION, SegmentKind.JOIN)
        self.tables["segments"].append(nodes=ends, birth=np.full(len(ends), step), kind=kinds)
        sources = self.tables["nodes"].arrays["source"]
        for row, (a, b) in enumerate(ends.tolist(), start=first):
            is_loop = not self._connect(a, b)
            if is_extension[row - first]:
                continue
            source = int(max(sources[a], sources[b]))
            self._log(step, EventKind.VEIN_JOINED, row, source)
            if is_loop:
                self._log(step, EventKind.LOOP_CLOSED, row, source)

    def finish(self, step: int, reason: StopReason) -> None:
        """Note that the run is over."""
        self._log(step, EventKind.RUN_FINISHED, int(reason), NULL)

    def in_tables(self, tables: Tables) -> "StrandRecord":
        """Go on in other tables with the same rows."""
        self.tables = tables
        return self

    def _connect(self, a: int, b: int) -> bool:
        """Note that two nodes are joined; tells whether they were not connected before."""
        first, second = self._root(a), self._root(b)
        self._roots[max(first, second)] = min(first, second)
        return first != second

    def _root(self, node: int) -> int:
        """Give the first node of those a node is connected with, and shorten the way there."""
        while self._roots[node] != node:
            self._roots[node] = self._roots[self._roots[node]]
            node = self._roots[node]
        return node

    def _log(self, step: int, kind: EventKind, subjects: Ids | int, objects: Ids | int) -> None:
        """Append events."""
        self.tables["events"].append(step=step, kind=kind, subject=subjects, object=objects)
