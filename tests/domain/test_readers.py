"""Outlines from text files: every format gives back a known leaf, and bad files say why."""

import json

import numpy as np
import pytest
import shapely

from vasc.domain import read_outline
from vasc.errors import OutlineError

LEAF = np.array([[10.0, 5.0], [14.0, 9.0], [13.0, 17.0], [10.0, 25.0], [7.0, 18.0], [5.0, 9.0]])
UNIT = (LEAF - [10.0, 5.0]) / 20.0
HOLE = np.array([[9.0, 10.0], [9.0, 12.0], [11.0, 12.0], [11.0, 10.0]])


def closed(ring):
    return [*ring.tolist(), ring[0].tolist()]


def pairs(ring, separator=" ", between=","):
    return between.join(separator.join(map(repr, point)) for point in ring.tolist())


def geojson(kind="Polygon", coordinates=None):
    return {"type": kind, "coordinates": coordinates or [closed(LEAF)]}


def svg(content):
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 30">{content}</svg>'


DOWN = LEAF * [1.0, -1.0] + [0.0, 30.0]
RELATIVE = pairs(np.diff(DOWN, axis=0), " ", " ")
FILES = {
    "plain.csv": pairs(LEAF, ",", "\n"),
    "header.csv": "x,y\n" + pairs(LEAF, ",", "\n"),
    "closed.csv": "# traced by hand\nx,y\n" + pairs(np.array(closed(LEAF)), ",", "\n") + "\n\n",
    "semicolon.csv": pairs(LEAF, "; ", "\r\n"),
    "tabs.txt": pairs(LEAF, "\t", "\n"),
    "spaces.txt": pairs(LEAF, "  ", "\n"),
    "clockwise.csv": pairs(LEAF[::-1], ",", "\n"),
    "bom.csv": "\ufeffx,y\n" + pairs(LEAF, ",", "\n"),
    "polygon.geojson": json.dumps(geojson()),
    "height.json": json.dumps(geojson(coordinates=[[[*p, 3.0] for p in closed(LEAF)]])),
    "feature.geojson": json.dumps({"type": "Feature", "properties": {}, "geometry": geojson()}),
    "collection.geojson": json.dumps(
        {
            "type": "FeatureCollection",
            "features": [
                {"type": "Feature", "geometry": None},
                {"type": "Feature", "geometry": {"type": "Point", "coordinates": [1, 2]}},
                {"type": "Feature", "geometry": geojson("MultiPolygon", [[closed(LEAF)]])},
            ],
        }
    ),
    "line.geojson": json.dumps(geojson("LineString", closed(LEAF))),
    "polygon.wkt": f"POLYGON (({pairs(np.array(closed(LEAF)))}))",
    "srid.wkt": f"SRID=4326;MULTIPOLYGON ((({pairs(np.array(closed(LEAF)))})))\n",
    "line.wkt": f"GEOMETRYCOLLECTION (POINT (1 2), LINESTRING ({pairs(np.array(closed(LEAF)))}))",
    "absolute.svg": svg(f'<path d="M {pairs(DOWN, ",", " L ")} Z"/>'),
    "implicit.svg": svg(f'<path d="M{pairs(DOWN, " ", " ")}z"/>'),
    "relative.svg": svg(f'<path d="m {pairs(DOWN[:1])} {RELATIVE} z"/>'),
    "closed-by-hand.svg": svg(f'<path d="M {pairs(np.array(closed(DOWN)), " ", " ")}"/>'),
    "polygon.svg": svg(f'<g><polygon points="{pairs(DOWN)}"/></g>'),
    "moved.svg": svg(
        f'<g transform="translate(100, -7) scale(2)"><path transform="matrix(.5 0 0 .5 3 4)"'
        f' d="M {pairs(DOWN, " ", " ")} Z"/></g>'
    ),
    "half-turn.svg": svg(f'<polygon transform="rotate(180 4 5)" points="{pairs(8.0 - DOWN)}"/>'),
}


@pytest.mark.parametrize("name", FILES)
def test_every_format_gives_the_leaf(name, tmp_path):
    path = tmp_path / name
    path.write_bytes(FILES[name].encode())
    (ring,) = read_outline(path)
    assert shapely.LinearRing(ring).is_ccw
    found = np.roll(ring, -int(np.argmin((ring * ring).sum(axis=1))), axis=0)
    np.testing.assert_allclose(found, UNIT, atol=1e-12)


HOLED = {
    "rings.csv": "x,y,ring\n"
    + "".join(f"{x},{y},a\n" for x, y in LEAF)
    + "".join(f"{x},{y},b\n" for x, y in HOLE),
    "holed.geojson": json.dumps(geojson(coordinates=[closed(LEAF), closed(HOLE)])),
    "holed.wkt": f"POLYGON (({pairs(np.array(closed(LEAF)))}), ({pairs(np.array(closed(HOLE)))}))",
    "holed.svg": svg(
        f'<path d="M {pairs(DOWN, " ", " ")} Z M {pairs(HOLE * [1, -1] + [0, 30], " ", " ")} Z"/>'
    ),
}


