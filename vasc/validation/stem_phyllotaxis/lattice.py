"""What phyllotaxis alone predicts: relative neighbours in the lattice of primordia.

Primordia sit at equal turns and rises on a cylinder. Which of them are relative
neighbours (Runions 2008, equation 4.1) depends on divergence and radius over rise
alone, and on the metric: veins that grow through the volume of the stem meet along
chords, veins bound to the surface would meet along arcs.
"""

from dataclasses import dataclass
from math import ceil, hypot, isfinite, pi, sqrt
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats
from vasc.errors import VascError

Metric = Literal["chord", "arc"]

TIE = 1e-9
"""Distances that differ by a smaller share are equal."""
N_RULERS = 16
"""Short separations that rule out most of the others before the exact comparison."""

Separations = NDArray[np.int64]
"""Rows (levels up, members on), shape (n, 2)."""
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class PrimordiumLattice:
    """Primordia at equal turns and rises on a cylinder.

    Spiral phyllotaxis has one primordium a level; decussate phyllotaxis two, with a
    divergence of a quarter turn; distichous one, with half a turn.

    Parameters
    ----------
    divergence : float
        Turn from one level to the next, in rad.
    rise : float
        Height from one level to the next, in D; positive.
    radius : float
        Of the cylinder, in D; positive.
    per_level : int
        Primordia a level, at equal angles; at least 1.

    Raises
    ------
    VascError
        If a number is not finite, or not positive where it has to be.

    Examples
    --------
    >>> PrimordiumLattice(np.radians(137.5), rise=10.0, radius=115.0).ratio
    11.5
    """

    divergence: float
    rise: float
    radius: float
    per_level: int = 1

    def __post_init__(self) -> None:
        if not isfinite(self.divergence):
            raise VascError(f"divergence: expected a finite angle, got {self.divergence}")
        for name, value in (("rise", self.rise), ("radius", self.radius)):
            if not (isfinite(value) and value > 0.0):
                raise VascError(f"{name}: expected a positive length, got {value}")
        if self.per_level < 1:
            raise VascError(f"per_level: expected at least 1 primordium, got {self.per_level}")

    @property
    def ratio(self) -> float:
        """Radius over rise, which decides the pattern."""
        return self.radius / self.rise

    def angles(self, separations: Separations) -> Floats:
        """Give the turns of separations, the short way round, in rad.

        Parameters
        ----------
        separations : ndarray of shape (..., 2), int64
            (levels up, members on), along the last axis.

        Returns
        -------
        ndarray of shape (...), float64
            Within (-pi, pi].
        """
        levels, members = separations[..., 0], separations[..., 1]
        turns = levels * self.divergence + members * 2.0 * pi / self.per_level
        return pi - (pi - turns) % (2.0 * pi)

    def distances(self, separations: Separations, metric: Metric = "chord") -> Floats:
        """Give the lengths of separations.

        Parameters
        ----------
        separations : ndarray of shape (..., 2), int64
            (levels up, members on), along the last axis.
        metric : {"chord", "arc"}
            Straight through the stem, or along its surface.

        Returns
        -------
        ndarray of shape (...), float64
            In D.
        """
        angles = self.angles(separations)
        across = angles if metric == "arc" else 2.0 * np.sin(angles / 2.0)
        return np.hypot(self.radius * across, separations[..., 0] * self.rise)

    def code(self, separations: Separations) -> NDArray[np.int64]:
        """Give the step of each separation: how much further up the order of birth it leads.

        In a spiral the step from primordium m to n is n - m. With more primordia a
        level it is the levels between them times the primordia a level, and the
        members on; a step within a level is counted the short way round.
        """
        levels = np.abs(separations[:, 0])
        members = np.where(separations[:, 0] < 0, -separations[:, 1], separations[:, 1])
        members = members % self.per_level
        short = np.minimum(members, (-members) % self.per_level)
        return levels * self.per_level + np.where(levels == 0, short, members)


@dataclass(frozen=True)
class Prediction:
    """The relative neighbours of a primordium in the lattice.

    Parameters
    ----------
    steps : tuple of int
        Steps in the order of birth that are edges, ascending; see
        :meth:`PrimordiumLattice.code`.
    tied : tuple of int
        Those of them that are edges only because a rival is exactly as long.
    metric : {"chord", "arc"}
        How distances were measured.
    """

    steps: tuple[int, ...]
    tied: tuple[int, ...]
    metric: Metric = "chord"

    @property
    def pair(self) -> tuple[int, ...]:
        """The steps, a single one written twice, as (1, 1)."""
        return as_pair(self.steps)

    @property
    def firm(self) -> tuple[int, ...]:
        """The steps that do not hang on a tie."""
        return tuple(step for step in self.steps if step not in self.tied)


