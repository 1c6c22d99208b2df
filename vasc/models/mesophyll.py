"""The mesophyll event: from some step on, developing veins end blindly (Runions 2008, 5.2.4)."""

from typing import Annotated, Literal

from pydantic import Field

from vasc.growth import Growth
from vasc.limits import RUN_STEPS
from vasc.parameters import Parameters, quantity


class MesophyllNever(Parameters):
    """Veins always join."""

    kind: Literal["never"] = "never"

    def step(self, growth: Growth) -> int | None:
        """Give None: the event never happens."""
        return None


class MesophyllTime(Parameters):
    """The event happens at a time."""

    kind: Literal["time"] = "time"
    time: float = quantity("When the event happens; 0: before any vein.", unit="time", ge=0.0)

    def step(self, growth: Growth) -> int | None:
        """Give the first step at that time or later, None if no run lasts so long."""
        if self.time > growth.time(RUN_STEPS):
            return None
        step = max(1, int(self.time / growth.time(1)))
        # a step takes the same time always; the division may be off by rounding
        while step > 1 and growth.time(step - 1) >= self.time:
            step -= 1
        return step if growth.time(step) >= self.time else step + 1


class MesophyllLength(Parameters):
    """The event happens when the blade reaches a length."""

    kind: Literal["length"] = "length"
    length: float = quantity("Blade length at the event.", unit="D", gt=0.0)

    def step(self, growth: Growth) -> int | None:
        """Give the first step with a blade as long, None if it never is."""
        for step in range(1, growth.last_step + 1):
            if growth.domain(step).length >= self.length:
                return step
        return None


class MesophyllRate(Parameters):
    """The event happens when growth has become slow."""

    kind: Literal["growth_rate"] = "growth_rate"
    rate: float = quantity(
        "Relative areal growth rate of the blade below which it happens.", unit="1/time", gt=0.0
    )
    after: float = quantity(
        "Time before which slow growth does not count.", unit="time", default=0.0, ge=0.0
    )

    def step(self, growth: Growth) -> int | None:
        """Give the first step over which the blade grows more slowly; its end, if none does."""
        areas = [growth.domain(0).area]
        # the last step may be filled by growth in part only
        for step in range(1, growth.last_step):
            areas.append(growth.domain(step).area)
            duration = growth.time(step) - growth.time(step - 1)
            rate = (areas[-1] / areas[-2] - 1.0) / duration
            if growth.time(step) > self.after and rate < self.rate:
                return step
        return growth.last_step + 1


AnyMesophyll = Annotated[
    MesophyllNever | MesophyllTime | MesophyllLength | MesophyllRate, Field(discriminator="kind")
]
