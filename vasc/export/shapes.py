"""Veins and outlines as geometry: GeoJSON and well-known text."""

import json
from typing import Any

import numpy as np

from vasc.export.graphml import edge_columns
from vasc.export.outlines import outline_of
from vasc.export.specimen import Specimen
from vasc.export.words import as_bytes, comment


def geojson(specimen: Specimen) -> bytes:
    """Give outline and veins as a GeoJSON collection of features.

    Parameters
    ----------
    specimen : Specimen
        The step.

    Returns
    -------
    bytes
        The outline as a Polygon, if there is one, and each segment as a LineString from its
        proximal to its distal node. Since JSON has no comments, the member ``vasc`` says what
        it is.
    """
    run, moment, unit = specimen.heading
    about = {
        "run": specimen.run,
        "title": specimen.title,
        "step": specimen.step,
        "time": specimen.time,
        "length_unit": specimen.unit.name,
        "note": f"{run}; {moment}; {unit}",
    }
    features = [json.dumps(feature) for feature in _features(specimen)]
    return as_bytes(
        [
            f'{{"type": "FeatureCollection", "vasc": {json.dumps(about)}, "features": [',
            ",\n".join(features),
            "]}",
        ]
    )


def wkt(specimen: Specimen) -> bytes:
    """Give outline and veins as well-known text.

    Parameters
    ----------
    specimen : Specimen
        The step.

    Returns
    -------
    bytes
        After lines of comment, which begin with ``#``, one geometry a line: the outline, if
        there is one, and each segment as a LINESTRING, in the order of their ids.
    """
    import shapely

    lines = shapely.linestrings(specimen.positions[specimen.ends])
    outline = [outline_of(specimen)] if specimen.rings else []
    texts = shapely.to_wkt([*outline, *lines], rounding_precision=-1)
    return as_bytes([*comment(specimen.heading), *texts])


def _features(specimen: Specimen) -> list[dict[str, Any]]:
    """Give the outline and all segments as features."""
    import shapely

    found: list[dict[str, Any]] = []
    if specimen.rings:
        found.append(
            {
                "type": "Feature",
                "id": "outline",
                "properties": {"what": "outline"},
                "geometry": shapely.geometry.mapping(outline_of(specimen)),
            }
        )
    columns = edge_columns(specimen)
    pairs = specimen.ids[specimen.ends].tolist()
    places = np.asarray(specimen.positions)[specimen.ends].tolist()
    for row, pair, line in zip(zip(*columns.values(), strict=True), pairs, places, strict=True):
        said = dict(zip(columns, row, strict=True))
        # a row of one table is no row of another: what an id is of stands in its name
        segment = said.pop("id")
        said = {"segment": segment, "proximal_node": pair[0], "distal_node": pair[1]} | said
        found.append(
            {
                "type": "Feature",
                "id": f"segment {segment}",
                "properties": {"what": "vein", **said},
                "geometry": {"type": "LineString", "coordinates": line},
            }
        )
    return found
