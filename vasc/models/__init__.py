"""Models of vascular development: each a choice of parts for one sentence."""

from importlib.metadata import entry_points

from vasc.models.base import Model, Venation
from vasc.models.closed import ClosedVenation
from vasc.models.open import OpenVenation
from vasc.parameters import Parameters

MODELS: dict[str, type[Parameters]] = {
    **{point.name: point.load() for point in entry_points(group="vasc.models")},
    "open": OpenVenation,
    "closed": ClosedVenation,
}
"""Configs of all models by kind: installed ones, and ours, which none can replace."""

__all__ = ["MODELS", "ClosedVenation", "Model", "OpenVenation", "Venation"]
