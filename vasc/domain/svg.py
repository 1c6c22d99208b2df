"""Closed shapes of SVG drawings as rings of points; y points down, as in the file."""

import re
from collections.abc import Callable, Iterator
from xml.parsers import expat

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Points
from vasc.domain.checks import place, without_repeats
from vasc.errors import OutlineError
from vasc.limits import FILE_DEPTH, OUTLINE_POINTS

CURVE_STEPS = 48
"""Straight pieces that stand for one curve of a path."""
NOT_DRAWN = {"defs", "symbol", "clipPath", "mask", "pattern", "marker", "metadata"}
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
EMPTY = re.compile(r"(?:^|;)\s*fill\s*:\s*none\s*(?:;|$)")
TRANSFORM = re.compile(r"\s*(\w+)\s*\(([^()]*)\)[\s,]*")

Attributes = dict[str, str]
Affine = NDArray[np.float64]


def rings_of_drawing(content: bytes) -> list[Points]:
    """Give the outlines of all paths, polygons, rectangles, circles and ellipses.

    Parameters
    ----------
    content : bytes
        The file.

    Returns
    -------
    list of ndarray of shape (n, 2), float64
        In the user units of the drawing, transforms applied, y downward.

    Raises
    ------
    OutlineError
        If it is not well-formed, declares a document type or entities, is nested
        too deeply, has too many points, open subpaths, nothing closed or
        coordinates beyond the range of numbers.
    """
    drawing = _Drawing()
    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = _refuse_doctype
    parser.EntityDeclHandler = _refuse_doctype
    parser.StartElementHandler = drawing.start
    parser.EndElementHandler = drawing.end
    try:
        # numbers, and products of transforms, beyond the range are told of below
        with np.errstate(over="ignore", invalid="ignore"):
            parser.Parse(content, True)
    except expat.ExpatError as error:
        raise OutlineError(f"outline: not a well-formed SVG file: {error}") from error
    if not drawing.rings:
        raise OutlineError(
            "outline: holds no closed <path>, <polygon>, <rect>, <circle> or <ellipse>"
        )
    if not all(np.isfinite(ring).all() for ring in drawing.rings):
        raise OutlineError("outline: a shape has coordinates that are not finite")
    return drawing.rings


def _refuse_doctype(*_: object) -> None:
    """Refuse document types and with them all entities: none is needed for an outline."""
    raise OutlineError("outline: the SVG file declares a DOCTYPE or entities; remove them")


class _Drawing:
    """Collects rings while the elements of a drawing go by."""

    def __init__(self) -> None:
        self.rings: list[Points] = []
        self.transforms: list[Affine] = [np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])]
        self.n_hidden = 0
        self.n_points = 0

    def start(self, tag: str, attributes: Attributes) -> None:
        """Take in an element and, if it is a shape, its outline."""
        name = tag.rpartition(":")[2]
        if len(self.transforms) > FILE_DEPTH:
            raise OutlineError(f"outline: elements are nested more than {FILE_DEPTH} deep")
        motion = _after(self.transforms[-1], attributes.get("transform", ""))
        self.transforms.append(motion)
        if self.n_hidden or name in NOT_DRAWN:
            self.n_hidden += 1
            return
        if name not in SHAPE_READERS:
            return
        for ring in SHAPE_READERS[name](attributes):
            self.n_points += len(ring)
            if self.n_points > OUTLINE_POINTS:
                raise OutlineError(f"outline: more than {OUTLINE_POINTS:,} points")
            x, y = ring[:, 0], ring[:, 1]
            moved = np.stack([a * x + b * y + c for a, b, c in motion], axis=1)
            self.rings.append(without_repeats(moved))

    def end(self, tag: str) -> None:
        """Leave an element."""
        self.transforms.pop()
        self.n_hidden = max(0, self.n_hidden - 1)


def _after(outer: Affine, text: str) -> Affine:
    """Give a transform that is followed by an outer one; both map x, y, 1."""
    motion, at = outer, 0
    text = text.strip()
    while at < len(text):
        match = TRANSFORM.match(text, at)
        if match is None:
            raise OutlineError(f"outline: transform '{text[:60]}' cannot be read")
        inner = _one_transform(match[1], _numbers(match[2], "transform"))
        motion = np.stack(
            [
                [
                    row[0] * inner[0][k] + row[1] * inner[1][k] + (row[2] if k == 2 else 0.0)
                    for k in range(3)
                ]
                for row in motion
            ]
        )
        at = match.end()
    return motion


def _one_transform(kind: str, values: list[float]) -> list[list[float]]:
    """Give one function of a transform as two rows."""
    match kind, values:
        case "matrix", [a, b, c, d, e, f]:
            return [[a, c, e], [b, d, f]]
        case "translate", [x, *rest] if len(rest) < 2:
            return [[1.0, 0.0, x], [0.0, 1.0, rest[0] if rest else 0.0]]
        case "scale", [x, *rest] if len(rest) < 2:
            return [[x, 0.0, 0.0], [0.0, rest[0] if rest else x, 0.0]]
        case "rotate", [angle, *center] if len(center) in (0, 2):
            x, y = center or (0.0, 0.0)
            sine, cosine = float(np.sin(np.pi * angle / 180)), float(np.cos(np.pi * angle / 180))
            return [
                [cosine, -sine, x - cosine * x + sine * y],
                [sine, cosine, y - sine * x - cosine * y],
            ]
    raise OutlineError(
        f"outline: transform {kind[:60]} with {len(values)} numbers cannot be read;"
        " known are matrix, translate, scale and rotate"
    )


