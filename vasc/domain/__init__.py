"""What grows: the leaf blade, its outline and where outlines come from."""

from vasc.domain.blade import Blade
from vasc.domain.parameters import BladeParameters
from vasc.domain.readers import read_outline
from vasc.domain.seeds import SeedRowParameters
from vasc.domain.shapes import SHAPES
from vasc.domain.teeth import TeethParameters

__all__ = [
    "SHAPES",
    "Blade",
    "BladeParameters",
    "SeedRowParameters",
    "TeethParameters",
    "read_outline",
]
