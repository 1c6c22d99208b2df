"""How large a run of any kind will become: a leaf, a stem, a tissue, or a medium that doubles.

Stems were measured on the bundled ones, and on one of 97,000 nodes (270 bytes of memory each);
tissues in boxes of 3,600 to 90,000 cells (1,700 bytes a cell, 2,900 if they are Voronoi cells).
"""

from math import ceil, pi, sqrt
from typing import Any

from vasc.config.expected import (
    BYTES_OF_NODE,
    BYTES_OF_PROGRAM,
    BYTES_OF_SOURCE,
    FILE_BYTES_OF_FRAME,
    FILE_BYTES_OF_NODE,
    FILE_BYTES_OF_RUN,
    FILE_BYTES_OF_SOURCE,
    SOURCES_PER_SPACING,
    VEINS_PER_SPACING,
    ExpectedSize,
    expected_size,
)
from vasc.domain import Tissue
from vasc.growth import Growth
from vasc.models.gottlieb import GottliebParameters
from vasc.models.leaf import LeafVenation
from vasc.models.stem import StemVasculature
from vasc.timeline.tissues import LEAST_STEPS, n_bytes_a_step

STRANDS_PER_PRIMORDIUM = 2.5
"""Length of strands for each primordium, over the root of its share of the surface: in the
stems of the thesis it is 0.3 to 1.9, in the largest one measured 2.0."""

BYTES_OF_CELL = 5_000
"""Memory that a cell takes with its walls, while concentrations are solved for."""


def foreseen(parameters: Any, model: Any) -> ExpectedSize:
    """Give the size that a run may reach.

    Parameters
    ----------
    parameters : Parameters
        The checked config of any kind.
    model : Model
        The model that it gives.

    Returns
    -------
    ExpectedSize
        On the high side; of a tissue, the file after 100 steps, or as many as there may be. Of
        an installed model with a sentence of its own, what every run takes.
    """
    tissue = getattr(model, "tissue", None)
    if tissue is not None:
        return tissue_size(tissue, parameters.stop.steps)
    if isinstance(parameters, LeafVenation):
        return expected_size(parameters, model.growth)
    if isinstance(parameters, StemVasculature):
        return stem_size(parameters)
    if isinstance(parameters, GottliebParameters):
        return doubling_size(parameters, model.growth)
    return ExpectedSize(sources=0, nodes=0, memory=BYTES_OF_PROGRAM, file=FILE_BYTES_OF_RUN)


def stem_size(parameters: Any) -> ExpectedSize:
    """Give the size that a stem may reach, from its primordia and the surface around each."""
    placement, segment = parameters.placement, parameters.extension.segment_length
    radius = max([parameters.domain.radius or 0.0, *(r for _, r in parameters.domain.radii)])
    share = 2.0 * pi * radius * placement.rise / placement.per_level
    length = STRANDS_PER_PRIMORDIUM * sqrt(share) * placement.primordia
    # the last veins go round the stem at most
    levels = ceil(placement.primordia / placement.per_level)
    plastochron = placement.plastochron or ceil(0.5 * placement.rise / segment)
    steps = placement.first_step + levels * plastochron + ceil(2.0 * pi * radius / segment)
    nodes = (2.0 * pi * radius + length) / segment + placement.primordia
    file = FILE_BYTES_OF_NODE * nodes + FILE_BYTES_OF_SOURCE * placement.primordia
    file += FILE_BYTES_OF_FRAME * min(steps, parameters.stop.steps or steps)
    return ExpectedSize(
        sources=placement.primordia,
        nodes=round(nodes),
        memory=round(BYTES_OF_PROGRAM + BYTES_OF_NODE * nodes),
        file=round(FILE_BYTES_OF_RUN + file),
    )


def doubling_size(parameters: GottliebParameters, growth: Growth) -> ExpectedSize:
    """Give the size that straight veins may reach, from the spaces in the last blade."""
    area = growth.domain(growth.last_step).area
    sources = SOURCES_PER_SPACING * area / parameters.space**2 + 1.0
    # the first veins cross a blade, however large its spaces are
    length = VEINS_PER_SPACING * area / parameters.space + 3.0 * sqrt(area)
    # what is longer than the longest segment is halved
    nodes = 2.0 * length / parameters.longest + sources
    return ExpectedSize(
        sources=round(sources),
        nodes=round(nodes),
        memory=round(BYTES_OF_PROGRAM + BYTES_OF_NODE * nodes + BYTES_OF_SOURCE * sources),
        file=round(FILE_BYTES_OF_RUN + FILE_BYTES_OF_NODE * nodes + FILE_BYTES_OF_SOURCE * sources),
    )


def tissue_size(tissue: Tissue, steps: int | None = None) -> ExpectedSize:
    """Give the size that a run on a tissue may reach; of its steps, no more than are sure."""
    n_steps = min(steps or LEAST_STEPS, LEAST_STEPS)
    per_step = n_bytes_a_step(tissue.n_cells, tissue.n_walls)
    return ExpectedSize(
        sources=0,
        nodes=0,
        memory=BYTES_OF_PROGRAM + BYTES_OF_CELL * tissue.n_cells,
        file=FILE_BYTES_OF_RUN + per_step * (n_steps + 1),
        cells=tissue.n_cells,
    )
