"""Named leaf shapes: unit outlines with the attachment at the origin and the tip at (0, 1).

Each is a few cubic or trigonometric curves with a parameter or two, in the terms of
leaf morphology (Runions 2008, Figure 4.1); half outlines run from base to tip and
are mirrored.
"""

from collections.abc import Callable

import numpy as np

from vasc.arrays import Floats, Points

HALF_POINTS = 160
"""Points of half an outline."""


def from_half(x: Floats, y: Floats) -> Points:
    """Mirror half an outline, from base to tip on the right, and bring the tip to (0, 1)."""
    right = np.stack([x, y], axis=1)
    left = right[-2:0:-1] * np.array([-1.0, 1.0])
    outline = np.concatenate([right, left])
    return np.ascontiguousarray(outline / right[-1, 1])


def elliptic(*, width: float, n_points: int = HALF_POINTS) -> Points:
    """Give an ellipse, widest in the middle."""
    t = np.linspace(0.0, np.pi, n_points)
    return from_half(0.5 * width * np.sin(t), 0.5 - 0.5 * np.cos(t))


def ovate(*, width: float, n_points: int = HALF_POINTS, skew: float = 0.35) -> Points:
    """Give an egg shape, widest below the middle."""
    t = np.linspace(0.0, np.pi, n_points)
    y = 0.5 - 0.5 * np.cos(t)
    x = 0.5 * width * np.sin(t) * (1.0 + skew * np.cos(t)) / (1.0 + 0.12 * skew)
    return from_half(x, y)


def obovate(*, width: float, n_points: int = HALF_POINTS) -> Points:
    """Give an egg shape, widest above the middle."""
    return ovate(width=width, n_points=n_points, skew=-0.35)


def orbicular(*, width: float = 1.0, n_points: int = HALF_POINTS) -> Points:
    """Give a circle (for width 1)."""
    return elliptic(width=width, n_points=n_points)


def linear(*, width: float, n_points: int = HALF_POINTS) -> Points:
    """Give a strap with nearly parallel margins, a broad base and a pointed tip."""
    y = np.linspace(0.0, 1.0, n_points)
    fall = np.clip((y - 0.6) / 0.4, 0.0, 1.0)
    x = 0.5 * width * (1.0 - fall * fall)
    return from_half(np.concatenate([[0.0], x]), np.concatenate([[0.0], y]))


def cordate(*, width: float, sinus: float = 0.14, n_points: int = HALF_POINTS) -> Points:
    """Give a heart: rounded basal lobes beside the attachment, a pointed tip."""
    w = 0.5 * width
    lobe = _cubic((0.0, 0.0), (0.10 * w, -sinus), (0.55 * w, -1.25 * sinus), (0.86 * w, 0.10))
    side = _cubic((0.86 * w, 0.10), (1.22 * w, 0.36), (0.42 * w, 0.62), (0.0, 1.0))
    return _resampled(np.concatenate([lobe, side[1:]]), n_points)


def deltoid(*, width: float, n_points: int = HALF_POINTS) -> Points:
    """Give a triangle with rounded corners and a drawn-out tip, as of poplars."""
    w = 0.5 * width
    base = _cubic((0.0, 0.0), (0.35 * w, -0.05), (0.75 * w, -0.02), (0.95 * w, 0.14))
    side = _cubic((0.95 * w, 0.14), (1.12 * w, 0.34), (0.22 * w, 0.62), (0.0, 1.0))
    return _resampled(np.concatenate([base, side[1:]]), n_points)


def lobed(
    *, width: float = 1.1, lobes: int = 5, depth: float = 0.5, n_points: int = HALF_POINTS
) -> Points:
    """Give a digitate blade: pointed lobes that radiate from the attachment."""
    spread = np.pi * 0.74 if lobes > 3 else np.pi * 0.45
    angle = np.linspace(np.pi / 2 - spread, np.pi / 2, 2 * n_points)
    step = 2.0 * spread / (lobes - 1)
    phase = (np.pi / 2 - angle) / step
    to_axis = np.abs(phase - np.round(phase)) * 2.0
    fall = 1.0 - 0.30 * ((np.pi / 2 - angle) / spread) ** 2
    radius = fall * (1.0 - depth * to_axis * (1.6 - 0.6 * to_axis))
    base = np.array([[0.0, 0.0]])
    tips = np.stack([radius * np.cos(angle) * width, radius * np.sin(angle)], axis=1)
    half = np.concatenate([base, tips])
    return from_half(half[:, 0], half[:, 1])


