"""Rates: how often something was found, how sure that is, and whether two rates agree."""

from math import sqrt

import numpy as np

Z95 = 1.959963984540054
"""Half-width of the interval that holds 95 % of a standard normal distribution."""


def wilson(hits: int, n: int, z: float = Z95) -> tuple[float, float]:
    """Give the Wilson interval of a rate (Wilson 1927, J. Am. Stat. Assoc. 22, 209-212).

    Parameters
    ----------
    hits, n : int
        How often something was found in how many trials; without any, all is possible.
    z : float
        Half-width of the interval in standard deviations; 95 % by default.

    Returns
    -------
    low, high : float
        Ends of the interval, shares between 0 and 1.

    Examples
    --------
    >>> [round(end, 3) for end in wilson(58, 60)]
    [0.886, 0.991]
    """
    if n == 0:
        return 0.0, 1.0
    share, spread = hits / n, z * z / n
    middle = (share + spread / 2.0) / (1.0 + spread)
    half = z / (1.0 + spread) * sqrt(share * (1.0 - share) / n + spread / (4.0 * n))
    # the ends of rates of 0 and 1 are exact, whatever rounding says
    low = 0.0 if hits == 0 else max(0.0, middle - half)
    return low, 1.0 if hits == n else min(1.0, middle + half)


def same_rate(hits: int, n: int, other_hits: int, other_n: int) -> float:
    """Give the p-value of Fisher's exact test that two rates are the same, two-sided.

    Examples
    --------
    >>> round(same_rate(8, 10, 1, 6), 4)
    0.035
    """
    from scipy.stats import hypergeom

    both = hits + other_hits
    possible = np.arange(max(0, both - other_n), min(n, both) + 1)
    chances = hypergeom.pmf(possible, n + other_n, both, n)
    seen = chances[possible == hits]
    return float(min(1.0, chances[chances <= seen * (1.0 + 1e-7)].sum()))


def agreeing_rates(n: int, other_hits: int, other_n: int, least: float) -> tuple[float, float]:
    """Give the smallest and the largest rate of n trials that agree with another rate.

    Parameters
    ----------
    n : int
        Trials of the rate.
    other_hits, other_n : int
        The other rate.
    least : float
        The p-value of Fisher's exact test from which on two rates agree.

    Returns
    -------
    low, high : float
        Shares between 0 and 1.
    """
    agreeing = [k for k in range(n + 1) if same_rate(k, n, other_hits, other_n) >= least]
    return agreeing[0] / n, agreeing[-1] / n
