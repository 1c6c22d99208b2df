"""Plain dart throwing: over the whole blade, each dart tested against everything."""

import numpy as np
from reference.relative_neighbors import square

from vasc import kernels
from vasc.sources import Cause


def has_room(dart, sources, nodes, source_distance, node_distance):
    """Whether a dart is farther than the birth distances from all sources and nodes."""
    return all(square(dart, s) > source_distance**2 for s in sources) and all(
        square(dart, v) > node_distance**2 for v in nodes
    )


def kept_apart(points, distance):
    """Rows of the points that stay when each must be far from all that stayed before it."""
    kept = []
    for row, point in enumerate(points):
        if all(square(point, points[other]) > distance**2 for other in kept):
            kept.append(row)
    return kept


class PlainDarts:
    """A placement that throws its darts over the box of the whole blade of each step.

    Distances are in D; ``last_step`` is the last step with darts.
    """

    def __init__(self, growth, *, density, source_distance, node_distance, last_step=None):
        self.growth = growth
        self.density = density
        self.source_distance = source_distance
        self.node_distance = node_distance
        self.last_step = growth.last_step if last_step is None else last_step
        self.spacing = source_distance

    def begin(self, veins, rng):
        """Nothing is drawn before the first step."""

    def is_over(self, veins, step):
        """Darts end with their last step."""
        return step >= self.last_step

    def place(self, veins, moment, rng):
        """Throw a Poisson number of darts one by one and keep those with room."""
        if self.is_over(veins, moment.step - 1):
            return
        blade = self.growth.domain(moment.step)
        low_x, low_y, high_x, high_y = blade.bounds
        sides = np.array([high_x - low_x, high_y - low_y])
        darts = rng.random((rng.poisson(self.density * sides.prod()), 2)) * sides + (low_x, low_y)
        for dart in darts[blade.contains(darts)]:
            self._test(veins, moment, dart)

    def _test(self, veins, moment, dart):
        """Make a source of a dart with room."""
        nodes = veins.places("nodes")[: veins.nodes.n_rows] * moment.scale
        live = veins.places("sources")[veins.live] * moment.scale
        gaps_to_nodes = ((nodes - dart) ** 2).sum(axis=1)
        gaps_to_live = ((live - dart) ** 2).sum(axis=1)
        if (gaps_to_nodes <= self.node_distance**2).any():
            return
        if (gaps_to_live <= self.source_distance**2).any():
            return
        veins.reserve_sources(1)
        row = veins.sources.n_rows
        veins.places("sources")[row] = dart / moment.scale
        veins.is_live[row] = 1
        kernels.hash_grid.insert(veins.source_grid, veins.places("sources"), row, row + 1)
        veins.add_sources(moment.step, *moment.embed(veins.new_places(1)), Cause.DART)


class PlainLargestBlade(PlainDarts):
    """The other reading: darts on the largest blade at first, that wait for the contour."""

    def begin(self, veins, rng):
        """Throw as many darts as the steps of growth would on the box of the largest blade."""
        low_x, low_y, high_x, high_y = self.growth.domain(self.growth.last_step).bounds
        sides = np.array([high_x - low_x, high_y - low_y])
        n_darts = rng.poisson(self.density * sides.prod() * self.growth.last_step)
        darts = rng.random((n_darts, 2)) * sides + (low_x, low_y)
        self.waiting = darts[kept_apart(darts.tolist(), self.source_distance)]

    def place(self, veins, moment, rng):
        """Test the darts that the contour has reached."""
        if self.is_over(veins, moment.step - 1):
            return
        is_inside = self.growth.domain(moment.step).contains(self.waiting)
        for dart in self.waiting[is_inside]:
            self._test(veins, moment, dart)
        self.waiting = self.waiting[~is_inside]
