"""Sources of the largest blade, drawn once, that appear as the contour reaches them (4.2.3)."""

import numpy as np

from vasc import kernels
from vasc.arrays import Points
from vasc.growth import Growth
from vasc.placement.base import Moment, Placement
from vasc.sources import Cause
from vasc.streams import poisson_count
from vasc.vasculature import Vasculature


class LargestBladePlacement(Placement):
    """Sources placed once in the square that embeds the largest blade.

    As many darts are thrown as the other reading would throw on the largest blade
    in all steps of growth. Those that find room wait; one appears in the first
    step in which it is inside the blade, unless a vein is too near by then.

    Parameters
    ----------
    growth : Growth
        A marginally growing blade, so that a waiting place stays where it is.
    density : float
        Expected darts per unit of area and step.
    source_distance, node_distance : float
        As for :class:`vasc.placement.DartPlacement`, in D.
    """

    def __init__(
        self, growth: Growth, *, density: float, source_distance: float, node_distance: float
    ) -> None:
        self.growth = growth
        self.density = density
        self.source_distance = source_distance
        self.node_distance = node_distance

    @property
    def spacing(self) -> float:
        """The birth distance to sources."""
        return self.source_distance

    def begin(self, veins: Vasculature, rng: np.random.Generator) -> None:
        """Draw the sources of the largest blade.

        A resumed run draws them again; those that have appeared since are refused
        then, for their source lives or a vein has come near.
        """
        low_x, low_y, high_x, high_y = self.growth.domain(self.growth.last_step).bounds
        sides = np.array([high_x - low_x, high_y - low_y])
        mean = self.density * float(sides[0] * sides[1]) * self.growth.last_step
        darts = np.array([low_x, low_y]) + rng.random((poisson_count(rng, mean), 2)) * sides
        box = (low_x, low_y, high_x, high_y)
        grid = kernels.hash_grid.hash_grid(box, self.source_distance, len(darts))
        chosen = kernels.darts.keep_apart(darts, grid, self.source_distance**2)
        self._waiting: Points = darts[chosen]

    def place(self, veins: Vasculature, moment: Moment, rng: np.random.Generator) -> None:
        """Let the sources appear that the contour has reached."""
        if self.is_over(veins, moment.step - 1):
            return
        is_inside = kernels.polygon.are_inside(moment.outline, self._waiting, moment.outline_size)
        arriving = np.ascontiguousarray(self._waiting[is_inside])
        self._waiting = self._waiting[~is_inside]
        veins.reserve_sources(len(arriving))
        n_before = veins.sources.n_rows
        n_after = kernels.darts.throw(
            arriving,
            moment.outline,
            moment.outline_size,
            veins.node_grid,
            veins.places("nodes"),
            veins.source_grid,
            veins.places("sources"),
            veins.is_live,
            n_before,
            self.source_distance**2,
            self.node_distance**2,
        )
        born = veins.new_places(n_after - n_before)
        veins.add_sources(moment.step, *moment.embed(born), Cause.DART)

    def is_over(self, veins: Vasculature, step: int) -> bool:
        """Tell whether the contour stands still after a step."""
        return step >= self.growth.last_step