def fan(*, width: float = 1.6, wave: float = 0.012, notch: float = 0.0,
        n_points: int = HALF_POINTS) -> Points:
    """Give a ginkgo fan: straight flanks and a rounded, wavy outer margin."""
    spread = 0.5 * width * 0.95
    angle = np.linspace(spread, 0.0, n_points)
    rim = 1.0 - wave * (1.0 - np.cos(16.0 * angle)) - notch / (1.0 + (angle / 0.05) ** 2)
    corner = np.clip((spread - angle) / (0.22 * spread), 0.0, 1.0)
    rim = rim * (0.80 + 0.20 * np.sqrt(corner * (2.0 - corner)))
    x = np.concatenate([[0.0], rim * np.sin(angle)])
    y = np.concatenate([[0.0], rim * np.cos(angle)])
    x[-1] = 0.0
    return from_half(x, y)


def reniform(*, width: float = 1.15, lobes: int = 9, depth: float = 0.06,
             n_points: int = HALF_POINTS) -> Points:
    """Give a round blade about the attachment with shallow lobes and a basal sinus."""
    spread = np.pi * 0.93
    angle = np.linspace(np.pi / 2 - spread, np.pi / 2, 2 * n_points)
    phase = (np.pi / 2 - angle) / (2.0 * spread) * lobes
    radius = 1.0 - depth * (1.0 - np.cos(2.0 * np.pi * phase))
    fall = 1.0 - 0.28 * ((np.pi / 2 - angle) / spread) ** 2
    tips = np.stack([fall * radius * np.cos(angle) * width, fall * radius * np.sin(angle)], axis=1)
    half = np.concatenate([np.array([[0.0, 0.0]]), tips])
    half[-1, 0] = 0.0
    return from_half(half[:, 0], half[:, 1])


def bilobed(*, width: float = 1.15, notch: float = 0.28, n_points: int = HALF_POINTS) -> Points:
    """Give two round lobes parted by a notch at the tip, as of the orchid tree."""
    w = 0.5 * width
    low = _cubic((0.0, 0.0), (0.25 * w, -0.16), (1.05 * w, -0.10), (1.0 * w, 0.42))
    high = _cubic((1.0 * w, 0.42), (0.97 * w, 0.78), (0.78 * w, 1.0), (0.52 * w, 1.0))
    inner = _cubic((0.52 * w, 1.0), (0.28 * w, 1.0), (0.08 * w, 0.90), (0.0, 1.0 - notch))
    half = np.concatenate([low, high[1:], inner[1:]])
    return from_half_at_height(_resampled_half(half, n_points))


def from_half_at_height(half: Points) -> Points:
    """Mirror half an outline and bring its greatest height to 1."""
    left = half[-2:0:-1] * np.array([-1.0, 1.0])
    return np.ascontiguousarray(np.concatenate([half, left]) / half[:, 1].max())


def _cubic(a: tuple, b: tuple, c: tuple, d: tuple, n_points: int = 120) -> Points:
    """Give points of a cubic Bezier curve."""
    t = np.linspace(0.0, 1.0, n_points)[:, None]
    s = 1.0 - t
    points = s * s * s * np.array(a) + 3.0 * s * s * t * np.array(b)
    return points + 3.0 * s * t * t * np.array(c) + t * t * t * np.array(d)


def _resampled_half(half: Points, n_points: int) -> Points:
    """Spread points evenly along half an outline."""
    pieces = np.sqrt((np.diff(half, axis=0) ** 2).sum(axis=1))
    along = np.concatenate([[0.0], np.cumsum(pieces)])
    at = np.linspace(0.0, along[-1], n_points)
    return np.stack([np.interp(at, along, half[:, 0]), np.interp(at, along, half[:, 1])], axis=1)


def _resampled(half: Points, n_points: int) -> Points:
    """Spread points evenly along half an outline, and mirror it."""
    even = _resampled_half(half, n_points)
    return from_half(even[:, 0], even[:, 1])


SHAPES: dict[str, Callable[..., Points]] = {
    "elliptic": elliptic,
    "ovate": ovate,
    "obovate": obovate,
    "orbicular": orbicular,
    "linear": linear,
    "cordate": cordate,
    "deltoid": deltoid,
    "lobed": lobed,
    "fan": fan,
    "reniform": reniform,
    "bilobed": bilobed,
}
"""The shapes by name."""
