"""Sources that are given: points, with steps of birth if wanted, instead of a placement."""

import csv
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import model_validator

from vasc.arrays import Points, Steps, as_points
from vasc.errors import ConfigError
from vasc.growth import Growth
from vasc.limits import RUN_STEPS
from vasc.parameters import Parameters, quantity
from vasc.placement.base import Moment, Placement
from vasc.sources import Cause
from vasc.vasculature import Vasculature


class GivenPlacement(Placement):
    """Sources at given positions, each from a given step on.

    Parameters
    ----------
    growth : Growth
        The growing blade.
    points : ndarray of shape (n, 2), float64
        Positions at the step of birth, in D.
    births : ndarray of shape (n,), int32
        Steps of birth, at least 1, ascending.
    """

    def __init__(self, growth: Growth, points: Points, births: Steps) -> None:
        self.growth = growth
        self.points = points
        self.births = births

    @property
    def spacing(self) -> float:
        """The distance of as many points spread evenly over the blade."""
        return float(np.sqrt(self.growth.blade.area / max(1, len(self.points))))

    def place(self, veins: Vasculature, moment: Moment, rng: np.random.Generator) -> None:
        """Let the sources of this step appear."""
        rows = np.flatnonzero(self.births == moment.step)
        if len(rows) == 0:
            return
        veins.reserve_sources(len(rows))
        start = veins.sources.n_rows
        stop = start + len(rows)
        veins.places("sources")[start:stop] = self.points[rows] / moment.scale
        veins.is_live[start:stop] = 1
        veins.add_sources(moment.step, *moment.embed(veins.new_places(len(rows))), Cause.GIVEN)

    def is_over(self, veins: Vasculature, step: int) -> bool:
        """Tell whether all have appeared."""
        return len(self.births) == 0 or step >= int(self.births[-1])


class GivenParameters(Parameters):
    """A given set of sources: unit experiments and benchmarks."""

    kind: Literal["given"] = "given"
    points: list[tuple[float, float]] | None = quantity(
        "Positions of the sources, pairs [x, y].", unit="D", default=None, min_length=1
    )
    births: list[int] | None = quantity(
        "Step in which each appears; by default the first.", unit="steps", default=None
    )
    file: str | None = quantity(
        "CSV file with columns x, y and, if wanted, birth, instead of points.", default=None
    )

    @model_validator(mode="after")
    def _check(self) -> "GivenParameters":
        """Require one of the two ways, and one birth a point."""
        if (self.points is None) == (self.file is None):
            raise ValueError("give either 'points' or 'file'")
        if self.births is not None:
            if self.points is None or len(self.births) != len(self.points):
                raise ValueError("'births' needs one step for each of 'points'")
            if min(self.births) < 1:
                raise ValueError(f"'births' holds {min(self.births)}; the first step is 1")
        return self

    def placement(self, growth: Growth, kill_distance: float, folder: Path) -> GivenPlacement:
        """Give the placement for a growing blade.

        Raises
        ------
        ConfigError
            If the file cannot be read or a source lies outside the blade.
        """
        if self.file is not None:
            points, births = read_sources(folder / self.file)
        else:
            points = as_points(self.points or [], "placement.points")
            births = np.array(self.births or [1] * len(points), dtype=np.int32)
        for birth in np.unique(births).tolist():
            rows = np.flatnonzero(births == birth)
            is_inside = growth.domain(birth).contains(points[rows])
            if not is_inside.all():
                x, y = points[rows[~is_inside][0]].tolist()
                raise ConfigError(
                    f"placement: source ({x:g}, {y:g}) lies outside the blade of step {birth};"
                    " sources must lie inside"
                )
        order = np.argsort(births, kind="stable")
        return GivenPlacement(growth, points[order], births[order])


def read_sources(path: Path) -> tuple[Points, Steps]:
    """Read sources from a CSV file with columns x, y and perhaps birth.

    Raises
    ------
    ConfigError
        If the file is missing or a row is not made of numbers.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as stream:
            rows = list(csv.DictReader(stream))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ConfigError(f"placement.file: cannot read {str(path)!r}: {error}") from error
    points, births = [], []
    for number, row in enumerate(rows, start=2):
        try:
            points.append((float(row["x"]), float(row["y"])))
            births.append(int(row.get("birth") or 1))
        except (KeyError, TypeError, ValueError) as error:
            raise ConfigError(
                f"placement.file: line {number} of {str(path)!r} is {row!r:.80}; allowed are"
                " columns x, y (numbers) and birth (a whole number)"
            ) from error
        if not 1 <= births[-1] <= RUN_STEPS:
            raise ConfigError(
                f"placement.file: line {number} of {str(path)!r}: the birth is {births[-1]:.6g};"
                f" it must be a step from 1 to {RUN_STEPS:,}"
            )
    if not points:
        raise ConfigError(f"placement.file: {str(path)!r} holds no sources")
    return as_points(points, "placement.file"), np.array(births, dtype=np.int32)
