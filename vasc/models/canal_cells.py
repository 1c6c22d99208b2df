"""Veins of a tissue: which cells are veins and sources, and their rows in the tables of a run."""

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Codes, Ids, Points
from vasc.domain import Tissue
from vasc.events import EventKind
from vasc.fields import Role
from vasc.network import Origin, SegmentKind
from vasc.sources import Cause
from vasc.state import Tables
from vasc.states import Kind, SourceState


class CanalCells:
    """Cells that are veins or sources, kept in step with the tables.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    tables : Tables
        Tables of the run: new ones, or those of a record.
    """

    def __init__(self, tissue: Tissue, tables: Tables) -> None:
        self.tissue = tissue
        self.tables = tables
        self.nodes = np.full(tissue.n_cells, NULL, dtype=np.int32)
        """The vein node in each cell, -1 if none."""
        self.nodes[tissue.nearest_cells(tables["nodes"].view("material"))] = np.arange(
            tables["nodes"].n_rows
        )
        self.source_cells: Ids = tissue.nearest_cells(tables["sources"].view("material"))
        """The cell of each source."""
        self.live = self._live()

    @property
    def roles(self) -> Codes:
        """What each cell does, shape (n,)."""
        roles = np.full(self.tissue.n_cells, Role.GROUND, dtype=np.int8)
        roles[self.source_cells[self.live]] = Role.SOURCE
        roles[self.is_vein] = Role.VEIN
        return roles

    @property
    def is_vein(self) -> NDArray[np.bool_]:
        """Which cells are vein, shape (n,)."""
        return self.nodes >= 0

    def add_veins(self, lines: list[Ids]) -> None:
        """Begin with veins along lines of neighboring cells; lines that cross are one vein.

        A line that comes back to its first cell is a closed vein.
        """
        joined = np.zeros((0, 2), dtype=np.int32)
        for line in lines:
            _, first = np.unique(line, return_index=True)
            once = line[np.sort(first)]
            fresh = once[~self.is_vein[once]]
            self._add_nodes(0, fresh, np.full(len(fresh), NULL), Origin.SEED, NULL)
            joined = np.concatenate(
                [joined, np.stack([self.nodes[line[:-1]], self.nodes[line[1:]]], axis=1)]
            )
        # lines that go the same way have their segments once
        _, first = np.unique(np.sort(joined, axis=1), axis=0, return_index=True)
        self._add_segments(0, joined[np.sort(first)], SegmentKind.EXTENSION)

    def add_sources(self, step: int, cells: Ids, cause: Cause) -> None:
        """Let sources appear in cells."""
        places = self.tissue.positions[cells]
        rows = self.tables["sources"].append(
            birth=np.full(len(cells), step), cause=cause, position=places, material=places
        )
        ids = np.arange(rows.start, rows.stop, dtype=np.int32)
        self.source_cells = np.concatenate([self.source_cells, cells]).astype(np.int32)
        self.live = np.concatenate([self.live, ids]).astype(np.int32)
        self.log(step, EventKind.SOURCE_PLACED, ids, NULL)

    def differentiate(self, step: int, source: int, cells: Ids) -> None:
        """Make the canal from a source to a vein a vein; the source emits no more.

        Parameters
        ----------
        step : int
            The step.
        source : int
            The source.
        cells : ndarray of shape (k,), int32
            Cells from the source to a vein, which is the last.
        """
        root = int(self.nodes[cells[-1]])
        fresh = cells[-2::-1]
        first = self.tables["nodes"].n_rows
        ids = np.arange(first, first + len(fresh), dtype=np.int32)
        parents = np.concatenate([[root], ids[:-1]])[: len(fresh)]
        self._add_nodes(step, fresh, parents, Origin.CANAL, source)
        self._add_segments(step, np.stack([parents, ids], axis=1), SegmentKind.EXTENSION)
        if len(fresh):
            self.log(step, EventKind.VEIN_INITIATED, first, root)
        self.live = self.live[self.live != source]
        end = int(self.nodes[cells[0]])
        self.log(step, EventKind.SOURCE_REMOVED, source, end)
        self.tables["states"].append(
            step=step, what=Kind.SOURCE, id=source, state=SourceState.DRAINED
        )

    def extend(self, step: int, parent: int, cell: int) -> None:
        """Let a vein extend by one cell; off a node that has a child already, a vein begins."""
        segments = self.tables["segments"].view("nodes")
        is_branch = bool((self.tables["nodes"].view("parent") == parent).any())
        # the first veins have segments, but no parents
        is_branch |= int((segments == parent).sum()) > 1
        node = self.tables["nodes"].n_rows
        self._add_nodes(step, np.array([cell]), np.array([parent]), Origin.CANAL, NULL)
        self._add_segments(step, np.array([[parent, node]]), SegmentKind.EXTENSION)
        if is_branch:
            self.log(step, EventKind.VEIN_INITIATED, node, parent)

    def join(self, step: int, older: int, newer: int) -> None:
        """Connect two veins, and note the loop if that closes one."""
        is_loop = newer in self.within(older, self.tables["nodes"].n_rows)
        row = self.tables["segments"].n_rows
        self._add_segments(step, np.array([[older, newer]]), SegmentKind.JOIN)
        self.log(step, EventKind.VEIN_JOINED, row)
        if is_loop:
            self.log(step, EventKind.LOOP_CLOSED, row)

    def within(self, node: int, n_segments: int) -> set[int]:
        """Give the nodes that are so many segments or fewer from one, itself included."""
        pairs = self.tables["segments"].view("nodes")
        found = np.array([node])
        for _ in range(n_segments):
            ends = pairs[np.isin(pairs, found).any(axis=1)]
            further = np.union1d(found, ends)
            if len(further) == len(found):
                break
            found = further
        return set(found.tolist())

    def log(self, step: int, kind: EventKind, subject: Ids | int, other: Ids | int = NULL) -> None:
        """Append events."""
        self.tables["events"].append(step=step, kind=kind, subject=subject, object=other)

    def _add_nodes(
        self, step: int, cells: Ids, parents: NDArray, origin: Origin, source: int
    ) -> None:
        """Append vein nodes at the centres of cells."""
        places: Points = self.tissue.positions[cells]
        rows = self.tables["nodes"].append(
            birth=np.full(len(cells), step),
            parent=parents,
            origin=origin,
            source=source,
            position=places,
            material=places,
        )
        self.nodes[cells] = np.arange(rows.start, rows.stop)

    def _add_segments(self, step: int, pairs: Ids, kind: SegmentKind) -> None:
        """Append segments."""
        self.tables["segments"].append(nodes=pairs, birth=np.full(len(pairs), step), kind=kind)

    def _live(self) -> Ids:
        """Give the sources that are not drained."""
        states = self.tables["states"]
        is_end = (states.view("what") == Kind.SOURCE) & (
            states.view("state") == SourceState.DRAINED
        )
        ids = np.arange(self.tables["sources"].n_rows, dtype=np.int32)
        return np.setdiff1d(ids, states.view("id")[is_end]).astype(np.int32)
