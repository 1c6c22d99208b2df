"""A state of a run: how many rows of each append-only table exist, and where things are then."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.areoles import AREOLE_COLUMNS, BOUNDARY_COLUMNS, AreoleSet, areoles_from_columns
from vasc.arrays import Columns, Ids, Points, Table
from vasc.canals import CANAL_TABLES, CanalSet, canals_from_columns
from vasc.domain import Blade
from vasc.domain.tissue import Tissue
from vasc.events import EVENT_COLUMNS, EventKind
from vasc.fields import Fields
from vasc.network import NODE_COLUMNS, SEGMENT_COLUMNS, VeinNetwork
from vasc.pieces import growths_of
from vasc.sources import PERCEIVED_COLUMNS, SOURCE_COLUMNS, SourceSet
from vasc.states import STATE_COLUMNS, Kind, SourceState

TABLE_COLUMNS: dict[str, Columns] = {
    "nodes": NODE_COLUMNS,
    "segments": SEGMENT_COLUMNS,
    "sources": SOURCE_COLUMNS,
    "perceived": PERCEIVED_COLUMNS,
    "states": STATE_COLUMNS,
    "events": EVENT_COLUMNS,
    "areoles": AREOLE_COLUMNS,
    "boundaries": BOUNDARY_COLUMNS,
}
"""The append-only tables of a run in the plane, in the order of ``State.counts``."""
PLACED = ("position", "material")
"""Columns whose rows are points: they have as many numbers as there are dimensions."""

IDENTITY = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def table_columns(dimensions: int) -> dict[str, Columns]:
    """Give the columns of every table of a run in the plane (2) or in space (3)."""
    return {
        table: {
            name: replace(column, shape=(dimensions,)) if name in PLACED else column
            for name, column in columns.items()
        }
        for table, columns in TABLE_COLUMNS.items()
    }


class Past(Protocol):
    """What a model on a tissue must know of earlier steps to go on from a record."""

    def fields(self, step: int) -> Fields:
        """Give the fields of a recorded step."""

    def time(self, step: int) -> float:
        """Give the time of a recorded step."""


class Tables:
    """The append-only tables that all states of one run share.

    Parameters
    ----------
    dimensions : int
        2 for a run in the plane (a leaf), 3 for one in space (a stem).
    tables : dict of str to Table, optional
        Tables of these dimensions by name; empty ones when not given.
    past : Past, optional
        Earlier steps of a tissue, where a run goes on from a record.
    """

    def __init__(
        self,
        dimensions: int = 2,
        tables: dict[str, Table] | None = None,
        past: Past | None = None,
    ) -> None:
        self.dimensions = dimensions
        self.past = past
        self.tables = tables or {
            name: Table(columns) for name, columns in table_columns(dimensions).items()
        }

    def __getitem__(self, name: str) -> Table:
        """Give a table by its name."""
        return self.tables[name]

    def counts(self) -> tuple[int, ...]:
        """Give the rows of every table, in the order of ``TABLE_COLUMNS``."""
        return tuple(table.n_rows for table in self.tables.values())


def affine(scale: float) -> NDArray[np.float64]:
    """Give the (2, 3) map that scales about the origin."""
    return IDENTITY * scale


class Places(NamedTuple):
    """Where everything is at one step of a blade that no affine map moves."""

    nodes: Points
    """Positions of all nodes, retired ones as well, shape (n, 2); row = node id."""
    sources: Points
    """Positions of all sources, drained ones as well, shape (s, 2); row = source id."""
    outline: Points
    """The outline: one ring, of as many points at every step, shape (m, 2)."""


@dataclass(frozen=True)
class State:
    """One moment of a run; a view that copies nothing of what exists.

    Parameters
    ----------
    step : int
        Loop count; 0 is the initial state.
    time : float
        Model time: in steps, to which ``[units]`` gives a duration; on a tissue in the
        unit of the model, as turnover times of a wall.
    blade : Blade or None
        The blade at this time, in real size; None for a stem.
    motion : ndarray of shape (2, 3), float64, or None
        Affine map from material coordinates to positions at this time; None where
        there is none: ``places`` tell the positions, or nothing ever moves.
    outline_motion : ndarray of shape (2, 3), float64, or None
        Affine map from the initial outline to the outline at this time, None likewise.
    counts : tuple of int
        Rows of every table that exist at this step (``TABLE_COLUMNS`` order).
    live : ndarray of shape (s,), int32
        Ids of the live sources, ascending.
    tables : Tables
        The shared tables.
    places : Places or None
        Explicit positions; None where ``motion`` tells them. Without either, nothing
        ever moves, and positions are material coordinates.
    index : object
        What the model needs to go on from here.
    is_finished : bool
        True when the model has nothing left to do.
    base_ring : ndarray of shape (k,), int32, or None
        Ids of the nodes of the ring at the base of a stem, in their order around it;
        None for a blade.
    tissue : Tissue or None
        The cells of the blade, the same in all states of a run; None without cells.
    fields : Fields or None
        Auxin and carriers in them at this time; None without cells.
    """

    step: int
    time: float
    blade: Blade | None
    motion: NDArray[np.float64] | None
    outline_motion: NDArray[np.float64] | None
    counts: tuple[int, ...]
    live: Ids
    tables: Tables = field(repr=False)
    places: Places | None = field(repr=False, default=None)
    index: object = field(repr=False, default=None)
    is_finished: bool = False
    base_ring: Ids | None = field(repr=False, default=None)
    tissue: Tissue | None = field(repr=False, default=None)
    fields: Fields | None = field(repr=False, default=None)

    @property
    def dimensions(self) -> int:
        """2 for a run in the plane (a leaf), 3 for one in space (a stem)."""
        return self.tables.dimensions

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table at this step."""
        return self.counts[list(TABLE_COLUMNS).index(table)]

    @property
    def n_vein_nodes(self) -> int:
        """Number of nodes of the veins, without those that refinement has retired."""
        retired = self.rows("events", "kind") == EventKind.NODE_RETIRED
        return self.n_rows("nodes") - int(np.count_nonzero(retired))

    def rows(self, table: str, column: str) -> NDArray:
        """Give a column of a table as it was at this step."""
        return self.tables[table].view(column, 0, self.n_rows(table))

    def positions(self, table: str) -> Points:
        """Give the positions of all nodes or sources at this time, shape (n, d)."""
        return positions(self.places, self.motion, table, self.rows(table, "material"))

    @cached_property
    def network(self) -> VeinNetwork:
        """The vein network at this step, in real size."""
        return network_from_columns(
            {name: self.rows("nodes", name) for name in NODE_COLUMNS},
            {name: self.rows("segments", name) for name in SEGMENT_COLUMNS},
            {name: self.rows("events", name) for name in EVENT_COLUMNS},
            self.positions("nodes"),
        )

    @cached_property
    def sources(self) -> SourceSet:
        """The live sources at this step, in real size."""
        return SourceSet(
            ids=self.live,
            positions=self.positions("sources")[self.live],
            births=self.rows("sources", "birth")[self.live],
            states=source_states(
                {name: self.rows("states", name) for name in STATE_COLUMNS},
                self.n_rows("sources"),
            )[self.live],
        )

    @cached_property
    def areoles(self) -> AreoleSet:
        """The areoles at this step, in real size."""
        return areoles_from_columns(
            {name: self.rows("areoles", name) for name in AREOLE_COLUMNS},
            {name: self.rows("boundaries", name) for name in BOUNDARY_COLUMNS},
            {name: self.rows("events", name) for name in ("kind", "subject")},
            self.positions("nodes"),
        )

    @cached_property
    def canals(self) -> CanalSet:
        """The canals at this step; none in a model without strands."""
        tables = {
            table: {name: self.rows(table, name) for name in columns}
            for table, columns in CANAL_TABLES.items()
        }
        return canals_from_columns(tables, self.positions("sources"))


