"""Strands: veins that differentiate along canals, cell by cell (Runions 2008, 5.2.3-5.2.5)."""

import numpy as np

from vasc import kernels
from vasc.arrays import NULL, Ids, Points
from vasc.events import EventKind
from vasc.models.areolation import divide_tissue, enclose_sources
from vasc.models.arrival import Arrival
from vasc.models.canals import Canal, Canals
from vasc.models.extension import Extension
from vasc.network import Origin, SegmentKind
from vasc.parameters import Parameters, quantity
from vasc.placement import Moment
from vasc.states import CanalState
from vasc.vasculature import Vasculature


class StrandExtension(Extension[Canals]):
    """Every strand grows by one segment, straight to where its canal leads.

    Parameters
    ----------
    segment_length : float
        Length of a new segment, D.
    mesophyll_step : int or None
        From this step on strands end blindly; None: never.
    blind_gap : float
        What then remains between a strand and the vein it does not join, in D.
    """

    def __init__(self, segment_length: float, mesophyll_step: int | None, blind_gap: float) -> None:
        self._segment_length = segment_length
        self.mesophyll_step = mesophyll_step
        self.blind_gap = blind_gap

    @property
    def segment_length(self) -> float:
        """Length of a new segment, D."""
        return self._segment_length

    def is_interrupted(self, step: int) -> bool:
        """Tell whether mesophyll has differentiated by a step."""
        return self.mesophyll_step is not None and step >= self.mesophyll_step

    def gap(self, step: int) -> float:
        """Give the gap at which an outbound strand stops extending, in D."""
        return self.blind_gap if self.is_interrupted(step) else self._segment_length

    def extend(self, veins: Vasculature, attraction: Canals, moment: Moment) -> int:
        """Add the new nodes and their segments; gives their number."""
        if moment.step == self.mesophyll_step:
            veins.log(moment.step, EventKind.MESOPHYLL_EVENT, NULL, NULL)
        strands, places = [], []
        for canal in attraction.under_way():
            place = self._next_place(veins, moment, canal)
            if place is not None:
                strands.append(canal)
                places.append(place)
        if strands:
            self._add(veins, moment, strands, np.array(places))
        return len(strands)

    def _next_place(self, veins: Vasculature, moment: Moment, canal: Canal) -> Points | None:
        """Give the place of a strand's next node, or None if it needs none."""
        tip, goal = veins.places("nodes")[canal.tip], _goal_of(veins, canal)
        way = goal - tip
        distance = float(np.sqrt((way**2).sum()))
        step = self._segment_length / moment.scale
        if canal.state == CanalState.OUTBOUND:
            left = distance - self.gap(moment.step) / moment.scale
            if left <= 0.0:
                return None
            if self.is_interrupted(moment.step):
                step = min(step, left)
        place = tip + way * (step / distance)
        crossed = kernels.canals.first_crossed(
            veins.places("nodes"),
            veins.segments.arrays["nodes"],
            veins.refined,
            veins.segments.n_rows,
            canal.tip,
            place[0],
            place[1],
        )
        if crossed >= 0:
            self._meet(veins, moment, canal, crossed)
            return None
        return place

    @staticmethod
    def _meet(veins: Vasculature, moment: Moment, canal: Canal, segment: int) -> None:
        """Let a strand whose way is crossed by a vein lead to, or go on from, that vein."""
        ends = veins.segments.arrays["nodes"][segment].tolist()
        places = veins.places("nodes")
        gaps = [((places[end] - places[canal.tip]) ** 2).sum() for end in ends]
        node = ends[int(np.argmin(gaps))]
        if canal.state == CanalState.OUTBOUND:
            canal.node = node
            veins.log(moment.step, EventKind.CANAL_RETARGETED, canal.id, node)
        else:
            canal.tip = node
            veins.log(moment.step, EventKind.STRAND_EXTENDED, canal.id, node)

    @staticmethod
    def _add(veins: Vasculature, moment: Moment, strands: list[Canal], places: Points) -> None:
        """Append nodes, segments and events."""
        tips = np.array([canal.tip for canal in strands], dtype=np.int32)
        sources = np.array([canal.source for canal in strands], dtype=np.int32)
        material, positions = moment.embed(places, veins.nodes.arrays["material"][tips])
        nodes = _append(veins, moment.step, tips, material, positions, sources, Origin.EXTENSION)
        ids = np.array([canal.id for canal in strands], dtype=np.int32)
        veins.log(moment.step, EventKind.STRAND_EXTENDED, ids, nodes)
        for canal, node in zip(strands, nodes.tolist(), strict=True):
            canal.tip = node


