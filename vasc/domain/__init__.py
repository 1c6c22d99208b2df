"""What grows: blades, and where their outlines come from."""

from vasc.domain.blade import Blade
from vasc.domain.parameters import BladeParameters

__all__ = ["Blade", "BladeParameters"]
