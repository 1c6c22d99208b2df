"""Doubling: the whole blade is twice as large after each step (Gottlieb, 1993)."""

from typing import Literal

from vasc.domain import Blade
from vasc.growth.base import Similarity
from vasc.parameters import Parameters, quantity


class Doubling(Similarity):
    """Uniform growth by the factor 2 a step, so that all positions stay exact.

    Parameters
    ----------
    blade : Blade
        The blade at step 0.
    doublings : int
        Steps in which it grows.
    """

    def __init__(self, blade: Blade, doublings: int) -> None:
        super().__init__(blade)
        self.doublings = doublings

    @property
    def last_step(self) -> int:
        """The step of the last doubling."""
        return self.doublings

    def scale(self, step: int) -> float:
        """Give the size of the blade at a step, 1 at step 0."""
        return 2.0 ** min(step, self.doublings)

    def outline_scale(self, step: int) -> float:
        """Give the same: outline and material grow alike."""
        return self.scale(step)


class DoublingParameters(Parameters):
    """Growth by the factor 2 a step."""

    kind: Literal["doubling"] = "doubling"
    doublings: int = quantity("Steps, in each of which the blade doubles.", default=6, ge=1, le=16)

    def growth(self, blade: Blade) -> Doubling:
        """Give the growth of a blade."""
        return Doubling(blade, self.doublings)
