"""Network in, numbers out: widths, topology, areoles, densities."""

from vasc.analysis.areoles import Areoles, find_areoles
from vasc.analysis.branches import branch_orders
from vasc.analysis.statistics import statistics
from vasc.analysis.widths import WidthParameters, murray_radii, segment_radii

__all__ = [
    "Areoles",
    "WidthParameters",
    "branch_orders",
    "find_areoles",
    "murray_radii",
    "segment_radii",
    "statistics",
]
