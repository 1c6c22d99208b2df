"""Life tables: how many of those born are still alive at each age."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Steps

Z_95 = 1.959963984540054
"""Half-width of a 95 % interval of the normal distribution."""
ROUNDING = 1e-12
"""Of a share of survivors."""


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


@dataclass(frozen=True)
class MedianLife:
    """The age that half of those born do not outlive.

    Parameters
    ----------
    age : int or None
        In steps: the first age at which at most half live longer; None if more than half
        live longer than any age that was watched.
    low, high : int or None
        95 % interval of that age: the first ages at which ``low`` and ``high`` of the life
        table are at most a half; None where they never are (Brookmeyer and Crowley, 1982).
    n, deaths, censored : int
        How many were born, how many of them died, and how many lived at the end.
    least_survival : float
        The share that lives longer than the greatest age; nan without any item.
    """

    age: int | None
    low: int | None
    high: int | None
    n: int
    deaths: int
    censored: int
    least_survival: float


def median_life(table: Mapping[str, NDArray]) -> MedianLife:
    """Give the median of a life table.

    Parameters
    ----------
    table : mapping of str to ndarray
        What :func:`life_table` gives.

    Returns
    -------
    MedianLife

    References
    ----------
    R. Brookmeyer and J. Crowley (1982). A confidence interval for the median survival time.
    Biometrics 38, 29-41.

    Examples
    --------
    >>> table = life_table(np.array([0, 0, 1, 1]), np.array([1, -1, 2, -1]), 2)
    >>> median_life(table).age
    1
    """
    n_ages = len(table["age"])
    deaths, censored = int(table["deaths"].sum()), int(table["censored"].sum())

    def first(column: str) -> int | None:
        # rounding of the product must not put a half above a half
        rows = np.flatnonzero(table[column] <= 0.5 + ROUNDING)
        return int(table["age"][rows[0]]) if len(rows) else None

    return MedianLife(
        age=first("survival"),
        low=first("low"),
        high=first("high"),
        n=deaths + censored,
        deaths=deaths,
        censored=censored,
        least_survival=float(table["survival"][-1]) if n_ages else float("nan"),
    )
