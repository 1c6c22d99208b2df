"""What a sweep file may say."""

import math
from typing import Any, Literal, Self

from pydantic import model_validator

from vasc.limits import SWEEP_RUNS
from vasc.parameters import Parameters, quantity


class Span(Parameters):
    """From one value to another, both of them included."""

    low: float = quantity("The first value.", alias="from")
    high: float = quantity("The last value.", alias="to")
    scale: Literal["linear", "log"] = quantity(
        "Equal differences, or equal ratios.", default="linear"
    )
    whole: bool = quantity("Round to whole numbers.", default=False)

    @model_validator(mode="after")
    def _check_ends(self) -> Self:
        """Refuse ends that are one, and logarithms of what has none."""
        if self.low == self.high:
            raise ValueError(f"from and to are both {self.low:g}; they must differ")
        if self.scale == "log" and min(self.low, self.high) <= 0.0:
            raise ValueError('scale = "log" needs from and to greater than 0')
        apart = self.high / self.low if self.scale == "log" else self.high - self.low
        if not math.isfinite(apart):
            raise ValueError(f"from {self.low:g} to {self.high:g} is farther than numbers reach")
        return self

    def at(self, share: float) -> float | int:
        """Give the value at a share of the way from the first to the last one."""
        if share in (0.0, 1.0):
            value = self.high if share else self.low
        elif self.scale == "log":
            value = self.low * (self.high / self.low) ** share
        else:
            value = self.low + share * (self.high - self.low)
        if self.whole:
            return round(value)
        # twelve digits, so that no rounding of a power shows; the ends are as given
        return value if share in (0.0, 1.0) else float(f"{value:.12g}")


class Range(Span):
    """Values of an axis, evenly spaced."""

    num: int = quantity("Number of values.", ge=2, le=10_000)

    def values(self) -> list[float | int]:
        """Give the values in their order; rounded ones that are equal come once."""
        every = [self.at(index / (self.num - 1)) for index in range(self.num)]
        return list(dict.fromkeys(every))


class SweepParameters(Parameters):
    """A base experiment, what is varied in it, and what is measured."""

    base: str = quantity("A bundled experiment, or a config beside the sweep file.", min_length=1)
    title: str = quantity("What the sweep is about, in a sentence.", default="")
    reference: str = quantity("The figure or paper it follows.", default="")
    seed: int = quantity("The seed that the seeds of all runs come from.", default=1, ge=0)
    replicates: int = quantity("Runs of each choice, which differ by seed.", default=1, ge=1)
    draws: int = quantity("Random choices of the keys in [random].", default=1, ge=1)
    measures: list[str] = quantity("What is measured of each run.", min_length=1)
    figure: Literal["curves", "pictures", "none"] = quantity(
        "What the figure shows: measures over the axes, or the leaves.", default="curves"
    )
    changes: dict[str, Any] = quantity(
        "Keys of the config with values that differ from the base in all runs.",
        default={},
        alias="set",
    )
    axes: dict[str, list[Any] | Range] = quantity(
        "Keys of the config with all their values.", default={}
    )
    random: dict[str, Span] = quantity(
        "Keys of the config whose values are drawn at random.", default={}
    )

    @model_validator(mode="after")
    def _check_size(self) -> Self:
        """Refuse draws of nothing, keys that are varied twice, empty axes and too many runs."""
        if "draws" in self.model_fields_set and not self.random:
            raise ValueError(f"draws = {self.draws}: there is no key in [random] to be drawn")
        for key in [*self.axes, *self.random]:
            if (key in self.axes) + (key in self.random) + (key in self.changes) > 1:
                raise ValueError(f"{key}: is in two of [set], [axes] and [random]; one is enough")
        number = self.replicates * self.draws
        for key, values in self.axes.items():
            if not values:
                raise ValueError(f'axes."{key}" = []: must be a list of one or more values')
            number *= values.num if isinstance(values, Range) else len(values)
        if number > SWEEP_RUNS:
            raise ValueError(
                f"axes, draws and replicates make {number:,} runs; at most "
                f"{SWEEP_RUNS:,} are possible"
            )
        return self
