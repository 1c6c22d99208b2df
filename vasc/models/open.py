"""Open venation: free-ending veins, a tree (Runions 2008, section 4.2)."""

from pathlib import Path
from typing import Literal

from vasc.models.arrival import FirstArrival
from vasc.models.colonization import Colonization
from vasc.models.leaf import Venation
from vasc.models.perception import Attraction, NearestParameters
from vasc.parameters import quantity


class OpenVenation(Venation):
    """Each source attracts the nearest node and dies when the first vein arrives."""

    kind: Literal["open"] = "open"
    perception: NearestParameters = quantity(
        "Which nodes a source attracts.", default=NearestParameters()
    )

    def model(self, folder: Path = Path()) -> Colonization[Attraction]:
        """Give the model; files are looked for in ``folder``."""
        kill_distance = self.arrival.kill_distance
        return Colonization(
            perception=self.perception.perception(kill_distance),
            arrival=FirstArrival(kill_distance),
            **self.parts(folder),
        )
