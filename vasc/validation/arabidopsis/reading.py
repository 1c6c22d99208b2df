"""Read the story of a leaf out of a timeline; whatever model made it."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids, Points
from vasc.domain.rings import signed_area
from vasc.errors import VascError
from vasc.events import EventKind
from vasc.network import Origin, SegmentKind
from vasc.sources import Cause
from vasc.timeline import Frame, Timeline
from vasc.validation.arabidopsis.cast import Cast
from vasc.validation.arabidopsis.loops import KeptFrames, first_inside, loop_nodes
from vasc.validation.arabidopsis.story import Ending, LoopStory, SourceStory, Story
from vasc.validation.references import SEQUENCE


def read_story(timeline: Timeline) -> Story:
    """Give the story that a timeline tells.

    Parameters
    ----------
    timeline : Timeline
        An open timeline of any leaf.

    Returns
    -------
    Story
        All sources; loops of the pairs that the checker asks about.

    Raises
    ------
    VascError
        If no source was ever placed, or the run is one on a tissue: there is nothing to hold
        against a sequence.
    TimelineError
        If the file cannot be read.
    """
    if timeline.tissue is not None:
        raise VascError(
            f"{timeline.path}: is a run on a tissue, which does not grow and whose sources are"
            " placed in rounds; the sequence of a growing leaf cannot be decided"
        )
    if timeline.n_rows("sources") == 0:
        raise VascError(f"{timeline.path}: no source was placed, so that there is no sequence")
    reading = _Reading(timeline)
    sources, ended = reading.sources(), reading.growth_ended
    told = Story(
        sources=sources,
        loops=(),
        ending=reading.ending(),
        last_step=timeline.last_step,
        last_time=reading.time(timeline.last_step),
        # a run that its config has stopped is not over: its growth would have gone on
        is_over=ended is not None or timeline.stop_reason in ("no_sources", "nothing_pulled"),
        growth_ended=ended,
        growth_ended_time=None if ended is None else reading.time(ended),
        heights=reading.height,
        lengths=reading.length,
    )
    # whose loops matter is known only from the sources: to follow all of a large leaf is slow
    cast = Cast(told)
    closing = (pair for pair in (cast.upper, cast.pair_2, cast.pair_3) if pair is not None)
    actors = set().union(*(pair.ids for pair in closing))
    return replace(told, loops=reading.loops(actors, sources))


def node_owners(timeline: Timeline) -> Ids:
    """Give the owner of every node, shape (n,): 0 for seeds, else the source's id and 1.

    A node that refinement put on a segment belongs to the younger of the veins
    whose nodes the segment joined: a vein begins with the segment that leaves
    the older one.
    """
    owners = timeline.table("nodes", "source") + 1
    parents, origins = timeline.table("nodes", "parent"), timeline.table("nodes", "origin")
    segments = timeline.table("segments", "nodes")
    halves = segments[timeline.table("segments", "kind") == SegmentKind.REFINEMENT]
    distal = dict(zip(halves[::-1, 0].tolist(), halves[::-1, 1].tolist(), strict=True))
    # both ends are earlier rows, so that one pass in the order of ids reaches all
    for node in np.flatnonzero((owners == 0) & (origins == Origin.REFINEMENT)).tolist():
        owners[node] = max(owners[parents[node]], owners[distal.get(node, node)])
    return owners


class _Reading:
    """What the parts of one reading share."""

    def __init__(self, timeline: Timeline) -> None:
        self.timeline = timeline
        self.times: NDArray[np.float64] = timeline.frames["time"]
        self.events = {name: timeline.events[name] for name in timeline.events}
        self.owners = node_owners(timeline)
        self.frames = KeptFrames(timeline)
        self.fates = timeline.lineage.fates
        self.birth_distance = birth_distance(timeline)

    def time(self, step: int) -> float:
        """Give the model time of a step."""
        return float(self.times[step])

    def rows(self, kind: EventKind) -> Ids:
        """Give the rows of the events of a kind."""
        return np.flatnonzero(self.events["kind"] == kind).astype(np.int32)

    @property
    def growth_ended(self) -> int | None:
        """Step at which growth ended."""
        rows = self.rows(EventKind.GROWTH_ENDED)
        return int(self.events["step"][rows[0]]) if len(rows) else None

    def sources(self) -> tuple[SourceStory, ...]:
        """Give the stories of all sources."""
        births = self.timeline.table("sources", "birth")
        neighbors = self._neighbors(len(births))
        stories: list[SourceStory] = []
        for step in np.unique(births).tolist():
            ids = np.flatnonzero(births == step).astype(np.int32)
            stories += self._born(self.timeline.frame(step), ids, neighbors)
        return tuple(stories)

    def _born(
        self, frame: Frame, ids: Ids, neighbors: list[frozenset[int] | None]
    ) -> Iterable[SourceStory]:
        """Give the stories of the sources born at one step."""
        places = self.timeline.table("sources", "position")[ids]
        length = frame.blade.length
        are_marginal = self._are_marginal(frame, ids, places)
        for row, one in enumerate(ids.tolist()):
            drained = int(self.fates["removed"][one])
            yield SourceStory(
                id=one,
                step=frame.step,
                time=frame.time,
                x=float(places[row, 0]) / length,
                y=float(places[row, 1]) / length,
                leaf_length=length,
                is_on_margin=bool(are_marginal[row]),
                neighbors=neighbors[one],
                drained_step=None if drained == NULL else drained,
                drained_time=None if drained == NULL else self.time(drained),
            )

    def _are_marginal(self, frame: Frame, ids: Ids, places: Points) -> NDArray[np.bool_]:
        """Tell which sources are on the margin, from their cause or else their place."""
        causes = self.timeline.table("sources", "cause")[ids]
        are_marginal = causes == Cause.MARGIN
        is_open = ~are_marginal & (causes != Cause.SPACE)
        if is_open.any():
            distances = frame.blade.margin_distance(places[is_open])
            are_marginal[is_open] = distances < SEQUENCE.margin * self.birth_distance
        return are_marginal

    def _neighbors(self, n_sources: int) -> list[frozenset[int] | None]:
        """Give the owners of the nodes that each source attracted first."""
        found: list[frozenset[int] | None] = [None] * n_sources
        if self.timeline.records_perceived:
            for one, nodes in first_perceived(self.timeline).items():
                found[one] = frozenset(self.owners[nodes].tolist())
        return found

    def height(self, source: int, step: int) -> float:
        """Give where the tissue of a source is at a step, in leaf lengths from the base."""
        node = int(self.fates["nearest"][source])
        frame = self.frames.at(step)
        if node == NULL or node >= len(frame.positions):
            birth = int(self.fates["birth"][source])
            y = float(self.timeline.table("sources", "position", source, source + 1)[0, 1])
            return y / self.frames.at(birth).blade.length
        return float(frame.positions[node, 1]) / frame.blade.length

    def length(self, step: int) -> float:
        """Give the length of the leaf at a step."""
        return self.frames.at(step).blade.length

    def loops(self, actors: set[int], sources: tuple[SourceStory, ...]) -> tuple[LoopStory, ...]:
        """Give the loops that veins of some sources closed."""
        rows = self.rows(EventKind.LOOP_CLOSED)
        rows = rows[np.isin(self.events["object"][rows], sorted(actors))]
        steps = self.events["step"][rows].tolist()
        found = []
        for row, step in zip(rows.tolist(), steps, strict=True):
            nodes = loop_nodes(self.frames, row)
            moments = sorted({each for each in steps if each >= step} | {self.timeline.last_step})
            polygons = {at: self.frames.at(at).positions[nodes] for at in moments}
            found.append(
                LoopStory(
                    source=int(self.events["object"][row]),
                    step=step,
                    time=self.time(step),
                    owners=frozenset(self.owners[nodes].tolist()),
                    areas={at: abs(signed_area(polygon)) for at, polygon in polygons.items()},
                    first_source=first_inside(self.frames, nodes, step, sources),
                    outline=tuple(
                        (float(x), float(y)) for x, y in polygons[self.timeline.last_step]
                    ),
                )
            )
        return tuple(found)

    def ending(self) -> Ending:
        """Tell blind ends and joins before the event from those after it."""
        event = self.rows(EventKind.MESOPHYLL_EVENT)
        step = int(self.events["step"][event[0]]) if len(event) else None
        blind = self.events["step"][self.rows(EventKind.VEIN_ENDED_BLINDLY)]
        joins = self.events["step"][self.rows(EventKind.VEIN_JOINED)]
        # the event comes first in its step: what ends in that step obeys it
        first = self.timeline.last_step + 1 if step is None else step
        # without the event a vein ends blindly where it is the first at its source
        free = blind[:0] if step is None else blind
        return Ending(
            step=step,
            time=None if step is None else self.time(step),
            blind_before=int((blind < first).sum()),
            blind_after=int((blind >= first).sum()),
            joins_before=int((joins < first).sum()),
            joins_after=int((joins >= first).sum()),
            first_blind=int(free[0]) if len(free) else None,
            first_blind_time=self.time(int(free[0])) if len(free) else None,
        )


def first_perceived(timeline: Timeline) -> dict[int, Ids]:
    """Give the nodes of the first set that is recorded of each source, nearest first."""
    steps, sources, nodes = (
        timeline.table("perceived", column) for column in ("step", "source", "node")
    )
    if len(sources) == 0:
        return {}  # splitting nothing gives one piece, of no source
    order = np.argsort(sources, kind="stable")
    steps, sources, nodes = steps[order], sources[order], nodes[order]
    ids, starts = np.unique(sources, return_index=True)
    return {
        one: rows_nodes[rows_steps == rows_steps[0]]
        for one, rows_steps, rows_nodes in zip(
            ids.tolist(), np.split(steps, starts[1:]), np.split(nodes, starts[1:]), strict=True
        )
    }


def birth_distance(timeline: Timeline) -> float:
    """Give the distance that sources keep at birth, in D: the config's, or else an estimate.

    The estimate is the median distance between a source and the nearest node
    that it attracts, at its birth.
    """
    placement = timeline.config.get("placement") or {}
    for key in ("birth_distance", "birth_distance_sources"):
        value = placement.get(key)
        if isinstance(value, int | float):
            return float(value)
    if not timeline.records_perceived:
        return 0.0
    births = timeline.table("sources", "birth")
    places = timeline.table("sources", "position")
    gaps = []
    for one, nodes in first_perceived(timeline).items():
        positions = timeline.positions(int(births[one]))
        known = nodes[nodes < len(positions)]
        if len(known):
            gaps.append(float(np.hypot(*(positions[known[0]] - places[one]))))
    return float(np.median(gaps)) if gaps else 0.0
