"""GraphML, GeoJSON, WKT and SVG say the same network to programs that are not ours."""

import json
import re
from xml.etree import ElementTree

import networkx
import numpy as np
import pytest
import shapely
from svg.path import parse_path

from vasc.analysis.statistics import flattened
from vasc.cli.stats import measured
from vasc.domain.readers import read_outline
from vasc.domain.svg import rings_of_drawing
from vasc.errors import NetworkError, VascError
from vasc.export import export, specimen
from vasc.export.drawing import lines_of
from vasc.export.specimen import KINDS
from vasc.networks_in import read_network
from vasc.timeline import Timeline

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


def test_networkx_reads_the_graph(timeline, tmp_path):
    graph = networkx.read_graphml(export(timeline, tmp_path / "a.graphml"), node_type=int)
    found, own = specimen(timeline), timeline.frame().to_networkx()
    assert graph.graph["step"] == found.step
    assert graph.graph["length_unit"] == found.unit.name
    assert graph.graph["title"] == found.title
    assert set(graph) == set(own) == set(found.ids.tolist())
    places = [[graph.nodes[node][axis] for axis in found.axes] for node in found.ids.tolist()]
    np.testing.assert_array_equal(places, found.positions)
    assert graph.number_of_edges() == len(found.ends)
    scale = found.unit.per_segment
    for start, end, said in graph.edges(data=True):
        expected = own.edges[start, end]
        for key in ("id", "vein_birth", "segment_birth", "kind"):
            assert said[key] == expected[key]
        assert said["length"] == pytest.approx(scale * expected["length"])
        assert said["width"] > 0.0
    for node, said in graph.nodes(data=True):
        for key in ("birth", "origin", "parent", "source"):
            assert said[key] == own.nodes[node][key]


def test_a_graph_without_veins_reads_too(runs, tmp_path):
    graph = networkx.read_graphml(export(runs.open, tmp_path / "a.graphml", 0))
    assert graph.number_of_nodes() == 1
    assert graph.number_of_edges() == 0


def test_shapely_reads_the_features(timeline, tmp_path):
    text = export(timeline, tmp_path / "a.geojson").read_text()
    found = specimen(timeline)
    collection = json.loads(text)
    assert collection["vasc"]["step"] == found.step
    assert collection["vasc"]["length_unit"] == found.unit.name
    veins = [each for each in collection["features"] if each["properties"]["what"] == "vein"]
    others = [each for each in collection["features"] if each["properties"]["what"] != "vein"]
    lines = shapely.from_geojson([json.dumps(each["geometry"]) for each in veins])
    np.testing.assert_allclose(
        shapely.length(lines),
        found.lengths
        if len(found.axes) == 2
        else (np.hypot(*np.diff(found.positions[found.ends], axis=1)[:, 0, :2].T)),
    )
    places = shapely.get_coordinates(lines, include_z=len(found.axes) == 3)
    np.testing.assert_array_equal(places, found.positions[found.ends].reshape(-1, len(found.axes)))
    said = [each["properties"] for each in veins]
    assert [each["segment"] for each in said] == found.segment_ids.tolist()
    nodes = [[each["proximal_node"], each["distal_node"]] for each in said]
    assert nodes == found.ids[found.ends].tolist()
    assert len({each["id"] for each in collection["features"]}) == len(collection["features"])
    assert [each["vein_birth"] for each in said] == found.vein_births.tolist()
    assert [each["segment_birth"] for each in said] == found.segment_births.tolist()
    assert [each["kind"] for each in said] == [KINDS[kind] for kind in found.kinds.tolist()]
    assert [each["width"] for each in said] == found.widths.tolist()
    assert [each["source"] for each in said] == found.segment_causes.tolist()
    assert len(others) == bool(found.rings)
    if found.rings:
        outline = shapely.from_geojson(json.dumps(others[0]["geometry"]))
        assert outline.area == pytest.approx(shapely.Polygon(found.rings[0]).area)
    # the whole file is a collection of geometries to GEOS
    assert len(shapely.get_parts(shapely.from_geojson(text))) == len(collection["features"])


def test_shapely_reads_the_text(timeline, tmp_path):
    lines = export(timeline, tmp_path / "a.wkt").read_text().splitlines()
    found = specimen(timeline)
    assert lines[:3] == [f"# {line}" for line in found.heading]
    shapes = shapely.from_wkt(lines[3:])
    if found.rings:
        assert shapes[0].geom_type == "Polygon"
        np.testing.assert_allclose(
            shapely.get_coordinates(shapes[0].exterior)[:-1], found.rings[0], rtol=1e-14
        )
        shapes = shapes[1:]
    places = shapely.get_coordinates(shapes, include_z=len(found.axes) == 3)
    expected = found.positions[found.ends].reshape(-1, len(found.axes))
    # GEOS writes 16 digits
    np.testing.assert_allclose(places, expected, rtol=1e-14)


@pytest.fixture(params=["closed", "open", "areoles"])
def leaf(request, runs):
    """Give each leaf in turn."""
    with Timeline(getattr(runs, request.param)) as timeline:
        yield timeline


