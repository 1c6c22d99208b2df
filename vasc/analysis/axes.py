"""Axes: sections that continue each other through forks are one vein."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.sections import Sections
from vasc.arrays import Floats

MOST_VEINS = 100
"""Veins that meet at a place through which any of them may go on."""


@dataclass(frozen=True)
class Axes:
    """Which sections are one vein.

    Parameters
    ----------
    of_sections : ndarray of shape (k,), int64
        The axis of each section, 0 ... a-1.
    n_axes : int
        How many there are.
    """

    of_sections: NDArray[np.int64]
    n_axes: int

    def sums(self, values: Floats) -> Floats:
        """Add up values of sections over each axis."""
        return np.bincount(self.of_sections, values, minlength=self.n_axes).astype(np.float64)


def find_axes(sections: Sections) -> Axes:
    """Follow veins through forks, as the eye does: by width and continuity.

    At each junction the two sections that fit best are one vein, then the next
    two of those left. How badly two sections fit is the turn from one to the other,
    in right angles, plus the difference of their widths, as the logarithm of the
    ratio. Sections that turn by a right angle or more never continue each other.

    Parameters
    ----------
    sections : Sections
        The veins of a network.

    Returns
    -------
    Axes
        Each axis is a way without branches, or a ring.
    """
    pairs, misfits = _candidates(sections)
    n_sections = sections.n_sections
    is_taken = np.zeros(2 * n_sections, dtype=bool)
    joined = []
    for row in np.argsort(misfits, kind="stable").tolist():
        one, other = pairs[row].tolist()
        if not (is_taken[one] or is_taken[other]):
            is_taken[one] = is_taken[other] = True
            joined.append((one // 2, other // 2))
    if not n_sections:
        return Axes(np.zeros(0, dtype=np.int64), 0)
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    links = np.array(joined, dtype=np.int64).reshape(-1, 2).T
    graph = coo_array((np.ones(links.shape[1], dtype=np.int8), links), shape=(n_sections,) * 2)
    n_axes, labels = connected_components(graph, directed=False)
    return Axes(labels.astype(np.int64), int(n_axes))


def _candidates(sections: Sections) -> tuple[NDArray[np.int64], Floats]:
    """List pairs of section ends that may continue each other, and how badly they fit."""
    at = sections.ends.ravel()
    order = np.argsort(at, kind="stable")
    degrees = sections.degrees[at[order]]
    found = [np.zeros((0, 2), dtype=np.int64)]
    is_fork = (degrees > 1) & (degrees <= MOST_VEINS)
    for degree in np.unique(degrees[is_fork]).tolist():
        meeting = order[degrees == degree].reshape(-1, degree)
        rows, columns = np.triu_indices(degree, 1)
        found.append(np.stack([meeting[:, rows].ravel(), meeting[:, columns].ravel()], axis=1))
    pairs = np.concatenate(found)
    vectors = sections.leaving().reshape(-1, 2)
    sizes = np.sqrt((vectors**2).sum(axis=1))
    has_direction = (sizes[pairs] > 0.0).all(axis=1)
    pairs = pairs[has_direction]
    units = vectors / np.where(sizes > 0.0, sizes, 1.0)[:, None]
    cosines = -(units[pairs[:, 0]] * units[pairs[:, 1]]).sum(axis=1)
    turns = np.arccos(np.clip(cosines, -1.0, 1.0)) / (np.pi / 2.0)
    widths = np.maximum(sections.end_widths.ravel(), 1e-300)[pairs]
    misfits = turns + np.abs(np.log(widths[:, 0] / widths[:, 1]))
    # a hair less than a right angle: rounding must not decide
    is_possible = turns < 1.0 - 1e-9
    return pairs[is_possible], misfits[is_possible]
