"""The stem: a cylinder whose apex leaves primordia behind as it rises."""

from collections.abc import Sequence

import numpy as np
from pydantic import model_validator

from vasc.arrays import Floats
from vasc.parameters import Parameters, quantity


class StemParameters(Parameters):
    """A cylinder, or a surface of revolution whose radius follows the height."""

    radius: float | None = quantity("Radius of the stem (R).", unit="D", default=None, gt=0.0)
    radii: list[tuple[float, float]] = quantity(
        "Pairs [height, radius] of a stem whose apex changes its size: linear between them, instead"
        " of radius.",
        unit="D",
        default=[],
    )

    @model_validator(mode="after")
    def _check(self) -> "StemParameters":
        """Require one of the two ways, ascending heights from 0 on, and radii above 0."""
        if (self.radius is None) == (not self.radii):
            raise ValueError("give either 'radius' or 'radii'")
        heights = [height for height, _ in self.radii]
        for row, (height, radius) in enumerate(self.radii):
            if radius <= 0.0:
                raise ValueError(f"radii[{row}] has the radius {radius:g}; it must be above 0")
            if height <= (heights[row - 1] if row else -np.inf):
                raise ValueError(f"radii[{row}] has the height {height:g}; heights must ascend")
        if heights and heights[0] != 0.0:
            raise ValueError(f"radii[0] has the height {heights[0]:g}; the first must be 0")
        return self

    def radius_at(self, heights: Floats) -> Floats:
        """Give the radius of the stem at heights, in D."""
        return radii_at(heights, self.radius, self.radii)


def radii_at(heights: Floats, radius: float | None, radii: Sequence[tuple[float, float]]) -> Floats:
    """Give the radius of a stem at heights.

    Parameters
    ----------
    heights : ndarray of shape (n,), float64
        Above the ring, in D.
    radius : float or None
        The radius of a cylinder, in D.
    radii : sequence of pairs of float
        Heights and radii, in D, of a stem that is none; linear between them.

    Returns
    -------
    ndarray of shape (n,), float64
        In D.
    """
    if radius is not None:
        return np.full(len(heights), float(radius))
    known = np.array(radii, dtype=np.float64)
    return np.asarray(np.interp(heights, known[:, 0], known[:, 1]), dtype=np.float64)
