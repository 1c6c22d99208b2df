"""Dart throwing over the current blade in every step (Runions 2008, sections 4.2.3-4.2.4)."""

from typing import TYPE_CHECKING, Literal

import numpy as np

from vasc import kernels
from vasc.growth import Growth, Similarity
from vasc.parameters import Parameters, quantity
from vasc.placement.base import Moment, Placement
from vasc.placement.largest_blade import LargestBladePlacement
from vasc.sources import Cause
from vasc.streams import poisson_count
from vasc.vasculature import Vasculature

if TYPE_CHECKING:
    from vasc.kernels.darts import DartCells

EPOCH_RATIO = 1.19
"""The cells are made anew when the blade has grown by this factor."""

DARTS_PER_CELL = 3.0
"""A blade that does not grow is saturated when that many darts on every open cell,
in expectation, have found no room."""


class DartPlacement(Placement):
    """Sources where darts find room, over the whole blade of each step.

    Parameters
    ----------
    growth : Growth
        The growing blade.
    density : float
        Expected darts per unit of real area and step.
    source_distance, node_distance : float
        A dart is refused at most that far from a live source or a node, in D.
    last_step : int or None
        Last step with darts; None: as long as the blade grows, or, on a blade
        that does not, until it is saturated.
    """

    def __init__(
        self,
        growth: Growth,
        *,
        density: float,
        source_distance: float,
        node_distance: float,
        last_step: int | None,
    ) -> None:
        self.growth = growth
        self.density = density
        self.source_distance = source_distance
        self.node_distance = node_distance
        self.last_step = growth.last_step if last_step is None else last_step
        self.is_until_saturated = last_step is None and growth.last_step == 0
        self._epoch_end = 0
        cell_area = (node_distance / kernels.darts.CELLS_PER_RADIUS) ** 2
        self._n_quiet_steps = int(np.ceil(DARTS_PER_CELL / (density * cell_area)))

    @property
    def spacing(self) -> float:
        """The birth distance to sources."""
        return self.source_distance

    def place(self, veins: Vasculature, moment: Moment, rng: np.random.Generator) -> None:
        """Throw the darts of one step."""
        if self.is_over(veins, moment.step - 1):
            return
        self._cover(veins, moment.step)
        if self.cells.n_uncovered[0] == 0:
            return
        area = self.cells.n_uncovered[0] * (self.cells.corner[2] * moment.scale) ** 2
        n_darts = poisson_count(rng, self.density * float(area))
        if n_darts == 0:
            return
        darts = kernels.darts.aim(self.cells, rng.random((n_darts, 3)))
        veins.reserve_sources(n_darts)
        n_before = veins.sources.n_rows
        n_after = kernels.darts.throw(
            darts,
            moment.outline,
            moment.outline_size,
            veins.node_grid,
            veins.places("nodes"),
            veins.source_grid,
            veins.places("sources"),
            veins.is_live,
            n_before,
            (self.source_distance / moment.scale) ** 2,
            (self.node_distance / moment.scale) ** 2,
        )
        born = veins.new_places(n_after - n_before)
        veins.add_sources(moment.step, *moment.embed(born), Cause.DART)

    def is_over(self, veins: Vasculature, step: int) -> bool:
        """Tell whether no dart is thrown after a step."""
        if not self.is_until_saturated:
            return step >= self.last_step
        if self._epoch_end > 0 and self.cells.n_uncovered[0] == 0:
            return True
        n_sources = veins.sources.n_rows
        last_birth = int(veins.sources.arrays["birth"][n_sources - 1]) if n_sources else 0
        return step - last_birth >= self._n_quiet_steps

    def _cover(self, veins: Vasculature, step: int) -> None:
        """Make cells for a new epoch if one begins, and take out what new nodes cover."""
        if step >= self._epoch_end:
            self._begin_epoch(step)
            self._n_covering = 0
        # The nodes of earlier epochs come first and in order of birth, so that the
        # list of cells depends on nothing but the nodes: a resumed run rebuilds it.
        n_nodes = veins.nodes.n_rows
        nodes = veins.places("nodes")[self._n_covering : n_nodes]
        if veins.has_cuts:
            nodes = nodes[~veins.is_retired[self._n_covering : n_nodes]]
        kernels.darts.cover(self.cells, nodes, 0, len(nodes), self._radius)
        self._n_covering = n_nodes

    def _begin_epoch(self, step: int) -> None:
        """Lay cells over the blade, for all steps until it has grown by ``EPOCH_RATIO``."""
        start, end = epoch_of(self.growth, step)
        self._epoch_end = end
        last = max(start, end - 1)
        self._radius = self.node_distance / self.growth.scale(last)
        side = self._radius / kernels.darts.CELLS_PER_RADIUS
        self.cells = blade_cells(self.growth, start, last, side)


