"""One recorded step: the blade, the veins and the sources as they were then."""

from functools import cached_property
from importlib import import_module
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.areoles import AREOLE_COLUMNS, BOUNDARY_COLUMNS, AreoleSet, areoles_from_columns
from vasc.arrays import Points
from vasc.canals import CANAL_TABLES, CanalSet, canals_from_columns
from vasc.domain import Blade
from vasc.errors import VascError
from vasc.network import NODE_COLUMNS, Origin, SegmentKind, VeinNetwork
from vasc.sources import SourceSet
from vasc.state import moved, network_from_columns, source_states
from vasc.states import SourceState


class Recorded(Protocol):
    """What a frame needs of a timeline."""

    @property
    def initial_blade(self) -> Blade:
        """The blade at step 0."""

    def table(self, name: str, column: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Read rows of a column."""

    def places(self, name: str, step: int) -> Points:
        """Read explicit positions of a step."""


class Frame:
    """One recorded step of a timeline; its parts are read when asked for.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    step : int
        The step, at least 0.
    row : dict of str to scalar or ndarray
        The row of ``frames``.
    """

    def __init__(self, timeline: Recorded, step: int, row: dict[str, Any]) -> None:
        self._timeline = timeline
        self._row = row
        self.step = step
        self.time = float(row["time"])

    def __repr__(self) -> str:
        return f"Frame(step={self.step}, time={self.time:g}, nodes={self.n_rows('nodes')})"

    @property
    def motion(self) -> NDArray[np.float64] | None:
        """Affine map from material coordinates to positions, shape (2, 3).

        None where there is none, and the positions are explicit.
        """
        return self._row.get("motion")

    @property
    def outline_motion(self) -> NDArray[np.float64] | None:
        """Affine map from the outline at step 0 to that of this step, shape (2, 3).

        None where there is none, and the outline is explicit.
        """
        return self._row.get("outline_motion")

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table that existed at this step."""
        return int(self._row[f"n_{table}"])

    def rows(self, table: str, column: str) -> NDArray:
        """Give a column of a table as it was at this step.

        Raises
        ------
        TimelineError
            If the rows cannot be read.
        """
        return self._timeline.table(table, column, 0, self.n_rows(table))

    @cached_property
    def blade(self) -> Blade:
        """The blade at this step, in real size."""
        motion = self.outline_motion
        if motion is None:
            seeds = self.positions[self.rows("nodes", "origin") == Origin.SEED]
            return Blade.sound([self._timeline.places("outline", self.step)], seeds)
        initial = self._timeline.initial_blade
        scale = float(motion[0, 0])
        if np.array_equal(motion, [[scale, 0.0, 0.0], [0.0, scale, 0.0]]):
            return initial.scaled(scale)
        rings = [moved(ring, motion) for ring in initial.rings]
        return Blade.from_rings(rings, moved(initial.seeds, motion))

    @cached_property
    def positions(self) -> Points:
        """Where the nodes are at this step, shape (n, 2)."""
        return self._positions("nodes")

    @cached_property
    def network(self) -> VeinNetwork:
        """The vein network at this step, in real size."""
        needed = {"parent", "birth", "origin", "source"} & set(NODE_COLUMNS)
        return network_from_columns(
            {name: self.rows("nodes", name) for name in needed},
            {name: self.rows("segments", name) for name in ("nodes", "birth", "kind")},
            {name: self.rows("events", name) for name in ("kind", "subject")},
            self.positions,
        )

    @cached_property
    def sources(self) -> SourceSet:
        """The live sources at this step, in real size."""
        states = source_states(
            {name: self.rows("states", name) for name in ("what", "id", "state")},
            self.n_rows("sources"),
        )
        ids = np.flatnonzero(states != SourceState.DRAINED).astype(np.int32)
        return SourceSet(
            ids=ids,
            positions=self._positions("sources")[ids],
            births=self.rows("sources", "birth")[ids],
            states=states[ids],
        )

    @cached_property
    def areoles(self) -> AreoleSet:
        """The areoles at this step, in real size."""
        return areoles_from_columns(
            {name: self.rows("areoles", name) for name in AREOLE_COLUMNS},
            {name: self.rows("boundaries", name) for name in BOUNDARY_COLUMNS},
            {name: self.rows("events", name) for name in ("kind", "subject")},
            self.positions,
        )

    @cached_property
    def canals(self) -> CanalSet:
        """The canals at this step; none in a model without strands."""
        tables = {
            table: {name: self.rows(table, name) for name in columns}
            for table, columns in CANAL_TABLES.items()
        }
        return canals_from_columns(tables, self._positions("sources"))

    def to_networkx(self) -> Any:
        """Give the vein network as a ``networkx.Graph``.

        Returns
        -------
        networkx.Graph
            Nodes with ``x, y, birth, origin, parent, source``; edges with
            ``id, birth, kind, length``.

        Raises
        ------
        VascError
            If networkx is not installed.
        """
        networkx = require("networkx", "graph")
        network = self.network
        graph = networkx.Graph(step=self.step, time=self.time)
        columns = (
            network.positions.tolist(),
            network.births.tolist(),
            network.origins.tolist(),
            network.parents.tolist(),
            network.causes.tolist(),
        )
        for node, ((x, y), birth, origin, parent, source) in enumerate(zip(*columns, strict=True)):
            kind = Origin(origin).name.lower()
            graph.add_node(node, x=x, y=y, birth=birth, origin=kind, parent=parent, source=source)
        edges = (
            network.segments.tolist(),
            network.segment_ids.tolist(),
            network.segment_births.tolist(),
            network.segment_kinds.tolist(),
            network.lengths.tolist(),
        )
        for (start, end), row, birth, code, length in zip(*edges, strict=True):
            kind = SegmentKind(code).name.lower()
            graph.add_edge(start, end, id=row, birth=birth, kind=kind, length=length)
        return graph

    def _positions(self, table: str) -> Points:
        """Give where all nodes or sources are at this step."""
        if self.motion is None:
            return self._timeline.places(table, self.step)
        return moved(self.rows(table, "material"), self.motion)


def require(package: str, extra: str) -> Any:
    """Import an optional package.

    Raises
    ------
    VascError
        If it is not installed; the message names the extra that brings it.
    """
    try:
        return import_module(package)
    except ImportError as error:
        raise VascError(
            f'{package} is not installed; pip install "vasc[{extra}]" brings it'
        ) from error
