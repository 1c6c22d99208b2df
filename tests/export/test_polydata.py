"""VTK PolyData, read as the documentation of VTK's XML files says."""

import base64
from xml.etree import ElementTree

import numpy as np
import pytest

from vasc.export import export, specimen
from vasc.timeline import Timeline

DTYPES = {"Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "Int8": "<i1"}


def array(element):
    """Read one array: base64, of a length in bytes as UInt64, then the numbers."""
    assert element.get("format") == "binary"
    content = base64.b64decode(element.text, validate=True)
    assert int.from_bytes(content[:8], "little") == len(content) - 8
    values = np.frombuffer(content[8:], DTYPES[element.get("type")])
    return values.reshape(-1, int(element.get("NumberOfComponents", "1")))


def read_vtp(file):
    """Read points, lines and what is said of them and of the whole."""
    root = ElementTree.parse(file).getroot()
    assert dict(root.attrib) == {
        "type": "PolyData",
        "version": "1.0",
        "byte_order": "LittleEndian",
        "header_type": "UInt64",
    }
    parts = {
        element.tag: {each.get("Name"): array(each) for each in element}
        for element in [root.find("*/FieldData"), *root.find("*/Piece")]
    }
    piece = root.find("*/Piece")
    ends = parts["Lines"]["offsets"].ravel()
    assert int(piece.get("NumberOfPoints")) == len(parts["Points"]["Points"])
    assert int(piece.get("NumberOfLines")) == len(ends)
    lines = np.split(parts["Lines"]["connectivity"].ravel(), ends[:-1]) if len(ends) else []
    return parts, lines


def test_points_and_lines_are_nodes_and_segments(timeline, tmp_path):
    parts, lines = read_vtp(export(timeline, tmp_path / "a.vtp"))
    found = specimen(timeline)
    points = parts["Points"]["Points"]
    assert points.shape[1] == 3
    np.testing.assert_array_equal(points[:, : len(found.axes)], found.positions)
    assert (points[:, len(found.axes) :] == 0.0).all()
    np.testing.assert_array_equal(np.array(lines), found.ends)
    lengths = np.linalg.norm(np.diff(points[np.array(lines)], axis=1)[:, 0], axis=1)
    np.testing.assert_allclose(parts["CellData"]["length"].ravel(), lengths)
    for name, values in (("id", found.ids), ("birth", found.births), ("radius", found.radii)):
        np.testing.assert_array_equal(parts["PointData"][name].ravel(), values)
    for name, values in (
        ("id", found.segment_ids),
        ("width", found.widths),
        ("order", found.orders),
        ("branching_order", found.branching_orders),
        ("gravelius_order", found.gravelius_orders),
        ("kind", found.kinds),
    ):
        np.testing.assert_array_equal(parts["CellData"][name].ravel(), values)
    assert parts["FieldData"]["TimeValue"].item() == found.time
    assert parts["FieldData"]["step"].item() == found.step


def test_a_series_has_a_file_a_step(runs, tmp_path):
    file = export(runs.closed, tmp_path / "growth.pvd", every=20)
    with Timeline(runs.closed) as timeline:
        last = timeline.last_step
        steps = sorted({0, *range(last, -1, -20)})
        times = {step: timeline.frame(step).time for step in steps}
        nodes = {step: len(specimen(timeline, step).ids) for step in steps}
        rings = {step: specimen(timeline, step).rings for step in steps}
    root = ElementTree.parse(file).getroot()
    assert root.get("type") == "Collection"
    named = [dict(each.attrib) for each in root.find("Collection")]
    assert len(named) == 2 * len(steps)
    for step, veins, outline in zip(steps, named[::2], named[1::2], strict=True):
        assert float(veins["timestep"]) == float(outline["timestep"]) == times[step]
        assert (veins["part"], outline["part"]) == ("0", "1")
        parts, _ = read_vtp(tmp_path / veins["file"])
        assert len(parts["Points"]["Points"]) == nodes[step]
        parts, (line,) = read_vtp(tmp_path / outline["file"])
        assert line[0] == line[-1]
        np.testing.assert_array_equal(parts["Points"]["Points"][line[:-1], :2], rings[step][0])
    files = {path.name for path in (tmp_path / "growth").iterdir()}
    assert files == {each["file"].partition("/")[2] for each in named}


def test_a_series_of_a_stem_has_no_outline_and_may_end_early(runs, tmp_path):
    file = export(runs.stem, tmp_path / "a.pvd", 10, every=4)
    named = [each.get("file") for each in ElementTree.parse(file).getroot().find("Collection")]
    assert named == [f"a/a_veins_{step}.vtp" for step in ("00", "02", "06", "10")]


def test_about_fifty_files_are_written_when_nothing_is_said(runs, tmp_path):
    export(runs.areoles, tmp_path / "a.pvd")
    assert 40 <= len(list((tmp_path / "a").iterdir())) / 2 <= 60


@pytest.mark.parametrize("step", [0, -1])
def test_two_exports_are_the_same_bytes(path, step, tmp_path):
    first = export(path, tmp_path / "a.vtp", step).read_bytes()
    assert export(path, tmp_path / "b.vtp", step).read_bytes() == first
