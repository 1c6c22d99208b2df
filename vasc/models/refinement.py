"""Refinement: segments that growth has stretched are halved."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Literal

import numpy as np

from vasc.arrays import Ids
from vasc.events import EventKind
from vasc.growth import Growth, Similarity
from vasc.models.perception import Cut
from vasc.network import Origin, SegmentKind
from vasc.parameters import Parameters, quantity
from vasc.placement import Moment
from vasc.streams import Streams
from vasc.vasculature import Vasculature


class Refinement(ABC):
    """Keeps the veins fine enough while the blade grows."""

    @abstractmethod
    def refine(
        self, veins: Vasculature, moment: Moment, held: Ids, streams: Streams
    ) -> Sequence[Cut]:
        """Refine what growth has stretched in this step; gives the nodes that were replaced.

        Nodes that are ``held`` stay.
        """


class NoRefinement(Refinement):
    """Segments stay what they are."""

    def refine(
        self, veins: Vasculature, moment: Moment, held: Ids, streams: Streams
    ) -> Sequence[Cut]:
        """Do nothing."""
        return ()


class Subdivision(Refinement):
    """Halves every segment that is longer than a limit.

    When a segment will be too long follows from its birth and the growth, so
    that a step looks only at the segments that are due.

    Parameters
    ----------
    growth : Similarity
        The growing blade.
    longest : float
        Greatest length of a segment, in D.
    """

    def __init__(self, growth: Similarity, longest: float) -> None:
        self.longest = longest
        self._scales = np.array([growth.scale(step) for step in range(growth.last_step + 1)])
        self._due: dict[int, list[Ids]] = {}
        self._n_seen = 0

    def refine(
        self, veins: Vasculature, moment: Moment, held: Ids, streams: Streams
    ) -> Sequence[Cut]:
        """Halve the segments that are due, and the halves again if need be."""
        self._watch(veins, moment.step - 1)
        while (due := self._due.pop(moment.step, None)) is not None:
            halve(veins, moment, np.concatenate(due))
            self._watch(veins, moment.step - 1)
        return ()

    def _watch(self, veins: Vasculature, step: int) -> None:
        """Note when each new segment will be too long, in the next step at the soonest."""
        ids = np.arange(self._n_seen, veins.segments.n_rows, dtype=np.int32)
        self._n_seen = veins.segments.n_rows
        ids = ids[~veins.refined[ids]]
        ends = veins.places("nodes")[veins.segments.arrays["nodes"][ids]]
        lengths = np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1))
        due = np.searchsorted(self._scales, self.longest / lengths, side="right")
        is_ever = due < len(self._scales)
        due = np.maximum(due[is_ever], step + 1)
        for then in np.unique(due).tolist():
            self._due.setdefault(then, []).append(ids[is_ever][due == then])


class DeformedSubdivision(Refinement):
    """Halves every segment longer than a limit, where segments are stretched differently.

    Parameters
    ----------
    longest : float
        Greatest length of a segment, in D.
    """

    def __init__(self, longest: float) -> None:
        self.longest = longest

    def refine(
        self, veins: Vasculature, moment: Moment, held: Ids, streams: Streams
    ) -> Sequence[Cut]:
        """Halve the segments that are too long, and the halves again if need be."""
        limit = self.longest / moment.scale
        while True:
            ids = np.flatnonzero(~veins.refined[: veins.segments.n_rows]).astype(np.int32)
            ends = veins.places("nodes")[veins.segments.arrays["nodes"][ids]]
            lengths = np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1))
            if not (lengths > limit).any():
                return ()
            halve(veins, moment, ids[lengths > limit])


def halve(veins: Vasculature, moment: Moment, ids: Ids) -> None:
    """Replace segments by two halves with a new node between them."""
    ends = veins.segments.arrays["nodes"][ids]
    places = veins.places("nodes")
    middles = 0.5 * (places[ends[:, 0]] + places[ends[:, 1]])
    near = veins.nodes.arrays["material"][ends[:, 0]]
    causes = veins.nodes.arrays["source"][ends[:, 1]]
    rows = veins.add_nodes(
        moment.step, *moment.embed(middles, near), ends[:, 0], causes, Origin.REFINEMENT
    )
    nodes = np.arange(rows.start, rows.stop, dtype=np.int32)
    veins.has_child[nodes] = True
    halves = np.stack([ends[:, 0], nodes, nodes, ends[:, 1]], axis=1).reshape(-1, 2)
    veins.add_segments(moment.step, halves, SegmentKind.REFINEMENT)
    veins.refined[ids] = True
    veins.log(moment.step, EventKind.SEGMENT_REFINED, ids, nodes)


class NoRefinementParameters(Parameters):
    """Segments are never refined."""

    kind: Literal["none"] = "none"

    def refinement(self, growth: Growth, birth_distance: float, length: float) -> Refinement:
        """Give the refinement."""
        return NoRefinement()


class SubdivisionParameters(Parameters):
    """Segments that growth has stretched too far are halved."""

    kind: Literal["subdivision"] = "subdivision"
    longest: float | None = quantity(
        "Greatest length of a segment; by default the lesser of the birth distance to veins"
        " and two segment lengths, so that no vein can slip through a stretched one.",
        unit="D",
        default=None,
        gt=0.0,
    )

    def refinement(self, growth: Growth, birth_distance: float, length: float) -> Refinement:
        """Give the refinement for a growing blade."""
        longest = self.longest or min(birth_distance, 2.0 * length)
        if isinstance(growth, Similarity):
            return Subdivision(growth, longest)
        return DeformedSubdivision(longest)
