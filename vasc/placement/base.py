"""What a placement is: it puts sources where veins and other sources leave room."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from vasc.growth import Growth
from vasc.vasculature import Vasculature


@dataclass(frozen=True)
class Moment:
    """One step of a growing blade, as the parts of the sentence need it.

    Parameters
    ----------
    step : int
        The step being made.
    scale : float
        Real size of one material unit of length.
    outline_scale : float
        Size of the outline, 1 at step 0.
    """

    step: int
    scale: float
    outline_scale: float

    @property
    def outline_size(self) -> float:
        """Size of the outline in material coordinates, 1 for the initial outline."""
        return self.outline_scale / self.scale

    @classmethod
    def of(cls, growth: Growth, step: int) -> "Moment":
        """Give the moment of a step."""
        return cls(step, growth.scale(step), growth.outline_scale(step))


class Placement(ABC):
    """Puts sources into a growing blade, step by step."""

    @property
    @abstractmethod
    def spacing(self) -> float:
        """Typical distance of neighbouring sources, in D (for the size of search cells)."""

    def begin(self, veins: Vasculature, rng: np.random.Generator) -> None:
        """Prepare what is drawn once, before the first step; by default nothing."""

    @abstractmethod
    def place(self, veins: Vasculature, moment: Moment, rng: np.random.Generator) -> None:
        """Add the sources that appear in one step to the vasculature."""

    @abstractmethod
    def is_over(self, veins: Vasculature, step: int) -> bool:
        """Tell whether no source can appear after a step."""
