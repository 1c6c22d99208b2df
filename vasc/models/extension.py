"""Extension: every attracted node grows one segment toward its sources."""

from abc import ABC, abstractmethod
from typing import Generic, Literal

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import Ids, Points
from vasc.events import EventKind
from vasc.growth import Growth
from vasc.models.perception import A, Attraction
from vasc.network import Origin, SegmentKind
from vasc.parameters import Parameters, quantity
from vasc.placement import Moment
from vasc.vasculature import Vasculature


class Extension(ABC, Generic[A]):
    """How veins grow by one segment."""

    @abstractmethod
    def extend(self, veins: Vasculature, attraction: A, moment: Moment) -> int:
        """Add the new nodes and their segments; gives their number."""

    @property
    @abstractmethod
    def segment_length(self) -> float:
        """Length of a new segment, D."""


class PulledExtension(Extension[Attraction]):
    """Adds one node to every attracted node, in the mean direction of its sources.

    Parameters
    ----------
    segment_length : float
        Length of a new segment, D.
    bias : tuple of float
        The vector g of equation 3.3.
    stall_rule : bool
        Whether a node whose pulls cancel takes the nearest source (else it can
        livelock: the same child is added for ever).
    """

    def __init__(
        self, segment_length: float, bias: tuple[float, float], *, stall_rule: bool
    ) -> None:
        self._segment_length = segment_length
        self.bias = bias
        self.stall_rule = stall_rule

    @property
    def segment_length(self) -> float:
        """Length of a new segment, D."""
        return self._segment_length

    def extend(self, veins: Vasculature, attraction: Attraction, moment: Moment) -> int:
        """Add the new nodes and their segments; gives their number."""
        parents, places, causes, is_stalled = kernels.extension.children(
            attraction.order,
            attraction.pulls,
            veins.places("nodes"),
            veins.places("sources"),
            self.segment_length / moment.scale,
            self.bias[0],
            self.bias[1],
            self.stall_rule,
        )
        is_allowed = self.allowed(places, moment)
        if not is_allowed.all():
            parents, places = parents[is_allowed], places[is_allowed]
            causes, is_stalled = causes[is_allowed], is_stalled[is_allowed]
        if len(parents):
            self._add(veins, moment, parents, places, causes, is_stalled)
        return len(parents)

    @abstractmethod
    def allowed(self, places: Points, moment: Moment) -> NDArray[np.bool_]:
        """Tell which new nodes may come to be."""

    @staticmethod
    def _add(
        veins: Vasculature,
        moment: Moment,
        parents: Ids,
        places: Points,
        causes: Ids,
        is_stalled: NDArray[np.bool_],
    ) -> None:
        """Append nodes, segments and events."""
        branches = veins.has_child[parents]
        veins.has_child[parents] = True
        material, positions = moment.embed(places, veins.nodes.arrays["material"][parents])
        rows = veins.add_nodes(moment.step, material, positions, parents, causes, Origin.EXTENSION)
        children = np.arange(rows.start, rows.stop, dtype=np.int32)
        veins.add_segments(
            moment.step, np.stack([parents, children], axis=1), SegmentKind.EXTENSION
        )
        if branches.any():
            veins.log(moment.step, EventKind.VEIN_INITIATED, children[branches], parents[branches])
        if is_stalled.any():
            veins.log(
                moment.step, EventKind.STALL_RESOLVED, parents[is_stalled], causes[is_stalled]
            )


class FreeExtension(PulledExtension):
    """An extension that may cross the margin, where the blade is concave."""

    def allowed(self, places: Points, moment: Moment) -> NDArray[np.bool_]:
        """Allow all."""
        return np.ones(len(places), dtype=bool)


class ConfinedExtension(PulledExtension):
    """An extension that never leaves the blade: a node beyond the margin is not made.

    Parameters
    ----------
    growth : Growth
        The growing blade.
    segment_length, bias, stall_rule
        As for :class:`PulledExtension`.
    """

    def __init__(
        self,
        growth: Growth,
        segment_length: float,
        bias: tuple[float, float],
        *,
        stall_rule: bool,
    ) -> None:
        super().__init__(segment_length, bias, stall_rule=stall_rule)
        self.growth = growth

    def allowed(self, places: Points, moment: Moment) -> NDArray[np.bool_]:
        """Tell which new nodes are in the blade."""
        return kernels.polygon.are_inside(moment.outline, places, moment.outline_size)


class ExtensionParameters(Parameters):
    """How veins extend (equations 3.1 and 3.3)."""

    kind: Literal["free", "confined"] = quantity(
        "Whether a vein may cross the margin ('free': it may where the blade is concave) or"
        " not ('confined': it waits until another direction opens).",
        default="free",
    )
    segment_length: float = quantity(
        "Length of a new segment (D); all other lengths are in the same unit.",
        unit="D",
        default=1.0,
        gt=0.0,
    )
    bias: tuple[float, float] = quantity(
        "Constant bias of the direction (vector g of equation 3.3).", default=(0.0, 0.0)
    )
    stall_rule: bool = quantity(
        "Where the pulls on a node cancel, extend toward the nearest source; off, the"
        " literal equation 3.1, which can add the same node for ever.",
        default=True,
    )

    def extension(self, growth: Growth) -> PulledExtension:
        """Give the extension for a growing blade."""
        if self.kind == "confined":
            return ConfinedExtension(
                growth, self.segment_length, self.bias, stall_rule=self.stall_rule
            )
        return FreeExtension(self.segment_length, self.bias, stall_rule=self.stall_rule)
