"""Areoles: the smallest pieces of blade that veins enclose on all sides."""

from dataclasses import dataclass

import numpy as np

from vasc.analysis.faces import planar_drawing
from vasc.arrays import Floats
from vasc.faces import Drawing, FaceWalks, face_walks
from vasc.network import VeinNetwork


@dataclass(frozen=True)
class Areoles:
    """The areoles of a network.

    Parameters
    ----------
    areas : ndarray of shape (k,), float64
        Their areas, in D^2; veins have no thickness here.
    """

    areas: Floats

    @property
    def n_areoles(self) -> int:
        """Number of areoles."""
        return len(self.areas)

    @property
    def mean_area(self) -> float:
        """Mean area, in D^2; nan if there is no areole."""
        return float(self.areas.mean()) if len(self.areas) else float("nan")

    @property
    def area_variation(self) -> float:
        """Standard deviation of the area over its mean; nan if there is no areole."""
        return float(self.areas.std()) / self.mean_area if len(self.areas) else float("nan")


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
    drawing = planar_drawing(network)
    if len(drawing.segments) == 0:
        return Areoles(np.zeros(0))
    walks = face_walks(drawing)
    areas = walks.areas.copy()
    for face, area in _islands(drawing, walks):
        areas[face] -= area
    return Areoles(areas[~walks.is_outside])


def _islands(drawing: Drawing, walks: FaceWalks) -> list[tuple[int, float]]:
    """List components with loops that lie in an areole of another: its face, their area."""
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
            found.append((int(face), -float(walks.areas[outside])))
    return found


def _faces_around(drawing: Drawing, walks: FaceWalks, place: Floats) -> np.ndarray:
    """Give the bounded faces that a place is in, by counting edges to its right."""
    a, b = drawing.points[walks.starts], drawing.points[walks.ends]
    is_level = (a[:, 1] > place[1]) != (b[:, 1] > place[1])
    a, b, faces = a[is_level], b[is_level], walks.faces[is_level]
    x = a[:, 0] + (place[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    n_right = np.bincount(faces[x > place[0]], minlength=len(walks.areas))
    return np.flatnonzero((n_right % 2 == 1) & ~walks.is_outside)
