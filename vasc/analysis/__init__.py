"""Network in, numbers out: widths, topology, areoles, densities."""

from vasc.analysis.areoles import Areoles, find_areoles
from vasc.analysis.branches import gravelius_orders
from vasc.analysis.run_widths import run_widths
from vasc.analysis.sections import Sections, find_sections
from vasc.analysis.segment_orders import run_node_orders, segment_orders
from vasc.analysis.statistics import network_statistics, statistics
from vasc.analysis.vein_orders import vein_orders
from vasc.analysis.widths import WidthParameters, murray_radii, segment_radii

__all__ = [
    "Areoles",
    "Sections",
    "WidthParameters",
    "find_areoles",
    "find_sections",
    "gravelius_orders",
    "murray_radii",
    "network_statistics",
    "run_node_orders",
    "run_widths",
    "segment_orders",
    "segment_radii",
    "statistics",
    "vein_orders",
]
