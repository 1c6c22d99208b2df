"""Space colonization: the sentence that all its models share (Runions 2008, section 4.2.3)."""

from dataclasses import dataclass
from typing import Generic

import numpy as np

from vasc.arrays import NULL
from vasc.events import EventKind, StopReason
from vasc.growth import Growth
from vasc.models.arrival import Arrival
from vasc.models.base import Model, newest
from vasc.models.extension import Extension
from vasc.models.perception import A, Perception
from vasc.models.refinement import Refinement
from vasc.placement import Moment, Placement
from vasc.state import State, Tables, affine
from vasc.streams import Streams
from vasc.vasculature import Vasculature


@dataclass(frozen=True)
class Colonization(Model, Generic[A]):
    """Veins that colonize a growing blade, drawn by auxin sources.

    Parameters
    ----------
    growth, refinement, placement, perception, extension, arrival
        The parts of the sentence.
    last_step : int or None
        The run ends after this step at the latest.
    least_change : int
        Which changes of the sets of perceiving nodes are recorded.
    """

    growth: Growth
    refinement: Refinement
    placement: Placement
    perception: Perception[A]
    extension: Extension[A]
    arrival: Arrival
    last_step: int | None
    least_change: int

    def advance(self, state: State, streams: Streams) -> State:
        """Advance one step: grow, place, perceive, extend, reach."""
        veins = newest(state, Vasculature)

        # grow: the blade expands and carries veins and sources with it
        moment = self.grow(veins, state.step + 1, streams)

        # place: new sources appear where veins and sources leave room
        self.placement.place(veins, moment, streams["placement"])

        # perceive: each source attracts some of the vein nodes
        attraction = self.perception.perceive(veins, moment)

        # extend: every attracted node grows one segment toward its sources
        n_extended = self.extension.extend(veins, attraction, moment)

        # reach: sources that veins have reached emit no more
        self.perception.look(veins, veins.nodes.n_rows)
        n_reached = self.arrival.reach(veins, moment)

        # record: the state is a view of what there is now
        return self.state(veins, moment, self.reason_to_stop(veins, moment, n_extended, n_reached))

    def grow(self, veins: Vasculature, step: int, streams: Streams) -> Moment:
        """Let the blade grow by one step; stretched veins are refined."""
        moment = Moment.of(self.growth, step)
        self.growth.carry(veins, step)
        if step == self.growth.last_step:
            veins.log(step, EventKind.GROWTH_ENDED, NULL, NULL)
        if veins.side * moment.scale > 2.0 * self.cell_side():
            veins.regrid(self.cell_side() / moment.scale, veins.nodes.n_rows)
        cuts = self.refinement.refine(veins, moment, self.perception.held(veins), streams)
        self.perception.follow(veins, moment, cuts)
        return moment

    def reason_to_stop(
        self, veins: Vasculature, moment: Moment, n_extended: int, n_reached: int
    ) -> StopReason | None:
        """Give the reason why a run ends after a step, or None when it goes on."""
        step = moment.step
        if step >= self.growth.last_step and self.placement.is_over(veins, step):
            if len(veins.live) == 0 and not self.arrival.is_awaiting():
                return StopReason.NO_SOURCES
            if n_extended == 0 and n_reached == 0:
                return StopReason.NOTHING_PULLED
            # No set changed and no source died: the next step would add the same nodes again.
            if n_reached == 0 and self.perception.is_stuck(veins):
                return StopReason.LIVELOCK
        if self.last_step is not None and step >= self.last_step:
            return StopReason.STEP_LIMIT
        return None

    def state(self, veins: Vasculature, moment: Moment, reason: StopReason | None) -> State:
        """Give the state that the tables describe now."""
        if reason is not None:
            veins.log(moment.step, EventKind.RUN_FINISHED, int(reason), NULL)
        blade = self.growth.domain(moment.step)
        scales = self.growth.affine(moment.step)
        return State(
            step=moment.step,
            time=self.growth.time(moment.step),
            blade=blade,
            motion=None if scales is None else affine(scales[0]),
            outline_motion=None if scales is None else affine(scales[1]),
            places=veins.moved(blade.rings[0]) if scales is None else None,
            counts=veins.tables.counts(),
            live=veins.live,
            tables=veins.tables,
            index=veins,
            is_finished=reason is not None,
        )

    def initial_state(self, streams: Streams) -> State:
        """Give the state before the first step: the seed nodes alone."""
        veins = self.vasculature(Tables())
        moment = Moment.of(self.growth, 0)
        self.growth.carry(veins, 0)
        seeds = self.growth.material(self.growth.blade.seeds, 0)
        veins.seed(seeds, self.growth.position(seeds, 0))
        self.placement.begin(veins, streams["placement"])
        return self.state(veins, moment, None)

    def restore(self, tables: Tables, step: int, streams: Streams) -> State:
        """Give the state that a record describes, ready to go on to the same bytes.

        Parameters
        ----------
        tables : Tables
            All rows up to the step.
        step : int
            The last recorded step.
        streams : Streams
            As they were before the first step; set them to the recorded state after this call.
        """
        veins = self.vasculature(tables)
        moment = Moment.of(self.growth, step)
        self.placement.begin(veins, streams["placement"])
        # The last step is repeated as sources saw it: first the veins they were drawn to,
        # then those that had grown, so that what has changed is known as it was.
        self.growth.carry(veins, step)
        n_before = veins.restore(step)
        self.perception.restore(veins)
        self.perception.look(veins, n_before)
        veins.forget_changes()
        veins.index_nodes(n_before, veins.nodes.n_rows)
        self.perception.look(veins, veins.nodes.n_rows)
        return self.state(veins, moment, None)

    def vasculature(self, tables: Tables) -> Vasculature:
        """Give the indexes over tables, at the size of the largest blade."""
        return Vasculature(
            tables, self.growth.box, self.cell_side(), least_change=self.least_change
        )

    def cell_side(self) -> float:
        """Give the side of a cell of the search grid, in D; it decides the speed alone."""
        wanted = 0.4 * self.placement.spacing
        length = self.extension.segment_length
        return float(np.clip(wanted, 2.0 * length, 8.0 * length))
