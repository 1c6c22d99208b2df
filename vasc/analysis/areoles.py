"""Areoles: the smallest pieces of blade that veins enclose on all sides."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.sections import Sections, find_sections
from vasc.arrays import Floats
from vasc.faces import Drawing, FaceWalks, face_walks
from vasc.network import VeinNetwork

LEAST_AREA = 1e-12
"""Of an areole, over the square of the longer side of the network: below is rounding."""


@dataclass(frozen=True)
class Areoles:
    """The areoles of a network; veins have no thickness here.

    Parameters
    ----------
    areas : ndarray of shape (k,), float64
        Their areas, in the square of the unit of length.
    perimeters : ndarray of shape (k,), float64
        Lengths around them and around networks within; a vein with the same areole on
        both sides, as one that ends in it, is not counted.
    elongations : ndarray of shape (k,), float64
        Ratio of the axes of the ellipse with the same second moments, from 1.
    corners : ndarray of shape (k,), int64
        Junctions around each, of the network without free-ending trees.
    n_flat : int
        Faces of the drawing that enclose nothing but rounding, by ``LEAST_AREA``: no areoles.
    """

    areas: Floats
    perimeters: Floats
    elongations: Floats
    corners: NDArray[np.int64]
    n_flat: int = 0

    @property
    def n_areoles(self) -> int:
        """Number of areoles."""
        return len(self.areas)

    @property
    def mean_area(self) -> float:
        """Mean area; nan if there is no areole."""
        return float(self.areas.mean()) if len(self.areas) else float("nan")

    @property
    def area_variation(self) -> float:
        """Standard deviation of the area over its mean; nan if there is no areole."""
        return float(self.areas.std()) / self.mean_area if len(self.areas) else float("nan")

    @property
    def circularities(self) -> Floats:
        """4 pi A / P^2 of each, 1 for a circle, shape (k,)."""
        return 4.0 * np.pi * self.areas / self.perimeters**2


@dataclass(frozen=True)
class LoopedVeins:
    """The veins that border areoles: a network without its free-ending trees.

    Parameters
    ----------
    walks : FaceWalks
        Walks around its faces.
    sections : ndarray of shape (2q,), int64
        The section each half-edge belongs to.
    degrees : ndarray of shape (p,), int64
        Segments that meet at each point.
    """

    walks: FaceWalks
    sections: NDArray[np.int64]
    degrees: NDArray[np.int64]

    @property
    def is_border(self) -> NDArray[np.bool_]:
        """True for half-edges with another face on their other side, shape (2q,)."""
        faces = self.walks.faces
        return faces != np.roll(faces, len(faces) // 2)


def find_areoles(network: VeinNetwork) -> Areoles:
    """Find the areoles: the bounded faces of the network drawn in the plane.

    Veins that cross or touch meet there, whether or not they share a node. Veins
    that end inside an areole do not divide it; a network inside an areole with
    loops of its own takes its area from it. What the margin encloses together
    with veins is no areole.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.

    Returns
    -------
    Areoles
        Without any areole for a tree or an empty network.
    """
    sections = find_sections(network)
    return areoles_of(looped_veins(sections), sections.drawing)


def looped_veins(sections: Sections) -> LoopedVeins | None:
    """Give the veins that border areoles, None if there is no areole.

    Parameters
    ----------
    sections : Sections
        The veins of a network.
    """
    is_looped = sections.is_looped[sections.owners]
    if not is_looped.any():
        return None
    drawing, rows = sections.drawing, sections.rows[is_looped]
    segments = drawing.segments[rows]
    owners = sections.owners[is_looped]
    return LoopedVeins(
        face_walks(Drawing(drawing.points, segments)),
        np.concatenate([owners, owners]),
        np.bincount(segments.ravel(), minlength=len(drawing.points)),
    )


def areoles_of(looped: LoopedVeins | None, drawing: Drawing) -> Areoles:
    """Measure the areoles.

    Parameters
    ----------
    looped : LoopedVeins, optional
        The veins that border them.
    drawing : Drawing
        The drawing they are part of.

    Returns
    -------
    Areoles
        In the order of the faces, without the outsides and those without area.
    """
    if looped is None:
        return Areoles(np.zeros(0), np.zeros(0), np.zeros(0), np.zeros(0, dtype=np.int64))
    walks = looped.walks
    n_faces = len(walks.areas)
    faces, areas = walks.faces.astype(np.int64), walks.areas.copy()
    for face, outside in _islands(drawing, walks):
        # what goes around an island goes around a hole of the areole
        areas[face] += areas[outside]
        faces[walks.faces == outside] = face
    vectors = drawing.points[walks.ends] - drawing.points[walks.starts]
    lengths = np.where(looped.is_border, np.sqrt((vectors**2).sum(axis=1)), 0.0)
    perimeters = np.bincount(faces, lengths, minlength=n_faces).astype(np.float64)
    corners = np.bincount(walks.faces[looped.degrees[walks.starts] >= 3], minlength=n_faces)
    side = float(np.ptp(drawing.points, axis=0).max())
    is_flat = ~walks.is_outside & (areas < LEAST_AREA * side**2)
    is_inside = ~walks.is_outside & ~is_flat
    of_faces: list[Floats] = [areas, perimeters, _elongations(drawing, walks, faces, areas)]
    measured = [values[is_inside] for values in of_faces]
    flat = int(is_flat.sum())
    return Areoles(measured[0], measured[1], measured[2], corners[is_inside], flat)


def _elongations(
    drawing: Drawing, walks: FaceWalks, faces: NDArray[np.int64], areas: Floats
) -> Floats:
    """Give the axis ratios of the faces by second moments, by Green's theorem."""
    origins = np.zeros((len(areas), 2))
    # from a point of each face, so that far from the origin no digits cancel
    origins[faces] = drawing.points[walks.starts]
    x, y = (drawing.points[walks.starts] - origins[faces]).T
    u, v = (drawing.points[walks.ends] - origins[faces]).T
    cross = x * v - u * y

    def over_area(values: Floats, factor: float) -> Floats:
        sums = np.bincount(faces, cross * values, minlength=len(areas))
        return sums / (factor * np.where(areas != 0.0, areas, np.nan))

    center = over_area(x + u, 6.0), over_area(y + v, 6.0)
    xx = over_area(x * x + x * u + u * u, 12.0) - center[0] ** 2
    yy = over_area(y * y + y * v + v * v, 12.0) - center[1] ** 2
    xy = over_area(x * v + 2.0 * x * y + 2.0 * u * v + u * y, 24.0) - center[0] * center[1]
    middle, half = (xx + yy) / 2.0, np.hypot((xx - yy) / 2.0, xy)
    smaller = np.maximum(middle - half, 1e-30 * middle)
    # a hole is no face any more
    smaller = np.where(smaller > 0.0, smaller, np.nan)
    return np.sqrt((middle + half) / smaller)


