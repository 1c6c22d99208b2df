"""The genealogy of areoles: which was split from which, and which loop came first."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids


@dataclass(frozen=True)
class Genealogy:
    """Who was split from whom among the areoles of a run, up to a step.

    Parameters
    ----------
    births : ndarray of shape (a,), int32
        Step of birth.
    parents : ndarray of shape (a,), int32
        The areole each was split from, -1 if it was born in open tissue: a first-order loop.
    segments : ndarray of shape (a,), int32
        The segment that closed it.
    splits : ndarray of shape (a,), int32
        Step at which it was split, -1 if it is whole.
    boundaries : dict of int to ndarray of shape (b,), int32
        Nodes around every whole areole, counterclockwise.
    """

    births: Ids
    parents: Ids
    segments: Ids
    splits: Ids
    boundaries: dict[int, Ids]

    @property
    def n_areoles(self) -> int:
        """Number of areoles, split ones as well."""
        return len(self.births)

    @property
    def roots(self) -> Ids:
        """The first-order loop each areole lies in, itself for one of these; shape (a,)."""
        return self._climbed()[0]

    @property
    def generations(self) -> Ids:
        """Number of splits that led to each areole, 0 for a first-order loop; shape (a,)."""
        return self._climbed()[1]

    def columns(self) -> dict[str, NDArray]:
        """Give a table with one row an areole."""
        roots, generations = self._climbed()
        return {
            "areole": np.arange(self.n_areoles, dtype=np.int32),
            "birth": self.births,
            "parent": self.parents,
            "segment": self.segments,
            "split": self.splits,
            "first_order": roots,
            "generation": generations,
        }

    def ancestors(self, areole: int) -> tuple[int, ...]:
        """Give the areoles that one was split from, nearest first; none for a first-order loop."""
        found = []
        # a parent is an earlier row, in a sound file
        while 0 <= (parent := int(self.parents[areole])) < areole:
            found.append(parent)
            areole = parent
        return tuple(found)

    def alive_before(self, areole: int, step: int) -> int:
        """Give the areole or the ancestor of it that existed just before a step, -1 if none."""
        while areole != NULL and self.births[areole] >= step:
            areole = int(self.parents[areole])
        return areole

    def _climbed(self) -> tuple[Ids, Ids]:
        """Give roots and generations; a parent is an earlier row."""
        roots = np.arange(self.n_areoles, dtype=np.int32)
        generations = np.zeros(self.n_areoles, dtype=np.int32)
        for areole, parent in enumerate(self.parents.tolist()):
            if 0 <= parent < areole:
                roots[areole] = roots[parent]
                generations[areole] = generations[parent] + 1
        return roots, generations


@dataclass(frozen=True)
class Loops:
    """The areole on the left of every half-edge of the veins of a step.

    Parameters
    ----------
    nodes : ndarray of shape (2m,), int32
        The node each half-edge begins with.
    areoles : ndarray of shape (2m,), int32
        The whole areole on its left, -1 outside all.
    """

    nodes: Ids
    areoles: Ids

    def beside(self, nodes: Ids) -> Ids:
        """Give the areoles beside the first of some nodes that is in a vein; maybe none."""
        held = np.isin(nodes, self.nodes)
        found: Ids = self.areoles[self.nodes == nodes[held][0]] if held.any() else np.empty(0, "i4")
        return found
