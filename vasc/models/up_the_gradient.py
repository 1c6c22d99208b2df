"""Up-the-gradient polarization: cells pump auxin toward the neighbors that have most of it.

Carriers of a cell share themselves out over its walls by b to the power of the auxin behind
each (Smith et al., 2006). The equations are those that Abley et al. (2016, eLife 5, e18165,
equation 13 and Table 3) have published with every number, from which the defaults are taken.
There are no veins: auxin is made and destroyed in all cells alike, and maxima form at some
distance from each other where polar transport prevails over diffusion.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar, Literal, NamedTuple

import numpy as np

from vasc import kernels
from vasc.arrays import Floats
from vasc.domain import Tissue
from vasc.errors import ConfigError, RunError
from vasc.events import StopReason
from vasc.fields import Fields, Role
from vasc.models.base import newest
from vasc.models.on_tissue import TissueExperiment
from vasc.models.tissue_model import TissueModel
from vasc.parameters import Parameters, quantity
from vasc.state import State, Tables
from vasc.streams import Streams

HEXAGON = 10.0 * 3.0**0.5
"""Width of a hexagon whose sides are 10 um, as in Abley et al. (2016), in um."""


class Spread(NamedTuple):
    """What the model goes on from."""

    auxin: Floats
    """Auxin of every cell, shape (n,)."""


class AuxinRates(Parameters):
    """What cells do with auxin (Abley et al., 2016, Table 3); amounts in arbitrary units, Au.

    Ranges are ours: Table 3 has the defaults, and values that differ from them by more than
    three orders of magnitude are taken for mistakes.
    """

    production: float = quantity(
        "Production, rho; at most 1.", unit="Au/um2/s", default=3e-4, gt=0.0, le=1.0
    )
    decay: float = quantity(
        "Decay, mu; from 1e-6 to at most 10.", unit="1/s", default=5e-3, ge=1e-6, le=10.0
    )
    diffusion: float = quantity(
        "Passive permeation, D; at most 1e4.", unit="um/s", default=10.0, ge=0.0, le=1e4
    )
    transport: float = quantity(
        "Efflux by carriers, T; at most 1e5.", unit="um2/Au/s", default=80.0, ge=0.0, le=1e5
    )
    carriers: float = quantity(
        "Carriers of a cell, P_i; at most 100.", unit="Au/um", default=0.1, gt=0.0, le=100.0
    )
    base: float = quantity(
        "A wall gets b times the carriers for each Au/um2 more behind it; A is in Au/um2; at most"
        " 1e12.",
        default=6.0,
        gt=1.0,
        le=1e12,
    )


class StartParameters(Parameters):
    """How auxin is spread at first."""

    concentration: float = quantity(
        "Auxin at first, A(0); at most 1000, far above rho / mu of the paper.",
        unit="Au/um2",
        default=0.01,
        ge=0.0,
        le=1e3,
    )
    noise: float = quantity(
        "Half the range of a factor around 1, drawn a cell.", default=0.025, ge=0.0, lt=1.0
    )


class TimeParameters(Parameters):
    """Steps of time, and rest."""

    time_step: float = quantity(
        "Step of the integration, from 1e-6 to at most 1000; no cell may lose more in a step than"
        " it has.",
        unit="s",
        default=0.01,
        ge=1e-6,
        le=1e3,
    )
    recorded: int = quantity(
        "Such steps between two records, at most 10000000.", default=1000, ge=1, le=10**7
    )
    rest: float = quantity(
        "The tissue is at rest when no cell changes by more than that share of its largest"
        " concentration in the time 1/mu.",
        default=1e-4,
        gt=0.0,
        lt=1.0,
    )


@dataclass(frozen=True)
class UpTheGradient(TissueModel):
    """Auxin that cells pump toward the neighbors that have most of it.

    Parameters
    ----------
    tissue, last_step
        As for :class:`~vasc.models.tissue_model.TissueModel`.
    width : float
        One D in um.
    auxin : AuxinRates
        What cells do with auxin.
    start : StartParameters
        How it is spread at first.
    times : TimeParameters
        Steps of time, and rest.
    """

    width: float
    auxin: AuxinRates
    start: StartParameters
    times: TimeParameters

    @cached_property
    def exits(self) -> "kernels.up_the_gradient.Exits":  # type: ignore[name-defined]
        """The walls of each cell."""
        return kernels.up_the_gradient.exits(self.tissue.walls, self.tissue.n_cells)

    @cached_property
    def rates(self) -> "kernels.up_the_gradient.Rates":  # type: ignore[name-defined]
        """The same numbers as kernels take them."""
        one = self.auxin
        return kernels.up_the_gradient.Rates(
            one.production, one.decay, one.diffusion, one.transport, one.carriers, one.base
        )

    def advance(self, state: State, streams: Streams) -> State:
        """Advance one recorded step: auxin flows, and carriers follow it.

        Raises
        ------
        RunError
            If concentrations leave their range, as in steps of time that are too long.
        """
        before, times = newest(state, Spread).auxin, self.times
        tissue = self.tissue
        now = kernels.up_the_gradient.advance(
            tissue.walls,
            tissue.lengths * self.width,
            tissue.volumes * self.width**2,
            self.exits,
            self.rates,
            before,
            times.time_step,
            times.recorded,
        )
        step = state.step + 1
        if not np.isfinite(now).all() or now.min() < 0.0:
            raise RunError(
                f"step {step}: concentrations leave their range; times.time_step"
                f" ({times.time_step:g} s) is too long for this transport"
            )
        lapse = times.time_step * times.recorded
        change = float(np.abs(now - before).max()) / (self.auxin.decay * lapse)
        is_at_rest = change < times.rest * float(now.max())
        reason = self.reason_to_stop(step, is_over=is_at_rest)
        return self.state(state.tables, step, self.fields(now), reason)

    def fields(self, auxin: Floats) -> Fields:
        """Give the fields that go with the auxin of all cells."""
        carriers = kernels.up_the_gradient.polarize(self.exits, self.rates, auxin)
        density = kernels.up_the_gradient.fluxes(self.tissue.walls, self.rates, auxin, carriers)
        roles = np.full(self.tissue.n_cells, Role.GROUND, dtype=np.int8)
        return Fields(auxin, density * (self.tissue.lengths * self.width), carriers, roles)

    def initial_state(self, streams: Streams) -> State:
        """Give the state before the first step: auxin spread evenly, but for noise."""
        auxin = np.full(self.tissue.n_cells, self.start.concentration)
        if self.start.noise > 0.0:
            low, high = 1.0 - self.start.noise, 1.0 + self.start.noise
            auxin *= streams["noise"].uniform(low, high, len(auxin))
        return self.state(Tables(), 0, self.fields(auxin), None)

    def restore(self, tables: Tables, step: int, streams: Streams) -> State:
        """Give the state that a record describes, ready to go on to the same bytes."""
        assert tables.past is not None, "a record of a tissue tells its past"
        return self.state(tables, step, tables.past.fields(step), None)

    def state(self, tables: Tables, step: int, fields: Fields, reason: StopReason | None) -> State:
        """Give the state that the tables and fields describe now."""
        time = step * (self.times.time_step * self.times.recorded)
        return self.state_of(tables, step, time, fields, Spread(fields.concentration), reason)


class UpTheGradientParameters(TissueExperiment):
    """Polarization up the gradient of auxin; in um, s and arbitrary amounts of auxin."""

    evidence: ClassVar[str] = (
        "[V] equations and defaults read in Abley et al. (2016), equations 8, 10 and 13 and Table 3"
    )

    kind: Literal["up-the-gradient"] = "up-the-gradient"
    width: float = quantity(
        "One D, the width of a cell; by default that of a hexagon with sides of 10 um; from 0.1"
        " to at most 10000, which holds the cells of all plants.",
        unit="um",
        default=HEXAGON,
        ge=0.1,
        le=1e4,
    )
    auxin: AuxinRates = quantity("What cells do with auxin.", default=AuxinRates())
    start: StartParameters = quantity("Auxin at first.", default=StartParameters())
    times: TimeParameters = quantity("Steps of time, and rest.", default=TimeParameters())

    def model(self, folder: Path = Path()) -> UpTheGradient:
        """Give the model; files are looked for in ``folder``.

        Raises
        ------
        ConfigError
            If a cell would lose more auxin in a step of time than it has.
        """
        tissue = self.domain.tissue(self.seed, folder)
        check_time_step(tissue, self.width, self.auxin, self.times.time_step)
        return UpTheGradient(
            tissue=tissue,
            width=self.width,
            auxin=self.auxin,
            start=self.start,
            times=self.times,
            last_step=self.stop.steps,
        )


def check_time_step(tissue: Tissue, width: float, auxin: AuxinRates, time_step: float) -> None:
    """Refuse steps of time in which a cell may lose more auxin than it has.

    A cell loses at most mu + (1/R) (D sum_j l_ij + T P_i max_j l_ij) of it in a second.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    width : float
        One D in um.
    auxin : AuxinRates
        What cells do with auxin.
    time_step : float
        Step of the integration, in s.

    Raises
    ------
    ConfigError
        If the step is too long; the message names the rate that asks most for a shorter one.
    """
    cells, lengths = tissue.walls.T.ravel(), np.tile(tissue.lengths, 2)
    longest = np.zeros(tissue.n_cells)
    np.maximum.at(longest, cells, lengths)
    around = np.bincount(cells, lengths, minlength=tissue.n_cells)
    per_area = 1.0 / (tissue.volumes * width)
    rates = {
        ("decay", auxin.decay): auxin.decay,
        ("diffusion", auxin.diffusion): auxin.diffusion * float((around * per_area).max()),
        ("transport", auxin.transport): auxin.transport
        * auxin.carriers
        * float((longest * per_area).max()),
    }
    total = sum(rates.values())
    if time_step * total <= 1.0:
        return
    key, value = max(rates, key=lambda one: rates[one])
    also = f" and auxin.carriers = {auxin.carriers:g}" if key == "transport" else ""
    raise ConfigError(
        f"auxin.{key} = {value:g}{also}: a cell may lose {total:.3g} times the auxin it has in a"
        f" second; times.time_step, {time_step:g} s, must be at most {1.0 / total:.3g} s with"
        " these rates"
    )
