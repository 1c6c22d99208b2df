"""What a placement is: it puts sources where veins and other sources leave room."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from vasc.arrays import Points
from vasc.growth import Growth
from vasc.vasculature import Vasculature

if TYPE_CHECKING:
    from vasc.kernels.polygon import EdgeGrid


@dataclass(frozen=True)
class Moment:
    """One step of a growing blade, as the parts of the sentence need it.

    Parameters
    ----------
    growth : Growth
        The growing blade.
    step : int
        The step being made.
    scale : float
        Real size of one unit of the places of nodes and sources.
    outline_scale : float
        Size of the outline, 1 at step 0.
    """

    growth: Growth
    step: int
    scale: float
    outline_scale: float

    @property
    def outline(self) -> "EdgeGrid":
        """The outline, at a size of its own."""
        return self.growth.outline(self.step)

    @property
    def outline_size(self) -> float:
        """Size of the outline where nodes and sources have their places, over its own."""
        return self.outline_scale / self.scale

    def embed(self, places: Points, near: Points | None = None) -> tuple[Points, Points]:
        """Give the material points and the positions of places."""
        return self.growth.embed(places, self.step, near)

    @classmethod
    def of(cls, growth: Growth, step: int) -> "Moment":
        """Give the moment of a step."""
        return cls(growth, step, growth.scale(step), growth.outline_scale(step))


class Placement(ABC):
    """Puts sources into a growing blade, step by step."""

    @property
    @abstractmethod
    def spacing(self) -> float:
        """Typical distance of neighboring sources, in D (for the size of search cells)."""

    def begin(self, veins: Vasculature, rng: np.random.Generator) -> None:
        """Prepare what is drawn once, before the first step; by default nothing."""

    @abstractmethod
    def place(self, veins: Vasculature, moment: Moment, rng: np.random.Generator) -> None:
        """Add the sources that appear in one step to the vasculature."""

    @abstractmethod
    def is_over(self, veins: Vasculature, step: int) -> bool:
        """Tell whether no source can appear after a step."""
