"""Outlines from files: CSV, GeoJSON, WKT, SVG, and PNG, TIFF or JPEG masks and scans."""

import csv
import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from vasc.arrays import Points
from vasc.domain.checks import check_crossings, check_rings, closed_ring
from vasc.domain.normalization import Attachment, Tip, counter_clockwise, normalized
from vasc.errors import OutlineError, ShapeError
from vasc.limits import FILE_BYTES, FILE_DEPTH, OUTLINE_POINTS

LONGEST_REASON = 120
"""Characters of a reason that a library gives: some quote what they read in full."""


def read_outline(
    path: Path | str, *, attachment: Attachment = "lowest", tip: Tip = "highest"
) -> list[Points]:
    """Read a blade outline, normalized to height 1.

    Parameters
    ----------
    path : Path or str
        A file; its suffix says what it is: ``.csv``, ``.txt``, ``.geojson``,
        ``.json``, ``.wkt``, ``.svg``, ``.png``, ``.tif``, ``.tiff``, ``.jpg`` or
        ``.jpeg``. Images need the extra ``vasc[image]``.
    attachment : "origin", "lowest" or pair of float
        Where the petiole is attached, in the coordinates of the file (for images
        in pixels from the upper left corner, y downward, as viewers show them).
    tip : "highest", "farthest" or pair of float
        See :func:`vasc.domain.normalization.normalized`.

    Returns
    -------
    list of ndarray of shape (n, 2), float64
        Rings under the even-odd rule, attachment at the origin, highest point
        at y = 1, y upward; every ring runs counter-clockwise.

    Raises
    ------
    OutlineError
        If the file is missing, too large, not of its kind, or holds no outline
        that can be used.
    """
    checked, is_y_down = rings_in_file(Path(path))
    if is_y_down:
        flip = np.array([1.0, -1.0])
        checked = tuple(ring * flip for ring in checked)
        attachment, tip = _flipped(attachment), _flipped(tip)
    return [counter_clockwise(ring) for ring in normalized(checked, attachment=attachment, tip=tip)]


def rings_in_file(path: Path) -> tuple[tuple[Points, ...], bool]:
    """Read the rings of an outline as they are in the file.

    Parameters
    ----------
    path : Path
        A file that :func:`read_outline` knows.

    Returns
    -------
    rings : tuple of ndarray of shape (n, 2), float64
        In the coordinates of the file; they do not meet.
    is_y_down : bool
        Whether y points down there.

    Raises
    ------
    OutlineError
        As :func:`read_outline`.
    """
    read = READERS.get(path.suffix.lower())
    if read is None:
        known = ", ".join(sorted(READERS))
        raise OutlineError(
            f"outline: a file ending in '{path.suffix}' cannot be read; known are {known}"
        )
    content = _bytes_of(path)
    try:
        rings, is_y_down = read(content)
    except (RecursionError, MemoryError) as error:
        raise OutlineError("outline: nested too deeply or too large to be read") from error
    except ShapeError as error:
        raise OutlineError(str(error)) from error
    except OverflowError as error:
        raise OutlineError("outline: holds a number that is too large") from error
    checked = check_rings(rings)
    check_crossings(checked)
    return checked, is_y_down


def _flipped(point: Any) -> Any:
    """Give a point with y upward; a word stays as it is."""
    return point if isinstance(point, str) else (point[0], -point[1])


def _bytes_of(path: Path) -> bytes:
    """Read a file, at most the largest size that is allowed."""
    try:
        with path.open("rb") as file:
            content = file.read(FILE_BYTES + 1)
    except OSError as error:
        raise OutlineError(f"outline: cannot be read: {error.strerror or error}") from error
    if len(content) > FILE_BYTES:
        raise OutlineError(f"outline: the file is larger than {FILE_BYTES:,} bytes")
    return content


def text_of(content: bytes) -> str:
    """Decode a text file.

    Raises
    ------
    OutlineError
        If it is not UTF-8.
    """
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise OutlineError(f"outline: not a text in UTF-8 (byte {error.start})") from error


Outline = tuple[list[Points], bool]
"""Rings, and whether y points down."""


FIRST, SECOND = ("x", "lon"), ("y", "lat")
"""How names of columns begin that hold the first and the second coordinate."""


def read_csv(content: bytes) -> Outline:
    """Read corners, one a line: x, y and perhaps the name of the ring; a header is skipped.

    Raises
    ------
    OutlineError
        If a line is not two numbers, or a header says that the first is not x.
    """
    rings: dict[str, list[tuple[float, float]]] = {}
    n_points = 0
    for number, row in _rows(text_of(content)):
        try:
            x, y = float(row[0]), float(row[1])
        except (ValueError, IndexError) as error:
            if number == 1 and not any(_is_number(cell) for cell in row):
                _check_header(row)
                continue
            said = ", ".join(row)[:60]
            raise OutlineError(f"outline: line {number} is '{said}'; it must be x, y") from error
        n_points += 1
        if n_points > OUTLINE_POINTS:
            raise OutlineError(f"outline: more than {OUTLINE_POINTS:,} points")
        rings.setdefault(row[2].strip() if len(row) > 2 else "", []).append((x, y))
    closed = [
        points[:-1] if len(points) > 3 and points[0] == points[-1] else points
        for points in rings.values()
    ]
    return [np.array(points, dtype=np.float64) for points in closed], False


