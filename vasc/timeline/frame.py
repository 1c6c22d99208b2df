"""One recorded step: the blade, the veins and the sources as they were then."""

from collections.abc import Callable
from functools import cached_property
from importlib import import_module
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.areoles import AREOLE_COLUMNS, BOUNDARY_COLUMNS, AreoleSet, areoles_from_columns
from vasc.arrays import Points
from vasc.canals import CANAL_TABLES, CanalSet, canals_from_columns
from vasc.domain import Blade, Tissue
from vasc.errors import TimelineError, VascError
from vasc.events import EventKind
from vasc.fields import Fields
from vasc.network import NODE_COLUMNS, Origin, SegmentKind, VeinNetwork
from vasc.notebook import card, picture_of
from vasc.sources import SourceSet
from vasc.state import moved, network_from_columns, positions, source_states
from vasc.states import SourceState
from vasc.timeline.areas import AREOLES_IN_SPACE
from vasc.timeline.layout import Motion


class Recorded(Protocol):
    """What a frame needs of a timeline."""

    @property
    def initial_blade(self) -> Blade:
        """The blade at step 0."""

    @property
    def motion(self) -> Motion:
        """How the file tells where everything is at a step."""

    @property
    def tissue(self) -> Tissue | None:
        """The cells, None in a run without."""

    def fields(self, step: int) -> Fields:
        """Read the fields of a step."""

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
        return f"Frame(step={self.step}, time={self.time:g}, nodes={self.n_vein_nodes})"

    def _repr_html_(self) -> str:
        """Show a small picture in a notebook."""
        return card(f"Frame of step {self.step}", self._facts(), self.picture)

    def _facts(self) -> dict[str, Callable[[], object]]:
        """Give what a notebook shows beside the picture."""
        return {
            "time": lambda: f"{self.time:g}",
            "nodes": lambda: self.network.n_vein_nodes,
            "segments": lambda: self.network.n_segments,
            "live sources": lambda: self.sources.n_sources,
        }

    def picture(self) -> str:
        """Give a small picture of blade and veins, as HTML for a notebook."""
        is_leaf = self._timeline.motion != Motion.NONE
        rings = self.blade.rings if is_leaf else ()
        return picture_of(self.positions, self.network.segments, rings)

    @property
    def motion(self) -> NDArray[np.float64] | None:
        """Affine map from material coordinates to positions, shape (2, 3).

        None where there is none: positions are explicit, or nothing ever moves.
        """
        return self._row.get("motion")

    @property
    def outline_motion(self) -> NDArray[np.float64] | None:
        """Affine map from the outline at step 0 to that of this step, shape (2, 3).

        None where there is none: the outline is explicit, or a stem has none.
        """
        return self._row.get("outline_motion")

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table that existed at this step."""
        return int(self._row[f"n_{table}"])

    @property
    def n_vein_nodes(self) -> int:
        """Number of nodes at this step that refinement has not replaced."""
        retired = int((self.rows("events", "kind") == EventKind.NODE_RETIRED).sum())
        return self.n_rows("nodes") - retired

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
        """The blade at this step, in real size; a stem has none, which is an error."""
        if self._timeline.motion == Motion.EXPLICIT:
            seeds = self.positions[self.rows("nodes", "origin") == Origin.SEED]
            return Blade.sound([self._timeline.places("outline", self.step)], seeds)
        initial, motion = self._timeline.initial_blade, self.outline_motion
        assert motion is not None, "a blade that is not explicit has a map"
        scale = float(motion[0, 0])
        if np.array_equal(motion, [[scale, 0.0, 0.0], [0.0, scale, 0.0]]):
            return initial.scaled(scale)
        rings = [moved(ring, motion) for ring in initial.rings]
        return Blade.from_rings(rings, moved(initial.seeds, motion))

    @property
    def tissue(self) -> Tissue | None:
        """The cells of the blade; None in a run without cells."""
        return self._timeline.tissue

    @cached_property
    def fields(self) -> Fields | None:
        """Auxin and its carriers in the cells and walls at this step; None without cells."""
        return None if self.tissue is None else self._timeline.fields(self.step)

    @cached_property
    def positions(self) -> Points:
        """Where the nodes are at this step, shape (n, d)."""
        return self._positions("nodes")

    @cached_property
    def network(self) -> VeinNetwork:
        """The vein network at this step, in real size."""
        needed = {"parent", "birth", "origin", "source"} & set(NODE_COLUMNS)
        return network_from_columns(
            {name: self.rows("nodes", name) for name in needed},
            {name: self.rows("segments", name) for name in ("nodes", "birth", "kind")},
            {name: self.rows("events", name) for name in ("kind", "subject", "object")},
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
        """The areoles at this step, in real size; areoles in space are an error."""
        if self._timeline.motion == Motion.NONE and self.n_rows("areoles"):
            raise TimelineError(AREOLES_IN_SPACE)
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
            Nodes with ``x, y, birth, origin, parent, source``, in space ``z`` as well; those
            that refinement has replaced are left out. Edges with ``id, vein_birth,
            segment_birth, kind, length``: the step in which the vein there grew, and the one
            in which growth or refinement made this segment.

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
        retired = set(network.retired.tolist())
        for node, (place, birth, origin, parent, source) in enumerate(zip(*columns, strict=True)):
            if node in retired:
                continue
            axes = dict(zip("xyz", place, strict=False))
            kind = Origin(origin).name.lower()
            graph.add_node(node, **axes, birth=birth, origin=kind, parent=parent, source=source)
        edges = (
            network.segments.tolist(),
            network.segment_ids.tolist(),
            network.vein_births.tolist(),
            network.segment_births.tolist(),
            network.segment_kinds.tolist(),
            network.lengths.tolist(),
        )
        names = ("id", "vein_birth", "segment_birth", "kind", "length")
        for (start, end), row, grown, birth, code, length in zip(*edges, strict=True):
            values = (row, grown, birth, SegmentKind(code).name.lower(), length)
            graph.add_edge(start, end, **dict(zip(names, values, strict=True)))
        return graph

    def _positions(self, table: str) -> Points:
        """Give where all nodes or sources are at this step."""
        if self._timeline.motion == Motion.EXPLICIT:
            return self._timeline.places(table, self.step)
        return positions(None, self.motion, table, self.rows(table, "material"))


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
