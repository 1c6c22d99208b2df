"""Perception: which vein nodes each source attracts."""

from abc import ABC, abstractmethod
from types import ModuleType
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.parameters import Parameters, quantity
from vasc.placement import Moment
from vasc.vasculature import Vasculature


class Attraction(NamedTuple):
    """The pulls on the nodes in one step."""

    pulls: "kernels.extension.Pulls"  # type: ignore[name-defined]
    order: NDArray[np.int64]
    """Rows of ``pulls`` in ascending node id."""


class Perception(ABC):
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

    @property
    @abstractmethod
    def kernel(self) -> ModuleType:
        """The kernel with ``perceive_new`` and ``update``."""

    def look(self, veins: Vasculature, n_nodes: int) -> None:
        """Bring what all sources perceive up to date with the first ``n_nodes`` nodes."""
        nodes, sources = veins.material("nodes"), veins.material("sources")
        n_sources = veins.sources.n_rows
        born = np.searchsorted(veins.live, self._n_sources)
        self.kernel.update(
            veins.node_grid,
            nodes,
            veins.nodes.arrays["parent"],
            self._n_nodes,
            n_nodes,
            sources,
            veins.live[:born],
            veins.perceived,
        )
        if born < len(veins.live):
            self.kernel.perceive_new(
                veins.node_grid, nodes, sources, veins.live[born:], veins.perceived
            )
        self._n_nodes, self._n_sources = n_nodes, n_sources

    def perceive(self, veins: Vasculature, moment: Moment) -> Attraction:
        """Give the pulls of all sources on the nodes they attract."""
        self.look(veins, veins.nodes.n_rows)
        veins.record_perceived(moment.step)
        veins.reserve_pulls(kernels.perceived.MAX_MEMBERS * len(veins.live))
        n_pulled = kernels.extension.sum_pulls(
            veins.live,
            veins.material("sources"),
            veins.material("nodes"),
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


class NearestPerception(Perception):
    """A source attracts the nearest node (open venation, section 4.2)."""

    @property
    def kernel(self) -> ModuleType:
        """The kernel of nearest nodes."""
        return kernels.nearest


class RelativePerception(Perception):
    """A source attracts its relative neighbours (closed venation, equations 4.1 and 4.2)."""

    @property
    def kernel(self) -> ModuleType:
        """The kernel of exact relative neighbourhoods."""
        return kernels.relative_neighbors


class UrquhartPerception(Perception):
    """A source attracts its Urquhart neighbours, an approximation (section 4.4.2, Figure 4.13)."""

    @property
    def kernel(self) -> ModuleType:
        """The kernel of Urquhart neighbourhoods."""
        return kernels.urquhart


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

    def perception(self, kill_distance: float) -> Perception:
        """Give the perception."""
        return NearestPerception(kill_distance, self.influence_radius)


class RelativeParameters(PerceptionParameters):
    """Each source attracts its relative neighbours."""

    kind: Literal["relative"] = "relative"

    def perception(self, kill_distance: float) -> Perception:
        """Give the perception."""
        return RelativePerception(kill_distance, self.influence_radius)


class UrquhartParameters(PerceptionParameters):
    """Each source attracts its Urquhart neighbours."""

    kind: Literal["urquhart"] = "urquhart"

    def perception(self, kill_distance: float) -> Perception:
        """Give the perception."""
        return UrquhartPerception(kill_distance, self.influence_radius)
