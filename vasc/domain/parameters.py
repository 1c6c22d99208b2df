"""The [domain] table: which blade a run begins with."""

from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from vasc.arrays import Points
from vasc.domain.blade import Blade
from vasc.domain.checks import check_crossings, check_rings, check_seeds, place
from vasc.domain.normalization import Pair, normalized, rounded, smoothed
from vasc.domain.readers import read_outline, rings_in_file
from vasc.domain.rings import parts
from vasc.domain.seeds import SeedRowParameters, lowest_of_parts
from vasc.domain.shapes import SHAPES, Shape, ShapeName
from vasc.domain.teeth import TeethParameters
from vasc.errors import OutlineError
from vasc.limits import OUTLINE_POINTS
from vasc.parameters import Parameters, quantity

ONLY_FOR = {
    "parameters": ("shape",),
    "attachment": ("points", "file"),
    "tip": ("points", "file"),
    "smooth": ("points", "file"),
}
"""Keys that mean something for some kinds of outline only."""


SeedPoints = Annotated[list[Pair], Field(min_length=1)]


class BladeParameters(Parameters):
    """An outline by name, by points or from a file, at its initial length."""

    shape: ShapeName | None = quantity("A named shape.", default=None)
    points: list[Pair] | None = quantity(
        "Corners of the outline, in any unit, y upward.",
        default=None,
        max_length=OUTLINE_POINTS,
    )
    file: str | None = quantity(
        "A file with the outline: CSV, GeoJSON, WKT, SVG, or a PNG, TIFF or JPEG mask or scan.",
        default=None,
    )
    length: float = quantity("Initial blade length (L_i in Table 4.1).", unit="D", gt=0.0)
    width: float | None = quantity(
        "Width over length, to which the outline is stretched; its own if none is given.",
        default=None,
        gt=0.0,
    )
    parameters: Shape | None = quantity("Parameters of the named shape.", default=None)
    attachment: Literal["origin", "lowest"] | Pair | None = quantity(
        "Where the petiole is attached, in the coordinates of the points or the file; "
        "by default the origin for points and the lowest point for files.",
        default=None,
    )
    tip: Literal["highest", "farthest"] | Pair = quantity(
        "The tip, in the same coordinates; the outline is turned to hold it upright, "
        "but for the highest point.",
        default="highest",
    )
    smooth: bool = quantity(
        "Draw a smooth curve through the corners of points or a file.", default=False
    )
    curve_points: int = quantity(
        "Points of a named or smoothed outline.", default=320, ge=16, le=20_000
    )
    teeth: TeethParameters | None = quantity("A toothed margin.", default=None)
    seeds: SeedPoints | SeedRowParameters | Literal["lowest"] | None = quantity(
        "Seed nodes: a list of points, a row along the base, or the lowest point of each part; "
        "by default the attachment.",
        unit="blade length",
        default=None,
    )

    @model_validator(mode="before")
    @classmethod
    def _name_parameters(cls, table: Any) -> Any:
        """Let the table of parameters say which shape it is for."""
        if not isinstance(table, dict):
            return table
        if "shape" not in table and "parameters" in table:
            # before the parameters are looked at: they would miss the shape they are for
            given = [key for key in ("points", "file") if key in table] or ["no outline"]
            raise ValueError(f"'parameters' is for shape, not for {' and '.join(given)}")
        if not isinstance(table.get("shape"), str):
            return table
        if table["shape"] not in SHAPES:
            return table
        parameters = table.get("parameters")
        if parameters is None or isinstance(parameters, dict):
            named = {"shape": table["shape"], **(parameters or {})}
            return {**table, "parameters": named}
        return table

    @model_validator(mode="after")
    def _check(self) -> "BladeParameters":
        """Require exactly one outline, and no key that it has no use for."""
        given = [k for k in ("shape", "points", "file") if getattr(self, k) is not None]
        if len(given) != 1:
            said = " and ".join(f"'{key}'" for key in given) or "no outline"
            raise ValueError(f"{said} given; give exactly one of 'shape', 'points', 'file'")
        for key, outlines in ONLY_FOR.items():
            default = type(self).model_fields[key].default
            if getattr(self, key) != default and given[0] not in outlines:
                raise ValueError(f"'{key}' is for {' and '.join(outlines)}, not for {given[0]}")
        if self.parameters is not None and self.parameters.shape != self.shape:
            raise ValueError(
                f"parameters.shape = '{self.parameters.shape}': must be '{self.shape}'"
            )
        return self

    def blade(self, folder: Path = Path()) -> Blade:
        """Give the blade; a file is looked for in ``folder``.

        Raises
        ------
        OutlineError
            If the outline cannot be used; the message names key and place.
        """
        try:
            rings = [rounded(ring) for ring in self._unit_rings(folder)]
            seeds = rounded(self._unit_seeds(rings))
            # in unit coordinates, of which the table speaks
            check_seeds(tuple(rings), seeds)
            return Blade.from_rings([ring * self.length for ring in rings], seeds * self.length)
        except OutlineError as error:
            raise OutlineError(self._located(str(error))) from error

    def _unit_rings(self, folder: Path) -> list[Points]:
        """Give the outline with the attachment at the origin and height 1."""
        if self.shape is not None:
            parameters = self.parameters or SHAPES[self.shape]()
            rings = [parameters.outline(self.curve_points)]
        else:
            rings = self._given_rings(folder)
        if self.teeth is not None:
            rings = [self.teeth.applied(rings[0]), *rings[1:]]
        if self.width is not None:
            extent = float(np.ptp(np.concatenate(rings)[:, 0]))
            rings = [ring * np.array([self.width / extent, 1.0]) for ring in rings]
        check_crossings(check_rings(rings))
        return rings

    def _given_rings(self, folder: Path) -> list[Points]:
        """Give the outline of points or a file, normalized."""
        if self.points is not None:
            rings, attachment = check_rings([self.points]), self.attachment or "origin"
            check_crossings(rings)
            unit = normalized(rings, attachment=attachment, tip=self.tip)
        else:
            path = folder / str(self.file)
            unit = read_outline(path, attachment=self.attachment or "lowest", tip=self.tip)
            if self.seeds is None and len(parts(tuple(unit))) > 1:
                raise OutlineError(_too_many(path))
        if not self.smooth:
            return unit
        share = self.curve_points // len(unit)
        curves = [smoothed(ring, share) for ring in unit]
        height = max(float(ring[:, 1].max()) for ring in curves)
        return [ring / height for ring in curves]

    def _unit_seeds(self, rings: list[Points]) -> Points:
        """Give the seeds of a unit outline."""
        if isinstance(self.seeds, SeedRowParameters):
            return self.seeds.seeds(rings)
        if self.seeds == "lowest":
            return lowest_of_parts(rings)
        return np.array(self.seeds or [(0.0, 0.0)], dtype=np.float64)

    def _located(self, message: str) -> str:
        """Begin a message with the key that it is about."""
        if not message.startswith("outline"):
            return f"domain.{message}"
        key = "shape" if self.shape is not None else "file"
        value = "points" if self.points is not None else f'{key} = "{getattr(self, key)}"'
        return f"domain.{value}{message.removeprefix('outline')}"


def _too_many(path: Path) -> str:
    """Say which outlines a file has, in its own coordinates, where one is asked for."""
    rings, _ = rings_in_file(path)
    found = [rings[k] for k in parts(rings)]
    places = [f"{place(ring.min(axis=0))} to {place(ring.max(axis=0))}" for ring in found[:3]]
    more = ", ..." if len(found) > len(places) else ""
    return (
        f"outline: the file has {len(found)} outlines, from {', from '.join(places)}{more};"
        " draw one path, or join them; a blade of several parts needs"
        " seeds = 'lowest', or one in each"
    )
