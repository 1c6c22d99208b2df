"""Leaves as SVG drawings: veins as paths of their true width, a layer for every order."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby, pairwise
from xml.sax.saxutils import escape, quoteattr

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.ways import ways
from vasc.arrays import Points
from vasc.errors import VascError
from vasc.export.specimen import KINDS, Specimen
from vasc.export.words import as_bytes, xml_comment

LONGER_SIDE = 200.0
"""Of the drawing on paper, in mm."""
MARGIN = 0.02
"""Space around the blade, as a share of its longer side."""
BLADE_COLOR = "#edf4e6"
MARGIN_COLOR = "#8fae7f"
VEIN_COLOR = "#2f7a3f"
LAYER = 'inkscape:groupmode="layer" inkscape:label='


@dataclass(frozen=True)
class Line:
    """Segments of one order, kind and width that follow each other.

    Parameters
    ----------
    nodes : tuple of int
        Rows of its nodes, from proximal to distal.
    segments : tuple of int
        Rows of its segments, one less than nodes.
    """

    nodes: tuple[int, ...]
    segments: tuple[int, ...]


def svg(specimen: Specimen) -> bytes:
    """Give a leaf as an SVG drawing.

    Parameters
    ----------
    specimen : Specimen
        The step.

    Returns
    -------
    bytes
        One user unit is one unit of length, y downward as SVG has it; the paper is
        200 mm on its longer side. The outline is a layer, the veins of every order
        are one, thick veins above thin ones.

    Raises
    ------
    VascError
        If it is a stem.
    """
    if not specimen.rings:
        raise VascError("svg holds leaves; `vasc render --unroll` lays a stem flat")
    corners = np.concatenate([np.concatenate(specimen.rings), specimen.positions]) * [1.0, -1.0]
    low, high = corners.min(axis=0), corners.max(axis=0)
    low, high = low - MARGIN * (high - low).max(), high + MARGIN * (high - low).max()
    width, height = (high - low).tolist()
    paper = LONGER_SIDE / max(width, height)
    return as_bytes(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            xml_comment(specimen.heading),
            '<svg xmlns="http://www.w3.org/2000/svg"'
            ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" version="1.1"'
            f' width="{width * paper:.6g}mm" height="{height * paper:.6g}mm"'
            f' viewBox="{low[0]:.9g} {low[1]:.9g} {width:.9g} {height:.9g}"'
            f" data-run={quoteattr(specimen.run)}"
            f' data-step="{specimen.step}" data-unit={quoteattr(specimen.unit.name)}>',
            f"<title>{escape(specimen.title or specimen.run)}</title>",
            f"<desc>{escape('; '.join(specimen.heading))}</desc>",
            *_outline(specimen),
            *_veins(specimen),
            "</svg>",
        ]
    )


def lines_of(specimen: Specimen) -> list[Line]:
    """Join segments of one order, kind and width to lines.

    Parameters
    ----------
    specimen : Specimen
        The step.

    Returns
    -------
    list of Line
        Each segment in one of them; lines of the same look follow each other.
    """
    found = []
    d = specimen.unit.per_segment
    looks = np.stack(
        [specimen.orders, specimen.kinds, np.round(specimen.widths / d, 9)], axis=1
    ).astype(np.float64)
    _, classes = np.unique(looks, axis=0, return_inverse=True)
    for rows in _rows_of_each(classes.ravel()):
        pairs = specimen.ends[rows]
        by_ends = {
            tuple(pair): row for pair, row in zip(pairs.tolist(), rows.tolist(), strict=True)
        }
        for way in ways(pairs):
            # lines end where a way turns from inward to outward, or back
            for is_outward, steps in groupby(pairwise(way), by_ends.__contains__):
                forward = list(steps)
                course = forward if is_outward else [step[::-1] for step in reversed(forward)]
                nodes = (course[0][0], *(distal for _, distal in course))
                found.append(Line(nodes, tuple(by_ends[step] for step in course)))
    return found


def _rows_of_each(classes: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    """Give the rows of every class."""
    if not len(classes):
        return []
    order = np.argsort(classes, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(classes[order])) + 1)


def _outline(specimen: Specimen) -> Iterator[str]:
    """Give the layer of the outline."""
    rings = " ".join(f"{_course(ring)} Z" for ring in specimen.rings)
    yield f'<g id="outline" {LAYER}"outline">'
    yield (
        f'<path d="{rings}" fill="{BLADE_COLOR}" fill-rule="evenodd" stroke="{MARGIN_COLOR}"'
        ' stroke-width="0.5px" vector-effect="non-scaling-stroke"/>'
    )
    yield "</g>"


def _veins(specimen: Specimen) -> Iterator[str]:
    """Give a layer for every order of veins, the first one on top."""
    by_order: dict[int, list[Line]] = {}
    for line in lines_of(specimen):
        by_order.setdefault(int(specimen.orders[line.segments[0]]), []).append(line)
    for order in sorted(by_order, reverse=True):
        yield (
            f'<g id="order-{order}" {LAYER}"veins of order {order}" data-order="{order}"'
            f' stroke="{VEIN_COLOR}" stroke-linecap="round" stroke-linejoin="round">'
        )
        yield from (_path(specimen, line) for line in by_order[order])
        yield "</g>"


def _path(specimen: Specimen, line: Line) -> str:
    """Give one line as a path."""
    first = line.segments[0]
    width = f"{specimen.widths[first]:.9g}"
    ids = " ".join(str(specimen.segment_ids[row]) for row in line.segments)
    # fill stands on each path, so that a reader of outlines sees that it is a line
    return (
        f'<path d="{_course(specimen.positions[list(line.nodes)])}" fill="none"'
        f' stroke-width="{width}" data-width="{width}"'
        f' data-kind="{KINDS[specimen.kinds[first]]}"'
        f' data-vein-birth="{specimen.vein_births[first]}"'
        f' data-source="{specimen.segment_causes[first]}" data-segments="{ids}"/>'
    )


def _course(points: Points) -> str:
    """Give points as the commands of a path."""
    return "M " + " L ".join(f"{x:.9g},{0.0 - y:.9g}" for x, y in points.tolist())
