"""Perception: which vein nodes each source attracts."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Generic, Literal, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import NULL, Ids
from vasc.parameters import Parameters, quantity
from vasc.placement import Moment
from vasc.vasculature import Vasculature

A = TypeVar("A")
"""What an extension needs to know of a perception."""


class Cut(NamedTuple):
    """A node that refinement has replaced by two."""

    node: int
    first: int
    second: int


class Perception(ABC, Generic[A]):
    """What nodes perceive of sources."""

    @abstractmethod
    def look(self, veins: Vasculature, n_nodes: int) -> None:
        """Bring what is perceived up to date with the first ``n_nodes`` nodes."""

    @abstractmethod
    def perceive(self, veins: Vasculature, moment: Moment) -> A:
        """Give what veins extend toward in this step."""

    @abstractmethod
    def is_stuck(self, veins: Vasculature) -> bool:
        """Tell whether the next step would do what this one did, if no source dies."""

    @abstractmethod
    def held(self, veins: Vasculature) -> Ids:
        """Give the nodes that refinement must not replace."""

    def follow(self, veins: Vasculature, moment: Moment, cuts: Sequence[Cut]) -> None:
        """Take note of nodes that refinement has replaced; by default nothing."""

    def restore(self, veins: Vasculature) -> None:
        """Put back what the tables tell and :meth:`look` does not find; by default nothing."""


class Attraction(NamedTuple):
    """The pulls on the nodes in one step."""

    pulls: "kernels.extension.Pulls"  # type: ignore[name-defined]
    order: NDArray[np.int64]
    """Rows of ``pulls`` in ascending node id."""


class AttractingPerception(Perception[Attraction]):
    """Keeps, for every source, the set of nodes it attracts.

    Parameters
    ----------
    kill_distance : float
        Nodes nearer than that to a source are not pulled by it, in D.
    influence_radius : float or None
        Nodes farther than that are not pulled; None: no limit, in D.
    """

    def __init__(self, kill_distance: float, influence_radius: float | None) -> None:
        self.kill_distance = kill_distance
        self.influence_radius = np.inf if influence_radius is None else influence_radius
        self._n_nodes = 0
        self._n_sources = 0
        self._n_moves = 0

    @abstractmethod
    def update(self, veins: Vasculature, known: Ids, start: int, stop: int) -> None:
        """Bring the sets of known sources up to date with the nodes ``start`` to ``stop``."""

    @abstractmethod
    def perceive_new(self, veins: Vasculature, born: Ids) -> None:
        """Find the sets of new sources, among the nodes that are in the grid."""

    def look(self, veins: Vasculature, n_nodes: int) -> None:
        """Bring all sets up to date with the first ``n_nodes`` nodes."""
        n_known = int(np.searchsorted(veins.live, self._n_sources))
        if veins.n_moves != self._n_moves:
            self._perceive_again(veins, veins.live[:n_known])
            self._n_moves = veins.n_moves
        elif n_known and n_nodes > self._n_nodes:
            self.update(veins, veins.live[:n_known], self._n_nodes, n_nodes)
        if n_known < len(veins.live):
            self.perceive_new(veins, veins.live[n_known:])
        self._n_nodes, self._n_sources = n_nodes, veins.sources.n_rows

    def _perceive_again(self, veins: Vasculature, known: Ids) -> None:
        """Find the sets of known sources anew, after all distances have changed."""
        if len(known) == 0:
            return
        sets = veins.perceived
        members, change = sets.members[known], sets.change[known]
        previous, n_previous = sets.previous[known], sets.n_previous[known]
        sets.members[known] = NULL
        self.perceive_new(veins, known)
        is_same = (sets.members[known] == members).all(axis=1)
        sets.change[known] = np.where(is_same, change, kernels.perceived.OTHER_VEINS)
        sets.previous[known] = np.where(is_same[:, None], previous, members)
        sets.n_previous[known] = np.where(is_same, n_previous, (members >= 0).sum(axis=1))

    def is_stuck(self, veins: Vasculature) -> bool:
        """Tell whether no set has changed, so that the same nodes would be added again."""
        return not veins.perceived.change[veins.live].any()

    def held(self, veins: Vasculature) -> Ids:
        """Give the nodes that sources attract or wait for."""
        nodes = np.concatenate(
            [veins.perceived.members[veins.live].ravel(), veins.tags.nodes[veins.live].ravel()]
        )
        return np.unique(nodes[nodes >= 0]).astype(np.int32)

    def perceive(self, veins: Vasculature, moment: Moment) -> Attraction:
        """Give the pulls of all sources on the nodes they attract."""
        self.look(veins, veins.nodes.n_rows)
        veins.record_perceived(moment.step)
        veins.reserve_pulls(kernels.perceived.MAX_MEMBERS * len(veins.live))
        n_pulled = kernels.extension.sum_pulls(
            veins.live,
            veins.places("sources"),
            veins.places("nodes"),
            veins.nodes.arrays["parent"],
            veins.nodes.arrays["birth"],
            veins.perceived,
            veins.tags,
            (self.kill_distance / moment.scale) ** 2,
            (self.influence_radius / moment.scale) ** 2,
            veins.rank,
            veins.pulls,
        )
        order = np.argsort(veins.pulls.nodes[:n_pulled], kind="stable")
        return Attraction(veins.pulls, order)


class NearestPerception(AttractingPerception):
    """A source attracts the nearest node (open venation, section 4.2)."""

    def update(self, veins: Vasculature, known: Ids, start: int, stop: int) -> None:
        """Let nearer nodes take over."""
        kernels.nearest.update(
            veins.node_grid,
            veins.places("nodes"),
            veins.nodes.arrays["parent"],
            start,
            stop,
            veins.places("sources"),
            known,
            veins.perceived,
        )

    def perceive_new(self, veins: Vasculature, born: Ids) -> None:
        """Find the nearest nodes."""
        kernels.nearest.perceive_new(
            veins.node_grid,
            veins.places("nodes"),
            veins.places("sources"),
            born,
            veins.perceived,
        )


class RelativePerception(AttractingPerception):
    """A source attracts its relative neighbours (closed venation, equations 4.1 and 4.2)."""

    def update(self, veins: Vasculature, known: Ids, start: int, stop: int) -> None:
        """Let new nodes exclude members and become members."""
        kernels.relative_neighbors.update(
            veins.node_grid,
            veins.places("nodes"),
            veins.nodes.arrays["parent"],
            start,
            stop,
            veins.places("sources"),
            known,
            veins.perceived,
        )

    def perceive_new(self, veins: Vasculature, born: Ids) -> None:
        """Find the relative neighbours."""
        kernels.relative_neighbors.perceive_new(
            veins.node_grid,
            veins.places("nodes"),
            veins.places("sources"),
            born,
            veins.perceived,
        )


class UrquhartPerception(AttractingPerception):
    """A source attracts its Urquhart neighbours, an approximation (section 4.4.2, Figure 4.13)."""

    def __init__(self, kill_distance: float, influence_radius: float | None) -> None:
        super().__init__(kill_distance, influence_radius)
        self._cells = kernels.urquhart.voronoi_cells(0)

    def update(self, veins: Vasculature, known: Ids, start: int, stop: int) -> None:
        """Let new nodes cut the Voronoi cells."""
        self._cells = kernels.urquhart.update(
            veins.places("nodes"),
            veins.nodes.arrays["parent"],
            start,
            stop,
            veins.places("sources"),
            known,
            veins.perceived,
            self._cells,
        )

    def perceive_new(self, veins: Vasculature, born: Ids) -> None:
        """Find Voronoi cells, and the Urquhart neighbours among their neighbours."""
        if len(self._cells.n_corners) < veins.sources.capacity:
            self._cells = kernels.urquhart.enlarged(self._cells, veins.sources.capacity)
        low_x, low_y, high_x, high_y = veins.box
        self._cells = kernels.urquhart.perceive_new(
            veins.node_grid,
            veins.places("nodes"),
            veins.nodes.arrays["parent"],
            veins.places("sources"),
            born,
            veins.perceived,
            self._cells,
            max(high_x - low_x, high_y - low_y),
        )


class PerceptionParameters(Parameters):
    """What all perceptions have in common."""

    influence_radius: float | None = quantity(
        "Nodes farther than this are not attracted (d_I in section 3.1.2); by default there"
        " is no limit.",
        unit="D",
        default=None,
        gt=0.0,
    )


class NearestParameters(PerceptionParameters):
    """Each source attracts the nearest node."""

    kind: Literal["nearest"] = "nearest"

    def perception(self, kill_distance: float) -> AttractingPerception:
        """Give the perception."""
        return NearestPerception(kill_distance, self.influence_radius)


class RelativeParameters(PerceptionParameters):
    """Each source attracts its relative neighbours."""

    kind: Literal["relative"] = "relative"

    def perception(self, kill_distance: float) -> AttractingPerception:
        """Give the perception."""
        return RelativePerception(kill_distance, self.influence_radius)


class UrquhartParameters(PerceptionParameters):
    """Each source attracts its Urquhart neighbours."""

    kind: Literal["urquhart"] = "urquhart"

    def perception(self, kill_distance: float) -> AttractingPerception:
        """Give the perception."""
        return UrquhartPerception(kill_distance, self.influence_radius)