class DrainingArrival(Arrival):
    """A source that a vein reaches is drained and becomes vein; strands then leave it.

    A strand that leaves a source joins the vein its canal leads to, and so divides
    the areole; once mesophyll has differentiated it ends blindly before it.

    Parameters
    ----------
    kill_distance : float
        A vein not farther than that from a source has reached it (d_k), in D.
    canals : Canals
        The canals of all sources.
    extension : StrandExtension
        Tells how near strands come to veins.
    """

    def __init__(self, kill_distance: float, canals: Canals, extension: StrandExtension) -> None:
        super().__init__(kill_distance)
        self.canals = canals
        self.extension = extension

    def is_awaiting(self) -> bool:
        """Tell whether strands are under way, or about to leave a drained source."""
        return bool(self.canals.by_source)

    def reach(self, veins: Vasculature, moment: Moment) -> int:
        """Drain sources, join or end strands; gives the number of these."""
        enclose_sources(veins, moment)
        n_reached = 0
        for canal in self.canals.under_way():
            way = _goal_of(veins, canal) - veins.places("nodes")[canal.tip]
            distance = float(np.sqrt((way**2).sum())) * moment.scale
            if canal.state == CanalState.INBOUND and distance <= self.kill_distance:
                self._drain(veins, moment, canal)
                n_reached += 1
            elif canal.state == CanalState.OUTBOUND and self._is_there(moment, distance):
                self._end(veins, moment, canal)
                n_reached += 1
        return n_reached

    def _is_there(self, moment: Moment, distance: float) -> bool:
        """Tell whether nothing but the last cell is between a strand and its vein."""
        # a strand that stops at the gap is there, whatever the rounding
        return distance <= self.extension.gap(moment.step) * (1.0 + 1e-9)

    def _drain(self, veins: Vasculature, moment: Moment, canal: Canal) -> None:
        """Let a source become vein."""
        source, step = canal.source, moment.step
        row = slice(source, source + 1)
        columns = veins.sources.arrays
        material, place = columns["material"][row], veins.places("sources")[row]
        tip = np.array([canal.tip], dtype=np.int32)
        node = _append(veins, step, tip, material, place * moment.scale, source, Origin.SOURCE)
        veins.perceived.members[source, 0] = node[0]
        veins.remove_sources(step, np.array([source], dtype=np.int32))
        veins.log(step, EventKind.STRAND_EXTENDED, canal.id, node)
        self.canals.change(veins, step, canal, CanalState.VEIN)
        if source in self.canals.by_source:
            self.canals.drained[source] = int(node[0])

    def _end(self, veins: Vasculature, moment: Moment, canal: Canal) -> None:
        """Let a strand join the vein it leads to, or end blindly before it."""
        step, tip, node = moment.step, canal.tip, canal.node
        if self.extension.is_interrupted(step):
            veins.log(step, EventKind.VEIN_ENDED_BLINDLY, tip, canal.source)
            self.canals.change(veins, step, canal, CanalState.ARRESTED)
            return
        if tip != node and not veins.is_connected(min(tip, node), max(tip, node)):
            segment = veins.join(step, (tip, node), canal.source)
            divide_tissue(veins, moment, segment)
        self.canals.change(veins, step, canal, CanalState.VEIN)


def _goal_of(veins: Vasculature, canal: Canal) -> Points:
    """Give the place a strand grows to: its source, or the vein node its canal leads to."""
    if canal.state == CanalState.INBOUND:
        return veins.places("sources")[canal.source]
    return veins.places("nodes")[canal.node]


def _append(
    veins: Vasculature,
    step: int,
    tips: Ids,
    material: Points,
    positions: Points,
    sources: Ids | int,
    origin: Origin,
) -> Ids:
    """Append nodes beyond tips, and the segments to them; gives the ids of the nodes."""
    branches = veins.has_child[tips]
    veins.has_child[tips] = True
    rows = veins.add_nodes(step, material, positions, tips, sources, origin)
    nodes = np.arange(rows.start, rows.stop, dtype=np.int32)
    veins.add_segments(step, np.stack([tips, nodes], axis=1), SegmentKind.EXTENSION)
    if branches.any():
        veins.log(step, EventKind.VEIN_INITIATED, nodes[branches], tips[branches])
    return nodes


class StrandParameters(Parameters):
    """How strands extend along canals."""

    segment_length: float = quantity(
        "Length of a new segment (D); all other lengths are in the same unit.",
        unit="D",
        default=1.0,
        gt=0.0,
    )
    lean: float = quantity(
        "A vein to a source within the blade leaves another one that share of its length nearer"
        " to the base than the closest node, so that it branches at an acute angle; 0, as in the"
        " thesis: at right angles.",
        default=0.0,
        ge=0.0,
        le=2.0,
    )
    blind_gap: float = quantity(
        "What remains between a blind strand and the vein it does not join.",
        unit="D",
        default=0.9,
        gt=0.0,
    )

    def extension(self, mesophyll_step: int | None) -> StrandExtension:
        """Give the extension; from that step on strands end blindly, never if it is None."""
        return StrandExtension(self.segment_length, mesophyll_step, self.blind_gap)
