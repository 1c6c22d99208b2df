"""Corner cutting: stretched veins become smooth curves (Runions 2008, section 5.2.6)."""

from collections.abc import Sequence
from typing import Literal

import numpy as np
from pydantic import model_validator

from vasc.arrays import Ids, Points
from vasc.events import EventKind
from vasc.growth import Growth
from vasc.models.perception import Cut
from vasc.models.refinement import Refinement, halve
from vasc.network import Origin, SegmentKind
from vasc.parameters import Parameters, quantity
from vasc.placement import Moment
from vasc.streams import Streams
from vasc.vasculature import Vasculature

MOST_JITTER = 0.1
"""Displacement of new nodes at most, over the threshold of length."""


class CornerCutting(Refinement):
    """Replaces a node between two long segments by two nodes that cut its corner.

    Chaikin's method at one node at a time (equations 5.3 and 5.4). Nodes at
    which veins branch or end are never cut; a long segment between two of them
    is halved.

    Parameters
    ----------
    threshold : float
        A node is cut when its two segments are longer than that together, in D.
    alpha : float
        Weight of the node in those that replace it.
    jitter : float
        Greatest displacement of new nodes along each axis, in D.
    """

    def __init__(self, threshold: float, alpha: float, jitter: float) -> None:
        self.threshold = threshold
        self.alpha = alpha
        self.jitter = jitter

    def refine(
        self, veins: Vasculature, moment: Moment, held: Ids, streams: Streams
    ) -> Sequence[Cut]:
        """Cut the corners that have become too long; gives the cuts."""
        corners = Corners(veins, self.alpha)
        limit = self.threshold / moment.scale
        between = corners.long_between_branches(held, limit)
        for node in corners.long(held, limit):
            corners.cut(node, limit)
        if corners.cuts:
            self._write(veins, moment, corners, streams)
        if len(between):
            halve(veins, moment, between)
        return corners.cuts

    def _write(
        self, veins: Vasculature, moment: Moment, corners: "Corners", streams: Streams
    ) -> None:
        """Append the new nodes and segments to the tables."""
        places = np.array(corners.places)
        if self.jitter > 0.0:
            shifts = streams["refinement"].random(places.shape)
            places += (2.0 * shifts - 1.0) * (self.jitter / moment.scale)
        replaced = np.repeat([cut.node for cut in corners.cuts], 2).astype(np.int32)
        columns = veins.nodes.arrays
        material, positions = moment.embed(places, columns["material"][replaced])
        causes = columns["source"][replaced]
        step = moment.step
        veins.add_nodes(step, material, positions, replaced, causes, Origin.REFINEMENT)
        nodes = np.array([node for cut in corners.cuts for node in (cut.first, cut.second)])
        veins.has_child[nodes] = True
        veins.add_segments(step, np.array(corners.segments, dtype=np.int32), SegmentKind.REFINEMENT)
        ended = np.array(corners.ended, dtype=np.int32)
        veins.refined[ended[:, 0]] = True
        veins.log(step, EventKind.SEGMENT_REFINED, ended[:, 0], ended[:, 1])
        veins.retire(step, np.array([cut.node for cut in corners.cuts], dtype=np.int32))


