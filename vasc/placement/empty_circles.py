"""Sources in the centre of the largest empty circle (Runions 2008, section 5.2.2)."""

from typing import Literal

import numpy as np

from vasc import kernels
from vasc.arrays import Points
from vasc.errors import ConfigError
from vasc.growth import Growth
from vasc.parameters import Parameters, quantity
from vasc.placement.base import Moment, Placement
from vasc.placement.room import Room
from vasc.sources import Cause
from vasc.vasculature import Vasculature

MARGIN_SHARE = 0.15
"""A centre at most that share of the birth distance from the outline is on the margin (ours)."""


class EmptyCirclePlacement(Placement):
    """Sources one after the other where there is most room, while there is enough.

    The centre is in the blade or on its margin, and as far from all veins and
    other sources as possible. Of equally large circles the lowest wins, of those
    the leftmost, so that mirrored sources appear in the same step.

    Parameters
    ----------
    growth : Growth
        The growing blade.
    birth_distance : float
        A source appears while the largest circle is larger than that (b_s), in D.
    last_step : int or None
        Last step with new sources; None: as long as the blade grows.
    wander : float
        A source within the blade is displaced along each axis, at random, by at most that
        share of the birth distance.
    """

    def __init__(
        self, growth: Growth, birth_distance: float, last_step: int | None, wander: float
    ) -> None:
        self.growth = growth
        self.birth_distance = birth_distance
        self.wander = wander
        self.last_step = max(1, growth.last_step) if last_step is None else last_step

    @property
    def spacing(self) -> float:
        """The birth distance."""
        return self.birth_distance

    def is_over(self, veins: Vasculature, step: int) -> bool:
        """Tell whether no source can appear after a step."""
        return step >= self.last_step

    def place(self, veins: Vasculature, moment: Moment, rng: np.random.Generator) -> None:
        """Let sources appear until no circle is large enough."""
        if self.is_over(veins, moment.step - 1):
            return
        room = Room(veins, moment, self.birth_distance / moment.scale)
        while (found := room.largest_circle()) is not None:
            material, place = self._displaced(*found, moment, rng)
            position = place * moment.scale
            cause = Cause.MARGIN if self._is_marginal(place, moment) else Cause.SPACE
            veins.reserve_sources(1)
            row = veins.sources.n_rows
            veins.places("sources")[row] = place
            veins.is_live[row] = 1
            kernels.hash_grid.insert(veins.source_grid, veins.places("sources"), row, row + 1)
            veins.add_sources(moment.step, material, position, cause)
            room.fill(place)

    def _displaced(
        self, material: Points, place: Points, moment: Moment, rng: np.random.Generator
    ) -> tuple[Points, Points]:
        """Give the centre of a circle, displaced if it is to be and stays in the blade."""
        if self.wander == 0.0 or self._is_marginal(place, moment):
            return material, place
        shift = (2.0 * rng.random((1, 2)) - 1.0) * (self.wander * self.birth_distance)
        moved = place + shift / moment.scale
        is_inside = kernels.polygon.are_inside(moment.outline, moved, moment.outline_size)
        if not is_inside[0]:
            return material, place
        material, positions = moment.embed(moved)
        return material, positions / moment.scale

    def _is_marginal(self, place: Points, moment: Moment) -> bool:
        """Tell whether a place is on the margin, or as good as."""
        distance = moment.growth.domain(moment.step).margin_distance(place * moment.scale)
        return bool(distance[0] < MARGIN_SHARE * self.birth_distance)


class EmptyCircleParameters(Parameters):
    """Sources in the centre of the largest empty circle (Runions 2008, section 5.2.2)."""

    kind: Literal["empty_circles"] = "empty_circles"
    birth_distance: float = quantity(
        "A source appears while the largest empty circle is larger than this (b_s).",
        unit="D",
        gt=0.0,
    )
    wander: float = quantity(
        "A source within the blade is displaced along each axis, at random, by at most that"
        " share of the birth distance; 0, as in the thesis, places all in the centre.",
        default=0.0,
        ge=0.0,
        le=0.5,
    )
    until: int | None = quantity(
        "Last step with new sources; by default that of growth.",
        unit="steps",
        default=None,
        ge=1,
        le=1_000_000,
    )

    def placement(self, growth: Growth, kill_distance: float) -> EmptyCirclePlacement:
        """Give the placement for a growing blade.

        Raises
        ------
        ConfigError
            If the blade has several parts or holes.
        """
        n_rings = len(growth.blade.rings)
        if n_rings > 1:
            raise ConfigError(
                f"placement.kind = 'empty_circles': the outline has {n_rings} rings; the margin"
                " must be one"
            )
        return EmptyCirclePlacement(growth, self.birth_distance, self.until, self.wander)
