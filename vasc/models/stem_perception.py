"""Which nodes of a stem perceive each other, and how they grow (Runions 2008, section 6.2.1)."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.domain import StemParameters
from vasc.errors import ConfigError
from vasc.parameters import Parameters, quantity

if TYPE_CHECKING:
    from vasc.kernels.stem import Stem


class StemPerception(ABC):
    """Finds, for new nodes, the nodes that perceive them and that they perceive.

    Parameters
    ----------
    segment_length : float
        Length of a new segment, D.
    """

    def __init__(self, segment_length: float) -> None:
        self.segment_length = segment_length

    @abstractmethod
    def stem(self) -> "Stem":
        """Give a stem without nodes."""

    @abstractmethod
    def perceive(self, stem: "Stem", start: int) -> "Stem":
        """Bring active pairs up to date with the nodes from ``start`` on, and join the near."""

    def extend(self, stem: "Stem") -> "Stem":
        """Let every node of an active pair grow one segment toward its partners."""
        tips, sums = kernels.stem.directions(stem)
        return kernels.stem.extend(stem, tips, sums, self.segment_length)

    def places(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Give the places between which distances are taken, shape (n, 3)."""
        return positions

    def positions(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Give the positions in space of places, shape (n, 3)."""
        return places


class ChordPerception(StemPerception):
    """Relative neighbours by straight distances in space (equation 4.1 in three dimensions)."""

    def stem(self) -> "Stem":
        """Give a stem without nodes."""
        return kernels.stem.stem(self.segment_length)

    def perceive(self, stem: "Stem", start: int) -> "Stem":
        """Find the relative neighbours of new nodes."""
        return kernels.stem.insert(stem, start, self.segment_length)


class UrquhartStemPerception(ChordPerception):
    """Common neighbours in a Delaunay triangulation, an approximation (section 4.4.2)."""

    def perceive(self, stem: "Stem", start: int) -> "Stem":
        """Find all pairs anew."""
        return kernels.urquhart_3d.insert(stem, start, self.segment_length)


class SurfacePerception(StemPerception):
    """Relative neighbours by distances along the surface; veins stay on it.

    Parameters
    ----------
    segment_length : float
        Length of a new segment, D.
    radius : float
        Radius of the stem, D.
    """

    def __init__(self, segment_length: float, radius: float) -> None:
        super().__init__(segment_length)
        self.radius = radius
        self.period = kernels.cylinder.circumference(radius)

    def stem(self) -> "Stem":
        """Give a stem without nodes."""
        return kernels.stem.stem(self.segment_length, self.period)

    def perceive(self, stem: "Stem", start: int) -> "Stem":
        """Find the relative neighbours of new nodes."""
        return kernels.stem.insert(stem, start, self.segment_length)

    def places(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Give the places on the unrolled surface: along the arc, 0, height."""
        turns = np.arctan2(positions[:, 1], positions[:, 0]) / (2.0 * np.pi)
        arcs = (turns - np.floor(turns)) * self.period
        return np.stack([arcs, np.zeros(len(arcs)), positions[:, 2]], axis=1)

    def positions(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Give the positions in space of places on the unrolled surface."""
        angles = places[:, 0] / self.radius
        across, up = self.radius * np.cos(angles), self.radius * np.sin(angles)
        return np.stack([across, up, places[:, 2]], axis=1)


class StemPerceptionParameters(Parameters):
    """How nodes of a stem perceive each other."""

    metric: Literal["chord", "surface", "urquhart"] = quantity(
        "Relative neighbours by straight distances in space ('chord'), by distances along the"
        " surface, or common Delaunay neighbours ('urquhart'). Only the first makes the patterns of"
        " real stems; the others are there to be compared.",
        default="chord",
    )

    def perception(self, domain: StemParameters, segment_length: float) -> StemPerception:
        """Give the perception for a stem.

        Raises
        ------
        ConfigError
            If distances are to be along the surface of a stem that is no cylinder.
        """
        if self.metric == "chord":
            return ChordPerception(segment_length)
        if self.metric == "urquhart":
            return UrquhartStemPerception(segment_length)
        if domain.radius is None:
            raise ConfigError(
                "perception.metric = 'surface': needs domain.radius; the surface of a stem with"
                " domain.radii cannot be unrolled"
            )
        return SurfacePerception(segment_length, domain.radius)
