"""Transport of auxin through walls, and what its flux does to them (Mitchison 1980, 1981).

Three parts for the sentence of :mod:`vasc.models.canalization`. Their numbers have no
dimension: time is in turnover times of a wall, 1/gamma; a permeability in beta/gamma
(facilitated diffusion) or in the permeability T of a wall without carriers (polar
transport); a flux in what one source makes, K.
"""

from abc import abstractmethod
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field, model_validator

from vasc import kernels
from vasc.arrays import Floats
from vasc.domain import Tissue
from vasc.parameters import Parameters, quantity


class Transport(Parameters):
    """What walls pass, and what the flux makes of them."""

    gain: float

    @abstractmethod
    def resting(self, tissue: Tissue) -> Floats:
        """Give the carriers of walls without any flux, shape (w, 2)."""

    @abstractmethod
    def conductances(self, tissue: Tissue, carriers: Floats) -> tuple[Floats, Floats]:
        """Give what walls pass at concentration 1: from the first cell, and back, shape (w,)."""

    @abstractmethod
    def targets(self, tissue: Tissue, flux: Floats) -> Floats:
        """Give the carriers that a lasting flux would lead to, shape (w, 2)."""

    @property
    @abstractmethod
    def most(self) -> float:
        """Most carriers of a wall, infinite where there is no limit."""

    @property
    @abstractmethod
    def is_polar(self) -> bool:
        """Whether a wall may pass more in one direction."""

    def activation(self, tissue: Tissue) -> float:
        """Give the carriers from which on a wall counts as part of a canal.

        The geometric mean of what walls have at rest, on average, and of the most they can
        have; of the gain, where that has no limit.
        """
        most = self.most if np.isfinite(self.most) else self.gain
        return float(np.sqrt(self.resting(tissue).mean() * most))


class FacilitatedDiffusion(Transport):
    """Walls that become more permeable the more passes them, in both directions.

    With wall state D, wall length l and distance d of centres: flux D/d times the
    difference of concentrations; D relaxes to l + A flux^2, at most the saturation. A
    saturated wall resists in proportion to d, so that paths compete by their length.

    The equation is recalled from Mitchison (1980), not checked there.
    """

    evidence: ClassVar[str] = (
        "[R] the equation is recalled from Mitchison (1980), not checked there; [C] with it canals"
        " form as in Figure 4.9 of Runions (2008)"
    )

    kind: Literal["facilitated"] = "facilitated"
    gain: float = quantity(
        "Feedback gain A = alpha K^2 / beta; at most 1e12.", default=3e3, gt=0.0, le=1e12
    )
    saturation: float | None = quantity(
        "Largest state of a wall over the resting one, D_max gamma / beta, at most 1e12; the gain"
        " when not given.",
        default=None,
        gt=1.0,
        le=1e12,
    )

    @property
    def most(self) -> float:
        """The largest state of a wall."""
        return self.gain if self.saturation is None else self.saturation

    def resting(self, tissue: Tissue) -> Floats:
        """Give the carriers of walls without any flux, shape (w, 2)."""
        return np.stack([tissue.lengths, tissue.lengths], axis=1)

    def conductances(self, tissue: Tissue, carriers: Floats) -> tuple[Floats, Floats]:
        """Give what walls pass at concentration 1: the same both ways, shape (w,)."""
        both = carriers[:, 0] / tissue.distances
        return both, both

    def targets(self, tissue: Tissue, flux: Floats) -> Floats:
        """Give the carriers that a lasting flux would lead to, shape (w, 2)."""
        one = np.minimum(tissue.lengths + self.gain * flux * flux, self.most)
        return np.stack([one, one], axis=1)

    @property
    def is_polar(self) -> bool:
        """A permeability has no direction."""
        return False


class PolarWalls(Transport):
    """Walls with carriers that take auxin out of a cell.

    The flux is l (1 + P_ij) s_i - l (1 + P_ji) s_j.
    """

    def conductances(self, tissue: Tissue, carriers: Floats) -> tuple[Floats, Floats]:
        """Give what walls pass at concentration 1, forth and back, shape (w,)."""
        forth, back = (tissue.lengths * (1.0 + carriers[:, side]) for side in (0, 1))
        return forth, back

    @property
    def is_polar(self) -> bool:
        """Carriers take auxin out of a cell, not in."""
        return True


