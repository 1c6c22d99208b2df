"""Local-to-global growth: every height has a stretch of its own (Runions 2008, section 5.1)."""

from functools import cached_property
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import model_validator

from vasc.arrays import Floats, Points
from vasc.domain import Blade
from vasc.errors import ConfigError
from vasc.growth.base import Deformation, last_step_of
from vasc.growth.margins import MOST_CHECKS, dense, from_base
from vasc.growth.stretch import N_SAMPLES, AxialStretch, roots, smooth_table
from vasc.growth.stretch_table import check_table, read_table
from vasc.limits import RUN_STEPS
from vasc.parameters import Parameters, quantity


class LocalToGlobalGrowth(Deformation):
    """Tissue at each height is stretched by constant factors, across and along the axis.

    A material point is a position in the initial blade, (x0, y0), and after time t

    ``x = x0 G_x(y0)^t,  y = integral from 0 to y0 of G_y(h)^t dh,  G = 1 + g.``

    Between samples of y0, the stretch across and y are linear in y0, so that the
    map back is exact, too. It folds nowhere, since all G are above 0. A point beside
    the blade has a material point beside the initial one; only beyond tip and base
    is the nearest height taken.

    Parameters
    ----------
    blade : Blade
        The initial blade, of one outline through the attachment.
    heights : ndarray of shape (k,), float64
        Heights of the table over the initial length of the blade, ascending.
    g_x, g_y : ndarray of shape (k,), float64
        Relative increase per unit of time, across and along the axis, above -1.
    steps_per_unit : int
        Steps in one unit of time.
    end : float
        Time at which growth ends.

    Raises
    ------
    ConfigError
        If the blade has several outlines or none through the attachment, would have to
        grow for more than ``RUN_STEPS`` steps, or becomes too large.

    Notes
    -----
    The thesis gives both dx/dt = x RERG_x and x2 = x1 RERG_x^(t2 - t1), which differ; the
    second is used, with RERG_x = 1 + g_x as printed in Figure 5.2, so that the relative
    elemental growth rate proper is ln(1 + g_x).
    """

    def __init__(
        self,
        blade: Blade,
        heights: Floats,
        g_x: Floats,
        g_y: Floats,
        *,
        steps_per_unit: int,
        end: float,
    ) -> None:
        self.steps_per_unit = steps_per_unit
        # a time that is meant to be whole in steps may be a hair above
        n_steps = (1.0 - 1e-9) * (end * steps_per_unit)
        self._last_step = last_step_of(n_steps, "growth.end", end)
        if len(blade.rings) != 1:
            raise ConfigError(
                f"domain: the outline has {len(blade.rings)} rings;"
                " growth.kind = 'local_to_global' carries one"
            )
        samples = np.linspace(0.0, blade.length, N_SAMPLES)
        relative = samples / blade.length
        across = roots(1.0 + smooth_table(heights, g_x, relative), steps_per_unit)
        along = roots(1.0 + smooth_table(heights, g_y, relative), steps_per_unit)
        lowest = blade.bounds[1]
        if lowest < 0.0:
            # lobes below the attachment grow as the tissue at it does
            samples, across, along = (
                np.concatenate([[first], values])
                for first, values in ((lowest, samples), (across[0], across), (along[0], along))
            )
        self.stretch = AxialStretch(samples, across, along)
        steps = range(self._last_step + 1)
        margin = dense(from_base(blade.rings[0]), self.position, steps)
        super().__init__(margin.points, margin.n_base, blade.seeds)

    @property
    def last_step(self) -> int:
        """The step of the time at which growth ends."""
        return self._last_step

    @cached_property
    def box(self) -> tuple[float, float, float, float]:
        """A box around the blade at all steps, and around what veins may lay beside it.

        A vein between two places of the blade may leave it where the margin is
        concave, by no more than the blade is wide, and is carried along from there.
        """
        steps = np.unique(np.linspace(0, self.last_step, MOST_CHECKS).round())
        reach, beside = 0.0, np.zeros(len(self.stretch.heights))
        low = high = 0.0
        for step in steps.astype(np.int64).tolist():
            ring = self.position(self.margin, step)
            wide, _ = self.stretch.at(step)
            beside = np.maximum(beside, float(np.abs(ring[:, 0]).max()) / wide)
            reach = max(reach, float((beside * wide).max()))
            low, high = min(low, float(ring[:, 1].min())), max(high, float(ring[:, 1].max()))
        return -reach, low, reach, high

    def position(self, material: Points, step: int) -> Points:
        """Give the positions of material points at a step, shape (n, 2)."""
        wide, high = self.stretch.at(min(step, self._last_step))
        heights = self.stretch.heights
        across = material[:, 0] * np.interp(material[:, 1], heights, wide)
        return np.stack([across, np.interp(material[:, 1], heights, high)], axis=1)

    def material(self, position: Points, step: int, near: Points | None = None) -> Points:
        """Give the material points that are at positions at a step, shape (n, 2)."""
        wide, high = self.stretch.at(min(step, self._last_step))
        heights = np.interp(position[:, 1], high, self.stretch.heights)
        across = position[:, 0] / np.interp(heights, self.stretch.heights, wide)
        return np.stack([across, heights], axis=1)

    def time(self, step: int) -> float:
        """Give the model time of a step, in units of the rates."""
        return step / self.steps_per_unit


