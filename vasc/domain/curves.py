"""Half outlines drawn as a few smooth curves, from the attachment up to the axis at the tip.

Only + - * / sqrt, sin and cos: an outline must not depend on the processor.
"""

import numpy as np

from vasc.arrays import Points
from vasc.domain.rings import arc_lengths, at_lengths

Pair = tuple[float, float]

ROUND = 0.5522847498
"""Length of a control arm, in radii, that makes a cubic curve a quarter of a circle."""
CURVE_POINTS = 257


def line(a: Pair, b: Pair) -> Points:
    """Give a straight piece."""
    return np.array([a, b], dtype=np.float64)


def cubic(a: Pair, b: Pair, c: Pair, d: Pair) -> Points:
    """Give a cubic Bezier curve from a to d."""
    t = np.linspace(0.0, 1.0, CURVE_POINTS)[:, None]
    s = 1.0 - t
    curve = s * s * s * np.array(a) + 3.0 * (s * s * t) * np.array(b)
    return curve + 3.0 * (s * t * t) * np.array(c) + t * t * t * np.array(d)


def between(a: Pair, b: Pair, share: float) -> Pair:
    """Give the point at a share of the way from a to b."""
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])


def base_curve(half_width: float, height: float, base: float) -> Points:
    """Give the margin from the attachment up to the widest place.

    ``base`` is -1 for a base drawn out along the petiole, 0 for a wedge and 1
    for a rounded base.
    """
    wedge = (0.45 * half_width, 0.18 * height)
    end = (ROUND * half_width, 0.0) if base >= 0.0 else (0.0, 0.5 * height)
    return cubic(
        (0.0, 0.0),
        between(wedge, end, abs(base)),
        (half_width, height - ROUND * height),
        (half_width, height),
    )


def tip_curve(half_width: float, height: float, tip: float) -> Points:
    """Give the margin from the widest place up to the tip at (0, 1).

    ``tip`` is -1 for a drawn-out tip, 0 for a pointed and 1 for a rounded one.
    """
    rest = 1.0 - height
    point = (0.25 * half_width, 1.0 - 0.3 * rest)
    end = (ROUND * half_width, 1.0) if tip >= 0.0 else (0.0, 1.0 - 0.7 * rest)
    return cubic(
        (half_width, height),
        (half_width, height + ROUND * rest),
        between(point, end, abs(tip)),
        (0.0, 1.0),
    )


def sampled(pieces: list[Points], n_points: int) -> Points:
    """Spread points over curves that follow each other, evenly but with every joint.

    Parameters
    ----------
    pieces : list of ndarray of shape (k, 2), float64
        Curves, each of which begins where the one before ends.
    n_points : int
        Points wanted; each curve gets at least its ends.

    Returns
    -------
    ndarray of shape (n, 2), float64
        No point twice; n is about ``n_points``.
    """
    lengths = [float(arc_lengths(piece)[-1]) for piece in pieces]
    step = sum(lengths) / n_points
    parts = [pieces[0][:1]]
    for piece, length in zip(pieces, lengths, strict=True):
        n_steps = max(1, round(length / step)) if len(piece) > 2 else 1
        parts.append(at_lengths(piece, np.linspace(0.0, length, n_steps + 1))[1:-1])
        parts.append(piece[-1:])
    return np.concatenate(parts)


def mirrored(half: Points) -> Points:
    """Give the ring of a half outline on the right that ends on the axis, and its mirror image."""
    half[-1, 0] = 0.0
    left = half[-2:0:-1] * np.array([-1.0, 1.0])
    return np.concatenate([half, left])
