"""The leaf of the experiments with many sources, and its one vein at first."""

from vasc.domain import Tissue
from vasc.domain.parameters import BladeParameters
from vasc.domain.shapes import ShapeName
from vasc.domain.voronoi import voronoi_in
from vasc.streams import Streams

SHAPE: ShapeName = "ovate"
LENGTH = 45.4
"""In D: about 911 cells."""


def leaf(seed: int) -> tuple[Tissue, int]:
    """Draw the Voronoi cells of a leaf; give them, and the cell at its base."""
    blade = BladeParameters(shape=SHAPE, length=LENGTH).blade()
    tissue = voronoi_in(blade, Streams(seed)["placement"])
    return tissue, int(tissue.nearest_cells(blade.seeds)[0])
