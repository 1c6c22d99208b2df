"""Key-frames of a config that are given as outlines and landmarks by age."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
from pydantic import model_validator

from vasc.arrays import Points
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


def check_outlines(
    outlines: Sequence[OutlineParameters], landmarks: Sequence[LandmarkParameters]
) -> None:
    """Make sure that times ascend from 0, and that landmarks are of as many ages.

    Raises
    ------
    ValueError
        If not; the message names the row and what is allowed.
    """
    if outlines[0].time != 0.0:
        raise ValueError(f"outlines[0].time is {outlines[0].time:g}; it must be 0")
    for row, (before, after) in enumerate(pairwise(outlines), 1):
        if after.time <= before.time:
            raise ValueError(
                f"outlines[{row}].time is {after.time:g}; times must ascend, and the one"
                f" before is {before.time:g}"
            )
    for row, mark in enumerate(landmarks):
        if len(mark.positions) != len(outlines):
            raise ValueError(
                f"landmarks[{row}].positions holds {len(mark.positions)} places; it must have"
                f" one for each of the {len(outlines)} outlines"
            )


def fit_outlines(
    outlines: Sequence[OutlineParameters],
    landmarks: Sequence[LandmarkParameters],
    folder: Path,
    *,
    n_rows: int,
    tolerance: float,
) -> FittedFrames:
    """Fit key-frames to the outlines of a config; files are looked for in ``folder``.

    Parameters
    ----------
    outlines, landmarks : sequence
        Sound ones, see :func:`check_outlines`.
    folder : Path
        What the files of the outlines are relative to.
    n_rows, tolerance : int, float
        See :func:`vasc.growth.surface_fit.fit_keyframes`.

    Returns
    -------
    FittedFrames

    Raises
    ------
    ConfigError
        If an outline cannot be read, or key-frames cannot follow what is given.
    """
    heights = [outline.height for outline in outlines]
    return fit_keyframes(
        [_ring(row, outline, folder) for row, outline in enumerate(outlines)],
        [outline.time for outline in outlines],
        [_landmark(mark, heights) for mark in landmarks],
        n_rows=n_rows,
        tolerance=tolerance,
    )


def _ring(row: int, outline: OutlineParameters, folder: Path) -> Points:
    """Read an outline, in D."""
    key = f'growth.outlines[{row}].file = "{outline.file}"'
    try:
        rings = read_outline(folder / outline.file)
    except OutlineError as error:
        raise ConfigError(f"{key}: {error}") from error
    if len(rings) != 1:
        raise ConfigError(f"{key}: holds {len(rings)} rings; a leaf of one ring is needed")
    return rounded(rings[0]) * outline.height


def _landmark(mark: LandmarkParameters, heights: Sequence[float]) -> Landmark:
    """Give a landmark in D."""
    pairs = np.array([pair or [np.nan, np.nan] for pair in mark.positions])
    return Landmark(mark.name, pairs * np.array(heights)[:, None])
