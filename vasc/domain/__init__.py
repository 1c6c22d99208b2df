"""What grows: the leaf blade, its outline and where outlines come from; the stem."""

from vasc.domain.blade import Blade
from vasc.domain.parameters import BladeParameters
from vasc.domain.readers import read_outline
from vasc.domain.seeds import SeedRowParameters
from vasc.domain.shapes import SHAPES
from vasc.domain.stem import StemParameters
from vasc.domain.teeth import TeethParameters
from vasc.domain.tissue import Tissue

__all__ = [
    "SHAPES",
    "Blade",
    "BladeParameters",
    "SeedRowParameters",
    "StemParameters",
    "TeethParameters",
    "Tissue",
    "read_outline",
]
