"""Areolation: areoles are born when loops close, and split when veins cross them."""

import numpy as np

from vasc.arrays import NULL, Points
from vasc.events import EventKind
from vasc.faces import Drawing, FaceWalks, face_walks
from vasc.placement import Moment
from vasc.sources import Cause
from vasc.vasculature import Vasculature


class Areolation:
    """Keeps the areoles of a run, which are faces of the vein network.

    An areole lives until it is split. The nodes around it are recorded at its
    birth; where these material points are tells its area at any later time.
    """

    @staticmethod
    def enclose_sources(veins: Vasculature, moment: Moment) -> None:
        """Record in which areoles new sources have appeared."""
        births = veins.sources.view("birth")
        for source in np.flatnonzero(births == moment.step).tolist():
            if veins.sources.arrays["cause"][source] == Cause.MARGIN:
                continue
            areole = areole_at(veins, veins.places("sources")[source])
            if areole != NULL:
                veins.log(moment.step, EventKind.SOURCE_ENCLOSED, source, areole)

    def divide(self, veins: Vasculature, moment: Moment, segment: int) -> None:
        """Record the areoles on the two sides of a segment that has closed a loop."""
        walks, half_edge = self._walks(veins, segment)
        twin = (half_edge + len(walks.starts) // 2) % len(walks.starts)
        sides = [edge for edge in (half_edge, twin) if not walks.is_outside[walks.faces[edge]]]
        if walks.faces[half_edge] == walks.faces[twin] or not sides:
            return
        rings = [walks.around(edge) for edge in sides]
        places = veins.places("nodes")
        smallest = min(rings, key=lambda ring: polygon_area(places[ring]))
        parent = areole_at(veins, inner_point(places[smallest]))
        for ring in rings:
            row = veins.tables["areoles"].append(birth=moment.step, parent=parent, segment=segment)
            veins.tables["boundaries"].append(areole=row.start, node=np.array(ring, np.int32))
            if parent == NULL:
                veins.log(moment.step, EventKind.AREOLE_BORN, row.start, segment)
        if parent != NULL:
            veins.log(moment.step, EventKind.AREOLE_SPLIT, parent, segment)

    @staticmethod
    def _walks(veins: Vasculature, segment: int) -> tuple[FaceWalks, int]:
        """Give the walks around all faces, and the half-edge of a segment."""
        n_segments = veins.segments.n_rows
        ids = np.flatnonzero(~veins.refined[:n_segments])
        places = veins.places("nodes")[: veins.nodes.n_rows]
        drawing = Drawing(places, veins.segments.arrays["nodes"][ids])
        return face_walks(drawing), int(np.searchsorted(ids, segment))


def areole_at(veins: Vasculature, place: Points) -> int:
    """Give the living areole around a place, -1 if there is none."""
    import shapely

    areoles, boundaries = veins.tables["areoles"], veins.tables["boundaries"]
    is_split = np.zeros(areoles.n_rows, dtype=bool)
    parents = areoles.view("parent")
    is_split[parents[parents >= 0]] = True
    owners, nodes = boundaries.view("areole"), boundaries.view("node")
    places, point = veins.places("nodes"), shapely.Point(place)
    for areole in np.flatnonzero(~is_split).tolist():
        first, last = np.searchsorted(owners, [areole, areole + 1])
        if shapely.Polygon(places[nodes[first:last]]).contains(point):
            return areole
    return NULL


def polygon_area(ring: Points) -> float:
    """Give the area of a polygon."""
    x, y = ring[:, 0], ring[:, 1]
    return abs(float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())) / 2.0


def inner_point(ring: Points) -> Points:
    """Give a point well within a polygon."""
    import shapely

    point = shapely.maximum_inscribed_circle(shapely.Polygon(ring)).coords[0]
    return np.array(point)
