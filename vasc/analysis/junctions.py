"""Junctions of three veins: angles and widths, Bohn's balance of forces, Murray's exponents."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.sections import Sections
from vasc.arrays import Floats, Points
from vasc.streams import Streams

NEARLY_EQUAL = 0.98
"""Share of the widest vein from which a second one is as wide: no exponent is told then."""
LARGEST_EXPONENT = 1000.0


@dataclass(frozen=True)
class Junctions:
    """The places where exactly three veins meet; veins from the widest to the thinnest.

    Parameters
    ----------
    points : ndarray of shape (j,), int64
        Rows of the points of the drawing.
    widths : ndarray of shape (j, 3), float64
        Widths of the veins where they leave, falling along each row.
    directions : ndarray of shape (j, 3, 2), float64
        Unit vectors along which they leave.
    spans : ndarray of shape (j, 3), float64
        Lengths of their sections, as drawn.
    """

    points: NDArray[np.int64]
    widths: Floats
    directions: Points
    spans: Floats

    @property
    def n_junctions(self) -> int:
        """Number of junctions."""
        return len(self.points)

    @property
    def widest_angles(self) -> Floats:
        """Angles between the two widest veins of each junction, shape (j,), in rad."""
        cosines = (self.directions[:, 0] * self.directions[:, 1]).sum(axis=1)
        return np.arccos(np.clip(cosines, -1.0, 1.0))

    @property
    def residuals(self) -> Floats:
        """Force residual |sum w e| / sum w of each junction, shape (j,): 0 in balance.

        Notes
        -----
        Widths act as forces along the veins (Bohn, Andreotti, Douady, Munzinger and
        Couder, 2002, Physical Review E 65:061914).
        """
        return _residuals(self.widths, self.directions)

    def chosen(self, rows: NDArray) -> "Junctions":
        """Give the junctions of some rows."""
        parts = (self.points, self.widths, self.directions, self.spans)
        return Junctions(*(part[rows] for part in parts))

    def long(self, shortest: float) -> "Junctions":
        """Give the junctions whose sections are all drawn longer than a length."""
        return self.chosen(np.flatnonzero(self.spans.min(axis=1, initial=np.inf) > shortest))

    def shuffled_residuals(self, seed: int = 0) -> Floats:
        """Give the force residuals with the widths of each junction shuffled, shape (j,).

        The control of :attr:`residuals`: if widths had nothing to do with angles,
        both would be alike.
        """
        widths = Streams(seed, ["shuffle"])["shuffle"].permuted(self.widths, axis=1)
        return _residuals(widths, self.directions)


def find_junctions(sections: Sections) -> Junctions:
    """Find the junctions of three veins.

    Parameters
    ----------
    sections : Sections
        The veins of a network.

    Returns
    -------
    Junctions
        By point; one that a vein leaves and comes back to is none.
    """
    vectors = sections.leaving().reshape(-1, 2)
    chords = np.sqrt((vectors**2).sum(axis=1))
    at = sections.ends.ravel()
    order = np.argsort(at, kind="stable")
    order = order[(sections.degrees[at] == 3)[order]].reshape(-1, 3)
    has_three = (chords[order] > 0.0).all(axis=1)
    of_sections = np.sort(order // 2, axis=1)
    has_three &= (np.diff(of_sections, axis=1) > 0).all(axis=1)
    order = order[has_three]
    widths = sections.end_widths.ravel()[order]
    by_width = np.argsort(-widths, axis=1, kind="stable")
    order = np.take_along_axis(order, by_width, axis=1)
    return Junctions(
        at[order[:, 0]],
        sections.end_widths.ravel()[order],
        vectors[order] / chords[order][..., None],
        sections.spans[order // 2],
    )


def balanced_angles(widths: Floats) -> Floats:
    """Give the angles between the two widest veins that balance the widths as forces.

    Parameters
    ----------
    widths : ndarray of shape (j, 3), float64
        Widths, falling along each row.

    Returns
    -------
    ndarray of shape (j,), float64
        In rad; pi where the two thinner veins together are thinner than the widest.

    Notes
    -----
    cos a = (w3^2 - w1^2 - w2^2) / (2 w1 w2), which follows from
    w1 e1 + w2 e2 + w3 e3 = 0 (Bohn et al., 2002).

    Examples
    --------
    >>> np.degrees(balanced_angles(np.array([[1.0, 1.0, 1.0], [5.0, 1.0, 1.0]]))).round(3).tolist()
    [120.0, 180.0]
    """
    w1, w2, w3 = widths.T
    return np.arccos(np.clip((w3**2 - w1**2 - w2**2) / (2.0 * w1 * w2), -1.0, 1.0))


def murray_exponents(widths: Floats) -> Floats:
    """Give n for which w1^n = w2^n + w3^n at each junction.

    Parameters
    ----------
    widths : ndarray of shape (j, 3), float64
        Widths, above 0, falling along each row.

    Returns
    -------
    ndarray of shape (j,), float64
        nan where the two widest veins are alike within 2 %: n would be anything.

    Notes
    -----
    Murray (1926, PNAS 12:207) has n = 3 for the radii of tubes. Found by halving
    an interval, since the sum falls as n rises.

    Examples
    --------
    >>> murray_exponents(np.array([[5.0, 4.0, 3.0], [2.0, 1.0, 1.0], [1.0, 1.0, 0.5]])).round(6)
    array([ 2.,  1., nan])
    """
    ratios = widths[:, 1:] / widths[:, :1]
    low, high = np.zeros(len(ratios)), np.full(len(ratios), LARGEST_EXPONENT)
    for _ in range(60):
        middle = (low + high) / 2.0
        is_above = (ratios ** middle[:, None]).sum(axis=1) > 1.0
        low, high = np.where(is_above, middle, low), np.where(is_above, high, middle)
    is_told = ratios[:, 0] < NEARLY_EQUAL
    return np.where(is_told, high, np.nan)


def _residuals(widths: Floats, directions: Points) -> Floats:
    """Give |sum w e| / sum w."""
    force = (widths[..., None] * directions).sum(axis=1)
    return np.sqrt((force**2).sum(axis=1)) / widths.sum(axis=1)
