"""Named shapes that spread from the attachment: lobed like a hand, kidney-shaped, fan-shaped."""

from typing import Any, Literal

import numpy as np

from vasc.arrays import Points
from vasc.domain.curves import Pair, between, cubic, line
from vasc.domain.shape_base import ShapeParameters, tip_form
from vasc.parameters import quantity


def _lobes(default: int) -> Any:
    """Declare the number of lobes."""
    return quantity("Number of lobes.", default=default, ge=2, le=31)


def _spread(default: float) -> Any:
    """Declare how far lobes spread."""
    return quantity(
        "Angle between the axes of the outermost lobes.",
        unit="degrees",
        default=default,
        ge=20.0,
        le=340.0,
    )


def _depth(default: float) -> Any:
    """Declare the depth of sinuses."""
    return quantity(
        "Depth of the sinuses between lobes over the length of the lobes.",
        default=default,
        ge=0.0,
        le=0.9,
    )


def _outer(default: float) -> Any:
    """Declare the length of the outermost lobes."""
    return quantity(
        "Length of the outermost lobes over that of the longest.", default=default, ge=0.1, le=1.0
    )


def _bulge(default: float) -> Any:
    """Declare the flanks of lobes."""
    return quantity(
        "How far the flanks of a lobe swell: 0 straight, 1 strongly.",
        default=default,
        ge=0.0,
        le=1.0,
    )


class Lobed(ShapeParameters):
    """A digitate blade: lobes that radiate from the attachment, as in sweetgum or maple."""

    shape: Literal["lobed"] = "lobed"
    lobes: int = _lobes(5)
    spread: float = _spread(228.0)
    depth: float = _depth(0.56)
    outer: float = _outer(0.68)
    bulge: float = _bulge(0.3)
    tip: float = tip_form(-0.1)

    def half(self) -> list[Points]:
        """Give the flanks of the lobes on the right, from the outermost to the axis."""
        step = self.spread / (self.lobes - 1)
        n_right = (self.lobes + 1) // 2
        # angles from the axis, outermost lobe first
        tips = [0.5 * self.spread - k * step for k in range(n_right)]
        lengths = [1.0 - (1.0 - self.outer) * angle / (0.5 * self.spread) for angle in tips]
        pieces = [self._lower_flank(tips[0], lengths[0], 0.5 * step)]
        for k in range(1, n_right + 1):
            is_middle = k == n_right
            if is_middle and self.lobes % 2 == 1:
                break
            length = lengths[-1] if is_middle else min(lengths[k - 1], lengths[k])
            sinus = (1.0 - self.depth) * length
            pieces.append(self._flank(tips[k - 1], lengths[k - 1], -0.5 * step, sinus)[::-1])
            if not is_middle:
                pieces.append(self._flank(tips[k], lengths[k], 0.5 * step, sinus))
        return pieces

    def _flank(self, tip: float, length: float, offset: float, sinus: float) -> Points:
        """Give the margin from a sinus to the tip of a lobe; angles from the axis, in degrees."""
        across, along = sinus * _sin(offset), sinus * _cos(offset)
        rest = length - along
        # not so far that the two flanks at a sinus meet
        most = 0.38 * rest * _sin(abs(offset)) / _cos(offset)
        swell = min(0.7 * self.bulge * abs(across), most)
        swollen = (along + 0.42 * rest, across + (swell if across > 0.0 else -swell))
        return _turned(
            [(along, across), swollen, self._arm(length, across, rest), (length, 0.0)], tip
        )

    def _arm(self, length: float, across: float, rest: float) -> Pair:
        """Give the control point of a flank beside the tip, along and across the lobe."""
        point = (length - 0.38 * rest, (0.38 + 0.3 * self.bulge) * across)
        end = (length, 0.75 * across) if self.tip >= 0.0 else (length - 0.6 * rest, 0.0)
        return between(point, end, abs(self.tip))

    def _lower_flank(self, tip: float, length: float, offset: float) -> Points:
        """Give the margin from the attachment to the tip of the outermost lobe."""
        # a lobe that points down must not meet its mirror image
        opening = min(max(offset, 32.0), 0.85 * (180.0 - tip))
        across = (1.0 - self.depth) * length * _sin(min(offset, opening))
        start = (0.35 * length * _cos(opening), 0.35 * length * _sin(opening))
        arm = self._arm(length, across, 0.6 * length)
        return _turned([(0.0, 0.0), start, arm, (length, 0.0)], tip)


class Reniform(Lobed):
    """A nearly round blade about the attachment with shallow lobes, as in lady's mantle."""

    shape: Literal["reniform"] = "reniform"  # type: ignore[assignment]
    lobes: int = _lobes(9)
    spread: float = _spread(290.0)
    depth: float = _depth(0.09)
    outer: float = _outer(0.76)
    bulge: float = _bulge(0.0)
    tip: float = tip_form(1.0)


class Fan(ShapeParameters):
    """A fan with straight sides and a rounded, wavy outer margin, as in ginkgo."""

    shape: Literal["fan"] = "fan"
    opening: float = quantity(
        "Angle between the straight sides.", unit="degrees", default=125.0, ge=10.0, le=300.0
    )
    side: float = quantity(
        "Length of the straight sides.", unit="blade length", default=0.72, ge=0.1, le=0.95
    )
    waves: int = quantity("Waves on each half of the outer margin.", default=6, ge=0, le=100)
    wave: float = quantity(
        "Height of the waves.", unit="blade length", default=0.008, ge=0.0, le=0.2
    )
    notch: float = quantity(
        "Depth of the notch in the middle.", unit="blade length", default=0.0, ge=0.0, le=0.9
    )
    notch_width: float = quantity(
        "Width of the notch over that of the outer margin.", default=0.12, gt=0.0, le=1.0
    )

    def half(self) -> list[Points]:
        """Give the straight side and half the outer margin."""
        angle = 0.5 * self.opening
        shoulder = (self.side * _sin(angle), self.side * _cos(angle))
        reach = 0.55 * (1.0 - self.side) + 0.12
        arm = (shoulder[0] + reach * _sin(angle), shoulder[1] + reach * _cos(angle))
        rim = cubic(shoulder, arm, (0.62 * shoulder[0] + 0.1, 1.0), (0.0, 1.0))
        share = np.linspace(0.0, 1.0, len(rim))
        # waves fade in from the shoulder; one is at its height on the axis
        fade = np.minimum(1.0, 4.0 * share)
        ripple = 0.5 * self.wave * fade * (1.0 - np.cos(2.0 * np.pi * self.waves * (1.0 - share)))
        within = np.maximum(0.0, 1.0 - (1.0 - share) / self.notch_width)
        scale = 1.0 - ripple - self.notch * within * within
        return [line((0.0, 0.0), shoulder), rim * scale[:, None]]


def _sin(angle: float) -> float:
    """Give the sine of an angle in degrees."""
    return float(np.sin(np.pi * angle / 180.0))


def _cos(angle: float) -> float:
    """Give the cosine of an angle in degrees."""
    return float(np.cos(np.pi * angle / 180.0))


def _turned(points: list[Pair], angle: float) -> Points:
    """Give the cubic curve of points along and across a lobe whose axis is at an angle."""
    sine, cosine = _sin(angle), _cos(angle)
    # across is positive away from the axis of the blade, which is clockwise on the right
    a, b, c, d = (
        (along * sine + across * cosine, along * cosine - across * sine) for along, across in points
    )
    return cubic(a, b, c, d)
