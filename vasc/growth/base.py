"""Growth as a map between material coordinates, which never change, and positions."""

import math
from abc import ABC, abstractmethod
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from vasc import kernels
from vasc.arrays import Floats, Ids, Points
from vasc.domain import Blade
from vasc.errors import ConfigError
from vasc.limits import RUN_STEPS
from vasc.vasculature import Vasculature

if TYPE_CHECKING:
    from vasc.kernels.polygon import EdgeGrid


MARGIN_SPACING = 1.0
"""Greatest distance of neighboring points of a deformed outline, in D."""


class Growth(ABC):
    """A growing blade: where each material point is at each step.

    Parameters
    ----------
    blade : Blade
        The blade at step 0.
    """

    n_base: int = 1
    """How many points of the margin, the first ones, are the base."""

    def __init__(self, blade: Blade) -> None:
        self.blade = blade

    @property
    @abstractmethod
    def last_step(self) -> int:
        """The last step in which the blade grows, 0 if it never does."""

    @property
    @abstractmethod
    def box(self) -> tuple[float, float, float, float]:
        """A box around all places that nodes and sources ever have: low x, low y, high x, high y.

        Places are measured as the parts of the models do: in material units in a
        similarity, in D in a deformation.
        """

    @abstractmethod
    def scale(self, step: int) -> float:
        """Give the size of one unit of the places of nodes and sources at a step, in D."""

    @abstractmethod
    def outline_scale(self, step: int) -> float:
        """Give the size of the outline over that of :meth:`outline` at a step."""

    @abstractmethod
    def outline(self, step: int) -> "EdgeGrid":
        """Give the outline for a step, ready for the question whether a point is inside."""

    @abstractmethod
    def domain(self, step: int) -> Blade:
        """Give the blade at a step, in real size."""

    @abstractmethod
    def margin_places(self, step: int) -> Points:
        """Give the places of points of the margin, ``MARGIN_SPACING`` apart at most, shape (m, 2).

        The first :attr:`n_base` are the base where the leaf is attached.
        """

    @abstractmethod
    def along_margin(self, rows: Ids, shares: Floats, step: int) -> tuple[Points, Points]:
        """Give material points and places between points of the margin and those that follow."""

    @abstractmethod
    def position(self, material: Points, step: int) -> Points:
        """Give the positions of material points at a step, shape (n, 2)."""

    @abstractmethod
    def material(self, position: Points, step: int, near: Points | None = None) -> Points:
        """Give the material points that are at positions at a step, shape (n, 2).

        ``near`` holds material points close to those that are sought, where some are known.
        """

    @abstractmethod
    def embed(self, places: Points, step: int, near: Points | None = None) -> tuple[Points, Points]:
        """Give the material points at places at a step, and the positions of those."""

    @abstractmethod
    def carry(self, veins: Vasculature, step: int) -> None:
        """Take the places of nodes and sources along to a step."""

    @abstractmethod
    def affine(self, step: int) -> tuple[float, float] | None:
        """Give the scales of material points and of the outline; None for a deformation."""

    def time(self, step: int) -> float:
        """Give the model time of a step, by default in steps."""
        return float(step)


