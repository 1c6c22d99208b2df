"""Named leaf shapes in the terms of leaf morphology (Runions 2008, Figure 4.1).

Each is a class of a few parameters that draws a unit outline: attachment at the
origin, height 1, as wide as such leaves usually are.
"""

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from vasc.arrays import Points
from vasc.domain.curves import ROUND, base_curve, cubic, line, tip_curve
from vasc.domain.palmate import Fan, Lobed, Reniform
from vasc.domain.shape_base import ShapeParameters, base_form, tip_form
from vasc.parameters import quantity


class Elliptic(ShapeParameters):
    """An ellipse, widest in the middle."""

    half_width: ClassVar[float] = 0.3
    shape: Literal["elliptic"] = "elliptic"

    def half(self) -> list[Points]:
        """Give half an ellipse."""
        angles = np.linspace(0.0, np.pi, 513)
        arc = np.stack([self.half_width * np.sin(angles), 0.5 - 0.5 * np.cos(angles)], axis=1)
        return [arc]


class Orbicular(Elliptic):
    """A circle with the attachment on its margin."""

    half_width: ClassVar[float] = 0.5
    shape: Literal["orbicular"] = "orbicular"  # type: ignore[assignment]


class Ovate(ShapeParameters):
    """An egg, widest below the middle."""

    half_width: ClassVar[float] = 0.32
    shape: Literal["ovate"] = "ovate"
    widest: float = quantity(
        "Height of the widest place.", unit="blade length", default=0.36, ge=0.05, le=0.95
    )
    base: float = base_form(0.8)
    tip: float = tip_form(0.1)

    def half(self) -> list[Points]:
        """Give the margin below and above the widest place."""
        return [
            base_curve(self.half_width, self.widest, self.base),
            tip_curve(self.half_width, self.widest, self.tip),
        ]


class Obovate(Ovate):
    """An egg, widest above the middle."""

    half_width: ClassVar[float] = 0.3
    shape: Literal["obovate"] = "obovate"  # type: ignore[assignment]
    widest: float = quantity(
        "Height of the widest place.", unit="blade length", default=0.66, ge=0.05, le=0.95
    )
    base: float = base_form(0.0)
    tip: float = tip_form(0.8)


class Cordate(ShapeParameters):
    """A heart: basal lobes beside the attachment."""

    half_width: ClassVar[float] = 0.42
    shape: Literal["cordate"] = "cordate"
    widest: float = quantity(
        "Height of the widest place.", unit="blade length", default=0.24, ge=0.02, le=0.9
    )
    sinus: float = quantity(
        "Depth of the basal lobes below the attachment.",
        unit="blade length",
        default=0.13,
        ge=0.0,
        le=0.5,
    )
    tip: float = tip_form(-0.25)

    def half(self) -> list[Points]:
        """Give the inner and outer margin of the lobe, and that of the blade above."""
        w, h, d = self.half_width, self.widest, self.sinus
        lowest = (0.42 * w, -d)
        return [
            cubic((0.0, 0.0), (0.06 * w, -0.6 * d), (0.22 * w, -d), lowest),
            cubic(lowest, (0.74 * w, -d), (w, h - ROUND * (h + d)), (w, h)),
            tip_curve(w, h, self.tip),
        ]


class Deltoid(Cordate):
    """A triangle with rounded corners and a drawn-out tip, as in poplars."""

    half_width: ClassVar[float] = 0.44
    shape: Literal["deltoid"] = "deltoid"  # type: ignore[assignment]
    widest: float = quantity(
        "Height of the widest place.", unit="blade length", default=0.18, ge=0.02, le=0.9
    )
    sinus: float = quantity(
        "Depth of the basal lobes below the attachment.",
        unit="blade length",
        default=0.03,
        ge=0.0,
        le=0.5,
    )
    tip: float = tip_form(-0.6)


