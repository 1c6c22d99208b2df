"""Stem vasculature: primordia on a stem and the veins between them (Runions 2008, chapter 6)."""

from itertools import pairwise
from math import pi
from pathlib import Path
from typing import Literal

from pydantic import model_validator

from vasc.domain import StemParameters
from vasc.models.base import (
    PrintedParameters,
    RecordParameters,
    StopParameters,
    UnitParameters,
)
from vasc.models.stem_colonization import StemColonization
from vasc.models.stem_perception import StemPerceptionParameters
from vasc.models.strand_record import MOST_RING_NODES
from vasc.parameters import Parameters, quantity
from vasc.placement import PhyllotaxisParameters

MOST_STRETCH = 100.0
"""Height after growth of internodes at most, over that of the stem."""


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
