"""Where the predicted pattern changes: thresholds of radius over rise at any divergence."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import inf, log, nan, sqrt

import numpy as np

from vasc.errors import VascError
from vasc.validation.stem_phyllotaxis.lattice import (
    Metric,
    Prediction,
    PrimordiumLattice,
    as_pair,
    predict,
)

NARROW = 1e-6
"""Brackets of a threshold are halved to this share of it; far wider than a tie."""
SLIVER = 1e-5
"""Patterns that hold over a smaller share of the ratio are none."""
STRIDE = 0.01
"""Patterns are looked for at ratios that differ by this share."""


@dataclass(frozen=True)
class Interval:
    """A range of radius over rise with one predicted pattern.

    Parameters
    ----------
    low, high : float
        Thresholds of radius over rise; 0 and infinity where the range was not left.
    steps : tuple of int
        Steps that are edges within it.
    tied : tuple of int
        Those of them that hang on a tie.
    """

    low: float
    high: float
    steps: tuple[int, ...]
    tied: tuple[int, ...]

    @property
    def pair(self) -> tuple[int, ...]:
        """The steps, a single one written twice."""
        return as_pair(self.steps)

    def margin(self, ratio: float) -> float:
        """Give how far a ratio is from the nearer threshold, as a share of that threshold."""
        below = inf if self.low == 0.0 else ratio / self.low - 1.0
        above = inf if self.high == inf else 1.0 - ratio / self.high
        return min(below, above)


def crossing(
    step: int, other: int, divergence: float, *, metric: Metric = "chord", per_level: int = 1
) -> float:
    """Give the radius over rise at which two steps of a spiral are equally long.

    Parameters
    ----------
    step, other : int
        Two steps.
    divergence : float
        In rad.
    metric : {"chord", "arc"}
        Straight through the stem, or along its surface.
    per_level : int
        Primordia a level.

    Returns
    -------
    float
        Not a number where they never are.

    Notes
    -----
    With levels m, n and widths u, v on a cylinder of radius 1 (chords
    ``2 sin(m divergence / 2)`` or arcs), ``ratio^2 = (n^2 - m^2) / (u^2 - v^2)``.

    Examples
    --------
    >>> round(crossing(3, 8, np.radians(137.5)), 3)
    9.116
    """
    lattice = PrimordiumLattice(divergence, rise=1.0, radius=1.0, per_level=per_level)
    separations = np.array([divmod(step, per_level), divmod(other, per_level)])
    levels = separations[:, 0].astype(np.float64)
    widths = lattice.distances(separations, metric) ** 2 - levels**2
    rises, turns = levels[1] ** 2 - levels[0] ** 2, widths[0] - widths[1]
    return sqrt(rises / turns) if turns != 0.0 and rises / turns > 0.0 else nan


def intervals(
    divergence: float,
    *,
    low: float = 0.25,
    high: float = 30.0,
    metric: Metric = "chord",
    per_level: int = 1,
) -> tuple[Interval, ...]:
    """Give the predicted patterns and the thresholds of radius over rise between them.

    Thresholds are found by halving to a millionth of the ratio; each is where two
    steps are equally long (see :func:`crossing`). A pattern that holds over less than
    a hundredth of its ratio may be missed.

    Parameters
    ----------
    divergence : float
        In rad.
    low, high : float
        Range of radius over rise to look through.
    metric : {"chord", "arc"}
        Straight through the stem, or along its surface.
    per_level : int
        Primordia a level.

    Returns
    -------
    tuple of Interval
        Ascending; the first begins at 0 and the last ends at infinity, as far as looked.

    Raises
    ------
    VascError
        If the range is empty or not positive.

    Examples
    --------
    >>> for one in intervals(np.radians(99.5), high=10.0):
    ...     print(one.pair, round(one.low, 3), round(one.high, 3))
    (1, 1) 0.0 1.326
    (1, 3) 1.326 2.805
    (3, 4) 2.805 6.743
    (4, 7) 6.743 inf
    """
    if not 0.0 < low < high < inf:
        raise VascError(f"ratios: expected 0 < low < high, got {low} and {high}")

    def pattern(ratio: float) -> Prediction:
        lattice = PrimordiumLattice(divergence, rise=1.0, radius=ratio, per_level=per_level)
        return predict(lattice, metric)

    ratios = np.geomspace(low, high, int(log(high / low) / STRIDE) + 2).tolist()
    found = [(0.0, pattern(ratios[0]))]
    patterns = [pattern(ratio) for ratio in ratios]
    for left, right, before, after in zip(
        ratios[:-1], ratios[1:], patterns[:-1], patterns[1:], strict=True
    ):
        for ratio, new in _changes(pattern, left, right, before, after):
            # what holds over no range is a tie of the steps that change places
            if ratio < found[-1][0] * (1.0 + SLIVER):
                ratio = found.pop()[0]
            found.append((ratio, new))
    ends = [start for start, _ in found[1:]] + [inf]
    return tuple(
        Interval(start, end, one.steps, one.tied)
        for (start, one), end in zip(found, ends, strict=True)
    )


def _changes(
    pattern: Callable[[float], Prediction],
    left: float,
    right: float,
    before: Prediction,
    after: Prediction,
) -> Iterator[tuple[float, Prediction]]:
    """Give the ratios within a bracket at which the pattern changes, and what it becomes."""
    if before == after:
        return
    middle = sqrt(left * right)
    if right - left <= NARROW * right:
        yield middle, after
        return
    between = pattern(middle)
    yield from _changes(pattern, left, middle, before, between)
    yield from _changes(pattern, middle, right, between, after)
