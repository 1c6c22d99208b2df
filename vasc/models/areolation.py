"""Areolation: areoles are born when loops close, and split when veins cross them.

Areoles are faces of the vein network. One lives until it is split. The nodes around it are
recorded at its birth; where these material points are tells its area at any later time.
"""

import numpy as np

from vasc.arrays import NULL, Points
from vasc.events import EventKind
from vasc.faces import Drawing, FaceWalks, face_walks
from vasc.placement import Moment
from vasc.sources import Cause
from vasc.vasculature import Vasculature


def enclose_sources(veins: Vasculature, moment: Moment) -> None:
    """Record in which areoles the sources of this step have appeared."""
    births = veins.sources.view("birth")
    for source in np.flatnonzero(births == moment.step).tolist():
        if veins.sources.arrays["cause"][source] == Cause.MARGIN:
            continue
        areole = _areole_at(veins, veins.places("sources")[source])
        if areole != NULL:
            veins.log(moment.step, EventKind.SOURCE_ENCLOSED, source, areole)


def divide_tissue(veins: Vasculature, moment: Moment, segment: int) -> None:
    """Record the areoles on the two sides of a segment that has closed a loop."""
    walks, half_edge = _walks(veins, segment)
    twin = (half_edge + len(walks.starts) // 2) % len(walks.starts)
    sides = [edge for edge in (half_edge, twin) if not walks.is_outside[walks.faces[edge]]]
    if walks.faces[half_edge] == walks.faces[twin] or not sides:
        return
    smallest = min(sides, key=lambda edge: walks.areas[walks.faces[edge]])
    inside = _inner_point(veins.places("nodes")[walks.around(smallest)])
    parent = _areole_at(veins, inside)
    for ring in (walks.around(edge) for edge in sides):
        row = veins.tables["areoles"].append(birth=moment.step, parent=parent, segment=segment)
        veins.tables["boundaries"].append(areole=row.start, node=np.array(ring, np.int32))
        if parent == NULL:
            veins.log(moment.step, EventKind.AREOLE_BORN, row.start, segment)
    if parent != NULL:
        veins.log(moment.step, EventKind.AREOLE_SPLIT, parent, segment)


def _walks(veins: Vasculature, segment: int) -> tuple[FaceWalks, int]:
    """Give the walks around all faces, and the half-edge of a segment."""
    n_segments = veins.segments.n_rows
    ids = np.flatnonzero(~veins.refined[:n_segments])
    places = veins.places("nodes")[: veins.nodes.n_rows]
    drawing = Drawing(places, veins.segments.arrays["nodes"][ids])
    return face_walks(drawing), int(np.searchsorted(ids, segment))


def _areole_at(veins: Vasculature, place: Points) -> int:
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


def _inner_point(ring: Points) -> Points:
    """Give a point well within a polygon."""
    import shapely

    point = shapely.maximum_inscribed_circle(shapely.Polygon(ring)).coords[0]
    return np.array(point)
