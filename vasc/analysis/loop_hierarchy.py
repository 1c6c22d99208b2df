"""Loops within loops: the tree in which areoles merge as the thinnest veins go first."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.areoles import LoopedVeins
from vasc.analysis.sections import Sections
from vasc.arrays import Floats
from vasc.streams import Streams


@dataclass(frozen=True)
class LoopHierarchy:
    """The merges of areoles, in the order of the widths of the veins between them.

    Parameters
    ----------
    larger, smaller : ndarray of shape (k,), int64
        Areoles in the two parts that each merge joins.
    orders : ndarray of shape (k,), int64
        Horton-Strahler number of what each merge makes; an areole has 1.
    """

    larger: NDArray[np.int64]
    smaller: NDArray[np.int64]
    orders: NDArray[np.int64]

    @property
    def asymmetries(self) -> Floats:
        """Partition asymmetry 1 - smaller / larger of each merge, shape (k,)."""
        return 1.0 - self.smaller / self.larger

    @property
    def mean_asymmetry(self) -> float:
        """Mean over all merges; nan without any."""
        return float(self.asymmetries.mean()) if len(self.larger) else float("nan")

    @property
    def weighted_asymmetry(self) -> float:
        """Mean over all merges, each weighted by its areoles less one; nan without any."""
        weights = self.larger + self.smaller - 1
        if not len(weights):
            return float("nan")
        return float((self.asymmetries * weights).sum() / weights.sum())

    @property
    def order(self) -> int:
        """Horton-Strahler number of the whole, 0 without any merge."""
        return int(self.orders.max(initial=0))


def borders(looped: LoopedVeins | None, sections: Sections) -> NDArray[np.int64]:
    """List the sections with an areole on each side.

    Parameters
    ----------
    looped : LoopedVeins, optional
        The veins that border areoles.
    sections : Sections
        The sections they are made of.

    Returns
    -------
    ndarray of shape (b, 3), int64
        The section and the faces on its two sides, by section.
    """
    if looped is None:
        return np.zeros((0, 3), dtype=np.int64)
    half = len(looped.sections) // 2
    found, rows = np.unique(looped.sections[:half], return_index=True)
    left, right = looped.walks.faces[rows], looped.walks.faces[rows + half]
    is_between = (left != right) & ~looped.walks.is_outside[left] & ~looped.walks.is_outside[right]
    return np.stack([found, left, right], axis=1)[is_between].astype(np.int64)


def loop_hierarchy(between: NDArray[np.int64], widths: Floats) -> LoopHierarchy:
    """Merge areoles across the thinnest vein that is left, until none is left.

    Parameters
    ----------
    between : ndarray of shape (b, 3), int64
        What :func:`borders` gives.
    widths : ndarray of shape (b,), float64
        Width of each of these sections; of equals the first goes first.

    Returns
    -------
    LoopHierarchy
        One merge less than the areoles of each connected patch of them.

    Notes
    -----
    Katifori and Magnasco (2012, PLoS ONE 7:e37994); the asymmetry of a merge is
    that of Ronellenfitsch, Lasser, Daly and Katifori (2015, PLoS Computational
    Biology 11:e1004680). Veins at the outside border no second areole and stay.
    """
    faces, ends = np.unique(between[:, 1:], return_inverse=True)
    ends = ends.reshape(-1, 2)
    roots = list(range(len(faces)))
    sizes, orders = [1] * len(faces), [1] * len(faces)
    merges = []
    for row in np.argsort(widths, kind="stable").tolist():
        one, other = (_root(roots, face) for face in ends[row].tolist())
        if one == other:
            continue
        if sizes[one] < sizes[other]:
            one, other = other, one
        order = max(orders[one], orders[other]) + (orders[one] == orders[other])
        merges.append((sizes[one], sizes[other], order))
        roots[other] = one
        sizes[one] += sizes[other]
        orders[one] = order
    columns = np.array(merges, dtype=np.int64).reshape(-1, 3).T
    return LoopHierarchy(*columns)


def shuffled_hierarchies(
    between: NDArray[np.int64], widths: Floats, *, repeats: int = 4, seed: int = 0
) -> list[LoopHierarchy]:
    """Merge areoles with the widths shuffled over the sections, several times.

    Parameters
    ----------
    between : ndarray of shape (b, 3), int64
        What :func:`borders` gives.
    widths : ndarray of shape (b,), float64
        Width of each of these sections.
    repeats : int
        How often.
    seed : int
        Of the shuffles.

    Returns
    -------
    list of LoopHierarchy
        The control of :func:`loop_hierarchy`: what chance makes of these faces.
    """
    rng = Streams(seed, ["loops"])["loops"]
    return [loop_hierarchy(between, rng.permutation(widths)) for _ in range(repeats)]


def _root(roots: list[int], face: int) -> int:
    """Give the part a face is in by now; ways to it get shorter."""
    while roots[face] != face:
        roots[face] = roots[roots[face]]
        face = roots[face]
    return face
