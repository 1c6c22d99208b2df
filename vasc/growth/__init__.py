"""How a blade grows: maps between material coordinates and positions."""

from vasc.growth.base import (
    MARGIN_SPACING,
    Deformation,
    Growth,
    Similarity,
)
from vasc.growth.isogonic import IsogonicGrowth, IsogonicParameters
from vasc.growth.keyframed import KeyframedGrowth
from vasc.growth.keyframes import KeyframedParameters
from vasc.growth.linear import LinearGrowthParameters
from vasc.growth.local_to_global import LocalToGlobalGrowth, LocalToGlobalParameters
from vasc.growth.marginal import MarginalGrowth, MarginalParameters
from vasc.growth.none import NoGrowth, NoGrowthParameters
from vasc.parameters import Parameters

GROWTHS: dict[str, type[Parameters]] = {
    "none": NoGrowthParameters,
    "marginal": MarginalParameters,
    "isogonic": IsogonicParameters,
    "keyframed": KeyframedParameters,
    "local_to_global": LocalToGlobalParameters,
}
"""Parameters of our growths by kind; configs know installed ones, too."""

__all__ = [
    "GROWTHS",
    "MARGIN_SPACING",
    "Deformation",
    "Growth",
    "IsogonicGrowth",
    "IsogonicParameters",
    "KeyframedGrowth",
    "KeyframedParameters",
    "LinearGrowthParameters",
    "LocalToGlobalGrowth",
    "LocalToGlobalParameters",
    "MarginalGrowth",
    "MarginalParameters",
    "NoGrowth",
    "NoGrowthParameters",
    "Similarity",
]