def _numbers(text: str, name: str) -> list[float]:
    """Give the numbers of an attribute."""
    if NUMBER.sub("", text).strip(" \t\r\n,"):
        raise OutlineError(f"outline: {name} '{text[:60]}' is not a list of numbers")
    return [float(number) for number in NUMBER.findall(text)]


def _size(attributes: Attributes, name: str, default: float = 0.0) -> float:
    """Give an attribute that is one number, perhaps in px."""
    if name not in attributes:
        return default
    values = _numbers(attributes[name].strip().removesuffix("px"), name)
    if len(values) != 1:
        raise OutlineError(f"outline: {name} '{attributes[name][:60]}' is not a number")
    return values[0]


def _polygon(attributes: Attributes) -> Iterator[Points]:
    """Give the corners of a polygon."""
    values = _numbers(attributes.get("points", ""), "points")
    if len(values) % 2 or not values:
        raise OutlineError(f"outline: a polygon has {len(values)} numbers; pairs are needed")
    yield np.array(values).reshape(-1, 2)


def _rectangle(attributes: Attributes) -> Iterator[Points]:
    """Give the corners of a rectangle."""
    x, y = _size(attributes, "x"), _size(attributes, "y")
    width, height = _size(attributes, "width"), _size(attributes, "height")
    yield np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])


def _ellipse(attributes: Attributes) -> Iterator[Points]:
    """Give points of a circle or ellipse."""
    radius = _size(attributes, "r")
    center = np.array([_size(attributes, "cx"), _size(attributes, "cy")])
    radii = np.array([_size(attributes, "rx", radius), _size(attributes, "ry", radius)])
    angles = 2.0 * np.pi * np.arange(4 * CURVE_STEPS) / (4 * CURVE_STEPS)
    yield center + radii * np.stack([np.sin(angles), np.cos(angles)], axis=1)


def _path(attributes: Attributes) -> Iterator[Points]:
    """Give the closed subpaths of a path."""
    from svg.path import Close, Line, Move, parse_path

    text = attributes.get("d", "").strip()
    if not text or _is_mere_line(attributes, text):
        return
    if sum(1 for _ in NUMBER.finditer(text)) > 2 * OUTLINE_POINTS:
        raise OutlineError(f"outline: a path has more than {OUTLINE_POINTS:,} points")
    try:
        segments = parse_path(text)
        points: list[complex] = []
        is_closed = False
        for segment in segments:
            if isinstance(segment, Move):
                yield from _finished(points, is_closed)
                points, is_closed = [segment.end], False
            elif isinstance(segment, Close):
                is_closed = True
            else:
                if is_closed:
                    # drawing goes on from where the closed subpath began
                    yield from _finished(points, is_closed)
                    points, is_closed = [segment.start], False
                n_steps = 1 if isinstance(segment, Line) else CURVE_STEPS
                points += [segment.point(k / n_steps) for k in range(1, n_steps)]
                points.append(segment.end)
            if len(points) > OUTLINE_POINTS:
                raise OutlineError(f"outline: more than {OUTLINE_POINTS:,} points")
        yield from _finished(points, is_closed)
    except (ValueError, IndexError, TypeError, AssertionError, ArithmeticError) as error:
        raise OutlineError(
            f"outline: path '{text[:40]}' cannot be read: {str(error)[:80]}"
        ) from error


def _is_mere_line(attributes: Attributes, text: str) -> bool:
    """Tell whether a path is drawn as a line: it is marked as not filled and nowhere closed."""
    is_empty = attributes.get("fill") == "none" or EMPTY.search(attributes.get("style", ""))
    return bool(is_empty) and "z" not in text.lower()


def _finished(points: list[complex], is_closed: bool) -> Iterator[Points]:
    """Give a subpath as a ring, if it has any length."""
    if len(points) < 2:
        return
    ring = np.array([[point.real, point.imag] for point in points])
    gap = float(np.abs(ring[0] - ring[-1]).max())
    extent = float(np.ptp(ring, axis=0).max())
    if not is_closed and gap > 1e-6 * extent:
        raise OutlineError(
            f"outline: a path is open; it starts at {place(ring[0])} and ends at"
            f" {place(ring[-1])}; close it with Z"
        )
    # an end that misses the start by rounding alone is the start
    yield ring[:-1] if gap <= 1e-6 * extent else ring


SHAPE_READERS: dict[str, Callable[[Attributes], Iterator[Points]]] = {
    "path": _path,
    "polygon": _polygon,
    "rect": _rectangle,
    "circle": _ellipse,
    "ellipse": _ellipse,
}
"""From the name of an element to what reads it."""
