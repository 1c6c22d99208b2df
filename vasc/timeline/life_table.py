"""Life tables: how many of those born are still alive at each age."""

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Steps

Z_95 = 1.959963984540054
"""Half-width of a 95 % interval of the normal distribution."""


def life_table(births: Steps, deaths: Steps, last_step: int) -> dict[str, NDArray]:
    """Give the life table of items born at different steps: one row an age.

    Those that live at the end are censored: they count as at risk up to the age
    at which they were last seen, and no further.

    Parameters
    ----------
    births : ndarray of shape (s,), int32
        Steps of birth.
    deaths : ndarray of shape (s,), int32
        Steps of death, -1 for those that live.
    last_step : int
        The last step at which they were watched.

    Returns
    -------
    dict of str to ndarray
        ``age``, in steps since birth, from 0 to the greatest; ``at_risk``, seen alive up
        to that age; ``deaths`` at that age; ``censored``, last seen alive at that age;
        ``survival``, the share that lives longer (Kaplan and Meier, 1958);
        ``standard_error`` of it (Greenwood, 1926); ``low`` and ``high``, the 95 %
        interval that this error gives on the scale of log(-log(survival)), which never
        leaves 0 ... 1 (Kalbfleisch and Prentice, 1980). The interval is 1 to 1 while nobody
        has died; where nobody survives, error and interval are nan, for nothing is known.
        Empty columns when there is no item.

    References
    ----------
    E. L. Kaplan and P. Meier (1958). Nonparametric estimation from incomplete
    observations. Journal of the American Statistical Association 53, 457-481.
    M. Greenwood (1926). The natural duration of cancer. Reports on Public Health and
    Medical Subjects 33, 1-26.
    J. D. Kalbfleisch and R. L. Prentice (1980). The Statistical Analysis of Failure Time
    Data. Wiley.

    Examples
    --------
    >>> table = life_table(np.array([0, 0, 1, 1]), np.array([1, -1, 2, -1]), 2)
    >>> table["survival"].tolist()
    [1.0, 0.5, 0.5]
    """
    is_dead = deaths != NULL
    ages = np.where(is_dead, deaths, last_step) - births
    n_ages = int(ages.max()) + 1 if ages.size else 0
    died = np.bincount(ages[is_dead], minlength=n_ages)
    censored = np.bincount(ages[~is_dead], minlength=n_ages)
    at_risk = len(ages) - np.cumsum(died + censored) + died + censored
    survival = np.cumprod(1.0 - died / np.maximum(at_risk, 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        # Greenwood: the sum of d / (n (n - d)) is the variance of log(survival)
        spread = np.sqrt(np.cumsum(np.where(died > 0, died / (at_risk * (at_risk - died)), 0.0)))
        widening = np.exp(Z_95 * spread / np.log(survival))
        low, high = survival ** (1.0 / widening), survival**widening
    nobody_died, nobody_left = survival == 1.0, survival == 0.0
    for bound in (low, high):
        bound[nobody_died], bound[nobody_left] = 1.0, np.nan
    return {
        "age": np.arange(n_ages),
        "at_risk": at_risk,
        "deaths": died,
        "censored": censored,
        "survival": survival,
        "standard_error": np.where(nobody_left, np.nan, survival) * spread,
        "low": low,
        "high": high,
    }
