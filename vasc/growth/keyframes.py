"""Key-frames of a config: tables of control rows, or outlines by age."""

from itertools import pairwise
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import model_validator

from vasc.arrays import Floats
from vasc.growth.keyframed import KeyframedGrowth
from vasc.growth.outline_frames import (
    LandmarkParameters,
    OutlineParameters,
    check_outlines,
    fit_outlines,
)
from vasc.parameters import Parameters, quantity


class KeyframeParameters(Parameters):
    """One surface: control rows from the base to the tip."""

    time: float = quantity("When the blade has this shape.", unit="time", ge=0.0)
    rows: list[tuple[float, float, float]] = quantity(
        "Control rows, base to tip: height on the midline, half-width, and rise of the margin"
        " above the midline.",
        unit="D",
        min_length=4,
    )

    @model_validator(mode="after")
    def _check(self) -> "KeyframeParameters":
        """Refuse rows that do not rise or have no width."""
        for number, (row, following) in enumerate(zip(self.rows, self.rows[1:], strict=False)):
            if following[0] <= row[0]:
                raise ValueError(
                    f"the key-frame of time {self.time:g}: row {number + 1} has the height"
                    f" {following[0]:g}; it must be above that of row {number} ({row[0]:g})"
                )
        for number, (_, width, _) in enumerate(self.rows):
            if width <= 0.0:
                raise ValueError(
                    f"the key-frame of time {self.time:g}: row {number} has the half-width"
                    f" {width:g}; it must be greater than 0"
                )
        return self


class KeyframedParameters(Parameters):
    """Growth between surfaces that are given for some times."""

    kind: Literal["keyframed"] = "keyframed"
    frames: list[KeyframeParameters] = quantity(
        "The key-frames, in the order of time; the first is at time 0.", default=[]
    )
    outlines: list[OutlineParameters] = quantity(
        "Outlines by age, to which key-frames are fitted, instead of frames.", default=[]
    )
    landmarks: list[LandmarkParameters] = quantity(
        "Points with one place in the tissue at all ages of the outlines, such as vein ends or"
        " trichomes.",
        default=[],
    )
    n_rows: int = quantity(
        "Rows of control points that are fitted to outlines.", default=9, ge=4, le=40
    )
    tolerance: float = quantity(
        "Largest distance between an outline and the margin fitted to it, and of landmarks.",
        unit="blade length",
        default=0.02,
        gt=0.0,
        le=0.5,
    )
    step_duration: float = quantity("Time that passes in one step.", unit="time", default=1.0, gt=0)

    @model_validator(mode="after")
    def _check(self) -> "KeyframedParameters":
        """Refuse times out of order, and key-frames that are not of one size."""
        if bool(self.frames) == bool(self.outlines):
            raise ValueError("give either 'frames' or 'outlines'")
        if self.outlines:
            check_outlines(self.outlines, self.landmarks)
            return self
        if self.landmarks:
            raise ValueError("'landmarks' need 'outlines'; 'frames' say where all tissue is")
        times = [frame.time for frame in self.frames]
        if times[0] != 0.0:
            raise ValueError(f"the first key-frame is of time {times[0]:g}; it must be 0")
        for row, (before, after) in enumerate(pairwise(self.frames), start=1):
            if after.time <= before.time:
                raise ValueError(
                    f"frames[{row}].time is {after.time:g}; times must ascend, and the one before"
                    f" is {before.time:g}"
                )
            if self.step_duration > after.time - before.time:
                raise ValueError(
                    f"step_duration is {self.step_duration:g}; it must be at most the time between"
                    f" two key-frames, and frames[{row}] follows after {after.time - before.time:g}"
                )
            if len(after.rows) != len(before.rows):
                raise ValueError(
                    f"the key-frame of time {after.time:g} has {len(after.rows)} rows; all must"
                    f" have as many as the first ({len(self.frames[0].rows)})"
                )
        return self

    def keyframes(self, folder: Path = Path()) -> list[tuple[float, Floats]]:
        """Give times and control rows, shape (rows, 3).

        Raises
        ------
        ConfigError
            If an outline cannot be read, or key-frames cannot follow it.
        """
        if self.outlines:
            return fit_outlines(
                self.outlines,
                self.landmarks,
                folder,
                n_rows=self.n_rows,
                tolerance=self.tolerance,
            ).frames
        return [(frame.time, np.array(frame.rows, dtype=np.float64)) for frame in self.frames]

    def growth(self, folder: Path = Path()) -> KeyframedGrowth:
        """Give the growth; the key-frames tell the blade, files are looked for in ``folder``.

        Raises
        ------
        ConfigError
            If an outline cannot be read or followed, the surface folds, or growth would take
            too many steps.
        """
        frames = self.keyframes(folder)
        times = np.array([time for time, _ in frames])
        rows = np.ascontiguousarray([control.T for _, control in frames])
        return KeyframedGrowth(times, rows, self.step_duration)
