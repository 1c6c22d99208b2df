"""Which primordia veins connect: the vein graph read without any tolerance of geometry.

Veins fork a few D above a primordium and three of them meet in a Y, so that a way past
no other primordium leads from almost every primordium to almost every other. What
tells neighbours is the relative neighbourhood once more, with distances along veins.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Ids
from vasc.errors import VascError
from vasc.validation.stem_phyllotaxis.lattice import as_pair
from vasc.validation.stem_phyllotaxis.stem_graph import StemGraph

MARGIN = 0.005
"""A third primordium comes between two if it is nearer to both by this share."""
BASE = 6
"""Primordia at the base that are irregular, beyond those that lead to the ring."""
LEAST = 20
"""Primordia that a stem needs beyond three times the largest step."""
SHORTEST = 1e-12
"""Length given to segments without one, which a sparse matrix would drop."""

Steps = tuple[int, ...]


@dataclass(frozen=True)
class Deviation:
    """A primordium whose steps are not those of the others.

    Parameters
    ----------
    primordium : int
        Its number, from 0.
    steps : tuple of int
        Its steps upward.
    missing, extra : tuple of int
        What it lacks of the steps expected, and what it has beyond them.
    """

    primordium: int
    steps: Steps
    missing: Steps
    extra: Steps


@dataclass(frozen=True)
class Connectivity:
    """Connections between primordia, and what they have in common.

    Parameters
    ----------
    links : tuple of tuple of int
        Pairs (upper, lower) of primordia that veins connect, sorted.
    steps : tuple of tuple of int
        For each primordium its steps upward in the order of birth, ascending.
    judged : range
        Primordia that are neither too near to the base nor to the top.
    """

    links: tuple[tuple[int, int], ...]
    steps: tuple[Steps, ...]
    judged: range

    @property
    def dominant(self) -> Steps:
        """The steps that most judged primordia have; of equally many the first met."""
        return Counter(self.steps[m] for m in self.judged).most_common(1)[0][0]

    @property
    def pair(self) -> Steps:
        """The dominant steps, a single one written twice."""
        return as_pair(self.dominant)

    @property
    def fraction(self) -> float:
        """Share of the judged primordia that have exactly the dominant steps."""
        return self.share({self.dominant})

    def share(self, allowed: set[Steps]) -> float:
        """Give the share of the judged primordia whose steps are among those allowed."""
        return sum(self.steps[m] in allowed for m in self.judged) / len(self.judged)

    def exceptions(self, expected: Steps | Mapping[int, Steps]) -> tuple[Deviation, ...]:
        """Give the judged primordia whose steps are not those expected, of all or of each."""
        of_each = (
            expected if isinstance(expected, Mapping) else dict.fromkeys(self.judged, expected)
        )
        return tuple(
            Deviation(
                m,
                self.steps[m],
                tuple(sorted(set(of_each[m]) - set(self.steps[m]))),
                tuple(sorted(set(self.steps[m]) - set(of_each[m]))),
            )
            for m in self.judged
            if self.steps[m] != of_each[m]
        )


def measure_connectivity(graph: StemGraph, largest_step: int) -> Connectivity:
    """Read which primordia the veins of a stem connect.

    Two primordia are connected when a way along veins leads from one to the other,
    outside the ring at the base, and no third primordium is nearer to both along
    veins than they are to each other.

    Parameters
    ----------
    graph : StemGraph
        Veins and primordia.
    largest_step : int
        The largest step expected, b. Primordia from b + 6 up to 2 b + 2 below the
        last are judged: those further down lead to the ring, those further up are
        not connected to all that comes above.

    Returns
    -------
    Connectivity

    Raises
    ------
    VascError
        If there are fewer than 3 b + 20 primordia.
    """
    n_primordia, per_level = len(graph.primordia), graph.per_level
    needed = 3 * largest_step + LEAST
    if n_primordia < needed:
        raise VascError(
            f"primordia: expected at least {needed} for steps up to {largest_step},"
            f" got {n_primordia}"
        )
    lengths = way_lengths(graph.positions, graph.segments, graph.primordia, graph.ring)
    links = tuple(sorted((n, m) for m, n in relative_neighbors(lengths)))
    steps: list[set[int]] = [set() for _ in range(n_primordia)]
    for upper, lower in links:
        for one, step in _steps(upper, lower, per_level):
            steps[one].add(step)
    return Connectivity(
        links=links,
        steps=tuple(tuple(sorted(each)) for each in steps),
        judged=range(largest_step + BASE, n_primordia - 2 * largest_step - 2),
    )


def _steps(upper: int, lower: int, per_level: int) -> Iterator[tuple[int, int]]:
    """Give the step of a link, and of which primordium it is one."""
    (high, onto), (low, member) = divmod(upper, per_level), divmod(lower, per_level)
    on = (onto - member) % per_level
    if high > low:
        yield lower, (high - low) * per_level + on
        return
    # on one level each is a step from the other, counted the short way round
    for one in (lower, upper):
        yield one, min(on, per_level - on)


def way_lengths(positions: Floats, segments: Ids, primordia: Ids, ring: Ids) -> Floats:
    """Give the shortest ways along veins from primordium to primordium, past the ring.

    Parameters
    ----------
    positions : ndarray of shape (n, 3), float64
        Vein nodes, in D.
    segments : ndarray of shape (m, 2), integer
        Node ids.
    primordia : ndarray of shape (p,), integer
        Node ids of primordia.
    ring : ndarray of shape (r,), integer
        Node ids that no way may use: it would lead around the base.

    Returns
    -------
    ndarray of shape (p, p), float64
        In D; infinite where there is none.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import dijkstra

    kept = segments[~np.isin(segments, ring).any(axis=1)]
    # of segments that are there twice a sparse matrix would add the lengths
    kept = np.unique(np.sort(kept, axis=1), axis=0)
    ends = positions[kept]
    lengths = np.maximum(np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1)), SHORTEST)
    n_nodes = len(positions)
    veins = csr_array((lengths, (kept[:, 0], kept[:, 1])), shape=(n_nodes, n_nodes))
    # one at a time: all ways from all primordia need not be held at once
    rows = [dijkstra(veins, directed=False, indices=int(one))[primordia] for one in primordia]
    return np.array(rows, dtype=np.float64).reshape(len(primordia), len(primordia))


def relative_neighbors(lengths: Floats, margin: float = MARGIN) -> list[tuple[int, int]]:
    """Give the pairs that no third comes between, in any metric.

    Parameters
    ----------
    lengths : ndarray of shape (p, p), float64
        Distances, infinite where there is no way.
    margin : float
        A third comes between if both its distances are shorter by more than this share.

    Returns
    -------
    list of tuple of int
        Pairs (lower number, higher number), ascending.

    Examples
    --------
    >>> on_a_line = np.array([[0.0, 1.0, 2.0], [1.0, 0.0, 1.0], [2.0, 1.0, 0.0]])
    >>> relative_neighbors(on_a_line)
    [(0, 1), (1, 2)]
    """
    found = []
    for m, row in enumerate(lengths):
        others = m + 1 + np.flatnonzero(np.isfinite(row[m + 1 :]))
        limits = (1.0 - margin) * row[others]
        # rows: others, columns: thirds; the two themselves are at full length from one
        farther = np.maximum(lengths[others], row[None, :])
        is_between: NDArray[np.bool_] = (farther < limits[:, None]).any(axis=1)
        found += [(m, int(n)) for n in others[~is_between]]
    return found
