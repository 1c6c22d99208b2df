"""vasc: a simulation framework for vascular development in plants.

The names of this module are the public interface; each is loaded at its first use.

Examples
--------
>>> import vasc
>>> leaf = vasc.load("poplar-leaf")
>>> leaf.parameters.kind
'closed'
"""

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

_HOMES = {
    "AreoleVenation": "vasc.models",
    "Blade": "vasc.domain",
    "ClosedVenation": "vasc.models",
    "OpenVenation": "vasc.models",
    "StemVasculature": "vasc.models",
    "Streams": "vasc.streams",
    "Timeline": "vasc.timeline",
    "VascError": "vasc.errors",
    "animate": "vasc.render",
    "check_connectivity": "vasc.validation.stem_phyllotaxis",
    "check_sequence": "vasc.validation.arabidopsis",
    "draw_leaf": "vasc.render",
    "load": "vasc.config",
    "murray_radii": "vasc.analysis.widths",
    "network_statistics": "vasc.analysis",
    "read_network": "vasc.networks_in",
    "resume": "vasc.experiment",
    "run": "vasc.experiment",
    "simulate": "vasc.simulation",
    "statistics": "vasc.analysis",
    "validate": "vasc.timeline",
    "verify": "vasc.experiment",
}

__all__ = [
    "AreoleVenation",
    "Blade",
    "ClosedVenation",
    "OpenVenation",
    "StemVasculature",
    "Streams",
    "Timeline",
    "VascError",
    "animate",
    "check_connectivity",
    "check_sequence",
    "draw_leaf",
    "load",
    "murray_radii",
    "network_statistics",
    "read_network",
    "resume",
    "run",
    "simulate",
    "statistics",
    "validate",
    "verify",
]


def __getattr__(name: str) -> Any:
    """Load a public name from its module."""
    if name not in _HOMES:
        raise AttributeError(f"module 'vasc' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
