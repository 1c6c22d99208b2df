"""What the checks read of a stem: its veins as plain arrays, and where primordia came from."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Ids
from vasc.errors import ShapeError
from vasc.validation.stem_phyllotaxis.lattice import PrimordiumLattice


@dataclass(frozen=True)
class StemGraph:
    """The veins of a stem and its primordia; nothing else is known to the checks.

    Parameters
    ----------
    positions : ndarray of shape (n, 3), float64
        Vein nodes, in D; the stem stands along the third axis, around the origin.
    segments : ndarray of shape (m, 2), integer
        Node ids of both ends.
    primordia : ndarray of shape (p,), integer
        Node ids of the primordia, in the order of birth.
    ring : ndarray of shape (r,), integer
        Node ids of the ring at the base.
    divergence : float
        Turn from one level of primordia to the next, in rad.
    rise : float
        Height from one level to the next, in D.
    radius : float
        Of the stem, in D; that at the middle primordium where it changes.
    per_level : int
        Primordia a level; those of one level follow each other.
    radii : ndarray of shape (p,), float64, optional
        Its radius at each primordium, in D; None where it is the same for all.

    Raises
    ------
    ShapeError
        If an array has another shape, a position is not finite, or an id is no node's.
    VascError
        If divergence, rise, radius or primordia a level make no lattice.
    """

    positions: Floats
    segments: Ids
    primordia: Ids
    ring: Ids
    divergence: float
    rise: float
    radius: float
    per_level: int = 1
    radii: Floats | None = None

    def __post_init__(self) -> None:
        if self.positions.ndim != 2 or self.positions.shape[1] != 3:
            raise ShapeError(f"positions: expected shape (n, 3), got {self.positions.shape}")
        if not np.isfinite(self.positions).all():
            raise ShapeError("positions: numbers must be finite")
        if self.segments.ndim != 2 or self.segments.shape[1] != 2:
            raise ShapeError(f"segments: expected shape (m, 2), got {self.segments.shape}")
        for name, ids in (
            ("segments", self.segments),
            ("primordia", self.primordia),
            ("ring", self.ring),
        ):
            _check_ids(name, ids, len(self.positions))
        if self.radii is not None and self.radii.shape != self.primordia.shape:
            raise ShapeError(f"radii: expected one a primordium, got shape {self.radii.shape}")
        _ = self.lattice

    @property
    def lattice(self) -> PrimordiumLattice:
        """The lattice that the primordia were placed on."""
        return PrimordiumLattice(self.divergence, self.rise, self.radius, self.per_level)

    @property
    def radius_range(self) -> tuple[float, float] | None:
        """Least and largest radius at the primordia, in D; None where all have the same."""
        return None if self.radii is None else (float(self.radii.min()), float(self.radii.max()))


def _check_ids(name: str, ids: NDArray, n_nodes: int) -> None:
    """Raise an error if ids are not whole numbers of nodes."""
    if ids.size and not np.issubdtype(ids.dtype, np.integer):
        raise ShapeError(f"{name}: expected whole numbers, got {ids.dtype}")
    wrong = ids[(ids < 0) | (ids >= n_nodes)]
    if wrong.size:
        raise ShapeError(f"{name}: there is no node {int(wrong.flat[0])}, only {n_nodes}")
