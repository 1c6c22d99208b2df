"""How far walls change in a step, and when they are at rest."""

from math import exp, log1p

import numpy as np

from vasc.arrays import Floats
from vasc.domain import Tissue
from vasc.fields import Role
from vasc.models.transport import Transport
from vasc.parameters import Parameters, quantity
from vasc.streams import Streams

LONGEST = 40.0
"""Turnover times after which facilitated diffusion is not waited for any more."""
PER_CELL = 1.5
"""The same for polar transport, for each cell of the way: its front moves at finite speed."""


class Settling(Parameters):
    """Steps of time that bound the change of every wall, and rest when none asks for any."""

    tolerance: float = quantity(
        "Largest change of a wall in a step, relative to its state plus 1; from 1e-3 to at most"
        " 100.",
        default=0.3,
        ge=1e-3,
        le=100.0,
    )
    largest_lapse: float = quantity(
        "Longest step; at most 100.", unit="turnover times", default=1.0, gt=0.0, le=100.0
    )
    rest: float = quantity(
        "Walls are at rest when none asks for a larger relative change.",
        default=0.02,
        ge=1e-6,
        lt=1.0,
    )
    until: float | None = quantity(
        "Time after which canals are taken as they are, though walls still change; by default 40"
        " turnover times, for polar transport 1.5 for each cell of the longest way to a vein, if"
        " that is more. At most 1e5.",
        unit="turnover times",
        default=None,
        gt=0.0,
        le=1e5,
    )
    noise: float = quantity(
        "Half the range of a factor around 1 that the walls begin with.",
        default=0.0,
        ge=0.0,
        lt=1.0,
    )

    def lapse(self, carriers: Floats, target: Floats) -> tuple[float, float]:
        """Give the time of a step, and the largest relative change that walls ask for."""
        change = float(np.max(np.abs(target - carriers) / (carriers + 1.0), initial=0.0))
        if change * (1.0 - exp(-self.largest_lapse)) <= self.tolerance:
            return self.largest_lapse, change
        return -log1p(-self.tolerance / change), change

    def longest(self, tissue: Tissue, transport: Transport, roles: np.ndarray) -> float:
        """Give the time after which canals are taken as they are."""
        if self.until is not None:
            return self.until
        if not transport.is_polar:
            return LONGEST
        hops = tissue.hops(np.flatnonzero(roles == Role.VEIN))
        return max(LONGEST, PER_CELL * float(hops.max()))

    def disturbed(self, carriers: Floats, streams: Streams) -> Floats:
        """Give the carriers that a tissue begins with; noise is drawn a wall."""
        if self.noise == 0.0:
            return carriers
        factors = streams["noise"].uniform(1.0 - self.noise, 1.0 + self.noise, len(carriers))
        return carriers * factors[:, None]
