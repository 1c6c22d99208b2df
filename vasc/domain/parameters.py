"""The [domain] table: which blade a run begins with."""

from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import model_validator

from vasc.arrays import Points
from vasc.domain.blade import Blade
from vasc.errors import OutlineError
from vasc.parameters import Parameters, quantity

ShapeName = Literal[
    "elliptic", "ovate", "obovate", "orbicular", "linear", "cordate", "deltoid", "lobed",
    "fan", "reniform", "bilobed",
]  # fmt: skip


class TeethParameters(Parameters):
    """A toothed margin: triangular waves, summed (Runions 2008, section 4.2.2)."""

    amplitudes: list[float] = quantity("Height of each wave.", unit="blade length", min_length=1)
    frequencies: list[int] = quantity("Teeth around the margin, one number a wave.", min_length=1)

    @model_validator(mode="after")
    def _check(self) -> "TeethParameters":
        """Require one frequency for each amplitude."""
        if len(self.amplitudes) != len(self.frequencies):
            raise ValueError(
                f"{len(self.amplitudes)} amplitudes and {len(self.frequencies)} frequencies;"
                " give as many of both"
            )
        return self


class SeedRowParameters(Parameters):
    """A row of seed nodes along the base, as in a grass leaf."""

    count: int = quantity("Number of seeds.", ge=2)
    height: float = quantity("Height of the row.", unit="blade length", default=0.004, ge=0.0)


class BladeParameters(Parameters):
    """An outline by name, by points or from a file, at its initial length."""

    shape: ShapeName | None = quantity("A named shape.", default=None)
    points: list[tuple[float, float]] | None = quantity(
        "Corners of the outline; attachment at [0, 0], tip toward positive y.", default=None
    )
    file: str | None = quantity(
        "A file with the outline: CSV, GeoJSON, WKT, SVG, or a PNG, TIFF or JPEG mask.",
        default=None,
    )
    length: float = quantity("Initial blade length (L_i in Table 4.1).", unit="D", gt=0.0)
    width: float | None = quantity(
        "Width over length of a named shape; each has its own default.", default=None, gt=0.0
    )
    options: dict[str, float] = quantity("Further options of a named shape.", default={})
    teeth: TeethParameters | None = quantity("A toothed margin.", default=None)
    seeds: list[tuple[float, float]] | SeedRowParameters | None = quantity(
        "Seed nodes: a list of points, or a row along the base; by default the attachment.",
        unit="blade length",
        default=None,
    )

    @model_validator(mode="after")
    def _check(self) -> "BladeParameters":
        """Require exactly one outline."""
        given = [k for k in ("shape", "points", "file") if getattr(self, k) is not None]
        if len(given) != 1:
            said = " and ".join(f"'{key}'" for key in given) or "no outline"
            raise ValueError(f"{said} given; give exactly one of 'shape', 'points', 'file'")
        return self

    def blade(self, folder: Path = Path()) -> Blade:
        """Give the blade; a file is looked for in ``folder``.

        Raises
        ------
        OutlineError
            If the outline cannot be used.
        """
        rings = self._unit_rings(folder)
        if isinstance(self.seeds, SeedRowParameters):
            seeds = seed_row(rings, self.seeds.count, self.seeds.height)
        else:
            seeds = np.array(self.seeds or [(0.0, 0.0)], dtype=np.float64)
        return Blade.from_rings(
            [ring * self.length for ring in rings], seeds * self.length
        )

    def _unit_rings(self, folder: Path) -> list[Points]:
        """Give the outline with a blade length of 1."""
        from vasc.domain.shapes import SHAPES

        if self.shape is None:
            raise OutlineError("domain: only named shapes are read so far")
        options = dict(self.options)
        if self.width is not None:
            options["width"] = self.width
        return [SHAPES[self.shape](**{"width": 0.7, **options})]


def seed_row(rings: list[Points], count: int, height: float) -> Points:
    """Spread seeds evenly over the width of the blade near its base."""
    ring = rings[0]
    following = np.roll(ring, -1, axis=0)
    crosses = (ring[:, 1] <= height) != (following[:, 1] <= height)
    a, b = ring[crosses], following[crosses]
    x = a[:, 0] + (height - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    low, high = float(x.min()), float(x.max())
    at = low + (np.arange(count) + 0.5) / count * (high - low)
    return np.stack([at, np.full(count, height)], axis=1)
