"""Stem vasculature: veins between primordia, every node a source (Runions 2008, chapter 6)."""

from dataclasses import dataclass
from itertools import pairwise
from math import pi
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import model_validator

from vasc.domain import StemParameters
from vasc.events import StopReason
from vasc.models.base import (
    Model,
    PrintedParameters,
    RecordParameters,
    StopParameters,
    UnitParameters,
)
from vasc.models.stem_perception import StemPerception, StemPerceptionParameters
from vasc.models.strand_record import MOST_RING_NODES, StrandRecord
from vasc.parameters import Parameters, quantity
from vasc.placement import PhyllotaxisParameters
from vasc.state import State, Tables
from vasc.streams import Streams

MOST_STRETCH = 100.0
"""Height after growth of internodes at most, over that of the stem."""


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
        record = self.record_of(state)
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
        return self.state(self.record_of(state).in_tables(tables), step, None)

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

    @staticmethod
    def record_of(state: State) -> StrandRecord:
        """Give the record of a state, which must be the newest of its run.

        Raises
        ------
        ValueError
            If the state has a successor already.
        """
        record = state.index
        if not isinstance(record, StrandRecord) or record.tables.counts() != state.counts:
            raise ValueError(f"the state of step {state.step} has been advanced already")
        return record


class StemExtensionParameters(Parameters):
    """How strands extend."""

    segment_length: float = quantity(
        "Length of a new segment (D); all other lengths are in the same unit.",
        unit="D",
        default=1.0,
        gt=0.0,
    )


class StemVasculature(Parameters):
    """Primordia of a stem, and the strands that connect them."""

    kind: Literal["stem"] = "stem"
    title: str = quantity("One sentence on the experiment.", default="")
    reference: str = quantity("The figure or paper it follows.", default="")
    seed: int = quantity("Seed of all randomness.", default=1, ge=0, lt=2**63)
    domain: StemParameters = quantity("The stem.")
    placement: PhyllotaxisParameters = quantity("Where and when primordia appear.")
    perception: StemPerceptionParameters = quantity(
        "Which nodes perceive each other.", default=StemPerceptionParameters()
    )
    extension: StemExtensionParameters = quantity(
        "How strands extend.", default=StemExtensionParameters()
    )
    internodes: list[tuple[float, float]] = quantity(
        "Growth of internodes, for pictures alone: pairs of the height over that of the stem and"
        " of the height after growth, from [0, 0] on; a smooth curve rises through them (Figure"
        " 6.5).",
        default=[],
    )
    stop: StopParameters = quantity("When the run ends.", default=StopParameters())
    record: RecordParameters = quantity("What is recorded.", default=RecordParameters())
    units: UnitParameters | None = quantity("Real units.", default=None)
    printed: PrintedParameters | None = quantity("Values as printed.", default=None)

    @model_validator(mode="after")
    def _check_internodes(self) -> "StemVasculature":
        """Require a map of heights that rises from the base to the top."""
        pairs = self.internodes
        if not pairs:
            return self
        if pairs[0] != (0.0, 0.0) or pairs[-1][0] != 1.0:
            raise ValueError(
                f"internodes begins with {list(pairs[0])} and ends with {list(pairs[-1])}; the"
                " first must be [0, 0], and the last must have the height 1"
            )
        for row, ((a, b), (c, d)) in enumerate(pairwise(pairs), start=1):
            if d > MOST_STRETCH:
                raise ValueError(
                    f"internodes[{row}] is {[c, d]}; no height may become more than"
                    f" {MOST_STRETCH:g} times that of the stem"
                )
            if c <= a or d <= b:
                raise ValueError(
                    f"internodes[{row}] is {[c, d]}; both numbers must be above those of {[a, b]}"
                )
        return self

    @model_validator(mode="after")
    def _check(self) -> "StemVasculature":
        """Refuse stems too thin for a ring or too thick to hold, and levels too near each other."""
        length, rise = self.extension.segment_length, self.placement.rise
        if rise < length:
            raise ValueError(
                f"placement.rise is {rise:g}; it must be at least extension.segment_length"
                f" ({length:g}): nearer primordia would be joined when they appear"
            )
        radii = [radius for _, radius in self.domain.radii] or [self.domain.radius or 0.0]
        key = "domain.radii" if self.domain.radii else "domain.radius"
        if min(radii) < length:
            raise ValueError(
                f"{key}: a radius of {min(radii):g} is less than extension.segment_length"
                f" ({length:g}); it must be at least that"
            )
        n_ring = 2.0 * pi * max(radii) / length
        if n_ring > MOST_RING_NODES:
            raise ValueError(
                f"{key}: a radius of {max(radii):g} makes a ring of {n_ring:.3g} nodes, more than"
                f" memory can hold; at most {MOST_RING_NODES:,} are allowed"
            )
        return self

    @property
    def stream_names(self) -> tuple[str, ...]:
        """Names of the processes that draw random numbers."""
        return ("placement",)

    def model(self, folder: Path = Path()) -> StemColonization:
        """Give the model."""
        length = self.extension.segment_length
        return StemColonization(
            domain=self.domain,
            placement=self.placement,
            perception=self.perception.perception(self.domain, length),
            segment_length=length,
            last_step=self.stop.steps,
        )
