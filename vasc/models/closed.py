"""Closed venation: veins that meet at sources and form loops (Runions 2008, section 4.3)."""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from vasc.models.arrival import TaggedArrivalParameters
from vasc.models.colonization import Colonization
from vasc.models.leaf import Venation
from vasc.models.perception import Attraction, RelativeParameters, UrquhartParameters
from vasc.parameters import quantity

AnyPerception = Annotated[RelativeParameters | UrquhartParameters, Field(discriminator="kind")]


class ClosedVenation(Venation):
    """Each source attracts its relative neighbours and dies when all awaited have arrived."""

    kind: Literal["closed"] = "closed"
    perception: AnyPerception = quantity(
        "Which nodes a source attracts.", default=RelativeParameters()
    )

    arrival: TaggedArrivalParameters = quantity("When sources are reached.")

    def model(self, folder: Path = Path()) -> Colonization[Attraction]:
        """Give the model; files are looked for in ``folder``."""
        kill_distance = self.arrival.kill_distance
        return Colonization(
            perception=self.perception.perception(kill_distance),
            arrival=self.arrival.arrival(
                self.extension.segment_length, self.perception.influence_radius
            ),
            **self.parts(folder),
        )
