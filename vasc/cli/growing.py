"""From a recorded run to a picture of its growth, which its config tells."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from vasc.growth import Growth
    from vasc.timeline import Timeline

N_PANELS = 5


def growth_figure(path: Path, steps: Sequence[int]) -> "Figure":
    """Draw how the leaf of a run grows.

    Parameters
    ----------
    path : Path
        The recorded run; its config tells the growth, which no model need run for.
    steps : sequence of int
        Recorded steps, -1 for the last; five over the time of growth if empty.

    Returns
    -------
    Figure

    Raises
    ------
    ConfigError
        If this version cannot read the run's config, or its model has no growing blade.
    TimelineError
        If the file is no timeline.
    VascError
        If a step was not recorded.
    """
    from vasc.config import experiment_from_record
    from vasc.errors import ConfigError
    from vasc.models.leaf import LeafVenation
    from vasc.timeline import Timeline

    with (
        Timeline(path) as timeline,
        experiment_from_record(timeline.config, name=str(path)) as experiment,
    ):
        # refuses a run without a step
        timeline.frame()
        if not isinstance(experiment.parameters, LeafVenation):
            raise ConfigError(f"{path}: kind = {experiment.kind!r}: has no blade that grows")
        growth = experiment.parameters.grown(experiment.folder)
        return _drawn(growth, _chosen(timeline, growth, steps), timeline)


def _chosen(timeline: "Timeline", growth: "Growth", steps: Sequence[int]) -> list[int]:
    """Give the steps to draw, ascending, each once."""
    if steps:
        return sorted({timeline.frame(step).step for step in steps})
    last = min(timeline.last_step, growth.last_step)
    return sorted({last * number // (N_PANELS - 1) for number in range(N_PANELS)})


def _drawn(growth: "Growth", steps: list[int], timeline: "Timeline") -> "Figure":
    """Measure growth between the steps, and draw it."""
    from vasc.growth.tensor import material_grid, positions_of, strain
    from vasc.render import GrownGrid, GrowthMap, draw_growth

    material = material_grid(growth, steps[0], steps[-1])
    grids = [
        GrownGrid(step, growth.domain(step), positions_of(growth, material, step)) for step in steps
    ]
    maps: list[GrowthMap] = []
    for before, after in pairwise(grids):
        found = strain(growth, material, before.step, after.step - before.step)
        maps.append(GrowthMap(before.step, after, *found))
    return draw_growth(grids, maps, units=timeline.units)