class LocalToGlobalParameters(Parameters):
    """Growth by a table of stretch along the axis, which the shape of the leaf follows from."""

    kind: Literal["local_to_global"] = "local_to_global"
    heights: list[float] | None = quantity(
        "Heights of the table, from 0 at the base to 1 at the tip of the initial blade, ascending.",
        unit="blade length",
        default=None,
        min_length=2,
    )
    g_x: list[float] | None = quantity(
        "Relative increase across the axis at these heights: widths are multiplied by"
        " 1 + g_x (RERG_x in Figure 5.2) in a unit of time.",
        unit="1/unit of time",
        default=None,
        min_length=2,
    )
    g_y: list[float] | None = quantity(
        "Relative increase along the axis at these heights, in the same way.",
        unit="1/unit of time",
        default=None,
        min_length=2,
    )
    file: str | None = quantity(
        "CSV file with columns height, g_x and g_y, instead of the three lists.", default=None
    )
    steps_per_unit: int = quantity(
        "Steps in one unit of time.", unit="steps", default=100, ge=1, le=RUN_STEPS
    )
    end: float = quantity(
        "Time at which growth ends, in units of time.", unit="units of time", gt=0.0
    )

    @model_validator(mode="after")
    def _check(self) -> "LocalToGlobalParameters":
        """Require one sound table."""
        given = {"heights": self.heights, "g_x": self.g_x, "g_y": self.g_y}
        missing = [key for key, values in given.items() if values is None]
        if self.file is not None:
            if len(missing) < len(given):
                raise ValueError("give either 'file' or 'heights', 'g_x' and 'g_y', not both")
        elif missing:
            raise ValueError(f"'{missing[0]}' is missing; give 'heights', 'g_x', 'g_y', or 'file'")
        else:
            check_table(*(values or [] for values in given.values()))
        return self

    def growth(self, blade: Blade, folder: Path = Path()) -> LocalToGlobalGrowth:
        """Give the growth of a blade; a file is looked for in ``folder``.

        Raises
        ------
        ConfigError
            If the file cannot be read or holds no sound table, or the blade
            cannot grow so.
        """
        if self.file is not None:
            heights, g_x, g_y = read_table(folder / self.file)
        else:
            heights, g_x, g_y = self.heights or [], self.g_x or [], self.g_y or []
        return LocalToGlobalGrowth(
            blade,
            np.array(heights),
            np.array(g_x),
            np.array(g_y),
            steps_per_unit=self.steps_per_unit,
            end=self.end,
        )
