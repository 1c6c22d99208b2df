"""Isogonic growth: the whole blade is scaled, with all that is in it (Runions 2008, 4.2.3)."""

from typing import Literal

from vasc.domain import Blade
from vasc.growth.linear import LinearGrowth, LinearGrowthParameters


class IsogonicGrowth(LinearGrowth):
    """Uniform isotropic growth: positions are material points times one factor.

    The thesis shrinks the unit distance instead of scaling the leaf up; here the
    leaf grows, and kernels that work in material units divide lengths by the scale.
    """

    def scale(self, step: int) -> float:
        """Give the size of the blade at a step, 1 at step 0."""
        return self.length_ratio(step)

    def outline_scale(self, step: int) -> float:
        """Give the same: outline and material grow alike."""
        return self.length_ratio(step)


class IsogonicParameters(LinearGrowthParameters):
    """Growth that is the same at all points and in all directions."""

    kind: Literal["isogonic"] = "isogonic"

    def growth(self, blade: Blade) -> IsogonicGrowth:
        """Give the growth of a blade."""
        return IsogonicGrowth(blade, self.final_length, self.length_per_step)
