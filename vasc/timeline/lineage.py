"""Lineage: who descends from whom, what a source caused, and what became of it."""

from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids
from vasc.errors import TimelineError
from vasc.notebook import card
from vasc.timeline import competition, vein_loops, veins
from vasc.timeline.areole_lineage import AreoleFate, areole_fate
from vasc.timeline.competition import competitors
from vasc.timeline.frame import require
from vasc.timeline.genealogy import Genealogy, Loops
from vasc.timeline.life_table import MedianLife, life_table, median_life
from vasc.timeline.place_history import PlaceHistory, history_at
from vasc.timeline.run_genealogy import genealogy_of
from vasc.timeline.source_fates import Fate, SourceFate, fate_columns, fate_table, source_fate
from vasc.timeline.vein_loops import VeinLoop, loop_of
from vasc.timeline.veins import Veins, births, births_by_order, veins_of


class Recorded(vein_loops.Recorded, competition.Recorded, veins.Recorded, Protocol):
    """What lineage needs of a timeline."""

    @property
    def last_step(self) -> int:
        """The last recorded step."""


LINEAGE_TABLES = ("areoles", "births", "births_by_order", "competitors", "fates", "life_table")
"""Names that :meth:`Lineage.table` knows."""


class Lineage:
    """Descent of nodes and fates of sources, over all steps of a timeline.

    Parameters
    ----------
    timeline : Timeline
        An open timeline; columns are read when first needed.
    """

    def __init__(self, timeline: Recorded) -> None:
        self._timeline = timeline

    def __repr__(self) -> str:
        return f"Lineage({str(self._timeline.path)!r})"

    def _repr_html_(self) -> str:
        """Show in a notebook what there is to ask of."""
        rows = self._timeline.n_rows
        facts = {
            "run": lambda: self._timeline.path.name,
            "last step": lambda: self._timeline.last_step,
            "nodes, replaced ones too": lambda: rows("nodes"),
            "sources, removed ones too": lambda: rows("sources"),
            "tables": lambda: ", ".join(LINEAGE_TABLES),
        }
        return card("Lineage", facts, lambda: "")

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
        return source_fate(self._timeline, self.fates, source, self.nodes_of(source))

    @cached_property
    def fates(self) -> dict[str, Ids]:
        """Per source, each of shape (s,), int32: ``birth, tagged, removed, nearest``.

        Steps of birth, of the first tag and of death, and the nearest node at
        death; -1 for what did not happen.
        """
        return fate_columns(self._timeline)

    def fate_table(self) -> dict[str, NDArray]:
        """Give what became of every source: see :func:`vasc.timeline.source_fates.fate_table`."""
        return fate_table(self._timeline, self.fates, self.causes)

    def areole(self, areole: int) -> AreoleFate:
        """Tell where an areole came from, and what became of it.

        Raises
        ------
        TimelineError
            If there is no such areole.
        """
        return areole_fate(self._timeline, self._loops[0], areole)

    def life_table(self) -> dict[str, NDArray]:
        """Give the life table of the sources: see :func:`vasc.timeline.life_table.life_table`.

        Those alive at the last recorded step are censored.
        """
        births, removed = self.fates["birth"], self.fates["removed"]
        return life_table(births, removed, self._timeline.last_step)

    def median_life(self) -> MedianLife:
        """Give the median of the life table: :func:`vasc.timeline.life_table.median_life`."""
        return median_life(self.life_table())

    def at(self, x: float, y: float, step: int = -1) -> PlaceHistory:
        """Tell what is at a place of the blade at a step, and how it came to be.

        Parameters
        ----------
        x, y : float
            The place at that step, in D.
        step : int
            The step, the last one when not given.

        Returns
        -------
        PlaceHistory

        Raises
        ------
        TimelineError
            If the step is not recorded, the run is one of a stem, there is no vein, or the
            place is neither on the blade nor within 1 D of a vein.
        """
        frame = self._timeline.frame(step)
        return history_at(self._timeline, frame, self.veins, self.fates, (x, y))

    @cached_property
    def veins(self) -> Veins:
        """The vein that each node belongs to, and its branching order."""
        return veins_of(self._timeline)

    def births(self, orders: NDArray | None = None) -> dict[str, NDArray]:
        """Give the birth of every vein, in step, time and height, by its order.

        Parameters
        ----------
        orders : ndarray of shape (n,), int, optional
            An order for each node, -1 where it is not known: vein orders, as
            :func:`vasc.analysis.segment_orders.run_node_orders` gives them. Without any,
            the table has branching orders alone.

        Returns
        -------
        dict of str to ndarray
            See :func:`vasc.timeline.veins.births`.

        Raises
        ------
        TimelineError
            If there is not one whole number a node.
        """
        n_nodes = self._timeline.n_rows("nodes")
        if orders is not None:
            orders = np.asarray(orders)
            if orders.shape != (n_nodes,) or orders.dtype.kind != "i":
                raise TimelineError(
                    f"{self._timeline.path}: orders: expected integers of shape ({n_nodes},), "
                    f"one a node, got {orders.dtype} of shape {orders.shape}"
                )
        return births(self._timeline, self.veins, orders)

    def competitors(self, source: int | None = None) -> dict[str, NDArray]:
        """Give the veins that ever competed for a source, or for each.

        Parameters
        ----------
        source : int, optional
            A source; all if left out.

        Returns
        -------
        dict of str to ndarray
            See :func:`vasc.timeline.competition.competitors`.

        Raises
        ------
        TimelineError
            If there is no such source, or the run does not record what sources perceive.
        """
        if source is not None:
            self._check("source", source, self._timeline.n_rows("sources"))
        return competitors(self._timeline, self.veins, source)

    def genealogy(self, step: int = -1) -> Genealogy:
        """Give the genealogy of areoles up to a step, the last one when not given.

        Raises
        ------
        TimelineError
            If the step is not recorded, or the run is one of a stem.
        """
        return genealogy_of(self._timeline, step)[0]

    def loop_of(self, node: int) -> VeinLoop:
        """Tell in which areole the vein of a node grew, and in which first-order loop.

        Raises
        ------
        TimelineError
            If there is no such node, or the run is one of a stem.
        """
        self._check("node", node, self._timeline.n_rows("nodes"))
        return loop_of(self._timeline, self.veins, self._loops, node)

    def table(self, name: str, orders: NDArray | None = None) -> dict[str, NDArray]:
        """Give a table by its name, as columns of numpy.

        Parameters
        ----------
        name : {"areoles", "births", "births_by_order", "competitors", "fates", "life_table"}
            Which.
        orders : ndarray of shape (n,), int, optional
            Orders of nodes for the tables of births, as for :meth:`births`.

        Returns
        -------
        dict of str to ndarray
            Columns of one length; codes as numbers, null as -1.

        Raises
        ------
        TimelineError
            If there is no such table, or the run lacks what it is made of.
        """
        if name not in LINEAGE_TABLES:
            known = ", ".join(LINEAGE_TABLES)
            raise TimelineError(f"there is no table {name!r} of lineage; tables are {known}")
        if name == "areoles":
            return self._loops[0].columns()
        if name == "births_by_order":
            return births_by_order(self.births(orders))
        if name == "births":
            return self.births(orders)
        if name == "competitors":
            return self.competitors()
        return self.fate_table() if name == "fates" else self.life_table()

    def to_pandas(self, name: str, orders: NDArray | None = None) -> Any:
        """Give a table as a ``pandas.DataFrame``; its index is the first column.

        Codes become names, null stays -1.

        Parameters
        ----------
        name : str
            As for :meth:`table`.
        orders : ndarray of shape (n,), int, optional
            As for :meth:`births`.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        TimelineError
            If there is no such table, or the run lacks what it is made of.
        VascError
            If pandas is not installed.
        """
        pandas = require("pandas", "tables")
        columns: dict[str, Any] = dict(self.table(name, orders))
        if "fate" in columns:
            names = [fate.name.lower() for fate in Fate]
            columns["fate"] = pandas.Categorical.from_codes(columns["fate"], names)
        return pandas.DataFrame(columns).set_index(next(iter(columns)))

    @cached_property
    def _loops(self) -> tuple[Genealogy, Loops | None]:
        """The genealogy at the last step, and the areoles beside the veins if they were found."""
        return genealogy_of(self._timeline)

    def _check(self, what: str, row: int, n_rows: int) -> None:
        """Refuse an id that does not exist."""
        if not 0 <= row < n_rows:
            raise TimelineError(
                f"{self._timeline.path}: there is no {what} {row}; ids are 0 to {n_rows - 1}"
            )