class PolarTransport(PolarWalls):
    """Walls that get carriers out of a cell the more auxin leaves through them.

    P_ij relaxes to B + A max(flux, 0)^2, at most the saturation. Without one, fluxes in
    closed loops may grow without bound.

    The square is recalled from Mitchison (1981), not checked there.
    """

    evidence: ClassVar[str] = (
        "[R] the squared flux is recalled from Mitchison (1981), not checked there; [V] production"
        " of carriers by flux, their decay and their limit were read in Abley et al. (2016),"
        " equations 8 to 12, where the flux is not squared"
    )

    kind: Literal["polar"] = "polar"
    gain: float = quantity(
        "Feedback gain A = alpha K^2 / (gamma T); at most 1e12.", default=1e3, gt=0, le=1e12
    )
    saturation: float | Literal["none"] | None = quantity(
        "Most carriers of a wall, P_max / T; the gain when not given, 'none' for no limit.",
        default=None,
    )
    baseline: float = quantity(
        "Carriers without flux, B = beta / (gamma T); at most 1e6.", default=0.1, gt=0.0, le=1e6
    )

    @model_validator(mode="after")
    def _check(self) -> "PolarTransport":
        """Require room for carriers above those without flux."""
        if self.most <= self.baseline:
            key = "gain" if self.saturation is None else "saturation"
            raise ValueError(
                f"'{key}' is {self.most:g}; it must be greater than 'baseline', {self.baseline:g}"
            )
        return self

    @property
    def most(self) -> float:
        """Most carriers of a wall."""
        if self.saturation == "none":
            return np.inf
        return self.gain if self.saturation is None else self.saturation

    def resting(self, tissue: Tissue) -> Floats:
        """Give the carriers of walls without any flux, shape (w, 2)."""
        return np.full((tissue.n_walls, 2), self.baseline)

    def targets(self, tissue: Tissue, flux: Floats) -> Floats:
        """Give the carriers that a lasting flux would lead to, shape (w, 2)."""
        return np.minimum(self.baseline + self.gain * one_way(flux) ** 2, self.most)


class PooledTransport(PolarWalls):
    """Polar transport by carriers of which each cell has a fixed number (Feugier et al. 2005).

    Walls of a cell compete: with weights w_ij = B + A max(flux_ij, 0)^2 and fast cycling
    P_ij relaxes to pool w_ij / (1 + sum_j l_ij w_ij), so that the sum over the walls of a
    cell never exceeds the pool.

    The equation is recalled from Feugier et al. (2005), not checked there.
    """

    evidence: ClassVar[str] = (
        "[R] the conserved pool is recalled from Feugier et al. (2005), not checked there"
    )

    kind: Literal["pool"] = "pool"
    gain: float = quantity(
        "Feedback gain A = alpha K^2 / (gamma T); at most 1e12.", default=30.0, gt=0, le=1e12
    )
    baseline: float = quantity(
        "Weight of a wall without flux, B; at most 1e6.", default=0.2, gt=0.0, le=1e6
    )
    pool: float = quantity(
        "Carriers of a cell, P_tot / T; at most 1e12.", default=10.0, gt=0.0, le=1e12
    )

    @property
    def most(self) -> float:
        """Most carriers of a wall: all of a cell."""
        return self.pool

    def resting(self, tissue: Tissue) -> Floats:
        """Give the carriers of walls without any flux, shape (w, 2)."""
        return self.targets(tissue, np.zeros(tissue.n_walls))

    def targets(self, tissue: Tissue, flux: Floats) -> Floats:
        """Give the carriers that a lasting flux would lead to, shape (w, 2)."""
        weights = self.baseline + self.gain * one_way(flux) ** 2
        of_sides = tissue.lengths[:, None] * weights
        asked = kernels.transport.cell_sums(tissue.walls, of_sides, tissue.n_cells)
        return self.pool * weights / (1.0 + asked[tissue.walls])


AnyTransport = Annotated[
    FacilitatedDiffusion | PolarTransport | PooledTransport, Field(discriminator="kind")
]


def one_way(flux: Floats) -> Floats:
    """Give what leaves each wall's first cell, and its second, shape (w, 2); never below 0."""
    return np.stack([np.maximum(flux, 0.0), np.maximum(-flux, 0.0)], axis=1)
