"""Where veins begin: at the attachment, at given places, or in a row along the base."""

import numpy as np

from vasc.arrays import Points
from vasc.domain.rings import surrounding
from vasc.errors import OutlineError
from vasc.parameters import Parameters, quantity


class SeedRowParameters(Parameters):
    """A row of seeds along the base, as in a grass leaf."""

    count: int = quantity("Number of seeds.", ge=2, le=10_000)
    height: float = quantity(
        "Height of the row above the attachment.",
        unit="blade length",
        default=0.004,
        ge=0.0,
        lt=1.0,
    )

    def seeds(self, rings: list[Points]) -> Points:
        """Spread the seeds evenly over the width of a unit outline at the height of the row.

        Parameters
        ----------
        rings : list of ndarray of shape (n, 2), float64
            The outline.

        Returns
        -------
        ndarray of shape (count, 2), float64
            From left to right, each in the middle of its share of the width.

        Raises
        ------
        OutlineError
            If the outline has no width at that height.
        """
        crossings = []
        for ring in rings:
            following = np.roll(ring, -1, axis=0)
            spans = (ring[:, 1] <= self.height) != (following[:, 1] <= self.height)
            a, b = ring[spans], following[spans]
            share = (self.height - a[:, 1]) / (b[:, 1] - a[:, 1])
            crossings.append(a[:, 0] + share * (b[:, 0] - a[:, 0]))
        x = np.concatenate(crossings)
        if len(x) == 0:
            raise OutlineError(f"seeds.height = {self.height:g}: the blade does not reach there")
        at = x.min() + (np.arange(self.count) + 0.5) / self.count * (x.max() - x.min())
        return np.stack([at, np.full(self.count, self.height)], axis=1)


def lowest_of_parts(rings: list[Points]) -> Points:
    """Give the lowest point of every part, shape (parts, 2)."""
    around = surrounding(tuple(rings))
    parts = [ring for ring, others in zip(rings, around, strict=True) if len(others) % 2 == 0]
    return np.array([ring[np.argmin(ring[:, 1])] for ring in parts])
