"""The veins and sources of one run: append-only tables, and the indexes to search them.

All states of a run share one vasculature; a state is a count of its rows. Only
the models and the parts of their sentence write to it.
"""

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import NULL, Codes, Ids, Points, filled_from
from vasc.events import EventKind
from vasc.network import Origin, SegmentKind
from vasc.sources import Cause
from vasc.state import Places, Tables
from vasc.states import CanalState, Kind, SourceState


class Vasculature:
    """Veins and sources in growth.

    Parameters
    ----------
    tables : Tables
        Empty, or filled with the record of a run that is to go on.
    box : tuple of float
        Box of the blade in material coordinates.
    side : float
        Side of a grid cell, in material units.
    least_change : int
        Which changes of perceived sets are recorded, see :mod:`vasc.kernels.perceived`.

    Attributes
    ----------
    live : ndarray of int32
        Ids of the live sources, ascending; a new array after each change.
    is_live : ndarray of uint8
        Per source: 1 while it lives.
    has_child : ndarray of bool
        Per node: whether a node extends it.
    refined : ndarray of bool
        Per segment: whether finer ones have replaced it.
    trees : ndarray of int32
        Per node: the seed it descends from.
    joins : set of tuple of int
        Pairs (older, newer) of nodes that a join connects.
    merged : dict of int to int
        Seeds whose veins are connected with those of an earlier seed.
    perceived, tags : Perceived, Tags
        Per source: the nodes that perceive it, and the veins it waits for.
    is_retired : ndarray of bool
        Per node: whether refinement has replaced it.
    has_cuts : bool
        Whether any has been.
    n_moves : int
        How often the places of nodes and sources have changed.
    """

    def __init__(
        self,
        tables: Tables,
        box: tuple[float, float, float, float],
        side: float,
        *,
        least_change: int,
    ) -> None:
        self.tables = tables
        self.nodes = tables["nodes"]
        self.segments = tables["segments"]
        self.sources = tables["sources"]
        self.box = box
        self.least_change = least_change
        self.live: Ids = np.empty(0, dtype=np.int32)
        n_nodes, n_sources = self.nodes.capacity, self.sources.capacity
        self.has_child = np.zeros(n_nodes, dtype=bool)
        self.is_retired = np.zeros(n_nodes, dtype=bool)
        self.has_cuts = False
        self.n_moves = 0
        self._moved: dict[str, Points] = {}
        self.refined = np.zeros(self.segments.capacity, dtype=bool)
        self.rank = np.full(n_nodes, NULL, dtype=np.int32)
        self.trees = np.full(n_nodes, NULL, dtype=np.int32)
        self.is_live = np.zeros(n_sources, dtype=np.uint8)
        self.perceived = kernels.perceived.perceived(n_sources)
        self.tags = kernels.tags.tags(n_sources)
        self.joins: set[tuple[int, int]] = set()
        self.merged: dict[int, int] = {}
        self.pulls = kernels.extension.pulls(256)
        self.regrid(side, 0)

    def regrid(self, side: float, n_nodes: int) -> None:
        """Index the first nodes and the live sources anew, in cells of a given side."""
        self.side = side
        grid = kernels.hash_grid
        self.node_grid = grid.hash_grid(self.box, side, self.nodes.capacity)
        self.index_nodes(0, n_nodes)
        self.source_grid = grid.hash_grid(self.box, side, self.sources.capacity)
        grid.insert_chosen(self.source_grid, self.places("sources"), self.live)

    def places(self, table: str) -> Points:
        """Give the whole buffer of places of nodes or sources, between which distances are taken.

        They are material coordinates, or positions once :meth:`move` has told them.
        """
        return self._moved.get(table, self.tables[table].arrays["material"])

    def move(self, nodes: Points, sources: Points) -> None:
        """Give all nodes and sources new places, shapes (n, 2) and (s, 2), and index them anew."""
        for name, places in (("nodes", nodes), ("sources", sources)):
            buffer = np.empty((self.tables[name].capacity, 2))
            buffer[: len(places)] = places
            self._moved[name] = buffer
        self.n_moves += 1
        self.regrid(self.side, self.nodes.n_rows)

    def moved(self, outline: Points) -> Places:
        """Give the places of all nodes and sources as they are now, with an outline."""
        nodes = self._moved["nodes"][: self.nodes.n_rows]
        sources = self._moved["sources"][: self.sources.n_rows]
        for places in (nodes, sources):
            places.flags.writeable = False
        return Places(nodes, sources, outline)

    def retire(self, step: int, nodes: Ids) -> None:
        """Take nodes that refinement has replaced out of the veins."""
        self.is_retired[nodes] = True
        self.has_cuts = True
        self.log(step, EventKind.NODE_RETIRED, nodes, NULL)
        self.regrid(self.side, self.nodes.n_rows)

    def _enlarge_moved(self, table: str) -> None:
        """Make room for as many places as the table has rows."""
        if table in self._moved:
            self._moved[table] = _enlarged(self._moved[table], self.tables[table].capacity, np.nan)

    def reserve_nodes(self, extra: int) -> None:
        """Make room for ``extra`` more nodes in the table and in the indexes."""
        if self.nodes.reserve(extra):
            capacity = self.nodes.capacity
            self.has_child = _enlarged(self.has_child, capacity, False)
            self.rank = _enlarged(self.rank, capacity, NULL)
            self.trees = _enlarged(self.trees, capacity, NULL)
            self.is_retired = _enlarged(self.is_retired, capacity, False)
            self._enlarge_moved("nodes")
            following = _enlarged(self.node_grid.following, capacity, NULL)
            self.node_grid = self.node_grid._replace(following=following)

    def reserve_sources(self, extra: int) -> None:
        """Make room for ``extra`` more sources in the table and in the indexes."""
        if self.sources.reserve(extra):
            capacity = self.sources.capacity
            self.is_live = _enlarged(self.is_live, capacity, 0)
            self._enlarge_moved("sources")
            self.perceived = filled_from(kernels.perceived.perceived(capacity), self.perceived)
            self.tags = filled_from(kernels.tags.tags(capacity), self.tags)
            following = _enlarged(self.source_grid.following, capacity, NULL)
            self.source_grid = self.source_grid._replace(following=following)

    def reserve_pulls(self, n_pairs: int) -> None:
        """Make room for the pulls of ``n_pairs`` source-node pairs."""
        if len(self.pulls.nodes) < n_pairs:
            self.pulls = kernels.extension.pulls(n_pairs + n_pairs // 2)

    def seed(self, material: Points, positions: Points) -> None:
        """Begin with isolated nodes."""
        self.add_nodes(0, material, positions, NULL, NULL, Origin.SEED)

    def restore(self, step: int) -> int:
        """Rebuild everything but the perceived sets from the tables.

        The nodes that veins added in the last step stay out of the grid; the number
        of the others is returned.
        """
        nodes, events = self.nodes, self.tables["events"]
        parents = nodes.view("parent")
        is_halving = nodes.view("origin") == Origin.REFINEMENT
        # a node that halves a join extends no vein: its parent may be a tip still
        self.has_child[parents[(parents >= 0) & ~is_halving]] = True
        self.has_child[: nodes.n_rows][is_halving] = True
        self.trees[: nodes.n_rows] = _roots(parents)
        kinds, subjects = events.view("kind"), events.view("subject")
        self.is_retired[subjects[kinds == EventKind.NODE_RETIRED]] = True
        self.has_cuts = bool(self.is_retired.any())
        self.refined[subjects[kinds == EventKind.SEGMENT_REFINED]] = True
        for row in np.flatnonzero(self.segments.view("kind") == SegmentKind.JOIN).tolist():
            self._connect(tuple(self.segments.view("nodes")[row].tolist()))
        self.is_live[: self.sources.n_rows] = 1
        self.is_live[subjects[kinds == EventKind.SOURCE_REMOVED]] = 0
        self.live = np.flatnonzero(self.is_live).astype(np.int32)
        is_tag = kinds == EventKind.SOURCE_TAGGED
        kernels.tags.retag(
            self.tags, events.view("step")[is_tag], subjects[is_tag], events.view("object")[is_tag]
        )
        born_now = (nodes.view("birth") == step) & (nodes.view("origin") == Origin.EXTENSION)
        n_before = int(np.argmax(born_now)) if born_now.any() else nodes.n_rows
        self.regrid(self.side, n_before)
        return n_before

    def add_nodes(
        self,
        step: int,
        material: Points,
        positions: Points,
        parents: Ids | int,
        causes: Ids | int,
        origin: Origin,
    ) -> slice:
        """Append nodes and index them; the rows they occupy are returned."""
        n_new = len(material)
        self.reserve_nodes(n_new)
        start = self.nodes.n_rows
        rows = slice(start, start + n_new)
        columns = self.nodes.arrays
        columns["birth"][rows] = step
        columns["parent"][rows] = parents
        columns["origin"][rows] = origin
        columns["source"][rows] = causes
        columns["material"][rows] = material
        columns["position"][rows] = positions
        if self._moved:
            self._moved["nodes"][rows] = positions
        self.nodes.n_rows += n_new
        is_seed = origin == Origin.SEED
        self.trees[rows] = np.arange(start, start + n_new) if is_seed else self.trees[parents]
        self.index_nodes(start, start + n_new)
        return rows

    def add_segments(self, step: int, nodes: Ids, kind: SegmentKind) -> slice:
        """Append segments, shape (m, 2), proximal node first; their rows are returned."""
        n_new = len(nodes)
        if self.segments.reserve(n_new):
            self.refined = _enlarged(self.refined, self.segments.capacity, False)
        rows = slice(self.segments.n_rows, self.segments.n_rows + n_new)
        columns = self.segments.arrays
        columns["nodes"][rows] = nodes
        columns["birth"][rows] = step
        columns["kind"][rows] = kind
        self.segments.n_rows += n_new
        return rows

    def new_places(self, n_new: int) -> Points:
        """Give the places in the buffer of the next ``n_new`` sources."""
        return self.places("sources")[self.sources.n_rows : self.sources.n_rows + n_new]

    def add_sources(
        self, step: int, material: Points, positions: Points, causes: Cause | Codes
    ) -> slice:
        """Give birth to sources whose places in the buffer and in the index exist already."""
        n_new = len(material)
        rows = slice(self.sources.n_rows, self.sources.n_rows + n_new)
        columns = self.sources.arrays
        columns["birth"][rows] = step
        columns["cause"][rows] = causes
        columns["material"][rows] = material
        columns["position"][rows] = positions
        if self._moved:
            self._moved["sources"][rows] = positions
        self.sources.n_rows += n_new
        if n_new:
            ids = np.arange(rows.start, rows.stop, dtype=np.int32)
            self.live = np.concatenate([self.live, ids])
            self.log(step, EventKind.SOURCE_PLACED, ids, NULL)
        return rows

    def remove_sources(self, step: int, ids: Ids) -> None:
        """Let sources die; the nearest node of each is named in the event."""
        self.is_live[ids] = 0
        self.live = self.live[self.is_live[self.live] != 0]
        self.log(step, EventKind.SOURCE_REMOVED, ids, self.perceived.members[ids, 0])
        self.log_states(step, ids, SourceState.DRAINED)

    def is_connected(self, older: int, newer: int) -> bool:
        """Tell whether a segment runs between two nodes."""
        if self.has_cuts:
            # a segment may be the outcome of a cut, and parent and child be separated by one
            live = self.segments.view("nodes")[~self.refined[: self.segments.n_rows]]
            return bool(((live == (older, newer)) | (live == (newer, older))).all(axis=1).any())
        parents = self.nodes.arrays["parent"]
        return parents[newer] == older or (older, newer) in self.joins

    def join(self, step: int, pair: tuple[int, int], source: int) -> int:
        """Connect two veins that met, and note the loop if that closes one; gives the segment."""
        row = self.add_segments(step, np.array([pair], dtype=np.int32), SegmentKind.JOIN).start
        self.log(step, EventKind.VEIN_JOINED, row, source)
        if self._connect(pair):
            self.log(step, EventKind.LOOP_CLOSED, row, source)
        return row

    def _connect(self, pair: tuple[int, int]) -> bool:
        """Note that two nodes are joined; tells whether they were connected already."""
        self.joins.add((min(pair), max(pair)))
        older, newer = self._tree(pair[0]), self._tree(pair[1])
        self.merged[max(older, newer)] = min(older, newer)
        return older == newer

    def _tree(self, node: int) -> int:
        """Give the first seed of the veins that a node is connected with."""
        tree = int(self.trees[node])
        while self.merged.get(tree, tree) != tree:
            tree = self.merged[tree]
        return tree

    def log(self, step: int, kind: EventKind, subjects: Ids | int, objects: Ids | int) -> None:
        """Append events; a number is repeated."""
        table = self.tables["events"]
        n_new = len(subjects) if isinstance(subjects, np.ndarray) else 1
        table.reserve(n_new)
        rows = slice(table.n_rows, table.n_rows + n_new)
        table.arrays["step"][rows] = step
        table.arrays["kind"][rows] = kind
        table.arrays["subject"][rows] = subjects
        table.arrays["object"][rows] = objects
        table.n_rows += n_new

    def log_states(
        self, step: int, ids: Ids, state: SourceState | CanalState, what: Kind = Kind.SOURCE
    ) -> None:
        """Append changes of state, of sources unless told otherwise."""
        table = self.tables["states"]
        table.reserve(len(ids))
        rows = slice(table.n_rows, table.n_rows + len(ids))
        table.arrays["step"][rows] = step
        table.arrays["what"][rows] = what
        table.arrays["id"][rows] = ids
        table.arrays["state"][rows] = state
        table.n_rows += len(ids)

    def index_nodes(self, start: int, stop: int) -> None:
        """Put nodes that are in the table into the grid, but for retired ones."""
        grid, places = self.node_grid, self.places("nodes")
        if self.is_retired[start:stop].any():
            ids = np.flatnonzero(~self.is_retired[start:stop]).astype(np.int32) + np.int32(start)
            kernels.hash_grid.insert_chosen(grid, places, ids)
        else:
            kernels.hash_grid.insert(grid, places, start, stop)

    def forget_changes(self) -> None:
        """Count all changes of perceived sets as recorded."""
        self.perceived.change[:] = kernels.perceived.NO_CHANGE

    def record_perceived(self, step: int) -> None:
        """Append the sets of perceiving nodes that changed since they were last appended."""
        table = self.tables["perceived"]
        n_pairs = kernels.perceived.count_changed(self.live, self.perceived, self.least_change)
        table.reserve(n_pairs)
        columns, start = table.arrays, table.n_rows
        kernels.perceived.take_changed(
            self.live,
            self.perceived,
            self.least_change,
            columns["source"],
            columns["node"],
            start,
        )
        columns["step"][start : start + n_pairs] = step
        table.n_rows += n_pairs


def _enlarged(array: NDArray, capacity: int, fill: object) -> NDArray:
    """Give a copy with room for more rows."""
    larger = np.full((capacity, *array.shape[1:]), fill, dtype=array.dtype)
    larger[: len(array)] = array
    return larger


def _roots(parents: Ids) -> Ids:
    """Give the seed that each node descends from, by doubling the steps taken."""
    roots = np.where(parents < 0, np.arange(len(parents)), parents)
    while not np.array_equal(further := roots[roots], roots):
        roots = further
    return roots.astype(np.int32)
