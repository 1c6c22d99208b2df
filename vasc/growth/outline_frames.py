"""Key-frames of a config that are given as outlines and landmarks by age."""

from itertools import pairwise
from pathlib import Path

import numpy as np
from pydantic import model_validator

from vasc.arrays import Floats, Points
from vasc.domain import read_outline
from vasc.domain.normalization import rounded
from vasc.errors import ConfigError, OutlineError
from vasc.growth.surface_fit import FittedFrames, Landmark, fit_keyframes
from vasc.parameters import Parameters, quantity


class OutlineParameters(Parameters):
    """The outline of a leaf at one age."""

    time: float = quantity("Time of this age; that of the first is 0.", unit="time", ge=0.0)
    file: str = quantity("A file with the outline, as for the domain.")
    height: float = quantity("Length of the leaf at this age.", unit="D", gt=0.0, le=1e4)


class LandmarkParameters(Parameters):
    """A point of the tissue that is recognised at several ages."""

    name: str = quantity("What it is, for example 'first lateral vein'.", min_length=1)
    positions: list[list[float]] = quantity(
        "Where it is at each age, [x, y] from the attachment; [] where it was not seen.",
        unit="blade length",
    )

    @model_validator(mode="after")
    def _check(self) -> "LandmarkParameters":
        """Require pairs, at least one."""
        for age, pair in enumerate(self.positions):
            if len(pair) not in (0, 2):
                raise ValueError(f"positions[{age}] holds {len(pair)} numbers; give [x, y] or []")
        if not any(self.positions):
            raise ValueError("'positions' holds no pair; a landmark must be seen at one age")
        return self


class OutlineFrames(Parameters):
    """Key-frames from outlines of one symmetric leaf at several ages."""

    outlines: list[OutlineParameters] = quantity(
        "Outlines in the order of their times.", min_length=1
    )
    landmarks: list[LandmarkParameters] = quantity(
        "Points that have one place in the tissue, such as vein ends or trichomes.", default=[]
    )
    n_rows: int = quantity("Rows of control points of the surface.", default=9, ge=4, le=40)
    tolerance: float = quantity(
        "Largest distance between outline and margin, and of landmarks.",
        unit="blade length",
        default=0.02,
        gt=0.0,
        le=0.5,
    )

    @model_validator(mode="after")
    def _check(self) -> "OutlineFrames":
        """Require ascending times from 0 on, and landmarks of as many ages."""
        if self.outlines[0].time != 0.0:
            raise ValueError(f"outlines[0].time is {self.outlines[0].time:g}; it must be 0")
        for row, (before, after) in enumerate(pairwise(self.outlines), 1):
            if after.time <= before.time:
                raise ValueError(
                    f"outlines[{row}].time is {after.time:g}; times must ascend, and the one"
                    f" before is {before.time:g}"
                )
        for row, mark in enumerate(self.landmarks):
            if len(mark.positions) != len(self.outlines):
                raise ValueError(
                    f"landmarks[{row}].positions holds {len(mark.positions)} places; it must have"
                    f" one for each of the {len(self.outlines)} outlines"
                )
        return self

    def fitted(self, folder: Path = Path()) -> FittedFrames:
        """Fit key-frames; files are looked for in ``folder``.

        Raises
        ------
        ConfigError
            If an outline cannot be read, or key-frames cannot follow what is given.
        """
        return fit_keyframes(
            [self._ring(row, folder) for row in range(len(self.outlines))],
            [outline.time for outline in self.outlines],
            [self._landmark(mark) for mark in self.landmarks],
            n_rows=self.n_rows,
            tolerance=self.tolerance,
        )

    def keyframes(self, folder: Path = Path()) -> list[tuple[float, Floats]]:
        """Give times and rows y, w, s, shape (rows, 3), as the key-framed growth takes them.

        Raises
        ------
        ConfigError
            If an outline cannot be read, or key-frames cannot follow what is given.
        """
        return self.fitted(folder).frames

    def _ring(self, row: int, folder: Path) -> Points:
        """Read an outline, in D."""
        outline = self.outlines[row]
        key = f'growth.outlines[{row}].file = "{outline.file}"'
        try:
            rings = read_outline(folder / outline.file)
        except OutlineError as error:
            raise ConfigError(f"{key}: {error}") from error
        if len(rings) != 1:
            raise ConfigError(f"{key}: holds {len(rings)} rings; a leaf of one ring is needed")
        return rounded(rings[0]) * outline.height

    def _landmark(self, mark: LandmarkParameters) -> Landmark:
        """Give a landmark in D."""
        pairs = np.array([pair or [np.nan, np.nan] for pair in mark.positions])
        heights = np.array([outline.height for outline in self.outlines])
        return Landmark(mark.name, pairs * heights[:, None])