def test_a_drawing_has_every_vein_at_its_width(leaf, tmp_path):
    root = ElementTree.parse(export(leaf, tmp_path / "a.svg")).getroot()
    found = specimen(leaf)
    widths = dict(zip(found.segment_ids.tolist(), found.widths.tolist(), strict=True))
    orders = dict(zip(found.segment_ids.tolist(), found.orders.tolist(), strict=True))
    lengths = dict(zip(found.segment_ids.tolist(), found.lengths.tolist(), strict=True))
    drawn = []
    for layer in root.findall(f"{SVG}g")[1:]:
        assert layer.get(f"{INKSCAPE}groupmode") == "layer"
        for path in layer.findall(f"{SVG}path"):
            ids = [int(word) for word in path.get("data-segments").split()]
            drawn += ids
            assert {orders[each] for each in ids} == {int(layer.get("data-order"))}
            for each in ids:
                assert float(path.get("stroke-width")) == pytest.approx(widths[each], rel=1e-8)
            course = parse_path(path.get("d"))
            assert course.length() == pytest.approx(sum(lengths[each] for each in ids), rel=1e-6)
            assert len(course) == len(ids) + 1
    assert sorted(drawn) == found.segment_ids.tolist()
    # the first order is drawn last, above the others
    layers = [int(each.get("data-order")) for each in root.findall(f"{SVG}g")[1:]]
    assert layers == sorted(layers, reverse=True)
    assert layers[-1] == 1


def test_a_drawing_shows_all_of_the_leaf(leaf, tmp_path):
    root = ElementTree.parse(export(leaf, tmp_path / "a.svg")).getroot()
    left, top, width, height = (float(word) for word in root.get("viewBox").split())
    found = specimen(leaf)
    assert (found.positions[:, 0] > left).all()
    assert (found.positions[:, 0] < left + width).all()
    assert (-found.positions[:, 1] > top).all()
    assert (-found.positions[:, 1] < top + height).all()
    sides = [float(root.get(side).removesuffix("mm")) for side in ("width", "height")]
    assert max(sides) == pytest.approx(200.0)
    assert sides[0] / sides[1] == pytest.approx(width / height, rel=1e-4)
    assert root.get("data-unit") == found.unit.name


def test_our_own_reader_finds_the_outline_in_a_drawing(leaf, tmp_path):
    file = export(leaf, tmp_path / "a.svg")
    found = specimen(leaf)
    (ring,) = rings_of_drawing(file.read_bytes())
    np.testing.assert_allclose(ring * [1.0, -1.0], found.rings[0], rtol=1e-7, atol=1e-6)
    (outline,) = read_outline(file, attachment="origin")
    assert np.ptp(outline[:, 1]) <= np.ptp(found.rings[0][:, 1])


def test_lines_are_as_long_as_they_can_be(leaf):
    found = specimen(leaf)
    lines = lines_of(found)
    assert sorted(row for line in lines for row in line.segments) == list(range(len(found.ends)))
    for line in lines:
        assert len(line.nodes) == len(line.segments) + 1
        steps = np.stack([line.nodes[:-1], line.nodes[1:]], axis=1)
        np.testing.assert_array_equal(steps, found.ends[list(line.segments)])
    if leaf.model == "open":
        assert len(lines) < len(found.ends) / 3


def test_a_stem_is_not_drawn_flat(runs, tmp_path):
    with pytest.raises(VascError, match=r"vasc render --unroll"):
        export(runs.stem, tmp_path / "a.svg")
    assert list(tmp_path.iterdir()) == []


def test_holes_of_an_outline_stay_holes(runs):
    from dataclasses import replace

    from vasc.export.outlines import outline_of

    with Timeline(runs.open) as timeline:
        found = specimen(timeline)
    square = np.array([[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]])
    rings = (square, square / 3.0 + 3.0, square + 20.0, square / 9.0 + 4.0)
    outline = outline_of(replace(found, rings=rings))
    assert outline.area == pytest.approx(81.0 - 9.0 + 81.0 + 1.0)
    assert outline.geom_type == "MultiPolygon"


def test_numbers_in_a_drawing_are_plain(leaf, tmp_path):
    text = export(leaf, tmp_path / "a.svg").read_text()
    assert not re.search(r"nan|inf", text.partition("</desc>")[2])


@pytest.mark.parametrize("name", ["closed", "open", "areoles"])
def test_statistics_of_the_file_are_those_of_the_run(runs, tmp_path, name):
    path = getattr(runs, name)
    file = export(path, tmp_path / "a.graphml")
    run, exported = (dict(flattened(measured(each, -1, 0))) for each in (path, file))
    # of veins of equal width the one first met is taken first, in streams and hierarchies
    tied = {key for key in run if re.match("strahler|horton|loop_asymmetry|bohn.*shuffled", key)}
    assert run.keys() - tied == exported.keys() - tied
    assert not {key for key in run if key not in tied and exported[key] != approx(run[key])}


def approx(value):
    return pytest.approx(value, rel=1e-9) if isinstance(value, float) else value


def test_a_stem_is_not_measured_as_if_it_were_flat(runs, tmp_path):
    with pytest.raises(NetworkError, match="nodes differ in z; veins must lie in a plane"):
        read_network(export(runs.stem, tmp_path / "a.graphml"))


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("length_unit", "a\x85m", "length_unit is"),
        ("step", "one", "step is 'one'; it must be a number"),
        ("blade_length", "nan", "blade_length is 'nan'; it must be a number"),
        ("outline", "POINT (0 0)", "outline is 'POINT .0 0.'; it must be a POLYGON"),
        ("outline", "a leaf", "outline is 'a leaf'; it must be a POLYGON"),
    ],
)
def test_exports_that_were_changed_are_refused(runs, tmp_path, key, value, said):
    file = export(runs.closed, tmp_path / "a.graphml")
    found = re.sub(f'(<data key="graph_{key}">)[^<]*', rf"\g<1>{value}", file.read_text())
    file.write_text(found)
    with pytest.raises(NetworkError, match=said):
        read_network(file)
