"""What named shapes have in common: half an outline, mirrored at the axis."""

from abc import abstractmethod
from typing import Any

import numpy as np

from vasc.arrays import Points
from vasc.domain.curves import mirrored, sampled
from vasc.parameters import Parameters, quantity


def base_form(default: float) -> Any:
    """Declare the form of a base."""
    return quantity(
        "Form of the base: -1 drawn out along the petiole, 0 a wedge, 1 rounded.",
        default=default,
        ge=-1.0,
        le=1.0,
    )


def tip_form(default: float) -> Any:
    """Declare the form of a tip."""
    return quantity(
        "Form of the tip: -1 drawn out, 0 pointed, 1 rounded.", default=default, ge=-1.0, le=1.0
    )


class ShapeParameters(Parameters):
    """Parameters of a named shape that is symmetric about the axis from base to tip."""

    @abstractmethod
    def half(self) -> list[Points]:
        """Give the curves of the right half, from the attachment to the axis at the tip."""

    def outline(self, n_points: int) -> Points:
        """Give the ring of a unit outline.

        Parameters
        ----------
        n_points : int
            Points wanted.

        Returns
        -------
        ndarray of shape (n, 2), float64
            Counter-clockwise from the attachment at the origin; the highest point
            is at y = 1. n is about ``n_points``.
        """
        ring = mirrored(sampled(self.half(), n_points // 2))
        return ring / np.max(ring[:, 1])
