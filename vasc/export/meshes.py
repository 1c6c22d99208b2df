"""Surfaces of strands and primordia: closed tubes and spheres of triangles."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.tubes import (
    PRIMORDIUM_OUTWARD,
    PRIMORDIUM_RADIUS,
    set_outward,
    strand_radii,
)
from vasc.analysis.ways import ways
from vasc.arrays import Floats, Ids, Points

N_SIDES = 8
"""Corners around a tube."""
N_BANDS = 8
"""Bands of a sphere from pole to pole."""
VEIN_COLOR = (47, 122, 63, 255)
PRIMORDIUM_COLOR = (224, 160, 48, 255)
"""Red, green, blue and opacity."""
SHORTEST = 1e-9
"""Segments shorter than this share of a radius have no direction."""

Faces = NDArray[np.int64]


@dataclass(frozen=True)
class StemMesh:
    """Veins as triangles: bodies one after another, each of them closed.

    Parameters
    ----------
    points : ndarray of shape (n, 3), float64
        Corners, in D or the unit of a run; a stem stands along the third axis.
    faces : ndarray of shape (m, 3), int64
        Rows of ``points``, counterclockwise as seen from outside.
    colors : ndarray of shape (n, 4), uint8
        Colour of each corner; no two bodies share one.
    bodies : ndarray of shape (m,), int64
        Number of the body that each face is of: tubes first, then primordia.
    n_tubes : int
        How many of the bodies are tubes.
    """

    points: Points
    faces: Faces
    colors: NDArray[np.uint8]
    bodies: NDArray[np.int64]
    n_tubes: int

    def scaled(self, scale: float) -> "StemMesh":
        """Give the same in another unit, of which D is ``scale``."""
        return replace(self, points=self.points * scale)


def mesh_of(positions: Points, segments: Ids, primordia: Ids) -> StemMesh:
    """Give the surfaces of a stem: a tube for every way of a strand, a sphere a primordium.

    Tubes taper towards the apex and reach into each other where strands meet.

    Parameters
    ----------
    positions : ndarray of shape (n, 3), float64
        Vein nodes, in D.
    segments : ndarray of shape (m, 2), integer
        Node ids.
    primordia : ndarray of shape (p,), integer
        Node ids.

    Returns
    -------
    StemMesh
        Without a face if there is neither a segment nor a primordium.
    """
    radii = strand_radii(positions[:, 2])
    pairs = np.unique(np.sort(segments, axis=1), axis=0)
    tubes = [tube(positions[way], radii[way]) for way in ways(pairs)]
    centres = set_outward(positions[primordia], PRIMORDIUM_OUTWARD)
    spheres = [sphere(centre, PRIMORDIUM_RADIUS) for centre in centres]
    return joined(tubes, spheres)


def joined(tubes: list[tuple[Points, Faces]], spheres: list[tuple[Points, Faces]]) -> StemMesh:
    """Give bodies as one model: tubes in the colour of veins, spheres in that of primordia.

    Parameters
    ----------
    tubes, spheres : list of tuple of ndarray
        Points, shape (n, 3), and faces, shape (m, 3), of each body.

    Returns
    -------
    StemMesh
        Without a face if there is no body.
    """
    bodies = [*tubes, *spheres]
    counts = [len(faces) for _, faces in bodies]
    starts = np.cumsum([0, *(len(points) for points, _ in bodies)])
    numbers = np.repeat(np.arange(len(bodies)), counts)
    is_primordium = (np.arange(len(bodies)) >= len(tubes)).astype(np.int64)
    palette = np.array([VEIN_COLOR, PRIMORDIUM_COLOR], dtype=np.uint8)
    return StemMesh(
        points=np.concatenate([np.zeros((0, 3)), *(points for points, _ in bodies)]),
        faces=np.concatenate(
            [
                np.zeros((0, 3), dtype=np.int64),
                *(faces + start for (_, faces), start in zip(bodies, starts, strict=False)),
            ]
        ),
        colors=np.repeat(palette[is_primordium], np.diff(starts), axis=0),
        bodies=numbers,
        n_tubes=len(tubes),
    )


def tube(path: Points, radii: Floats) -> tuple[Points, Faces]:
    """Give a closed tube along a path.

    Parameters
    ----------
    path : ndarray of shape (k, 3), float64
        Points of the path, at least two; the last may be the first again.
    radii : ndarray of shape (k,), float64
        Radius at each.

    Returns
    -------
    tuple of ndarray
        Points, shape (n, 3), and faces, shape (m, 3).
    """
    along = _directions(path)
    turns = 2.0 * np.pi * np.arange(N_SIDES) / N_SIDES
    first, second = _carried(along)
    around = (
        np.cos(turns)[None, :, None] * first[:, None]
        + np.sin(turns)[None, :, None] * second[:, None]
    )
    rings = path[:, None] + radii[:, None, None] * around
    points = np.concatenate([rings.reshape(-1, 3), path[[0, -1]]])
    sides = np.arange(N_SIDES)
    after = np.roll(sides, -1)
    levels = N_SIDES * np.arange(len(path) - 1)[:, None]
    low, low_after = levels + sides, levels + after
    high, high_after = low + N_SIDES, low_after + N_SIDES
    walls = [
        np.stack(part, axis=2) for part in ((low, low_after, high_after), (low, high_after, high))
    ]
    last, ends = N_SIDES * (len(path) - 1), N_SIDES * len(path)
    base = np.stack([np.full(N_SIDES, ends), after, sides], axis=1)
    top = np.stack([np.full(N_SIDES, ends + 1), last + sides, last + after], axis=1)
    faces = np.concatenate([*(wall.reshape(-1, 3) for wall in walls), base, top])
    return points, faces.astype(np.int64)


def sphere(centre: Points, radius: float) -> tuple[Points, Faces]:
    """Give a closed sphere, whose poles are above and below its centre.

    Parameters
    ----------
    centre : ndarray of shape (3,), float64
        Where it is.
    radius : float
        How large.

    Returns
    -------
    tuple of ndarray
        Points, shape (n, 3), and faces, shape (m, 3).
    """
    levels = np.pi * np.arange(N_BANDS + 1) / N_BANDS
    # the poles are rings without a width, whose ends close the tube
    path = np.zeros((N_BANDS + 1, 3))
    path[:, 2] = -np.cos(levels)
    inner = slice(1, N_BANDS)
    points, faces = tube(path[inner], np.sin(levels)[inner])
    points[-2:] = path[[0, -1]]
    return centre + radius * points, faces


def _directions(path: Points) -> Points:
    """Give the direction of a path at each of its points, shape (k, 3)."""
    steps = np.diff(path, axis=0)
    lengths = np.linalg.norm(steps, axis=1)[:, None]
    steps = np.divide(steps, lengths, out=np.zeros_like(steps), where=lengths > SHORTEST)
    sums = np.concatenate([steps[:1], steps[:-1] + steps[1:], steps[-1:]])
    lengths = np.linalg.norm(sums, axis=1)[:, None]
    upward = np.broadcast_to([0.0, 0.0, 1.0], sums.shape)
    return np.where(lengths > SHORTEST, sums / np.maximum(lengths, SHORTEST), upward)


def _carried(along: Points) -> tuple[Points, Points]:
    """Give two directions across a path at each point, turned as little as can be on the way."""
    first = np.zeros_like(along)
    across = np.eye(3)[int(np.argmin(np.abs(along[0])))]
    for row, direction in enumerate(along):
        level = across - (across @ direction) * direction
        length = float(np.linalg.norm(level))
        if length < SHORTEST:
            # a path that turns right into the old direction across begins anew
            level = np.cross(direction, np.eye(3)[int(np.argmin(np.abs(direction)))])
            length = float(np.linalg.norm(level))
        across = level / length
        first[row] = across
    return first, np.cross(along, first)
