"""Marginal growth: the outline is scaled, veins and sources stay (Runions 2008, 4.2.3)."""

from typing import Literal

from vasc.domain import Blade
from vasc.growth.linear import LinearGrowth, LinearGrowthParameters


class MarginalGrowth(LinearGrowth):
    """Material point = position; the outline moves outward from the attachment."""

    def scale(self, step: int) -> float:
        """Give 1: nothing in the blade moves."""
        return 1.0

    def outline_scale(self, step: int) -> float:
        """Give the size of the outline at a step, 1 at step 0."""
        return self.length_ratio(step)


class MarginalParameters(LinearGrowthParameters):
    """Growth concentrated on the margin."""

    kind: Literal["marginal"] = "marginal"

    def growth(self, blade: Blade) -> MarginalGrowth:
        """Give the growth of a blade."""
        return MarginalGrowth(blade, self.final_length, self.length_per_step)
