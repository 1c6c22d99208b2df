"""Units of what cells hold and pass, as the models on tissues count them."""

from collections.abc import Mapping
from typing import Any

PERMEABILITIES = {"facilitated": "β/γ", "polar": "T", "pool": "T"}
"""Unit of what a wall lets pass, by the kind of transport."""
CONCENTRATIONS = {"facilitated": "Kγ/β", "polar": "K/T", "pool": "K/T"}
"""Unit of auxin, K being what a source makes."""
OF_MODELS = {"up-the-gradient": "Au/µm²", "constant-production": "K D²/D_c"}
"""Unit of auxin in models without sources; K is then what an area makes."""
TIMES = {"canalization": "turnover times of a wall", "up-the-gradient": "s"}
"""Unit of time; other models count steps."""


def unit_of(config: Mapping[str, Any], color: str) -> str:
    """Give the unit of what cells are shaded by; empty where it has none of its own.

    Parameters
    ----------
    config : mapping
        The config of a run on a tissue.
    color : {"concentration", "flux", "carriers", "role"}
        What the shade of a cell tells.

    Returns
    -------
    str
    """
    model = config.get("kind")
    if model in OF_MODELS:
        return OF_MODELS[model] if color == "concentration" else ""
    kind = (config.get("transport") or {}).get("kind", "")
    if color == "concentration":
        return CONCENTRATIONS.get(kind, "")
    if color == "carriers":
        return PERMEABILITIES.get(kind, "")
    return "K" if color == "flux" and kind in CONCENTRATIONS else ""


def time_unit(config: Mapping[str, Any]) -> str:
    """Give the unit of the time of a run on a tissue."""
    return TIMES.get(config.get("kind", ""), "steps")
