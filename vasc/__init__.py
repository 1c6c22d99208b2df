"""vasc: a simulation framework for vascular development in plants."""

__version__ = "0.1.0"
