"""Models of vascular development: each a choice of parts for a sentence."""

from vasc.models.areole import AreoleVenation
from vasc.models.base import Model
from vasc.models.canalization import CanalizationParameters
from vasc.models.closed import ClosedVenation
from vasc.models.constant_production import ConstantProductionParameters
from vasc.models.gottlieb import GottliebParameters
from vasc.models.leaf import LeafVenation, Venation
from vasc.models.open import OpenVenation
from vasc.models.stem import StemVasculature
from vasc.models.up_the_gradient import UpTheGradientParameters
from vasc.parameters import Parameters

MODELS: dict[str, type[Parameters]] = {
    "open": OpenVenation,
    "closed": ClosedVenation,
    "areole": AreoleVenation,
    "stem": StemVasculature,
    "canalization": CanalizationParameters,
    "up-the-gradient": UpTheGradientParameters,
    "constant-production": ConstantProductionParameters,
    "gottlieb": GottliebParameters,
}
"""Configs of our models by kind; ``vasc.config`` knows installed ones, too."""

__all__ = [
    "MODELS",
    "AreoleVenation",
    "CanalizationParameters",
    "ClosedVenation",
    "ConstantProductionParameters",
    "GottliebParameters",
    "LeafVenation",
    "Model",
    "OpenVenation",
    "StemVasculature",
    "UpTheGradientParameters",
    "Venation",
]
