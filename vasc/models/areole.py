"""Areole venation: veins that cross areoles from vein to vein (Runions 2008, section 5.2)."""

from pathlib import Path
from typing import Literal

from vasc.models.canals import CanalPerception, Canals
from vasc.models.colonization import Colonization
from vasc.models.leaf import LeafVenation
from vasc.models.mesophyll import AnyMesophyll, MesophyllNever
from vasc.models.strands import DrainingArrival, StrandParameters
from vasc.parameters import quantity

TIE_SHARE = 0.01
"""Relative neighbors are as close as the closest within that share of the sources' spacing."""


class AreoleVenation(LeafVenation):
    """A source is reached by its closest neighbor; from it veins go on to the others."""

    kind: Literal["areole"] = "areole"
    extension: StrandParameters = quantity("How veins extend.", default=StrandParameters())
    mesophyll: AnyMesophyll = quantity(
        "When the event happens after which veins end blindly.", default=MesophyllNever()
    )

    def model(self, folder: Path = Path()) -> Colonization[Canals]:
        """Give the model; files are looked for in ``folder``."""
        parts = self.parts(folder)
        canals = Canals()
        extension = self.extension.extension(self.mesophyll.step(parts["growth"]))
        return Colonization(
            extension=extension,
            perception=CanalPerception(
                canals, TIE_SHARE * parts["placement"].spacing, self.extension.lean
            ),
            arrival=DrainingArrival(self.arrival.kill_distance, canals, extension),
            **parts,
        )
