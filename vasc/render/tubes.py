"""Tubes and spheres seen from afar, as pixels: each shaded, the nearest one in front.

A tube is a row of spheres that overlap. Far things are paler, as in a mist.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Points

LIGHT = np.array([-0.45, 0.55, 0.7]) / np.linalg.norm([-0.45, 0.55, 0.7])
"""Where light comes from: left, above, and the viewer's side."""
SHADE = 0.5
"""Light on what faces away from it."""
GLOSS = 0.28
"""Light that is thrown back like from a mirror, at most."""
MIST = 0.75
"""Share of white in what is farthest."""
OVERSAMPLING = 2
"""Pixels are made of so many times so many."""


@dataclass(frozen=True)
class Spheres:
    """Spheres to be seen along the third axis, from above.

    Parameters
    ----------
    centres : ndarray of shape (k, 3), float64
        Across, up and towards the viewer, in D.
    radii : ndarray of shape (k,), float64
        In D.
    colors : ndarray of shape (k, 3), float64
        Red, green and blue from 0 to 1.
    nearness : ndarray of shape (k,), float64
        From 0, far away and pale, to 1.
    """

    centres: Points
    radii: Floats
    colors: Floats
    nearness: Floats


def swept(
    points: Points, radii: Floats, segments: NDArray, spacing: float
) -> tuple[Points, Floats]:
    """Give spheres that make tubes along segments.

    Parameters
    ----------
    points : ndarray of shape (n, 3), float64
        Ends of segments.
    radii : ndarray of shape (n,), float64
        Radius of the tube at each.
    segments : ndarray of shape (m, 2), integer
        Rows of ``points``.
    spacing : float
        Distance between centres at most.

    Returns
    -------
    tuple of ndarray
        Centres, shape (k, 3), and radii, shape (k,).
    """
    starts, ends = points[segments[:, 0]], points[segments[:, 1]]
    lengths = np.linalg.norm(ends - starts, axis=1)
    counts = np.maximum(np.ceil(lengths / spacing).astype(np.int64), 1)
    rows = np.repeat(np.arange(len(segments)), counts)
    firsts = np.repeat(np.cumsum(counts) - counts, counts)
    shares = ((np.arange(len(rows)) - firsts + 0.5) / counts[rows])[:, None]
    centres = starts[rows] + shares * (ends - starts)[rows]
    first, second = radii[segments[rows, 0]], radii[segments[rows, 1]]
    return centres, first + shares[:, 0] * (second - first)


def paint(
    spheres: Spheres, box: tuple[float, float, float, float], pixels_per_length: float
) -> NDArray[np.uint8]:
    """Paint spheres on glass.

    Parameters
    ----------
    spheres : Spheres
        What to paint.
    box : tuple of float
        Left, bottom, right and top of what is seen, in D.
    pixels_per_length : float
        Scale.

    Returns
    -------
    ndarray of shape (height, width, 4), uint8
        Red, green, blue and opacity; the first row is the top one.
    """
    left, bottom, right, top = box
    scale = pixels_per_length * OVERSAMPLING
    width, height = (
        OVERSAMPLING * max(1, round(side * pixels_per_length))
        for side in (right - left, top - bottom)
    )
    # of spheres that fall on one pixel the last one stays: the nearest
    order = np.argsort(spheres.centres[:, 2], kind="stable")
    centres = (spheres.centres[order] - [left, bottom, 0.0]) * scale
    normals, owners = _seen(centres, spheres.radii[order] * scale, width, height)
    picture = np.zeros((height * width, 4))
    is_hit = owners >= 0
    hit = owners[is_hit]
    picture[is_hit, 3] = 1.0
    picture[is_hit, :3] = _lit(
        normals[is_hit], spheres.colors[order][hit], spheres.nearness[order][hit]
    )
    blocks = picture.reshape(height // OVERSAMPLING, OVERSAMPLING, width // OVERSAMPLING, -1, 4)
    mean = blocks.mean(axis=(1, 3))
    # colours are those of what was hit, however little of the pixel it covers
    mean[..., :3] /= np.maximum(mean[..., 3:], 1e-9)
    return np.ascontiguousarray(np.rint(mean[::-1] * 255.0).astype(np.uint8))


def _seen(
    centres: Points, radii: Floats, width: int, height: int
) -> tuple[Floats, NDArray[np.int64]]:
    """Give for every pixel the sphere that is nearest there, -1 for none, and its slope."""
    depths = np.full(width * height, -np.inf)
    owners = np.full(width * height, -1, dtype=np.int64)
    normals = np.zeros((width * height, 2))
    corners = np.floor(centres[:, :2]).astype(np.int64)
    reaches = np.ceil(radii).astype(np.int64)
    for reach in np.unique(reaches):
        rows = np.flatnonzero(reaches == reach)
        around = np.arange(-reach, reach + 1)
        for up in around:
            for across in around:
                pixels = corners[rows] + [across, up]
                slopes = (pixels + 0.5 - centres[rows, :2]) / radii[rows, None]
                rises = 1.0 - (slopes**2).sum(axis=1)
                is_on = (
                    (rises > 0.0) & (pixels >= 0).all(axis=1) & (pixels < [width, height]).all(1)
                )
                found = pixels[is_on, 1] * width + pixels[is_on, 0]
                near = centres[rows[is_on], 2] + radii[rows[is_on]] * np.sqrt(rises[is_on])
                is_nearer = near > depths[found]
                found = found[is_nearer]
                depths[found] = near[is_nearer]
                owners[found] = rows[is_on][is_nearer]
                normals[found] = slopes[is_on][is_nearer]
    return normals, owners


def _lit(slopes: Floats, colors: Floats, nearness: Floats) -> Floats:
    """Give colours in light and mist."""
    facing = np.sqrt(np.maximum(1.0 - (slopes**2).sum(axis=1), 0.0))
    normals = np.column_stack([slopes, facing])
    light = np.maximum(normals @ LIGHT, 0.0)
    halfway = LIGHT + np.array([0.0, 0.0, 1.0])
    mirrored = np.maximum(normals @ (halfway / np.linalg.norm(halfway)), 0.0) ** 24
    shaded = colors * (SHADE + (1.0 - SHADE) * light)[:, None] + GLOSS * mirrored[:, None]
    mist = (MIST * (1.0 - nearness) ** 1.2)[:, None]
    return np.asarray(np.clip(shaded * (1.0 - mist) + mist, 0.0, 1.0))
