"""How a blade grows: maps between material coordinates and positions."""

from importlib.metadata import entry_points

from vasc.growth.base import Growth, LinearGrowthParameters
from vasc.growth.isogonic import IsogonicGrowth, IsogonicParameters
from vasc.growth.marginal import MarginalGrowth, MarginalParameters
from vasc.growth.none import NoGrowth, NoGrowthParameters
from vasc.parameters import Parameters

GROWTHS: dict[str, type[Parameters]] = {
    **{point.name: point.load() for point in entry_points(group="vasc.growth")},
    "none": NoGrowthParameters,
    "marginal": MarginalParameters,
    "isogonic": IsogonicParameters,
}
"""Parameters of all growths by kind: installed ones, and ours, which none can replace."""

__all__ = [
    "GROWTHS",
    "Growth",
    "IsogonicGrowth",
    "IsogonicParameters",
    "LinearGrowthParameters",
    "MarginalGrowth",
    "MarginalParameters",
    "NoGrowth",
    "NoGrowthParameters",
]
