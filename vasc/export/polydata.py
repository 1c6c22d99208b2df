"""Veins as VTK PolyData: a step, or a series of steps for ParaView."""

import base64
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Points
from vasc.export.specimen import Specimen, specimens
from vasc.export.words import as_bytes, xml_comment
from vasc.timeline import Timeline

OPENING = '<VTKFile type="{}" version="1.0" byte_order="LittleEndian" header_type="UInt64">'
TYPES = {"f8": "Float64", "i4": "Int32", "i8": "Int64", "i1": "Int8"}
"""From numpy's names of number types to those of VTK."""
DEFAULT_FILES = 50
"""Steps of a series where no distance is given, about."""


def vtp(specimen: Specimen) -> bytes:
    """Give the veins of a step as VTK PolyData.

    Parameters
    ----------
    specimen : Specimen
        The step.

    Returns
    -------
    bytes
        A point a node, a line a segment from its proximal to its distal node. A leaf lies in
        the plane z = 0. Origins and kinds are codes.
    """
    of_points: dict[str, NDArray] = {
        "id": specimen.ids,
        "birth": specimen.births,
        "parent": specimen.parents,
        "source": specimen.causes,
        "origin": specimen.origins,
        "radius": specimen.radii,
    }
    of_lines: dict[str, NDArray] = {
        "id": specimen.segment_ids,
        "vein_birth": specimen.vein_births,
        "segment_birth": specimen.segment_births,
        "kind": specimen.kinds,
        "order": specimen.orders,
        "branching_order": specimen.branching_orders,
        "gravelius_order": specimen.gravelius_orders,
        "width": specimen.widths,
        "length": specimen.lengths,
        "source": specimen.segment_causes,
    }
    starts = 2 * np.arange(1, len(specimen.ends) + 1, dtype=np.int64)
    return _polydata(
        specimen, specimen.positions, (specimen.ends.ravel(), starts), of_points, of_lines
    )


def outline_vtp(specimen: Specimen) -> bytes:
    """Give the outline of a step as VTK PolyData, a closed line a ring."""
    points = np.concatenate([np.empty((0, 2)), *specimen.rings])
    corners, n_before = [np.empty(0, dtype=np.int64)], 0
    for ring in specimen.rings:
        corners.append(n_before + np.r_[np.arange(len(ring)), 0])
        n_before += len(ring)
    ends = np.cumsum([len(ring) + 1 for ring in specimen.rings], dtype=np.int64)
    return _polydata(specimen, points, (np.concatenate(corners), ends), {}, {})


def steps_of(timeline: Timeline, last: int, every: int | None) -> list[int]:
    """Choose the steps of a series: from the last one back, and step 0.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    last : int
        The last step; -1 is the last recorded.
    every : int, optional
        Steps from one to the next; if left out, so many that there are about fifty.

    Returns
    -------
    list of int
        Ascending, with 0 and the last.

    Raises
    ------
    TimelineError
        If the last step was not recorded.
    """
    last = timeline.frame(last).step
    every = every or max(1, round(last / DEFAULT_FILES))
    return sorted({0, *range(last, -1, -every)})


def write_series(timeline: Timeline, folder: Path, steps: Sequence[int], name: str) -> list[str]:
    """Fill a folder with the steps of a series.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    folder : Path
        An empty folder.
    steps : sequence of int
        The steps, ascending.
    name : str
        What the names of its files begin with, and what the folder will be called.

    Returns
    -------
    list of str
        The lines of the collection, which lies beside the folder: time, and name of the file;
        part 0 are the veins, part 1 is the outline.

    Raises
    ------
    TimelineError
        If a step was not recorded, or cannot be read.
    """
    digits = len(str(max(steps)))
    lines, heading = [], ("", "", "")
    for each in specimens(timeline, steps):
        parts = [("veins", vtp(each))] + ([("outline", outline_vtp(each))] if each.rings else [])
        for part, (word, content) in enumerate(parts):
            file = f"{name}_{word}_{each.step:0{digits}d}.vtp"
            (folder / file).write_bytes(content)
            place = quoteattr(f"{name}/{file}")
            lines.append(f'<DataSet timestep="{each.time!r}" part="{part}" file={place}/>')
        heading = each.heading
    moment = f"steps {steps[0]} to {steps[-1]}, {len(steps)} of them; the last is {heading[1]}"
    return [
        '<?xml version="1.0"?>',
        xml_comment((heading[0], moment, heading[2])),
        OPENING.format("Collection"),
        "<Collection>",
        *lines,
        "</Collection>",
        "</VTKFile>",
    ]


def _polydata(
    specimen: Specimen,
    points: Points,
    lines: tuple[NDArray, NDArray],
    of_points: Mapping[str, NDArray],
    of_lines: Mapping[str, NDArray],
) -> bytes:
    """Give points and lines, and what is said of them, as a file."""
    corners, ends = lines
    places = np.zeros((len(points), 3))
    places[:, : points.shape[1]] = points
    moment = {
        "TimeValue": np.array([specimen.time]),
        "step": np.array([specimen.step], dtype=np.int32),
    }
    return as_bytes(
        [
            '<?xml version="1.0"?>',
            xml_comment(specimen.heading),
            OPENING.format("PolyData"),
            "<PolyData>",
            "<FieldData>",
            *(_array(name, values, is_field=True) for name, values in moment.items()),
            "</FieldData>",
            f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="{len(ends)}"'
            ' NumberOfStrips="0" NumberOfPolys="0">',
            *_section("PointData", of_points),
            *_section("CellData", of_lines),
            *_section("Points", {"Points": places}),
            *_section(
                "Lines",
                {"connectivity": corners.astype(np.int64), "offsets": ends.astype(np.int64)},
            ),
            "</Piece>",
            "</PolyData>",
            "</VTKFile>",
        ]
    )


def _section(name: str, arrays: Mapping[str, NDArray]) -> Iterator[str]:
    """Give one part of a piece."""
    yield f"<{name}>"
    yield from (_array(word, values) for word, values in arrays.items())
    yield f"</{name}>"


def _array(name: str, values: NDArray, *, is_field: bool = False) -> str:
    """Give numbers as VTK has them in XML: in base64, after their length in bytes."""
    kind = TYPES[values.dtype.str[1:]]
    content = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<")).tobytes()
    text = base64.b64encode(len(content).to_bytes(8, "little") + content).decode()
    count = f' NumberOfTuples="{len(values)}"' if is_field else ""
    wide = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
    return f'<DataArray type="{kind}" Name="{name}"{wide}{count} format="binary">{text}</DataArray>'
