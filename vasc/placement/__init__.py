"""Where auxin sources appear."""

from vasc.placement.base import Moment, Placement
from vasc.placement.darts import DartParameters, DartPlacement
from vasc.placement.empty_circles import EmptyCircleParameters, EmptyCirclePlacement
from vasc.placement.given import GivenParameters, GivenPlacement
from vasc.placement.largest_blade import LargestBladePlacement
from vasc.placement.primordia import Phyllotaxis, PhyllotaxisParameters

__all__ = [
    "DartParameters",
    "DartPlacement",
    "EmptyCircleParameters",
    "EmptyCirclePlacement",
    "GivenParameters",
    "GivenPlacement",
    "LargestBladePlacement",
    "Moment",
    "Phyllotaxis",
    "PhyllotaxisParameters",
    "Placement",
]
