"""Compiled kernels: arrays in, arrays out; a module is compiled when first asked for."""

from importlib import import_module
from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    """Load a kernel module at its first use, so that importing vasc compiles nothing."""
    if name.startswith("_"):
        raise AttributeError(name)
    try:
        return import_module(f"{__name__}.{name}")
    except ModuleNotFoundError as error:
        raise AttributeError(f"vasc.kernels has no module {name!r}") from error
