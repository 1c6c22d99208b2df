"""What the configs of the leaf models have in common: the parts, and what must fit together."""

from abc import abstractmethod
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, model_validator

from vasc.domain import BladeParameters
from vasc.growth import (
    Growth,
    IsogonicParameters,
    KeyframedParameters,
    LinearGrowthParameters,
    LocalToGlobalParameters,
    MarginalParameters,
    NoGrowthParameters,
)
from vasc.models.arrival import ArrivalParameters
from vasc.models.base import (
    Model,
    PrintedParameters,
    RecordParameters,
    StopParameters,
    UnitParameters,
)
from vasc.models.corner_cutting import CornerCuttingParameters
from vasc.models.extension import ExtensionParameters
from vasc.models.refinement import NoRefinementParameters, SubdivisionParameters
from vasc.parameters import Parameters, quantity
from vasc.placement import DartParameters, EmptyCircleParameters, GivenParameters, Placement

AnyGrowth = Annotated[
    NoGrowthParameters
    | MarginalParameters
    | IsogonicParameters
    | KeyframedParameters
    | LocalToGlobalParameters,
    Field(discriminator="kind"),
]
AnyPlacement = Annotated[
    DartParameters | GivenParameters | EmptyCircleParameters, Field(discriminator="kind")
]
AnyRefinement = Annotated[
    NoRefinementParameters | SubdivisionParameters | CornerCuttingParameters,
    Field(discriminator="kind"),
]


class LeafVenation(Parameters):
    """What the configs of leaf venation have in common."""

    title: str = quantity("One sentence on the experiment.", default="")
    reference: str = quantity("The figure or paper it follows.", default="")
    seed: int = quantity("Seed of all randomness.", default=1, ge=0, lt=2**63)
    domain: BladeParameters | None = quantity(
        "The blade at step 0; none where key-frames tell it.", default=None
    )
    growth: AnyGrowth = quantity("How the blade grows.", default=NoGrowthParameters())
    placement: AnyPlacement = quantity("Where sources appear.")
    extension: Any = quantity("How veins extend.")
    arrival: ArrivalParameters = quantity("When sources are reached.")
    refinement: AnyRefinement = quantity(
        "What becomes of stretched segments.", default=NoRefinementParameters()
    )
    stop: StopParameters = quantity("When the run ends.", default=StopParameters())
    record: RecordParameters = quantity("What is recorded.", default=RecordParameters())
    units: UnitParameters | None = quantity("Real units.", default=None)
    printed: PrintedParameters | None = quantity("Values as printed.", default=None)

    @model_validator(mode="after")
    def _check_kill_distance(self) -> "LeafVenation":
        """Refuse kill distances that veins step over (they would livelock)."""
        kill, length = self.arrival.kill_distance, self.extension.segment_length
        if kill < length:
            raise ValueError(
                f"arrival.kill_distance is {kill:g}; it must be at least"
                f" extension.segment_length ({length:g}): with a shorter one veins step over"
                " sources and never reach them"
            )
        return self

    @model_validator(mode="after")
    def _check_growth(self) -> "LeafVenation":
        """Refuse a blade that would have to shrink, and placements that need marginal growth."""
        growth, placement = self.growth, self.placement
        if isinstance(growth, KeyframedParameters) and self.domain is not None:
            raise ValueError(
                "domain: key-frames tell the blade, so that growth.kind = 'keyframed' allows no"
                " table [domain]"
            )
        if not isinstance(growth, KeyframedParameters) and self.domain is None:
            raise ValueError(
                f"domain: missing; growth.kind = {growth.kind!r} needs a table [domain] with the"
                " length of the blade"
            )
        if (
            isinstance(growth, LinearGrowthParameters)
            and self.domain is not None
            and growth.final_length < self.domain.length
        ):
            raise ValueError(
                f"growth.final_length is {growth.final_length:g}; it must be at least"
                f" domain.length ({self.domain.length:g})"
            )
        if (
            isinstance(placement, DartParameters)
            and placement.reading == "largest_blade"
            and not isinstance(growth, MarginalParameters)
        ):
            raise ValueError(
                "placement.reading is 'largest_blade'; it needs growth.kind = 'marginal',"
                " where places in the blade stay (section 4.2.3)"
            )
        return self

    @model_validator(mode="after")
    def _check_circles(self) -> "LeafVenation":
        """Refuse sources so near to each other that veins would reach them where they begin."""
        placement, kill = self.placement, self.arrival.kill_distance
        if isinstance(placement, EmptyCircleParameters) and placement.birth_distance <= kill:
            raise ValueError(
                f"placement.birth_distance is {placement.birth_distance:g}; it must be greater than"
                f" arrival.kill_distance ({kill:g}), or sources appear that are reached at once"
            )
        return self

    @model_validator(mode="after")
    def _check_until(self) -> "LeafVenation":
        """Refuse a last step of darts where they are thrown once."""
        placement = self.placement
        if not isinstance(placement, DartParameters) or placement.reading == "each_step":
            return self
        if placement.until is not None:
            raise ValueError(
                f"placement.until is {placement.until}; it is not allowed with"
                " placement.reading = 'largest_blade', where darts are thrown once"
            )
        return self

    def grown(self, folder: Path) -> Growth:
        """Give the growing blade; files are looked for in ``folder``."""
        if isinstance(self.growth, KeyframedParameters):
            return self.growth.growth(folder)
        assert self.domain is not None, "checked"
        blade = self.domain.blade(folder)
        if isinstance(self.growth, LocalToGlobalParameters):
            return self.growth.growth(blade, folder)
        return self.growth.growth(blade)

    def parts(self, folder: Path) -> dict[str, Any]:
        """Give the parts of the sentence that do not depend on the kind of venation."""
        growth = self.grown(folder)
        kill, length = self.arrival.kill_distance, self.extension.segment_length
        placement = self.placement
        birth_distance = float("inf")
        if isinstance(placement, GivenParameters):
            placed: Placement = placement.placement(growth, kill, folder)
        else:
            placed = placement.placement(growth, kill)
            if isinstance(placement, DartParameters):
                birth_distance = placement.birth_distance_veins
        return {
            "growth": growth,
            "placement": placed,
            "refinement": self.refinement.refinement(growth, birth_distance, length),
            "last_step": self.stop.steps,
            "least_change": self.record.least_change,
        }

    @property
    def stream_names(self) -> tuple[str, ...]:
        """Names of the processes that draw random numbers."""
        refinement = self.refinement
        is_jittered = isinstance(refinement, CornerCuttingParameters) and refinement.jitter > 0.0
        return ("placement", "refinement") if is_jittered else ("placement",)

    @abstractmethod
    def model(self, folder: Path = Path()) -> Model:
        """Give the model; files are looked for in ``folder``."""


class Venation(LeafVenation):
    """What open and closed venation have in common: sources pull veins."""

    extension: ExtensionParameters = quantity("How veins extend.", default=ExtensionParameters())

    def parts(self, folder: Path) -> dict[str, Any]:
        """Give the parts of the sentence that do not depend on what sources attract."""
        parts = super().parts(folder)
        return {**parts, "extension": self.extension.extension(parts["growth"])}
