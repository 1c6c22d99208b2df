"""Growth as a map between material coordinates, which never change, and positions."""

from abc import ABC, abstractmethod
from functools import cached_property
from typing import TYPE_CHECKING

from vasc import kernels
from vasc.arrays import Points
from vasc.domain import Blade
from vasc.errors import ConfigError
from vasc.parameters import Parameters, quantity

if TYPE_CHECKING:
    from vasc.kernels.polygon import EdgeGrid


MOST_STEPS = 1_000_000
"""Greatest number of steps that growth may take."""


class Growth(ABC):
    """A growing blade: where each material point is at each step.

    Parameters
    ----------
    blade : Blade
        The blade at step 0.

    Notes
    -----
    The growths of this base move material points by one scale factor about the
    attachment, so that their shape never changes and distances in material
    units are distances in real units over :meth:`scale`.
    """

    def __init__(self, blade: Blade) -> None:
        self.blade = blade

    @cached_property
    def outline(self) -> "EdgeGrid":
        """The outline at step 0, ready for the question whether a point is inside."""
        return kernels.polygon.edge_grid(*self.blade.flat)

    @property
    @abstractmethod
    def last_step(self) -> int:
        """The last step in which the blade grows, 0 if it never does."""

    @abstractmethod
    def scale(self, step: int) -> float:
        """Give the size of one material unit of length at a step."""

    @abstractmethod
    def outline_scale(self, step: int) -> float:
        """Give the size of the outline at a step, 1 at step 0."""

    def domain(self, step: int) -> Blade:
        """Give the blade at a step, in real size."""
        return self.blade.scaled(self.outline_scale(step))

    def position(self, material: Points, step: int) -> Points:
        """Give the positions of material points at a step, shape (n, 2)."""
        return material * self.scale(step)

    def material(self, position: Points, step: int) -> Points:
        """Give the material points that are at positions at a step, shape (n, 2)."""
        return position / self.scale(step)


class LinearGrowth(Growth):
    """A blade whose length increases by the same amount in every step.

    Parameters
    ----------
    blade : Blade
        The blade at step 0.
    final_length : float
        Blade length at which growth ends, in D.
    length_per_step : float
        Increase of the blade length in one step, in D.

    Raises
    ------
    ConfigError
        If growth would take more than ``MOST_STEPS`` steps.
    """

    def __init__(self, blade: Blade, final_length: float, length_per_step: float) -> None:
        super().__init__(blade)
        self.final_length = final_length
        self.length_per_step = length_per_step
        n_steps = max(0.0, (final_length - blade.length) / length_per_step)
        if n_steps > MOST_STEPS:
            raise ConfigError(
                f"growth.length_per_step = {length_per_step:g}: growth would take {n_steps:.3g}"
                f" steps; allowed are {MOST_STEPS:,}"
            )
        self._last_step = int(n_steps) + (int(n_steps) < n_steps)

    @property
    def last_step(self) -> int:
        """The step in which the blade reaches its final length."""
        return self._last_step

    def length_ratio(self, step: int) -> float:
        """Give the blade length at a step over the initial one (section 4.2.3)."""
        if step >= self._last_step:
            return max(self.final_length, self.blade.length) / self.blade.length
        length = min(self.final_length, self.blade.length + step * self.length_per_step)
        return length / self.blade.length


class LinearGrowthParameters(Parameters):
    """What the growths with a constant increase of length have in common."""

    final_length: float = quantity(
        "Blade length at which growth ends (L_f in Table 4.1).", unit="D", gt=0.0
    )
    length_per_step: float = quantity(
        "Increase of the blade length in one step (Delta L in Table 4.1).", unit="D", gt=0.0
    )
