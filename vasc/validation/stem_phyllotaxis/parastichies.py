"""Phyllotaxis beside veins: contact parastichies, sympodia, and a table of both."""

from dataclasses import dataclass
from itertools import combinations
from math import degrees, gcd, pi

import numpy as np

from vasc.arrays import Ids
from vasc.validation.stem_phyllotaxis.connectivity import Connectivity
from vasc.validation.stem_phyllotaxis.lattice import TIE, Prediction, PrimordiumLattice


@dataclass(frozen=True)
class ContactParastichies:
    """The two families of spirals along which neighbours on the surface touch.

    Parameters
    ----------
    numbers : tuple of int
        Spirals in each family, the smaller first: the visible pair (m, n).
    steps : tuple of int
        Steps in the order of birth along the two families, in the same order.
    angles : tuple of float
        Turn of one step along each, in rad; they may go past half a turn.
    """

    numbers: tuple[int, int]
    steps: tuple[int, int]
    angles: tuple[float, float]

    @property
    def is_opposed(self) -> bool:
        """Whether the two families wind in opposite directions."""
        return self.angles[0] * self.angles[1] < 0.0


def contact_parastichies(lattice: PrimordiumLattice) -> ContactParastichies:
    """Find the two shortest independent ways between primordia on the surface.

    The surface is unrolled, and every way round is a separation of its own: at half
    a turn the two ways to the next primordium are the pair (1, 1). Ways within a
    level are left out.

    Parameters
    ----------
    lattice : PrimordiumLattice
        The primordia.

    Returns
    -------
    ContactParastichies
        Families of the same number are ordered by the size of their turns.

    References
    ----------
    R. O. Erickson (1983), in J. E. Dale and F. L. Milthorpe (eds.), The growth and
    functioning of leaves; J. Swinton, Mathematical Phyllotaxis: the principal pair.

    Examples
    --------
    >>> found = contact_parastichies(PrimordiumLattice(np.radians(137.5), 10.0, 115.0))
    >>> found.numbers, found.is_opposed
    ((5, 8), True)
    >>> contact_parastichies(PrimordiumLattice(np.pi / 2, 10.0, 10.0, per_level=2)).numbers
    (2, 2)
    """
    part = 2.0 * pi / lattice.per_level
    # the second shortest is no longer than one rise and one turn past the next primordium
    longest = np.hypot(2.0 * part * lattice.radius, lattice.rise)
    levels = np.arange(1, int(longest / lattice.rise) + 2)
    nearest = np.round(-levels * lattice.divergence / part).astype(np.int64)
    around = np.arange(-2, 3)
    all_levels = np.repeat(levels, len(around))
    turns = (nearest[:, None] + around).ravel()
    angles = all_levels * lattice.divergence + turns * part
    lengths = np.hypot(angles * lattice.radius, all_levels * lattice.rise)
    # of equal lengths the lower level, and a turn to the left, come first
    order = np.lexsort((angles, all_levels, np.round(lengths / (TIE * longest))))
    first = order[0]
    winding = all_levels[first] * turns - all_levels * turns[first]
    second = next(row for row in order[1:] if winding[row] != 0)
    rows = sorted((first, second), key=lambda row: (all_levels[row], abs(angles[row])))
    separations = np.stack([all_levels[rows], turns[rows]], axis=1)
    steps = lattice.code(separations)
    return ContactParastichies(
        numbers=(
            int(all_levels[rows[0]]) * lattice.per_level,
            int(all_levels[rows[1]]) * lattice.per_level,
        ),
        steps=(int(steps[0]), int(steps[1])),
        angles=(float(angles[rows[0]]), float(angles[rows[1]])),
    )