def _islands(drawing: Drawing, walks: FaceWalks) -> list[tuple[int, int]]:
    """List components with loops that lie in an areole of another: its face, their outside."""
    with_loops = np.unique(walks.components[~walks.is_outside])
    if len(with_loops) < 2:
        return []
    found = []
    outsides = np.flatnonzero(walks.is_outside & np.isin(walks.components, with_loops))
    for outside in outsides:
        place = drawing.points[walks.starts[np.argmax(walks.faces == outside)]]
        around = _faces_around(drawing, walks, place)
        around = around[walks.components[around] != walks.components[outside]]
        if len(around):
            face = around[np.argmin(walks.areas[around])]
            found.append((int(face), int(outside)))
    return found


def _faces_around(drawing: Drawing, walks: FaceWalks, place: Floats) -> np.ndarray:
    """Give the bounded faces that a place is in, by counting edges to its right."""
    a, b = drawing.points[walks.starts], drawing.points[walks.ends]
    is_level = (a[:, 1] > place[1]) != (b[:, 1] > place[1])
    a, b, faces = a[is_level], b[is_level], walks.faces[is_level]
    x = a[:, 0] + (place[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    n_right = np.bincount(faces[x > place[0]], minlength=len(walks.areas))
    return np.flatnonzero((n_right % 2 == 1) & ~walks.is_outside)
