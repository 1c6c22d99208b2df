"""The sentence of a stem: every node of its veins is a source (Runions 2008, section 6.2.1)."""

from dataclasses import dataclass

import numpy as np

from vasc.domain import StemParameters
from vasc.events import StopReason
from vasc.models.base import Model, newest
from vasc.models.stem_perception import StemPerception
from vasc.models.strand_record import StrandRecord
from vasc.placement import PhyllotaxisParameters
from vasc.state import State, Tables
from vasc.streams import Streams


@dataclass(frozen=True)
class StemColonization(Model):
    """Veins of a stem, which colonize the space between primordia as these appear.

    Parameters
    ----------
    domain : StemParameters
        The stem.
    placement : PhyllotaxisParameters
        Its primordia.
    perception : StemPerception
        Which nodes perceive each other.
    segment_length : float
        Length of a new segment, D.
    last_step : int or None
        The run ends after this step at the latest.
    """

    domain: StemParameters
    placement: PhyllotaxisParameters
    perception: StemPerception
    segment_length: float
    last_step: int | None

    def advance(self, state: State, streams: Streams) -> State:
        """Advance one step: grow, place, perceive, extend, reach."""
        record = newest(state, StrandRecord)
        step = state.step + 1
        n_before = record.stem.n_nodes, record.stem.n_edges

        # grow: the apex has risen; nothing that it left behind moves
        # place: primordia appear at the apex
        record.add_primordia(step, record.phyllotaxis.born(step), self.perception)

        # perceive: each is a source to its relative neighbours, and these to it
        record.stem = self.perception.perceive(record.stem, n_before[0])

        # extend: every node of an active pair grows one segment toward its partners
        n_nodes = record.stem.n_nodes
        record.stem = self.perception.extend(record.stem)

        # reach: nodes that have come near are joined; the others are perceived from now on
        record.stem = self.perception.perceive(record.stem, n_nodes)

        # record: the state is a view of what there is now
        record.write(step, self.perception)
        is_at_rest = n_before == (record.stem.n_nodes, record.stem.n_edges)
        return self.state(record, step, self.reason_to_stop(record, step, is_at_rest))

    def reason_to_stop(
        self, record: StrandRecord, step: int, is_at_rest: bool
    ) -> StopReason | None:
        """Give the reason why a run ends after a step, or None when it goes on."""
        if step >= record.phyllotaxis.last_step:
            if len(record.stem.pairs) == 0:
                return StopReason.NO_SOURCES
            if is_at_rest:
                return StopReason.NOTHING_PULLED
        if self.last_step is not None and step >= self.last_step:
            return StopReason.STEP_LIMIT
        return None

    def initial_state(self, streams: Streams) -> State:
        """Give the state before the first step: the ring of the hypocotyl alone."""
        return self._begun(Tables(dimensions=3), streams)

    def _begun(self, tables: Tables, streams: Streams) -> State:
        """Give the first state, in tables that are empty."""
        phyllotaxis = self.placement.phyllotaxis(
            self.domain, self.segment_length, streams["placement"]
        )
        record = StrandRecord(tables, phyllotaxis, self.perception.stem())
        record.add_ring(
            float(self.domain.radius_at(np.zeros(1))[0]), self.segment_length, self.perception
        )
        record.stem = self.perception.perceive(record.stem, 0)
        record.write(0, self.perception)
        return self.state(record, 0, None)

    def restore(self, tables: Tables, step: int, streams: Streams) -> State:
        """Give the state that a record describes, ready to go on to the same bytes.

        Active pairs are in no table; the steps are made again, which takes microseconds
        a node.
        """
        state = self._begun(Tables(dimensions=3), streams)
        while state.step < step:
            state = self.advance(state, streams)
        return self.state(newest(state, StrandRecord).in_tables(tables), step, None)

    def state(self, record: StrandRecord, step: int, reason: StopReason | None) -> State:
        """Give the state that the tables describe now."""
        if reason is not None:
            record.finish(step, reason)
        return State(
            step=step,
            time=float(step),
            blade=None,
            motion=None,
            outline_motion=None,
            counts=record.tables.counts(),
            live=np.arange(record.tables["sources"].n_rows, dtype=np.int32),
            tables=record.tables,
            index=record,
            is_finished=reason is not None,
            base_ring=record.ring,
        )
