"""GeoJSON lines: veins with their courses, which meet where they have a corner in common."""

import json
import re
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from vasc.errors import NetworkError
from vasc.limits import NETWORK_DEPTH
from vasc.networks_in.edges import Edges, shown
from vasc.real_network import RealNetwork

COLLECTIONS = ("FeatureCollection", "GeometryCollection")

Line = tuple[str, Any, Any]


def read_geojson(name: str, text: str) -> RealNetwork:
    """Read the lines of a GeoJSON object.

    Parameters
    ----------
    name : str
        Name of the file.
    text : str
        Any GeoJSON object. Lines become veins, other geometries are left alone. A
        feature may have the property ``width``, which holds all along its lines.

    Returns
    -------
    RealNetwork
        A node at every corner; corners at exactly one place are one node. A
        repeated corner, and a piece drawn again exactly, count once.

    Raises
    ------
    NetworkError
        If it is no GeoJSON, holds no line, or a line is not a list of places.
    """
    found = Edges(name)
    drawn: set[frozenset[int]] = set()
    for where, line, width in _lines(name, _object(name, text)):
        if not isinstance(line, list) or len(line) < 2:
            raise found.error(where, f"a line is {shown(line)}; it must be two places or more")
        corners = [_corner(found, position, where) for position in line]
        for one, other in pairwise(corners):
            pair = frozenset((found.rows[one], found.rows[other]))
            if len(pair) == 2 and pair not in drawn:
                drawn.add(pair)
                found.add_edge(one, other, width, None, where)
    return found.network()


def _object(name: str, text: str) -> Any:
    """Parse JSON that is not nested too deeply."""
    depth = 0
    for mark in re.findall(r"[\[{\]}]", text):
        depth += 1 if mark in "[{" else -1
        if depth > NETWORK_DEPTH:
            raise NetworkError(f"{name}: brackets are nested more than {NETWORK_DEPTH} deep")
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise NetworkError(f"{name}: not JSON: {error}") from error
    except (ValueError, RecursionError) as error:
        # Python reads no whole number of more than 4300 digits
        raise NetworkError(f"{name}: not JSON that can be read: a number is too long") from error


def _lines(name: str, found: Any, where: str = "", width: Any = None) -> Iterator[Line]:
    """Give all lines with the place they are at and the width of their feature."""
    if not isinstance(found, dict) or not isinstance(found.get("type"), str):
        raise NetworkError(
            f"{name}, {where or 'at its top'}: is {shown(found)};"
            " it must be a GeoJSON object with a 'type'"
        )
    kind, inside = found["type"], found.get("coordinates")
    if kind == "Feature":
        properties = found.get("properties") or {}
        own = properties.get("width") if isinstance(properties, dict) else None
        if found.get("geometry") is not None:
            yield from _lines(name, found["geometry"], where or "feature 1", own)
    elif kind in COLLECTIONS:
        parts = found.get("features" if kind == "FeatureCollection" else "geometries")
        if not isinstance(parts, list):
            raise NetworkError(f"{name}, {where or 'at its top'}: a {kind} without a list")
        for number, part in enumerate(parts, 1):
            yield from _lines(name, part, where or f"feature {number}", width)
    elif kind == "LineString":
        yield where or "its line", inside, width
    elif kind == "MultiLineString":
        if not isinstance(inside, list):
            raise NetworkError(f"{name}, {where or 'its lines'}: coordinates are no list")
        for line in inside:
            yield where or "its lines", line, width


def _corner(found: Edges, position: Any, where: str) -> tuple[Any, Any]:
    """Give the node at a position, made if it is new."""
    if (
        not isinstance(position, list)
        or len(position) < 2
        or not all(isinstance(value, int | float) for value in position[:2])
    ):
        raise found.error(where, f"a place is {shown(position)}; it must be [x, y]")
    # 0.0 is -0.0, and 1 is 1.0: equal numbers are one key
    corner = position[0], position[1]
    if corner not in found.rows:
        found.add_node(corner, *corner, where)
    return corner