def _check_header(row: list[str]) -> None:
    """Refuse a header that begins with the second coordinate: it would be read as the first."""
    names = [cell.strip().lower() for cell in row[:2]]
    if names[:1] and (names[0].startswith(SECOND) or names[-1].startswith(FIRST)):
        said = ", ".join(row)[:60]
        raise OutlineError(f"outline: the header is '{said}'; the columns must be x, y")


def _is_number(cell: str) -> bool:
    """Tell whether a cell holds a number."""
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _rows(text: str) -> Iterator[tuple[int, list[str]]]:
    """Give line numbers, from 1 for the first that is no comment, and cells."""
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    sample = lines[0] if lines else ""
    delimiter = next((mark for mark in (",", ";", "\t") if mark in sample), "")
    if delimiter:
        yield from enumerate(csv.reader(lines, delimiter=delimiter), 1)
    else:
        yield from enumerate((line.split() for line in lines), 1)


def read_geojson(content: bytes) -> Outline:
    """Read polygons and closed lines from any GeoJSON object.

    Raises
    ------
    OutlineError
        If it is not GeoJSON, or a ring is open.
    """
    text = text_of(content)
    _check_depth(text, "[{", "]}")
    try:
        found = json.loads(text)
    except ValueError as error:
        raise OutlineError(f"outline: not JSON: {error}") from error
    rings = [closed_ring(_xy(ring), "outline") for ring in _rings_of(found)]
    if not rings:
        raise OutlineError("outline: holds no Polygon, MultiPolygon or closed LineString")
    return rings, False


def _rings_of(found: Any) -> Iterator[Any]:
    """Give the rings of all polygons and lines of a GeoJSON object."""
    if not isinstance(found, dict):
        raise OutlineError("outline: not GeoJSON; an object with a 'type' is needed")
    kind, inside = found.get("type"), found.get("coordinates", [])
    parts = found.get("features") or found.get("geometries") or [found.get("geometry")]
    try:
        if kind == "Polygon":
            yield from inside
        elif kind == "MultiPolygon":
            for polygon in inside:
                yield from polygon
        elif kind == "LineString":
            yield inside
        elif kind in ("Feature", "FeatureCollection", "GeometryCollection"):
            for part in parts:
                if part is not None:
                    yield from _rings_of(part)
    except TypeError as error:
        raise OutlineError(f"outline: the coordinates of a {kind} are not lists") from error


def _xy(ring: Any) -> list[Any]:
    """Give x and y of positions that may have a height, too."""
    if not isinstance(ring, list):
        raise OutlineError("outline: a ring is not a list of positions")
    if len(ring) > OUTLINE_POINTS:
        raise OutlineError(f"outline: more than {OUTLINE_POINTS:,} points")
    for position in ring:
        is_pair = isinstance(position, list) and len(position) >= 2
        if not is_pair or not all(type(value) in (int, float) for value in position[:2]):
            raise OutlineError(f"outline: {str(position)[:60]} is not a position [x, y]")
    return [position[:2] for position in ring]


def read_wkt(content: bytes) -> Outline:
    """Read the polygons, or closed lines, of a well-known text.

    Raises
    ------
    OutlineError
        If it is not such a text, or a ring is open.
    """
    import shapely

    text = text_of(content).strip()
    _check_depth(text, "(", ")")
    if text.count(",") > OUTLINE_POINTS + 1000:
        raise OutlineError(f"outline: more than {OUTLINE_POINTS:,} points")
    try:
        geometry = shapely.from_wkt(re.sub(r"^SRID=\d+;", "", text))
    except shapely.GEOSException as error:
        said = " ".join(str(error).split())[:LONGEST_REASON]
        raise OutlineError(f"outline: not a well-known text: {said}") from error
    rings = []
    for part in shapely.get_parts(shapely.get_parts(geometry)):
        lines = [part.exterior, *part.interiors] if part.geom_type == "Polygon" else [part]
        if lines[0].geom_type in ("LineString", "LinearRing"):
            rings += [
                closed_ring(shapely.get_coordinates(line), "outline")
                for line in lines
                if not line.is_empty
            ]
    if not rings:
        raise OutlineError("outline: holds no POLYGON, MULTIPOLYGON or closed LINESTRING")
    return rings, False


def _check_depth(text: str, opening: str, closing: str) -> None:
    """Refuse brackets that are nested too deeply, before anything is built from them."""
    depth = 0
    for mark in re.findall(f"[{re.escape(opening + closing)}]", text):
        depth += 1 if mark in opening else -1
        if depth > FILE_DEPTH:
            raise OutlineError(f"outline: brackets are nested more than {FILE_DEPTH} deep")


def read_svg(content: bytes) -> Outline:
    """Read the closed shapes of a drawing; see :mod:`vasc.domain.svg`."""
    from vasc.domain.svg import rings_of_drawing

    return rings_of_drawing(content), True


def read_image(content: bytes) -> Outline:
    """Read the leaf of a mask or scan; see :mod:`vasc.domain.images`."""
    from vasc.domain.images import rings_of_image

    return rings_of_image(content), True


READERS: dict[str, Callable[[bytes], Outline]] = {
    ".csv": read_csv,
    ".txt": read_csv,
    ".geojson": read_geojson,
    ".json": read_geojson,
    ".wkt": read_wkt,
    ".svg": read_svg,
    **dict.fromkeys((".png", ".tif", ".tiff", ".jpg", ".jpeg"), read_image),
}
"""From the suffix of a file to what reads it."""
