"""Stretch along the axis of a leaf: how far rows of tissue have moved, and how wide they are."""

import decimal

import numpy as np

from vasc.arrays import Floats

N_SAMPLES = 2001
"""Heights between base and tip at which stretch is known."""
STEPS_PER_ONE = 2.0**40
"""Stretch factors are rounded to this fraction, so that they do not depend on a library."""


def smooth_table(heights: Floats, rates: Floats, at: Floats) -> Floats:
    """Draw a smooth curve through a table; it rises and falls where the table does.

    Parameters
    ----------
    heights : ndarray of shape (k,), float64
        Ascending, k >= 2.
    rates : ndarray of shape (k,), float64
        Values there.
    at : ndarray of shape (n,), float64
        Heights wanted; beyond the table the first and the last value hold.

    Returns
    -------
    ndarray of shape (n,), float64
        Never beyond the two neighboring values of the table.

    References
    ----------
    F. N. Fritsch and R. E. Carlson (1980). Monotone piecewise cubic interpolation.
    SIAM Journal on Numerical Analysis 17, 238-246.
    """
    from scipy.interpolate import PchipInterpolator

    curve = PchipInterpolator(heights, rates)(np.clip(at, heights[0], heights[-1]))
    return np.round(curve * STEPS_PER_ONE) / STEPS_PER_ONE


def roots(factors: Floats, n: int) -> Floats:
    """Give the n-th root of every factor, the nearest float: equal on every processor."""
    context = decimal.Context(prec=30)
    exponent = context.divide(decimal.Decimal(1), decimal.Decimal(n))
    values = (context.power(decimal.Decimal(factor), exponent) for factor in factors.tolist())
    return np.array([float(value) for value in values])


class AxialStretch:
    """Heights and stretch across at every step, from the stretch in one step.

    Parameters
    ----------
    heights : ndarray of shape (n,), float64
        Initial heights, ascending; 0 is one of them.
    across, along : ndarray of shape (n,), float64
        Factors by which tissue is stretched in one step at these heights, above 0.

    Notes
    -----
    Factors of a step are those of the step before times the factors of one
    step, so that no power function is asked. The tables of the latest step are kept;
    going back begins at step 0 again.
    """

    def __init__(self, heights: Floats, across: Floats, along: Floats) -> None:
        self.heights = heights
        self.across = across
        self.along = along
        self._spacings = np.diff(heights)
        self._base = int(np.flatnonzero(heights == 0.0)[0])
        self._step = 0
        self._wide = self._long = np.ones(len(heights))
        self._high = self._integral()

    def at(self, step: int) -> tuple[Floats, Floats]:
        """Give the stretch across, and the heights that the initial ones have come to.

        Parameters
        ----------
        step : int
            A step, at least 0.

        Returns
        -------
        tuple of ndarray of shape (n,), float64
            Factors, and heights in D by the trapezoid rule, ascending and 0 at the base.
        """
        if step == self._step:
            return self._wide, self._high
        if step < self._step:
            self._step = 0
            self._wide = self._long = np.ones(len(self.heights))
        for _ in range(step - self._step):
            self._wide = self._wide * self.across
            self._long = self._long * self.along
        self._step, self._high = step, self._integral()
        return self._wide, self._high

    def _integral(self) -> Floats:
        """Sum up the stretch along the axis, from the base."""
        pieces = 0.5 * (self._long[1:] + self._long[:-1]) * self._spacings
        sums = np.concatenate([[0.0], np.cumsum(pieces)])
        return sums - sums[self._base]
