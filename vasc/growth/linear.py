"""Linear growth: the length of a blade increases by the same amount in every step."""

from vasc.domain import Blade
from vasc.growth.base import Similarity, last_step_of
from vasc.parameters import Parameters, quantity


class LinearGrowth(Similarity):
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
        If growth would take more than ``RUN_STEPS`` steps.
    """

    def __init__(self, blade: Blade, final_length: float, length_per_step: float) -> None:
        super().__init__(blade)
        self.final_length = final_length
        self.length_per_step = length_per_step
        n_steps = max(0.0, (final_length - blade.length) / length_per_step)
        self._last_step = last_step_of(n_steps, "growth.length_per_step", length_per_step)

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