@pytest.mark.parametrize("name", HOLED)
def test_holes_are_kept(name, tmp_path):
    (tmp_path / name).write_text(HOLED[name])
    rings = read_outline(tmp_path / name)
    areas = sorted(shapely.Polygon(ring).area for ring in rings)
    assert areas == pytest.approx([4.0 / 400.0, shapely.Polygon(UNIT).area])


def test_curves_of_paths_are_followed(tmp_path):
    # a circle of radius 10 about (0, 0): two arcs, four cubics, and an ellipse; quadratics are near
    k = 5.522847498
    drawings = {
        "arcs": '<path d="M 0 10 A 10 10 0 0 1 0 -10 a 10 10 0 0 1 0 20 Z"/>',
        "cubics": f'<path d="M0,10 C{k},10 10,{k} 10,0 S{k},-10 0,-10 s-10,{10 - k} -10,10'
        f' S-{k},10 0,10 Z"/>',
        "ellipse": '<ellipse rx="10" ry="10px"/>',
        "circle": '<circle r="10"/>',
    }
    for name, drawing in drawings.items():
        path = tmp_path / f"{name}.svg"
        path.write_text(svg(drawing))
        (ring,) = read_outline(path)
        # attachment at the lowest point, height 20
        radii = np.sqrt(((ring - [0.0, 0.5]) ** 2).sum(axis=1))
        np.testing.assert_allclose(radii, 0.5, atol=3e-4)
        assert len(ring) > 90
    (tmp_path / "q.svg").write_text(
        svg('<path d="M0 0 Q 20 0 20 -20 T 0 -40 H -10 V -1 L 0 0 Z"/>')
    )
    (ring,) = read_outline(tmp_path / "q.svg")
    # the first parabola passes through a quarter of its control point
    on_curve = np.array([15.0, 5.0]) / 40.0
    assert np.abs(ring - on_curve).max(axis=1).min() < 1e-12


def test_what_is_not_drawn_is_not_read(tmp_path):
    path = tmp_path / "defs.svg"
    hidden = "<defs><g><rect width='3' height='3'/></g></defs><clipPath><circle r='5'/></clipPath>"
    path.write_text(svg(f'{hidden}<line x1="0" x2="9"/><polygon points="{pairs(DOWN)}"/>'))
    assert len(read_outline(path)) == 1


def test_attachment_and_tip_may_be_given(tmp_path):
    # a leaf that lies on its side, its petiole at the right
    sideways = np.stack([-UNIT[:, 1], UNIT[:, 0]], axis=1) * 8.0 + [50.0, 7.0]
    path = tmp_path / "sideways.csv"
    path.write_text(pairs(sideways, ",", "\n"))
    for tip in ([42.0, 7.0], "farthest"):
        (ring,) = read_outline(path, attachment=(50.0, 7.0), tip=tip)
        np.testing.assert_allclose(ring, UNIT, atol=1e-12)
    # in a drawing, points are given as they stand in the file, y downward
    path = tmp_path / "sideways.svg"
    path.write_text(svg(f'<polygon points="{pairs(sideways * [1.0, -1.0])}"/>'))
    (ring,) = read_outline(path, attachment=(50.0, -7.0), tip=(42.0, -7.0))
    assert shapely.Polygon(ring).equals_exact(shapely.Polygon(UNIT), 1e-9) or np.allclose(
        np.sort(ring, axis=0), np.sort(UNIT, axis=0)
    )


def test_the_middle_of_a_straight_base_is_the_attachment(tmp_path):
    path = tmp_path / "box.csv"
    path.write_text("2,1\n4,1\n4,5\n2,5\n")
    (ring,) = read_outline(path)
    assert ring.tolist() == [[-0.25, 0.0], [0.25, 0.0], [0.25, 1.0], [-0.25, 1.0]]


