"""How a blade grows: maps between material coordinates and positions."""

from vasc.growth.base import Growth
from vasc.growth.isogonic import IsogonicGrowth, IsogonicParameters
from vasc.growth.marginal import MarginalGrowth, MarginalParameters
from vasc.growth.none import NoGrowth, NoGrowthParameters

__all__ = [
    "Growth",
    "IsogonicGrowth",
    "IsogonicParameters",
    "MarginalGrowth",
    "MarginalParameters",
    "NoGrowth",
    "NoGrowthParameters",
]
