"""Straight veins in a medium that doubles (Gottlieb, 1991, 1993, as Runions 2008 tells it).

The growing medium makes room, each large enough space gets a source, and each source is
connected by a straight segment to the closest vein, or, where veins shall form loops, to all
veins within a distance. There is no field, and no vein grows gradually: the artefacts are
regular endings, long straight lines, and sharp angles where veins meet (section 4.1.4).

The grid of the original is not kept: spaces are the largest empty circles of section 5.2.2.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal

import numpy as np
from pydantic import model_validator

from vasc import kernels
from vasc.arrays import NULL, Floats, Ids, Points
from vasc.domain import Blade, BladeParameters
from vasc.errors import ConfigError
from vasc.events import EventKind, StopReason
from vasc.growth import Similarity
from vasc.growth.doubling import DoublingParameters
from vasc.models.base import (
    Model,
    PrintedParameters,
    RecordParameters,
    StopParameters,
    UnitParameters,
    newest,
)
from vasc.models.refinement import Subdivision
from vasc.network import Origin, SegmentKind
from vasc.parameters import Parameters, quantity
from vasc.placement import Moment
from vasc.placement.empty_circles import EmptyCirclePlacement
from vasc.state import State, Tables, affine
from vasc.states import SourceState
from vasc.streams import Streams
from vasc.vasculature import Vasculature

MOST_PIECES = 2e4
"""Segments that a blade may be long."""
SHORTEST = 1e-6
"""Least length of the blade at first, in D: areas of far smaller ones vanish."""
ROUNDING = 1e-9
"""Share of its length that a vein along the margin may lie beyond it."""
NOTHING = np.empty(0, dtype=np.int32)


@dataclass(frozen=True)
class StraightVeins(Model):
    """Sources in every large space, each connected by straight segments at once.

    Parameters
    ----------
    growth : Similarity
        The growing blade.
    placement : EmptyCirclePlacement
        Where sources appear.
    longest : float
        Greatest length of a segment after growth, in D.
    reach : float or None
        Distance within which all veins are connected, in D; None: the closest alone.
    last_step : int or None
        The run ends after this step at the latest.
    """

    growth: Similarity
    placement: EmptyCirclePlacement
    longest: float
    reach: float | None
    last_step: int | None

    def advance(self, state: State, streams: Streams) -> State:
        """Advance one step: grow, place, connect."""
        veins = newest(state, Vasculature)
        moment = Moment.of(self.growth, state.step + 1)

        # grow: the blade doubles, and long segments are halved
        self.growth.carry(veins, moment.step)
        if moment.step == self.growth.last_step:
            veins.log(moment.step, EventKind.GROWTH_ENDED, NULL, NULL)
        veins.regrid(self.longest / moment.scale, veins.nodes.n_rows)
        # looked at anew in each step, it finds all that is too long
        Subdivision(self.growth, self.longest).refine(veins, moment, NOTHING, streams)

        # place: a source appears in every space that is large enough
        self.placement.place(veins, moment, streams["placement"])

        # connect: straight segments to the sources, the one nearest to a vein first
        self.connect_all(veins, moment)

        # record: the state is a view of what there is now
        return self.state(veins, moment, self.reason_to_stop(veins, moment.step))

    def connect_all(self, veins: Vasculature, moment: Moment) -> None:
        """Connect all sources, always the one that is nearest to a vein of those left.

        So no straight vein runs over a source that is not connected yet.
        """
        waiting = veins.live
        nearest = np.full(len(waiting), np.inf)
        n_seen = 0
        while len(waiting):
            places = veins.places("sources")[waiting]
            for node in veins.places("nodes")[n_seen : veins.nodes.n_rows]:
                nearest = np.minimum(nearest, _distances(places, node))
            n_seen = veins.nodes.n_rows
            row = int(nearest.argmin())
            self.connect(veins, moment, int(waiting[row]))
            waiting, nearest = np.delete(waiting, row), np.delete(nearest, row)

    def connect(self, veins: Vasculature, moment: Moment, source: int) -> None:
        """Connect a source with the closest vein, or with all that are near and in sight.

        Where every way would cross a vein or leave the blade, the source waits for the next step.
        """
        place = veins.places("sources")[source]
        blade = moment.growth.domain(moment.step)
        distances = _distances(veins.places("nodes")[: veins.nodes.n_rows], place)
        segments = veins.segments.view("nodes")[~veins.refined[: veins.segments.n_rows]]
        limit = np.inf if self.reach is None else self.reach / moment.scale
        nearest = first = NULL
        for end in self.nearest_points(distances, segments).tolist():
            # the closest vein in sight is connected however far it is
            if first >= 0 and (self.reach is None or distances[end] > limit):
                break
            if kernels.crossings.is_crossed(veins.places("nodes"), segments, end, place):
                continue
            way = np.stack([veins.places("nodes")[end], place]) * moment.scale
            if not stays_within(blade, way):
                continue
            if first < 0:
                nearest, first = end, self.extend(veins, moment, source, end)
            else:
                veins.join(moment.step, (end, first), source)
        if first >= 0:
            self.drain(veins, moment.step, source, nearest)

    @staticmethod
    def nearest_points(distances: Floats, segments: Ids) -> Ids:
        """Give the point of each vein that is nearest to a source, the nearest vein first.

        A node is such a point where no node next to it along a vein is nearer.
        """
        is_near = np.ones(len(distances), dtype=bool)
        first, second = distances[segments[:, 0]], distances[segments[:, 1]]
        # of two equally near the older one
        is_second = (second < first) | ((second == first) & (segments[:, 1] < segments[:, 0]))
        is_near[np.where(is_second, segments[:, 0], segments[:, 1])] = False
        candidates = np.flatnonzero(is_near)
        return candidates[np.argsort(distances[candidates], kind="stable")].astype(np.int32)

    @staticmethod
    def extend(veins: Vasculature, moment: Moment, source: int, parent: int) -> int:
        """Make the straight vein from a node to a source; the new node is returned."""
        place = veins.places("sources")[[source]]
        material, position = moment.embed(place)
        is_branch = bool(veins.has_child[parent])
        rows = veins.add_nodes(
            moment.step,
            material,
            position,
            np.array([parent], dtype=np.int32),
            source,
            Origin.SOURCE,
        )
        veins.has_child[parent] = True
        pair = np.array([[parent, rows.start]], dtype=np.int32)
        veins.add_segments(moment.step, pair, SegmentKind.EXTENSION)
        if is_branch:
            veins.log(moment.step, EventKind.VEIN_INITIATED, rows.start, parent)
        return rows.start

    @staticmethod
    def drain(veins: Vasculature, step: int, source: int, node: int) -> None:
        """Let a source that is connected emit no more; the node of its closest vein is noted."""
        veins.is_live[source] = 0
        veins.live = veins.live[veins.is_live[veins.live] != 0]
        veins.log(step, EventKind.SOURCE_REMOVED, source, node)
        veins.log_states(step, np.array([source], dtype=np.int32), SourceState.DRAINED)

    def reason_to_stop(self, veins: Vasculature, step: int) -> StopReason | None:
        """Give the reason why a run ends after a step, or None when it goes on."""
        if step >= self.growth.last_step:
            return StopReason.NO_SOURCES if len(veins.live) == 0 else StopReason.NOTHING_PULLED
        if self.last_step is not None and step >= self.last_step:
            return StopReason.STEP_LIMIT
        return None

    def initial_state(self, streams: Streams) -> State:
        """Give the state before the first step: the seed nodes alone."""
        veins = self.vasculature(Tables())
        seeds = self.growth.material(self.growth.blade.seeds, 0)
        veins.seed(seeds, self.growth.position(seeds, 0))
        return self.state(veins, Moment.of(self.growth, 0), None)

    def restore(self, tables: Tables, step: int, streams: Streams) -> State:
        """Give the state that a record describes, ready to go on to the same bytes."""
        veins = self.vasculature(tables)
        veins.restore(step)
        return self.state(veins, Moment.of(self.growth, step), None)

    def vasculature(self, tables: Tables) -> Vasculature:
        """Give the indexes over tables; no source has a set of nodes that perceive it."""
        return Vasculature(
            tables, self.growth.box, self.longest, least_change=kernels.perceived.NEVER
        )

    def state(self, veins: Vasculature, moment: Moment, reason: StopReason | None) -> State:
        """Give the state that the tables describe now."""
        if reason is not None:
            veins.log(moment.step, EventKind.RUN_FINISHED, int(reason), NULL)
        scale, outline_scale = self.growth.affine(moment.step)
        return State(
            step=moment.step,
            time=self.growth.time(moment.step),
            blade=self.growth.domain(moment.step),
            motion=affine(scale),
            outline_motion=affine(outline_scale),
            counts=veins.tables.counts(),
            live=veins.live,
            tables=veins.tables,
            index=veins,
            is_finished=reason is not None,
        )


def stays_within(blade: Blade, way: Points) -> bool:
    """Tell whether a straight way stays in a blade, the margin included.

    Parameters
    ----------
    blade : Blade
        The blade.
    way : ndarray of shape (2, 2), float64
        The ends of the way, in D.
    """
    import shapely

    apart = shapely.LineString(way).difference(blade.polygon)
    if apart.is_empty:
        return True
    # ends on the margin may lie off it by rounding
    beyond = shapely.get_coordinates(shapely.segmentize(apart, 0.25))
    return bool(blade.margin_distance(beyond).max() <= ROUNDING * blade.length)


def _distances(points: Points, place: Points) -> Floats:
    """Give the distances of points from a place, shape (n,)."""
    return np.sqrt(((points - place) ** 2).sum(axis=1))


class GottliebParameters(Parameters):
    """Straight veins to sources in every large space of a blade that doubles."""

    evidence: ClassVar[str] = (
        "[T] as sections 2.2 and 4.1.4 of Runions (2008) tell Gottlieb's model; the original was"
        " not read, and its grid is replaced by largest empty circles"
    )

    kind: Literal["gottlieb"] = "gottlieb"
    title: str = quantity("One sentence on the experiment.", default="")
    reference: str = quantity("The figure or paper it follows.", default="")
    seed: int = quantity("Seed of all randomness; the model draws none.", default=1, ge=0, lt=2**63)
    domain: BladeParameters = quantity("The blade at step 0.")
    doublings: int = quantity(
        "Steps, in each of which the blade doubles; at most 12.", default=4, ge=1, le=12
    )
    space: float = quantity(
        "A source appears while the largest empty circle has a radius larger than this; from 1e-3"
        " to at most 1e6.",
        unit="D",
        ge=1e-3,
        le=1e6,
    )
    reach: float | None = quantity(
        "Each source is connected with all veins in sight and so near, at least with the closest;"
        " by default with the closest alone, so that veins form no loops. At most 1e6.",
        unit="D",
        default=None,
        gt=0.0,
        le=1e6,
    )
    longest: float = quantity(
        "Greatest length of a segment after growth: veins can be met at its ends; at most 1e6, and"
        " not more than space.",
        unit="D",
        default=1.0,
        gt=0.0,
        le=1e6,
    )
    stop: StopParameters = quantity("When the run ends.", default=StopParameters())
    record: RecordParameters = quantity("What is recorded.", default=RecordParameters())
    units: UnitParameters | None = quantity("Real units.", default=None)
    printed: PrintedParameters | None = quantity("Values as printed.", default=None)

    @model_validator(mode="after")
    def _check_size(self) -> "GottliebParameters":
        """Refuse a blade that no memory holds, and pieces longer than the spaces between them."""
        first, last = self.domain.length, self.domain.length * 2.0**self.doublings
        if first < SHORTEST:
            raise ValueError(f"domain.length = {first:g}: must be at least {SHORTEST:g} D")
        if self.longest > self.space:
            raise ValueError(
                f"longest = {self.longest:g}: must be at most space, {self.space:g} D, or"
                " veins lie within a space without a node there"
            )
        # longest is the shorter of the two
        if last > MOST_PIECES * self.longest:
            raise ValueError(
                f"domain.length = {first:g} and doublings = {self.doublings}: the blade would be"
                f" {last:.3g} D long in the end, {last / self.longest:.3g} times longest ="
                f" {self.longest:g}, more than memory can hold; at most {MOST_PIECES:g} times are"
                " allowed"
            )
        return self

    @property
    def growth(self) -> DoublingParameters:
        """How the blade grows."""
        return DoublingParameters(doublings=self.doublings)

    @property
    def stream_names(self) -> tuple[str, ...]:
        """Names of the processes that draw random numbers."""
        return ("placement",)

    def model(self, folder: Path = Path()) -> StraightVeins:
        """Give the model; files are looked for in ``folder``.

        Raises
        ------
        ConfigError
            If the blade has several parts or holes, or no room for a source in the end.
        """
        blade = self.domain.blade(folder)
        if len(blade.rings) > 1:
            raise ConfigError(
                f"domain: the outline has {len(blade.rings)} rings; the margin must be one"
            )
        low_x, low_y, high_x, high_y = blade.scaled(2.0**self.doublings).bounds
        across = float(np.hypot(high_x - low_x, high_y - low_y))
        if self.space >= across:
            raise ConfigError(
                f"space = {self.space:g}: no source would ever appear in a blade that is"
                f" {across:.4g} D across in the end; it must be less"
            )
        growth = self.growth.growth(blade)
        return StraightVeins(
            growth=growth,
            placement=EmptyCirclePlacement(growth, self.space, None, 0.0),
            longest=self.longest,
            reach=self.reach,
            last_step=self.stop.steps,
        )