class Corners:
    """The nodes with two segments, while they are cut one after the other.

    Parameters
    ----------
    veins : Vasculature
        Not changed here; ids of nodes and segments to come are counted on.
    alpha : float
        Weight of a node in those that replace it.

    Attributes
    ----------
    cuts : list of Cut
        The nodes replaced.
    places : list of ndarray
        Places of the new nodes, two a cut.
    segments : list of tuple of int
        New segments, proximal node first, three a cut.
    ended : list of tuple of int
        Segments replaced, each with a new node.
    """

    def __init__(self, veins: Vasculature, alpha: float) -> None:
        self.alpha = alpha
        self.cuts: list[Cut] = []
        self.places: list[Points] = []
        self.segments: list[tuple[int, int]] = []
        self.ended: list[tuple[int, int]] = []
        self._veins = veins
        self._n_nodes, self._n_segments = veins.nodes.n_rows, veins.segments.n_rows
        self._ids = np.flatnonzero(~veins.refined[: self._n_segments])
        self._ends = veins.segments.arrays["nodes"][self._ids]
        places = veins.places("nodes")
        gaps = places[self._ends[:, 1]] - places[self._ends[:, 0]]
        self._lengths = np.sqrt((gaps**2).sum(axis=1))
        self._degrees = np.bincount(self._ends.ravel(), minlength=self._n_nodes)
        # the two segments of each node that will be cut, the older one first
        self._around: dict[int, list[int]] = {}

    def long(self, held: Ids, limit: float) -> list[int]:
        """Give the nodes whose two segments are too long together, ascending."""
        sums = np.zeros(self._n_nodes)
        np.add.at(sums, self._ends[:, 0], self._lengths)
        np.add.at(sums, self._ends[:, 1], self._lengths)
        is_long = (self._degrees == 2) & (sums > limit)
        is_long[held] = False
        touches = is_long[self._ends]
        for column in (0, 1):
            for row in np.flatnonzero(touches[:, column]).tolist():
                node = int(self._ends[row, column])
                self._around.setdefault(node, []).append(int(self._ids[row]))
        for segments in self._around.values():
            segments.sort()
        return np.flatnonzero(is_long).tolist()

    def long_between_branches(self, held: Ids, limit: float) -> Ids:
        """Give the segments too long whose two ends are never cut."""
        is_fixed = self._degrees != 2
        is_fixed[held] = True
        found = self._ids[is_fixed[self._ends].all(axis=1) & (self._lengths > limit)]
        return found.astype(np.int32)

    def cut(self, node: int, limit: float) -> None:
        """Replace a node by two, unless cuts of its neighbors have made it short."""
        older, newer = self._around[node]
        before, after = self._ends_of(older), self._ends_of(newer)
        first_end, second_end = _other(before, node), _other(after, node)
        p1, p2, p3 = (self._place(end) for end in (first_end, node, second_end))
        if _distance(p1, p2) + _distance(p2, p3) <= limit:
            return
        cut = Cut(node, self._n_nodes + len(self.places), self._n_nodes + len(self.places) + 1)
        self.cuts.append(cut)
        # equations 5.3 and 5.4
        self.places.append((1.0 - self.alpha) * p1 + self.alpha * p2)
        self.places.append((1.0 - self.alpha) * p3 + self.alpha * p2)
        self.ended += [(older, cut.first), (newer, cut.second)]
        is_forward = before[1] == node
        middle = (cut.first, cut.second)
        self._replace(first_end, older, _with(before, node, cut.first))
        self.segments.append(middle if is_forward else middle[::-1])
        self._replace(second_end, newer, _with(after, node, cut.second))

    def _replace(self, neighbor: int, segment: int, ends: tuple[int, int]) -> None:
        """Add a segment that takes the place of another one at a neighbor."""
        new = self._n_segments + len(self.segments)
        self.segments.append(ends)
        if neighbor in self._around:
            around = self._around[neighbor]
            around[around.index(segment)] = new

    def _ends_of(self, segment: int) -> tuple[int, int]:
        """Give the two nodes of a segment, of the table or new."""
        if segment >= self._n_segments:
            return self.segments[segment - self._n_segments]
        first, second = self._veins.segments.arrays["nodes"][segment].tolist()
        return first, second

    def _place(self, node: int) -> Points:
        """Give the place of a node, of the table or new."""
        if node >= self._n_nodes:
            return self.places[node - self._n_nodes]
        return self._veins.places("nodes")[node]


def _other(ends: tuple[int, int], node: int) -> int:
    """Give the end of a segment that is not a node."""
    return ends[1] if ends[0] == node else ends[0]


def _with(ends: tuple[int, int], node: int, new: int) -> tuple[int, int]:
    """Give the ends of a segment with one of them replaced."""
    return (new, ends[1]) if ends[0] == node else (ends[0], new)


def _distance(a: Points, b: Points) -> float:
    """Give the distance of two places."""
    return float(np.sqrt(((a - b) ** 2).sum()))


class CornerCuttingParameters(Parameters):
    """Corners of stretched veins are cut (equations 5.3 and 5.4)."""

    kind: Literal["corner_cutting"] = "corner_cutting"
    threshold: float = quantity(
        "A node is replaced when its two segments are longer than this together.",
        unit="D",
        default=3.0,
        gt=0.0,
    )
    alpha: float = quantity(
        "Weight of the node in the two that replace it; the thesis uses 0.5 to 0.75.",
        default=0.6,
        ge=0.5,
        lt=1.0,
    )
    jitter: float = quantity(
        "Greatest displacement of new nodes along each axis.", unit="D", default=0.0, ge=0.0
    )

    @model_validator(mode="after")
    def _check(self) -> "CornerCuttingParameters":
        """Refuse displacements that lengthen segments as fast as they are cut."""
        if self.jitter > MOST_JITTER * self.threshold:
            raise ValueError(
                f"jitter is {self.jitter:g}; it must be at most {MOST_JITTER:g} times the threshold"
                f" ({self.threshold:g}), or cut segments are as long as before"
            )
        return self

    def refinement(self, growth: Growth, birth_distance: float, length: float) -> Refinement:
        """Give the refinement."""
        return CornerCutting(self.threshold, self.alpha, self.jitter)