BAD = {
    "none.csv": (None, "cannot be read: No such file"),
    "leaf.doc": ("", "a file ending in '.doc' cannot be read; known are .csv"),
    "empty.csv": ("", "outline: empty"),
    "only-header.csv": ("x,y\n", "outline: empty"),
    "turned.csv": ("y,x\n0,0\n0,4\n1,2\n", "the header is 'y, x'; the columns must be x, y"),
    "places.csv": ("lat,lon\n0,0\n0,4\n1,2\n", "the columns must be x, y"),
    "ids.csv": ("id,x,y\n0,0,1\n1,4,1\n2,1,2\n", "the columns must be x, y"),
    "two.csv": ("0,0\n1,1\n", "2 points; it needs at least 3"),
    "word.csv": ("0,0\n1,one\n2,0\n", "line 2 is '1, one'; it must be x, y"),
    "typing-error.csv": ("0,O\n1,1\n2,0\n", "line 1 is '0, O'; it must be x, y"),
    "one-column.csv": ("0,0\n1\n2,0\n", "line 2 is '1'"),
    "nan.csv": ("0,0\nnan,1\n2,0\n", "row 1 is [nan, 1.0]"),
    "repeated.csv": ("0,0\n1,1\n1,1\n0,1\n", "rows 1 and 2 are the same point (1, 1)"),
    "crossing.csv": ("0,0\n4,4\n4,1\n0,4\n", "crosses or touches itself at (2.28571, 2.28571)"),
    "line.csv": ("0,0\n1,1\n2,2\n", "area 0"),
    "latin.csv": ("é".encode("latin-1"), "not a text in UTF-8"),
    "broken.json": ('{"type": ', "not JSON"),
    "list.json": ("[1, 2]", "not GeoJSON"),
    "point.json": ('{"type": "Point", "coordinates": [1, 2]}', "holds no Polygon"),
    "open.json": (
        json.dumps(geojson(coordinates=[LEAF.tolist()])),
        "open; it starts at (10, 5) and ends at (5, 9)",
    ),
    "strings.json": (
        json.dumps(geojson(coordinates=[[["1", "2"]] * 4])),
        "['1', '2'] is not a position",
    ),
    "number.json": ('{"type": "Polygon", "coordinates": 3}', "coordinates of a Polygon are not"),
    "deep-number.json": ('{"type": "Polygon", "coordinates": [3]}', "not a list of positions"),
    "huge-number.json": (
        json.dumps(geojson(coordinates=[[[0, 0], [1, 0], [0, 10**400], [0, 0]]])),
        "holds a number that is too large",
    ),
    "words.wkt": ("a leaf", "not a well-known text"),
    "point.wkt": ("POINT (1 2)", "holds no POLYGON"),
    "empty.wkt": ("POLYGON EMPTY", "holds no POLYGON"),
    "open.wkt": ("LINESTRING (0 0, 4 0, 4 4)", "open; it starts at (0, 0) and ends at (4, 4)"),
    "words.svg": ("a leaf", "not a well-formed SVG"),
    "empty.svg": (svg(""), "holds no closed <path>"),
    "open.svg": (svg('<path d="M0 0 L9 0 L9 2"/>'), "a path is open; it starts at (0, 0) and ends"),
    "second-open.svg": (
        svg('<path d="M0 0 L9 0 L9 2 Z M 20 0 L 29 0 L 29 2"/>'),
        "it starts at (20, 0) and ends at (29, 2)",
    ),
    "half-command.svg": (svg('<path d="M0 0 L9"/>'), "path 'M0 0 L9' cannot be read"),
    "no-move.svg": (svg('<path d="9 9 L 3 3"/>'), "cannot be read"),
    "flags.svg": (svg('<path d="M0 0 A 1 1 0 0"/>'), "cannot be read"),
    "odd.svg": (svg('<polygon points="0 0 1 1 2"/>'), "a polygon has 5 numbers"),
    "percent.svg": (svg('<rect width="50%" height="2"/>'), "width '50%' is not a list of numbers"),
    "skew.svg": (
        svg('<g transform="skewX(30)"><rect width="5" height="2"/></g>'),
        "transform skewX with 1 numbers cannot be read; known are",
    ),
    "bad-transform.svg": (svg('<g transform="move"/>'), "transform 'move' cannot be read"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_refused_in_one_line(name, tmp_path):
    content, said = BAD[name]
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(OutlineError) as caught:
        read_outline(path)
    message = str(caught.value)
    assert message.startswith("outline: ")
    assert said in message
    assert "\n" not in message


@pytest.mark.parametrize(
    ("attachment", "tip", "said"),
    [
        ((10.0, 25.0), "highest", "attachment (10, 25): no point of the outline is above it"),
        ((10.0, 5.0), (10.0, 5.0), "tip (10, 5): must not be the attachment"),
    ],
)
def test_an_attachment_that_cannot_be_is_refused(attachment, tip, said, tmp_path):
    path = tmp_path / "leaf.csv"
    path.write_text(FILES["plain.csv"])
    with pytest.raises(OutlineError) as caught:
        read_outline(path, attachment=attachment, tip=tip)
    assert said in str(caught.value)


@pytest.mark.parametrize("mark", ['fill="none"', 'style="stroke: black; fill: none"'])
def test_a_path_that_is_a_mere_line_is_no_outline(mark, tmp_path):
    path = tmp_path / "leaf.svg"
    line = f'<path d="M0 0 L9 0 L9 2" {mark}/>'
    path.write_text(svg(f'{line}<polygon points="{pairs(DOWN)}"/>'))
    assert len(read_outline(path)) == 1
    # a closed path that is not filled is one
    path.write_text(svg(f'{line}<path d="M {pairs(DOWN, ",", " L ")} Z" {mark}/>'))
    assert len(read_outline(path)) == 1
    path.write_text(svg(line))
    with pytest.raises(OutlineError, match="holds no closed <path>"):
        read_outline(path)