def epoch_of(growth: Growth, step: int) -> tuple[int, int]:
    """Give the first step of a step's epoch and the first of the next one.

    Epochs follow from the growth alone, never from the course of a run. Where places
    change in every step, each step is one.
    """
    if not isinstance(growth, Similarity):
        return step, step + 1
    start = 1
    for current in range(2, growth.last_step + 2):
        if growth.outline_scale(current) > EPOCH_RATIO * growth.outline_scale(start):
            if step < current:
                return start, current
            start = current
    return start, np.iinfo(np.int32).max


def blade_cells(growth: Growth, start: int, last: int, side: float) -> "DartCells":
    """Lay cells over everything that is blade in the steps ``start`` to ``last``.

    A blade that is not star-shaped about its attachment can leave, when only its
    outline is scaled, places it covered before: it is laid at several sizes.
    """
    last = min(last, max(growth.last_step, start))
    first_factor = growth.outline_scale(start) / growth.scale(start)
    last_factor = growth.outline_scale(last) / growth.scale(last)
    blade = growth.blade if isinstance(growth, Similarity) else growth.domain(start)
    box = np.array(blade.bounds)
    box = np.array([*np.minimum(box[:2], 0.0), *np.maximum(box[2:], 0.0)]) * last_factor
    low = box[:2] - side
    columns, rows = (np.ceil((box[2:] - low) / side).astype(int) + 1).tolist()
    reach = float(np.abs(box).max()) / last_factor
    n_sizes = 1
    if not blade.is_star_shaped:
        n_sizes += int(np.ceil(reach * (last_factor - first_factor) / (0.5 * side)))
    touched = np.zeros(columns * rows, dtype=np.uint8)
    for factor in np.linspace(last_factor, first_factor, n_sizes):
        touched |= kernels.polygon.raster(*blade.flat, factor, low[0], low[1], side, columns, rows)
    return kernels.darts.dart_cells(touched, (low[0], low[1]), side, columns)


class DartParameters(Parameters):
    """Sources by dart throwing (Runions 2008, section 4.2.3)."""

    kind: Literal["darts"] = "darts"
    density: float = quantity(
        "Darts per unit of blade area and step (rho in Table 4.1).", unit="1/D^2/step", gt=0.0
    )
    birth_distance_sources: float = quantity(
        "No source appears at most this far from another (b_s).", unit="D", gt=0.0
    )
    birth_distance_veins: float = quantity(
        "No source appears at most this far from a vein node (b_v); the kill distance"
        " counts instead where it is larger, since such a source would die at once.",
        unit="D",
        gt=0.0,
    )
    until: int | None = quantity(
        "Last step with darts; by default darts end with growth, and on a blade that"
        " does not grow when no dart finds room any more.",
        unit="steps",
        default=None,
        ge=1,
    )
    reading: Literal["each_step", "largest_blade"] = quantity(
        "Where darts fall: over the current blade in each step (4.2.4), or once over the"
        " largest blade, to appear when the contour reaches them (4.2.3).",
        default="each_step",
    )

    def placement(self, growth: Growth, kill_distance: float) -> Placement:
        """Give the placement for a growing blade."""
        node_distance = max(self.birth_distance_veins, kill_distance)
        if self.reading == "largest_blade":
            return LargestBladePlacement(
                growth,
                density=self.density,
                source_distance=self.birth_distance_sources,
                node_distance=node_distance,
            )
        return DartPlacement(
            growth,
            density=self.density,
            source_distance=self.birth_distance_sources,
            node_distance=node_distance,
            last_step=self.until,
        )