def positions(
    places: Places | None, motion: NDArray[np.float64] | None, table: str, material: Points
) -> Points:
    """Give the positions of all nodes or sources: explicit, moved or unmoved material points."""
    if places is not None:
        return places.nodes if table == "nodes" else places.sources
    return material if motion is None else moved(material, motion)


def moved(points: Points, motion: NDArray[np.float64]) -> Points:
    """Give the images of points under a (2, 3) affine map, by + and * alone."""
    x, y = points[:, 0], points[:, 1]
    return np.stack([x * a + y * b + c for a, b, c in motion], axis=1)


def network_from_columns(
    nodes: dict[str, NDArray],
    segments: dict[str, NDArray],
    events: dict[str, NDArray],
    positions: Points,
) -> VeinNetwork:
    """Build the network that the first rows of the tables describe.

    Parameters
    ----------
    nodes, segments, events : dict of str to ndarray
        Columns of the tables, cut to one step.
    positions : ndarray of shape (n, d), float64
        Where the nodes are at that step.

    Returns
    -------
    VeinNetwork
        Every node, and the segments not yet replaced by refinement.
    """
    refined = events["subject"][events["kind"] == EventKind.SEGMENT_REFINED]
    is_alive = np.ones(len(segments["birth"]), dtype=bool)
    is_alive[refined] = False
    ids = np.flatnonzero(is_alive).astype(np.int32)
    return VeinNetwork(
        positions=positions,
        parents=nodes["parent"],
        births=nodes["birth"],
        origins=nodes["origin"],
        causes=nodes["source"],
        segments=segments["nodes"][ids],
        segment_ids=ids,
        segment_births=segments["birth"][ids],
        segment_kinds=segments["kind"][ids],
        retired=events["subject"][events["kind"] == EventKind.NODE_RETIRED],
        growths=growths_of(ids, nodes, segments, events),
    )


def source_states(states: dict[str, NDArray], n_sources: int) -> NDArray[np.int8]:
    """Give the state of every source that the first rows of the states table describe."""
    current = np.full(n_sources, SourceState.ACTIVE, dtype=np.int8)
    is_source = states["what"] == Kind.SOURCE
    # rows are in the order of time, so that the last change of a source wins
    current[states["id"][is_source]] = states["state"][is_source]
    return current
