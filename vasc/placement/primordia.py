"""Primordia by a phyllotaxis: constant divergence, rise and plastochron (Runions 2008, 6.2)."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import model_validator

from vasc.arrays import Floats
from vasc.domain import StemParameters
from vasc.limits import RUN_STEPS
from vasc.parameters import Parameters, quantity


class Phyllotaxis:
    """Where the primordia of a stem are, and when each appears.

    Parameters
    ----------
    places : ndarray of shape (p, 3), float64
        Positions of the primordia, oldest first, in D.
    births : ndarray of shape (p,), int64
        Steps in which they appear, never falling.
    """

    def __init__(self, places: NDArray[np.float64], births: NDArray[np.int64]) -> None:
        self.places = places
        self.births = births

    @property
    def last_step(self) -> int:
        """The step in which the last one appears."""
        return int(self.births[-1])

    def born(self, step: int) -> NDArray[np.intp]:
        """Give the numbers of the primordia that appear in a step."""
        return np.flatnonzero(self.births == step)


class PhyllotaxisParameters(Parameters):
    """Primordia on a lattice around the stem."""

    kind: Literal["phyllotaxis"] = "phyllotaxis"
    divergence: float = quantity(
        "Angle from one level to the next: 137.5 golden, 99.5 Lucas, 180 distichous, 90 decussate"
        " with two primordia a level.",
        unit="degrees",
        gt=-360.0,
        lt=360.0,
    )
    rise: float = quantity("Height from one level to the next (H).", unit="D", gt=0.0, le=1e5)
    primordia: int = quantity("How many primordia appear.", default=40, ge=1, le=100_000)
    per_level: int = quantity("Primordia at each level, evenly around it.", default=1, ge=1, le=64)
    plastochron: int | None = quantity(
        "Steps from one level to the next; by default half the rise over the segment length, so"
        " that the apex rises as fast as two veins meet.",
        unit="steps",
        default=None,
        ge=1,
        le=RUN_STEPS,
    )
    first_step: int = quantity(
        "Step of the first primordia.", unit="steps", default=6, ge=1, le=RUN_STEPS
    )
    angle_noise: float = quantity(
        "Standard deviation of each primordium's angle.",
        unit="degrees",
        default=0.0,
        ge=0.0,
        le=180,
    )
    rise_noise: float = quantity(
        "Standard deviation of each primordium's height over the rise.", default=0.0, ge=0.0, le=0.5
    )

    @model_validator(mode="after")
    def _check(self) -> "PhyllotaxisParameters":
        """Refuse primordia so late that no run sees them."""
        n_levels = (self.primordia - 1) // self.per_level
        last = self.first_step + n_levels * (self.plastochron or 1)
        if last > RUN_STEPS:
            raise ValueError(
                f"plastochron is {self.plastochron}; the last of {self.primordia} primordia would"
                f" appear in step {last:,}, and at most {RUN_STEPS:,} steps are allowed"
            )
        return self

    @property
    def is_noisy(self) -> bool:
        """Whether random numbers are drawn."""
        return self.angle_noise > 0.0 or self.rise_noise > 0.0

    def steps_per_level(self, segment_length: float) -> int:
        """Give the plastochron, the default if none is given."""
        if self.plastochron is not None:
            return self.plastochron
        return max(1, round(self.rise / (2.0 * segment_length)))

    def phyllotaxis(
        self, stem: StemParameters, segment_length: float, rng: np.random.Generator
    ) -> Phyllotaxis:
        """Give the primordia of a stem.

        Parameters
        ----------
        stem : StemParameters
            The stem they are on.
        segment_length : float
            D.
        rng : Generator
            Drawn from only if there is noise.

        Returns
        -------
        Phyllotaxis
            At least one primordium.
        """
        numbers = np.arange(self.primordia)
        levels, places = numbers // self.per_level, numbers % self.per_level
        turns = levels * self.divergence + places * (360.0 / self.per_level)
        angles = np.asarray(turns, dtype=np.float64)
        heights = np.asarray((levels + 1) * self.rise, dtype=np.float64)
        if self.is_noisy:
            noise = rng.standard_normal((self.primordia, 2))
            angles = angles + self.angle_noise * noise[:, 0]
            heights = heights + self.rise_noise * self.rise * noise[:, 1]
        births = self.first_step + levels * self.steps_per_level(segment_length)
        return Phyllotaxis(on_stem(angles, heights, stem.radius_at(heights)), births)


def on_stem(degrees: Floats, heights: Floats, radii: Floats) -> NDArray[np.float64]:
    """Give the positions of points on a stem.

    Parameters
    ----------
    degrees : ndarray of shape (p,), float64
        Angles around the stem.
    heights, radii : ndarray of shape (p,), float64
        Heights above the ring, and the radius of the stem there, in D.

    Returns
    -------
    ndarray of shape (p, 3), float64
        x, y and height, in D.
    """
    angles = np.deg2rad(degrees)
    return np.stack([radii * np.cos(angles), radii * np.sin(angles), heights], axis=1)