def n_sympodia(steps: tuple[int, ...], per_level: int = 1) -> int:
    """Give how many systems of veins without connection an endless stem of these steps has.

    Primordia whose levels and members differ by sums of steps are connected. In a spiral
    there are as many systems as the greatest common divisor of the steps says: one step a
    alone gives a open sympodia, and two consecutive Fibonacci numbers join all into one
    closed system.

    Parameters
    ----------
    steps : tuple of int
        Steps in the order of birth, see :meth:`PrimordiumLattice.code`.
    per_level : int
        Primordia a level.

    Returns
    -------
    int
        0 for no steps: as many systems as primordia.

    Examples
    --------
    >>> n_sympodia((5, 8)), n_sympodia((5,)), n_sympodia((2, 4))
    (1, 5, 2)

    Leaves in crossed pairs whose veins follow the four rows of leaves:

    >>> n_sympodia((5,), per_level=2)
    4
    """
    # the index of the steps, with a full turn of a level, among all separations
    rows = [divmod(step, per_level) for step in steps] + [(0, per_level)]
    return gcd(*(a * d - b * c for (a, b), (c, d) in combinations(rows, 2)))


def sympodia(connectivity: Connectivity) -> Ids:
    """Give the system of veins that each primordium belongs to, as the links say.

    Parameters
    ----------
    connectivity : Connectivity
        The links.

    Returns
    -------
    ndarray of shape (p,), int32
        Numbers from 0, in the order of the first primordium of each.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    n_primordia = len(connectivity.steps)
    pairs = np.array(connectivity.links, dtype=np.int64).reshape(-1, 2)
    links = csr_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), (n_primordia, n_primordia))
    labels = connected_components(links, directed=False)[1]
    _, firsts, places = np.unique(labels, return_index=True, return_inverse=True)
    ranks = np.empty(len(firsts), dtype=np.int32)
    ranks[np.argsort(firsts)] = np.arange(len(firsts), dtype=np.int32)
    return ranks[places]


@dataclass(frozen=True)
class PrimordiumRow:
    """One primordium: where it is, and what its veins have to do with phyllotaxis.

    Parameters
    ----------
    primordium : int
        Its number, from 0.
    angle : float
        In degrees, from 0 to 360.
    height : float
        Above the ring, in D.
    up, down : tuple of int
        Primordia above and below that veins connect it to.
    steps : tuple of int
        Its steps upward.
    predicted : tuple of int
        Those of its steps that the lattice predicts.
    on_parastichies : tuple of int
        Those of its steps that follow a contact parastichy.
    sympodium : int
        The system of veins that it belongs to.
    judged : bool
        Whether it counts for the verdict.
    """

    primordium: int
    angle: float
    height: float
    up: tuple[int, ...]
    down: tuple[int, ...]
    steps: tuple[int, ...]
    predicted: tuple[int, ...]
    on_parastichies: tuple[int, ...]
    sympodium: int
    judged: bool


def topology_table(
    connectivity: Connectivity, lattice: PrimordiumLattice, prediction: Prediction
) -> tuple[PrimordiumRow, ...]:
    """Set phyllotaxis against the topology of veins, primordium by primordium.

    Parameters
    ----------
    connectivity : Connectivity
        What the veins connect.
    lattice : PrimordiumLattice
        Where the primordia are.
    prediction : Prediction
        What the lattice predicts.

    Returns
    -------
    tuple of PrimordiumRow
        In the order of birth.
    """
    along = contact_parastichies(lattice).steps
    systems = sympodia(connectivity)
    rows = []
    for m, steps in enumerate(connectivity.steps):
        level, member = divmod(m, lattice.per_level)
        turn = level * lattice.divergence + member * 2.0 * pi / lattice.per_level
        rows.append(
            PrimordiumRow(
                primordium=m,
                angle=degrees(turn % (2.0 * pi)),
                height=(level + 1) * lattice.rise,
                up=tuple(sorted(n for n, lower in connectivity.links if lower == m)),
                down=tuple(sorted(lower for n, lower in connectivity.links if n == m)),
                steps=steps,
                predicted=tuple(step for step in steps if step in prediction.steps),
                on_parastichies=tuple(step for step in steps if step in along),
                sympodium=int(systems[m]),
                judged=m in connectivity.judged,
            )
        )
    return tuple(rows)