class Linear(ShapeParameters):
    """A strap: a broad base, parallel margins and a pointed tip, as in grasses."""

    half_width: ClassVar[float] = 0.06
    shape: Literal["linear"] = "linear"
    base_width: float = quantity(
        "Width of the straight base over that of the blade.", default=0.8, gt=0.0, le=1.0
    )
    taper: float = quantity(
        "Length of the tapering tip; 0 ends the blade with a straight cut.",
        unit="blade length",
        default=0.45,
        ge=0.0,
        le=0.7,
    )

    def half(self) -> list[Points]:
        """Give base, margin and tip."""
        w, top = self.half_width, 1.0 - self.taper
        corner = (self.base_width * w, 0.0)
        shoulder = (w, 0.25)
        pieces = [line((0.0, 0.0), corner)]
        if self.base_width < 1.0:
            pieces.append(cubic(corner, (corner[0], 0.1), (w, 0.15), shoulder))
            pieces.append(line(shoulder, (w, top)))
        else:
            pieces.append(line(corner, (w, top)))
        if self.taper > 0.0:
            pieces.append(cubic((w, top), (w, 1 - 0.6 * self.taper), (0.45 * w, 0.97), (0.0, 1.0)))
        else:
            pieces.append(line((w, 1.0), (0.0, 1.0)))
        return pieces


class Bilobed(ShapeParameters):
    """Two round lobes parted by a notch at the tip, as in the orchid tree (Bauhinia).

    The blade length is the height of the lobes.
    """

    half_width: ClassVar[float] = 0.52
    shape: Literal["bilobed"] = "bilobed"
    notch: float = quantity(
        "Depth of the notch between the lobes.", unit="blade length", default=0.3, ge=0.0, le=0.8
    )
    sinus: float = quantity(
        "Depth of the basal lobes below the attachment.",
        unit="blade length",
        default=0.1,
        ge=0.0,
        le=0.5,
    )

    def half(self) -> list[Points]:
        """Give basal lobe, flank, and the outer and inner margin of the upper lobe."""
        w, d, n = self.half_width, self.sinus, self.notch
        lowest, widest, highest = (0.45 * w, -d), (w, 0.42), (0.55 * w, 1.0)
        return [
            cubic((0.0, 0.0), (0.08 * w, -0.6 * d), (0.24 * w, -d), lowest),
            cubic(lowest, (0.8 * w, -d), (w, 0.42 - ROUND * (0.42 + d)), widest),
            cubic(widest, (w, 0.8), (0.82 * w, 1.0), highest),
            cubic(highest, (0.3 * w, 1.0), (0.1 * w, 1.0 - 0.35 * n), (0.0, 1.0 - n)),
        ]


class Dome(ShapeParameters):
    """A young blade: straight base and sides under a domed tip (Runions 2008, chapter 5)."""

    half_width: ClassVar[float] = 0.25
    shape: Literal["dome"] = "dome"
    dome: float = quantity(
        "Height of the domed tip.", unit="blade length", default=0.3, gt=0.0, le=1.0
    )

    def half(self) -> list[Points]:
        """Give base, side and a quarter of an ellipse."""
        w, top = self.half_width, 1.0 - self.dome
        angles = np.linspace(0.0, 0.5 * np.pi, 257)
        arc = np.stack([w * np.cos(angles), top + self.dome * np.sin(angles)], axis=1)
        # with a point in the middle, so that more are spread over it
        side = [np.array([(w, 0.0), (w, 0.5 * top), (w, top)])] if top > 0.0 else []
        return [line((0.0, 0.0), (w, 0.0)), *side, arc]


SHAPES: dict[str, type[ShapeParameters]] = {
    "elliptic": Elliptic,
    "orbicular": Orbicular,
    "ovate": Ovate,
    "obovate": Obovate,
    "cordate": Cordate,
    "deltoid": Deltoid,
    "linear": Linear,
    "lobed": Lobed,
    "reniform": Reniform,
    "fan": Fan,
    "bilobed": Bilobed,
    "dome": Dome,
}
"""The shapes by name."""

Shape = Annotated[
    Elliptic
    | Orbicular
    | Ovate
    | Obovate
    | Cordate
    | Deltoid
    | Linear
    | Lobed
    | Reniform
    | Fan
    | Bilobed
    | Dome,
    Field(discriminator="shape"),
]
ShapeName = Literal[
    "elliptic",
    "orbicular",
    "ovate",
    "obovate",
    "cordate",
    "deltoid",
    "linear",
    "lobed",
    "reniform",
    "fan",
    "bilobed",
    "dome",
]
