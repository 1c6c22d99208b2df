"""A hypothesis: cells lose the competence to extend a vein as they grow old."""

from pathlib import Path
from typing import Literal

from vasc.models import OpenVenation
from vasc.models.extension import Extension
from vasc.models.perception import Attraction
from vasc.parameters import quantity
from vasc.placement import Moment
from vasc.vasculature import Vasculature


class YoungExtension(Extension[Attraction]):
    """Extends the nodes that are at most ``competence`` steps old, by the rule it is given."""

    def __init__(self, rule: Extension[Attraction], competence: int) -> None:
        self.rule, self.competence = rule, competence

    @property
    def segment_length(self) -> float:
        """Length of a new segment, D."""
        return self.rule.segment_length

    def extend(self, veins: Vasculature, attraction: Attraction, moment: Moment) -> int:
        """Add the new nodes and their segments; gives their number."""
        births = veins.nodes.arrays["birth"][attraction.pulls.nodes[attraction.order]]
        young = attraction.order[moment.step - births <= self.competence]
        return self.rule.extend(veins, attraction._replace(order=young), moment)


class YoungVenation(OpenVenation):
    """Open venation whose veins branch only where they are young."""

    kind: Literal["young-open"] = "young-open"
    competence: int = quantity("Age up to which a node can extend.", unit="steps", ge=1)

    def parts(self, folder: Path) -> dict:
        """Give the parts of open venation, with an extension of our own."""
        parts = super().parts(folder)
        return {**parts, "extension": YoungExtension(parts["extension"], self.competence)}
