"""Small sound files of every format that vasc reads, by suffix."""

import io
import json

import numpy as np
from PIL import Image

RING = [[0, 0], [5, 5], [0, 20], [-5, 5], [0, 0]]
LINES = [[[0, 0], [5, 5], [0, 20]], [[5, 5], [7, 5]]]


def feature(geometry, **properties):
    """Give a collection of one feature as bytes."""
    one = {"type": "Feature", "properties": properties, "geometry": geometry}
    return json.dumps({"type": "FeatureCollection", "features": [one]}).encode()


def image(form):
    """Give a white leaf on a black ground."""
    pixels = np.zeros((40, 30), np.uint8)
    pixels[5:35, 8:22] = 255
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, form)
    return file.getvalue()


PATH = (
    b'<svg xmlns="http://www.w3.org/2000/svg"><g transform="rotate(5) translate(1,2)">'
    b'<path d="M 0 0 C 1 5 5 9 0 20 A 3 4 0 0 1 -4 5 Q -2 3 -3 2 Z"/></g></svg>'
)
SHAPES = (
    b'<svg><polygon points="0,0 5,10 -3,20" transform="matrix(1 0 0 2 3 4)"/>'
    b'<ellipse cx="100" cy="3" rx="1" ry="2"/><rect x="40" width="5px" height="3"/></svg>'
)
POLYGON = feature({"type": "Polygon", "coordinates": [RING]})
CORNERS = b"# a leaf\nx,y\n0,0\n5,5\n0,20\n-5,5\n"

OUTLINES = {
    ".csv": [CORNERS, b"0;0;a\n5;5;a\n0;20;a\n"],
    ".txt": [b"0 0\n5 5\n0 20\n"],
    ".geojson": [POLYGON],
    ".json": [POLYGON],
    ".wkt": [b"MULTIPOLYGON (((0 0, 5 5, 0 20, -5 5, 0 0), (0 6, 1 7, 0 8, 0 6)))"],
    ".svg": [PATH, SHAPES],
    ".png": [image("PNG")],
    ".tif": [image("TIFF")],
    ".jpg": [image("JPEG")],
}

NODES = b"id,x_px,y_px,r\n0,0,0,1\n1,0,1,1\n2,1,1,1\n3,2,2,2\n"
EDGES = b"u,v,width_px,length_px\n0,1,2.0,1\n1,2,1.0,1\n2,3,1,1.5\n"
GRAPH = (
    b'<graphml xmlns="http://graphml.graphdrawing.org/xmlns">'
    b'<key id="d0" for="node" attr.name="x" attr.type="double"/>'
    b'<key id="d1" for="node" attr.name="y" attr.type="double"/>'
    b'<key id="d2" for="edge" attr.name="width" attr.type="double"/>'
    b'<graph edgedefault="undirected"><node id="0"><data key="d0">0</data>'
    b'<data key="d1">1</data></node><node id="1"><data key="d0">3</data>'
    b'<data key="d1">1</data></node>'
    b'<edge source="0" target="1"><data key="d2">2.5</data></edge></graph></graphml>'
)
VEINS = feature({"type": "MultiLineString", "coordinates": LINES}, width=2)
NEFI = (
    b"# NEFI\n(0, 1)|2\n(2, 3)|{'width': 2.0, 'length': 3}\n"
    b"(5, 5)|{'width': np.float64(1.5), 'length': 3}\n(2, 3)|1\n"
    b"(5, 5)|{'width': 1, 'length': 4}\n"
)

NETWORKS = {".graphml": [GRAPH], ".geojson": [VEINS], ".json": [VEINS], ".txt": [NEFI]}

SOURCES = b"x,y,birth\n0,5,1\n1,6,3\n-1,7,2\n"
STRETCH = b"height,g_x,g_y\n0,0.1,0.2\n0.5,0.2,0.1\n1,0.1,0.1\n"

LEAF = """kind = "open"
[domain]
{domain}
length = 20.0
[growth]
{growth}
[placement]
{placement}
[arrival]
kill_distance = 1.0
"""


def leaf(
    domain='shape = "ovate"',
    growth='kind = "none"',
    placement='kind = "given"\npoints = [[0.0, 5.0]]',
):
    """Give a config of a small leaf, in which a table may name a file."""
    return LEAF.format(domain=domain, growth=growth, placement=placement)