class Similarity(Growth):
    """A blade whose points move by one scale factor about the attachment.

    Distances in material units are then distances in real units over
    :meth:`scale`, so that places are material points and nothing is moved.
    """

    @property
    def box(self) -> tuple[float, float, float, float]:
        """The box of the largest blade, in material units."""
        factor = self.outline_scale(self.last_step) / self.scale(self.last_step)
        return self.blade.scaled(factor).bounds

    @cached_property
    def _outline(self) -> "EdgeGrid":
        return kernels.polygon.edge_grid(*self.blade.flat)

    def outline(self, step: int) -> "EdgeGrid":
        """Give the outline at step 0."""
        return self._outline

    def domain(self, step: int) -> Blade:
        """Give the blade at a step, in real size."""
        return self.blade.scaled(self.outline_scale(step))

    @cached_property
    def _margin(self) -> Points:
        """Points of the outline at step 0, near enough to each other at every size."""
        spacing = MARGIN_SPACING / self.outline_scale(self.last_step)
        parts = []
        for ring in self.blade.rings:
            ends = np.concatenate([ring, ring[:1]])
            numbers = np.ceil(np.sqrt((np.diff(ends, axis=0) ** 2).sum(axis=1)) / spacing)
            rows = np.repeat(np.arange(len(ring)), np.maximum(numbers, 1).astype(int))
            shares = np.concatenate([np.arange(n) / n for n in np.maximum(numbers, 1)])
            parts.append(ends[rows] + shares[:, None] * (ends[rows + 1] - ends[rows]))
        return np.concatenate(parts)

    def margin_places(self, step: int) -> Points:
        """Give the places of points of the margin, shape (m, 2)."""
        return self._margin * (self.outline_scale(step) / self.scale(step))

    def along_margin(self, rows: Ids, shares: Floats, step: int) -> tuple[Points, Points]:
        """Give material points, which are places, between points of the margin."""
        margin = self.margin_places(step)
        first, second = margin[rows], margin[(rows + 1) % len(margin)]
        places = first + shares[:, None] * (second - first)
        return places, places

    def position(self, material: Points, step: int) -> Points:
        """Give the positions of material points at a step, shape (n, 2)."""
        return material * self.scale(step)

    def material(self, position: Points, step: int, near: Points | None = None) -> Points:
        """Give the material points that are at positions at a step, shape (n, 2)."""
        return position / self.scale(step)

    def embed(self, places: Points, step: int, near: Points | None = None) -> tuple[Points, Points]:
        """Give the places themselves, which are material points, and their positions."""
        return places, places * self.scale(step)

    def carry(self, veins: Vasculature, step: int) -> None:
        """Do nothing: places are material points."""

    def affine(self, step: int) -> tuple[float, float]:
        """Give the scales of material points and of the outline."""
        return self.scale(step), self.outline_scale(step)


class Deformation(Growth):
    """A blade whose points move by a map that is no similarity; places are positions.

    Parameters
    ----------
    margin : ndarray of shape (m, 2), float64
        Material points of the outline in order, first of the attached base; mirror
        images of each other, and at no step farther apart than ``MARGIN_SPACING``.
    n_base : int
        How many points of the outline, the first ones, are the base where the leaf
        is attached: it is no margin, and no source appears on it.
    seeds : ndarray of shape (k, 2), float64
        Material points of the first vein nodes.
    """

    def __init__(self, margin: Points, n_base: int, seeds: Points) -> None:
        self.margin = margin
        self.n_base = n_base
        self.seeds = seeds
        self._latest: tuple[int, Blade] | None = None
        super().__init__(self.domain(0))

    def scale(self, step: int) -> float:
        """Give 1: places are positions."""
        return 1.0

    def outline_scale(self, step: int) -> float:
        """Give 1: every step has an outline of its own."""
        return 1.0

    def outline(self, step: int) -> "EdgeGrid":
        """Give the outline at a step."""
        return self.domain(step).edge_grid

    def domain(self, step: int) -> Blade:
        """Give the blade at a step; that of the last one asked for is kept."""
        if self._latest is None or self._latest[0] != step:
            rings = [self.position(self.margin, step)]
            self._latest = step, Blade.sound(rings, self.position(self.seeds, step))
        return self._latest[1]

    def margin_places(self, step: int) -> Points:
        """Give the positions of points of the margin, shape (m, 2)."""
        return self.domain(step).rings[0]

    def along_margin(self, rows: Ids, shares: Floats, step: int) -> tuple[Points, Points]:
        """Give material points and positions between points of the margin."""
        first, second = self.margin[rows], self.margin[(rows + 1) % len(self.margin)]
        material = (1.0 - shares[:, None]) * first + shares[:, None] * second
        return material, self.position(material, step)

    def embed(self, places: Points, step: int, near: Points | None = None) -> tuple[Points, Points]:
        """Give the material points nearest to places, and their positions.

        Outside the blade these are points of the margin.
        """
        material = self.material(places, step, near)
        return material, self.position(material, step)

    def affine(self, step: int) -> None:
        """Give None: positions are explicit."""

    def carry(self, veins: Vasculature, step: int) -> None:
        """Take the places of nodes and sources along to a step."""
        veins.move(
            self.position(veins.nodes.view("material"), step),
            self.position(veins.sources.view("material"), step),
        )


def last_step_of(n_steps: float, key: str, value: float) -> int:
    """Give the step in which growth that takes a number of steps ends.

    Parameters
    ----------
    n_steps : float
        Steps that growth takes, the last of them perhaps in part.
    key : str
        The key of the config that decides it.
    value : float
        Its value.

    Raises
    ------
    ConfigError
        If there are more than ``RUN_STEPS``; the message names the key.
    """
    if n_steps > RUN_STEPS:
        raise ConfigError(
            f"{key} = {value:g}: growth would take {n_steps:.3g} steps; allowed are {RUN_STEPS:,}"
        )
    return math.ceil(n_steps)
