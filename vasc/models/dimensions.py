"""Numbers with dimensions, as papers print them, and the numbers of transport that have none.

Time is scaled by the turnover of walls, permeability by that of a wall without flux, flux
by what one source makes:

======================  ======================================  ==============================
number                  facilitated diffusion                   polar transport
======================  ======================================  ==============================
gain A                  alpha K^2 / beta                        alpha K^2 / (gamma T)
saturation              D_max gamma / beta                      P_max / T
pool                    --                                      P_tot / T
baseline B              1 (the scale of permeability)           beta / (gamma T)
unit of time            1 / gamma                               1 / gamma
unit of permeability    beta / gamma                            T
unit of concentration   K gamma / beta                          K / T
======================  ======================================  ==============================

The equations are dD/dt = alpha phi^2 + beta - gamma D and
dP_ij/dt = alpha max(phi_ij, 0)^2 + beta - gamma P_ij (Mitchison 1980, 1981), where the flux
is D (s_i - s_j) l / d and l (T + P_ij) s_i - l (T + P_ji) s_j.
"""

from typing import NamedTuple


class FacilitatedRates(NamedTuple):
    """Facilitated diffusion in units of one's own; all numbers are above 0."""

    alpha: float
    """Permeability gained, by flux squared and time."""
    beta: float
    """Permeability gained without flux, by time."""
    gamma: float
    """Share of the permeability lost, by time."""
    source: float
    """What one source makes, K, by time."""
    most: float
    """Largest permeability of a wall, D_max."""


class PolarRates(NamedTuple):
    """Polar transport in units of one's own; all numbers are above 0."""

    alpha: float
    """Carriers gained, by flux squared and time."""
    beta: float
    """Carriers gained without flux, by time."""
    gamma: float
    """Share of the carriers lost, by time."""
    source: float
    """What one source makes, K, by time."""
    passive: float
    """Permeability of a wall without carriers, T."""
    most: float
    """Most carriers of a wall, P_max, or all of a cell, P_tot."""


class FacilitatedNumbers(NamedTuple):
    """Facilitated diffusion without dimensions."""

    gain: float
    """Feedback gain A."""
    saturation: float
    """Largest state of a wall over the resting one."""


class PolarNumbers(NamedTuple):
    """Polar transport without dimensions."""

    gain: float
    """Feedback gain A."""
    saturation: float
    """Most carriers of a wall, or the pool of a cell, over the passive permeability."""
    baseline: float
    """Carriers of a wall without flux, B."""


def facilitated_numbers(rates: FacilitatedRates) -> FacilitatedNumbers:
    """Give the numbers of facilitated diffusion that have no dimension.

    Raises
    ------
    ValueError
        If a rate is not above 0.

    Examples
    --------
    >>> facilitated_numbers(FacilitatedRates(0.3, 0.01, 0.1, 10.0, 300.0))
    FacilitatedNumbers(gain=3000.0, saturation=3000.0)
    """
    _check(rates)
    return FacilitatedNumbers(
        gain=rates.alpha * rates.source**2 / rates.beta,
        saturation=rates.most * rates.gamma / rates.beta,
    )


def facilitated_rates(
    numbers: FacilitatedNumbers, *, beta: float, gamma: float, source: float
) -> FacilitatedRates:
    """Give the rates that belong to numbers, once the three units are chosen.

    Parameters
    ----------
    numbers : FacilitatedNumbers
        Numbers without dimensions.
    beta, gamma, source : float
        See :class:`FacilitatedRates`.

    Raises
    ------
    ValueError
        If a number is not above 0.
    """
    rates = FacilitatedRates(
        alpha=numbers.gain * beta / source**2 if source else 0.0,
        beta=beta,
        gamma=gamma,
        source=source,
        most=numbers.saturation * beta / gamma if gamma else 0.0,
    )
    _check(rates)
    return rates


def polar_numbers(rates: PolarRates) -> PolarNumbers:
    """Give the numbers of polar transport that have no dimension.

    Raises
    ------
    ValueError
        If a rate is not above 0.

    Examples
    --------
    >>> polar_numbers(PolarRates(3.0, 0.05, 0.5, 10.0, 1.0, 300.0))
    PolarNumbers(gain=600.0, saturation=300.0, baseline=0.1)
    """
    _check(rates)
    return PolarNumbers(
        gain=rates.alpha * rates.source**2 / (rates.gamma * rates.passive),
        saturation=rates.most / rates.passive,
        baseline=rates.beta / (rates.gamma * rates.passive),
    )


def polar_rates(
    numbers: PolarNumbers, *, gamma: float, source: float, passive: float
) -> PolarRates:
    """Give the rates that belong to numbers, once the three units are chosen.

    Parameters
    ----------
    numbers : PolarNumbers
        Numbers without dimensions.
    gamma, source, passive : float
        See :class:`PolarRates`.

    Raises
    ------
    ValueError
        If a number is not above 0.
    """
    rates = PolarRates(
        alpha=numbers.gain * gamma * passive / source**2 if source else 0.0,
        beta=numbers.baseline * gamma * passive,
        gamma=gamma,
        source=source,
        passive=passive,
        most=numbers.saturation * passive,
    )
    _check(rates)
    return rates


def _check(rates: FacilitatedRates | PolarRates) -> None:
    """Refuse rates that are not above 0."""
    for name, value in rates._asdict().items():
        if not value > 0.0:
            raise ValueError(f"{name} = {value:g}: must be greater than 0")
