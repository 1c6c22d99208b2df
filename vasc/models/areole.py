"""Areole venation: veins that cross areoles from vein to vein (Runions 2008, section 5.2)."""

from pathlib import Path
from typing import Literal

from vasc.models.base import LeafVenation
from vasc.models.canals import CanalPerception, Canals
from vasc.models.colonization import Colonization
from vasc.models.mesophyll import AnyMesophyll, MesophyllNever
from vasc.models.strands import DrainingArrival, StrandExtension
from vasc.parameters import Parameters, quantity

TIE_SHARE = 0.01
"""Relative neighbours are as close as the closest within that share of the sources' spacing."""


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


class AreoleVenation(LeafVenation):
    """A source is reached by its closest neighbour; from it veins go on to the others."""

    kind: Literal["areole"] = "areole"
    extension: StrandParameters = quantity("How veins extend.", default=StrandParameters())
    mesophyll: AnyMesophyll = quantity(
        "When the event happens after which veins end blindly.", default=MesophyllNever()
    )

    def model(self, folder: Path = Path()) -> Colonization[Canals]:
        """Give the model; files are looked for in ``folder``."""
        parts = self.parts(folder)
        canals = Canals()
        extension = StrandExtension(
            self.extension.segment_length,
            self.mesophyll.step(parts["growth"]),
            self.extension.blind_gap,
        )
        parts["extension"] = extension
        return Colonization(
            perception=CanalPerception(
                canals, TIE_SHARE * parts["placement"].spacing, self.extension.lean
            ),
            arrival=DrainingArrival(self.arrival.kill_distance, canals, extension),
            **parts,
        )
