"""No growth: a blade of full size from the first step on."""

from typing import Literal

from vasc.domain import Blade
from vasc.growth.base import Similarity
from vasc.parameters import Parameters


class NoGrowth(Similarity):
    """Material point = position, and the outline stays."""

    @property
    def last_step(self) -> int:
        """The blade never grows."""
        return 0

    def scale(self, step: int) -> float:
        """Give 1."""
        return 1.0

    def outline_scale(self, step: int) -> float:
        """Give 1."""
        return 1.0


class NoGrowthParameters(Parameters):
    """A blade that does not grow."""

    kind: Literal["none"] = "none"

    def growth(self, blade: Blade) -> NoGrowth:
        """Give the growth of a blade."""
        return NoGrowth(blade)
