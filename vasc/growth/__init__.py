"""How a blade grows: maps between material coordinates and positions."""

from vasc.growth.base import Deformation, Growth, LinearGrowthParameters, Similarity
from vasc.growth.isogonic import IsogonicGrowth, IsogonicParameters
from vasc.growth.marginal import MarginalGrowth, MarginalParameters
from vasc.growth.none import NoGrowth, NoGrowthParameters
from vasc.parameters import Parameters

GROWTHS: dict[str, type[Parameters]] = {
    "none": NoGrowthParameters,
    "marginal": MarginalParameters,
    "isogonic": IsogonicParameters,
}
"""Parameters of our growths by kind; configs know installed ones, too."""

__all__ = [
    "GROWTHS",
    "Deformation",
    "Growth",
    "IsogonicGrowth",
    "IsogonicParameters",
    "LinearGrowthParameters",
    "MarginalGrowth",
    "MarginalParameters",
    "NoGrowth",
    "NoGrowthParameters",
    "Similarity",
]
