"""Models of vascular development: each a choice of parts for one sentence."""

from vasc.models.areole import AreoleVenation
from vasc.models.base import Model
from vasc.models.closed import ClosedVenation
from vasc.models.leaf import LeafVenation, Venation
from vasc.models.open import OpenVenation
from vasc.models.stem import StemVasculature
from vasc.parameters import Parameters

MODELS: dict[str, type[Parameters]] = {
    "open": OpenVenation,
    "closed": ClosedVenation,
    "areole": AreoleVenation,
    "stem": StemVasculature,
}
"""Configs of our models by kind; ``vasc.config`` knows installed ones, too."""

__all__ = [
    "MODELS",
    "AreoleVenation",
    "ClosedVenation",
    "LeafVenation",
    "Model",
    "OpenVenation",
    "StemVasculature",
    "Venation",
]