def as_pair(steps: tuple[int, ...]) -> tuple[int, ...]:
    """Write steps as the thesis does: a single one twice.

    Examples
    --------
    >>> as_pair((1,)), as_pair((5, 8))
    ((1, 1), (5, 8))
    """
    return steps * 2 if len(steps) == 1 else steps


def predict(lattice: PrimordiumLattice, metric: Metric = "chord") -> Prediction:
    """Predict which primordia veins connect, from where the primordia are.

    A separation is an edge when no third primordium is closer to both ends than
    they are to each other. It is tied when an equally long rival decides that:
    comparing strictly or not, and rounding, then give different graphs.

    Parameters
    ----------
    lattice : PrimordiumLattice
        The primordia.
    metric : {"chord", "arc"}
        Straight through the stem, or along its surface.

    Returns
    -------
    Prediction

    References
    ----------
    Runions (2008), equations 4.1 and 6.2.

    Examples
    --------
    >>> golden = np.radians(137.5)
    >>> predict(PrimordiumLattice(golden, rise=10.0, radius=115.0)).pair
    (5, 8)
    >>> predict(PrimordiumLattice(golden, rise=10.0, radius=16.0))
    Prediction(steps=(1, 2), tied=(1,), metric='chord')
    """
    candidates = _upward(lattice, _reach(lattice, metric))
    candidates = candidates[_survivors(lattice, candidates, metric)]
    lengths = lattice.distances(candidates, metric)
    # what excludes an edge is shorter than it
    up = _upward(lattice, ceil(float(lengths.max()) / lattice.rise) + 1)
    rivals = np.concatenate([up, -up])
    is_edge, is_firm = (
        _not_excluded(lattice, candidates, rivals, metric, slack)
        for slack in (1.0 - TIE, 1.0 + TIE)
    )
    steps = set(lattice.code(candidates[is_edge]).tolist())
    firm = set(lattice.code(candidates[is_firm]).tolist())
    return Prediction(tuple(sorted(steps)), tuple(sorted(steps - firm)), metric)


def _reach(lattice: PrimordiumLattice, metric: Metric) -> int:
    """Give a level above which nothing is an edge.

    Among the first n levels there is a separation w that turns by at most 1 / n of
    the angle between neighbours on a level. A separation v of m levels is longer
    than v - w as soon as the height that w saves outweighs the turn that it adds,
    2 m - 1 > 2 (half a turn) (turn of w) + (turn of w)^2, all in rises.
    """
    half_turn = lattice.ratio * (2.0 if metric == "chord" else pi)
    between = 2.0 * pi * lattice.ratio / lattice.per_level
    n = ceil(sqrt(half_turn * between)) + 1
    turn = between / n
    return ceil(max(half_turn * turn + turn**2 / 2.0 + 0.5, hypot(n, turn))) + 1


def _upward(lattice: PrimordiumLattice, top: int) -> Separations:
    """Give all separations up to a level, from the next primordium on."""
    numbers = np.arange(1, (top + 1) * lattice.per_level, dtype=np.int64)
    return np.stack(np.divmod(numbers, lattice.per_level), axis=1)


def _survivors(lattice: PrimordiumLattice, candidates: Separations, metric: Metric) -> Mask:
    """Tell which candidates the shortest separations do not exclude."""
    order = np.argsort(lattice.distances(candidates, metric), kind="stable")
    rulers = candidates[order[:N_RULERS]]
    rulers = np.concatenate([rulers, -rulers])
    return _not_excluded(lattice, candidates, rulers, metric, 1.0 - TIE)


def _not_excluded(
    lattice: PrimordiumLattice,
    candidates: Separations,
    rivals: Separations,
    metric: Metric,
    slack: float,
) -> Mask:
    """Tell which candidates have no rival that is nearer to both of their ends."""
    lengths = slack * lattice.distances(candidates, metric)[:, None]
    # rows: candidates, columns: rivals; a rival at the same place is the candidate itself
    onward = lattice.distances(candidates[:, None] - rivals, metric)
    is_near = (lattice.distances(rivals, metric) < lengths) & (onward < lengths)
    is_between = (is_near & (onward > TIE * lengths)).any(axis=1)
    return np.logical_not(is_between)
