"""Networks of other programs: written by these, and by hand, read as what they are."""

import gzip
import json
import re

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.networks import random_planar

from vasc.errors import NetworkError
from vasc.networks_in import is_network_file, read_network

# a triangle with a stalk, in this order
PLACES = {"a": (0.0, 0.0), "b": (0.0, 2.0), "c": (-1.5, 4.0), "d": (1.5, 4.0)}
EDGES = {
    ("a", "b"): (3.0, 2.1),
    ("b", "c"): (2.0, 2.5),
    ("b", "d"): (1.5, 2.6),
    ("c", "d"): (1.0, 3.3),
}


def as_graph():
    graph = nx.Graph()
    for node, (x, y) in PLACES.items():
        graph.add_node(node, x=x, y=y, label="a node", seen=True)
    for (one, other), (width, length) in EDGES.items():
        graph.add_edge(one, other, width=width, length=length, id=7)
    return graph


def write_tables(folder, zipped=False):
    nodes = "id,x_um,y_um\n" + "".join(f"{n},{x},{y}\n" for n, (x, y) in PLACES.items())
    edges = "u,v,length_um,width_um\n" + "".join(
        f"{u},{v},{length},{width}\n" for (u, v), (width, length) in EDGES.items()
    )
    for end, text in (("nodes", nodes), ("edges", edges)):
        path = folder / f"leaf_{end}.csv"
        if zipped:
            path.with_name(path.name + ".gz").write_bytes(gzip.compress(text.encode()))
        else:
            path.write_text(text)
    return folder / "leaf.csv"


def write_graphml(folder):
    nx.write_graphml(as_graph(), folder / "leaf.graphml")
    return folder / "leaf.graphml"


def write_nefi(folder):
    """As NEFI does: nodes are places in the image, cells apart by a bar."""
    graph = nx.Graph()
    names = {node: (-int(10 * y), int(10 * x)) for node, (x, y) in PLACES.items()}
    for (one, other), (width, length) in EDGES.items():
        graph.add_edge(
            names[one], names[other], pixels=3, width=10 * width, length=10 * length, width_var=0.25
        )
    nx.write_multiline_adjlist(graph, folder / "leaf.txt", delimiter="|")
    return folder / "leaf.txt"


def write_geojson(folder):
    features = [
        {
            "type": "Feature",
            "properties": {"width": width},
            "geometry": {"type": "LineString", "coordinates": [PLACES[one], PLACES[other]]},
        }
        for (one, other), (width, _) in EDGES.items()
    ]
    features.append({"type": "Feature", "properties": None, "geometry": None})
    point = {"type": "Point", "coordinates": [0.0, 0.0]}
    features.append({"type": "Feature", "properties": {}, "geometry": point})
    path = folder / "leaf.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


class TestSound:
    @pytest.mark.parametrize(
        ("write", "size", "unit"),
        [(write_tables, 1, "um"), (write_graphml, 1, ""), (write_nefi, 10, "px")],
    )
    def test_the_same_leaf(self, tmp_path, write, size, unit):
        leaf = read_network(write(tmp_path))
        assert leaf.unit == unit
        places = np.array(list(PLACES.values())) * size
        assert sorted(map(tuple, leaf.network.positions.tolist())) == sorted(map(tuple, places))
        ends = leaf.network.positions[leaf.network.segments] / size
        found = {
            frozenset(map(tuple, pair.tolist())): (width / size, length / size)
            for pair, width, length in zip(ends, leaf.widths, leaf.lengths, strict=True)
        }
        expected = {frozenset((PLACES[u], PLACES[v])): both for (u, v), both in EDGES.items()}
        assert found.keys() == expected.keys()
        for pair, both in expected.items():
            assert found[pair] == pytest.approx(both)

    def test_lines_of_geojson(self, tmp_path):
        leaf = read_network(write_geojson(tmp_path))
        assert (leaf.network.n_nodes, leaf.network.n_segments) == (4, 4)
        assert leaf.widths.tolist() == [3.0, 2.0, 1.5, 1.0]
        assert leaf.lengths == pytest.approx(leaf.network.lengths)

    def test_lines_with_corners_share_nodes(self, tmp_path):
        lines = [[[0, 0], [1, 1], [1, 1], [2, 0]], [[1, 1, 9], [1, 3]], [[1.0, 3], [1, 1]]]
        path = tmp_path / "lines.json"
        path.write_text(json.dumps({"type": "MultiLineString", "coordinates": lines}))
        network = read_network(path).network
        assert (network.n_nodes, network.n_segments) == (4, 3)
        assert network.degrees.tolist() == [1, 3, 1, 1]

    @pytest.mark.parametrize(
        "name", ["leaf.csv", "leaf_nodes.csv", "leaf_edges.csv", "leaf.csv.gz"]
    )
    @pytest.mark.parametrize("zipped", [False, True])
    def test_names_of_a_pair_of_tables(self, tmp_path, name, zipped):
        write_tables(tmp_path, zipped)
        assert read_network(tmp_path / name).network.n_segments == 4

    def test_columns_in_any_order_and_others_left_alone(self, tmp_path):
        (tmp_path / "x_nodes.csv").write_text("\ufeffY;note;X;Node\n1;;2;p\n\n3;n;4;q\n")
        (tmp_path / "x_edges.csv").write_text("target;source\nq;p\n")
        leaf = read_network(tmp_path / "x.csv")
        assert leaf.network.positions.tolist() == [[2.0, 1.0], [4.0, 3.0]]
        assert leaf.network.segments.tolist() == [[0, 1]]
        assert (leaf.widths, leaf.unit) == (None, "")
        assert leaf.lengths == pytest.approx([np.sqrt(8.0)])

    @given(st.integers(0, 2**32 - 1))
    def test_what_networkx_writes_of_any_network(self, tmp_path_factory, seed):
        net = random_planar(np.random.default_rng(seed), 20, 0.5)
        graph = nx.Graph()
        for node, (x, y) in enumerate(net.positions.tolist()):
            graph.add_node(node, x=x, y=y)
        graph.add_edges_from(net.segments.tolist())
        path = tmp_path_factory.mktemp("graph") / "net.graphml"
        nx.write_graphml(graph, path)
        if not net.n_segments:
            return
        found = read_network(path).network
        assert (found.positions == net.positions).all()
        pairs = {frozenset(pair) for pair in net.segments.tolist()}
        assert {frozenset(pair) for pair in found.segments.tolist()} == pairs

    def test_which_files_are_networks(self):
        assert all(map(is_network_file, ["a.csv", "a.GraphML", "a.json.gz", "a.txt", "a.geojson"]))
        assert not any(map(is_network_file, ["a.h5", "a", "a.gz", "a.xlsx"]))


NODES = "id,x,y\n0,0,0\n1,0,1\n2,1,1\n"


@pytest.mark.parametrize(
    ("nodes", "edges", "said"),
    [
        (NODES, "u,v\n0,9\n", "t_edges.csv, row 2: node '9' is none of the 3 nodes"),
        (NODES, "u,v\n0,1\n1,1\n", "t_edges.csv, row 3: from node '1' to itself"),
        (
            NODES,
            "u,v\n0,1\n1,0\n",
            "between '1' and '0' is given twice, first in row 2",
        ),
        (NODES, "u,v,width\n0,1,-3\n", "row 2: width is '-3'; it must be above 0"),
        (NODES, "u,v,width\n0,1,0\n", "row 2: width is '0'; it must be above 0"),
        (NODES, "u,v,width\n0,1,wide\n", "row 2: width is 'wide'; it must be a number between"),
        (NODES, "u,v,width\n0,1,nan\n", "row 2: width is 'nan'; it must be a number between"),
        (NODES, "u,v,width\n0,1,2\n1,2,\n", "row 3: has no width, as other edges have"),
        (NODES, "u,v\n0,1,2\n", "row 2: has 3 cells; the header names 2"),
        (
            NODES,
            "u,w\n0,1\n",
            "no column v or target or to or end or node2; there is 'u, w'",
        ),
        (NODES, "u,v\n", "t_edges.csv: holds no edge"),
        (NODES, "", "row 1: no column u or source or from or start or node1; there is 'nothing'"),
        (NODES, 'u,v\n"0,1\n', "t_edges.csv, row 2: unexpected end of data"),
        ("id,x,y\n0,0,0\n0,1,1\n", "u,v\n", "t_nodes.csv, row 3: node '0' is given twice"),
        ("id,x,y\n0,inf,0\n", "u,v\n", "t_nodes.csv, row 2: x is 'inf'; it must be a number"),
        ("id,x,y\n0,0,1e99\n", "u,v\n", "t_nodes.csv, row 2: y is '1e99'; it must be a number"),
        ("id,x\n0,0\n", "u,v\n", "t_nodes.csv, row 1: no column y; there is 'id, x'"),
        ("id,x_px,y_mm\n0,0,0\n", "u,v\n", "units 'mm, px'; all columns must be in one"),
        ("id,x,x_px,y\n0,0,0,0\n", "u,v\n", "columns 'x, x_px'; only one may be x"),
        ("id,x,y\n" + "a" * 300 + ",?,0\n", "u,v\n", "row 2: x is '?'"),
    ],
)
def test_wrong_tables_in_one_line(tmp_path, nodes, edges, said):
    (tmp_path / "t_nodes.csv").write_text(nodes)
    (tmp_path / "t_edges.csv").write_text(edges)
    with pytest.raises(NetworkError) as caught:
        read_network(tmp_path / "t.csv")
    assert said in str(caught.value)
    assert len(str(caught.value)) < 250
    assert "\n" not in str(caught.value)


NODE = '<node id="0"><data key="x">0</data><data key="y">0</data></node>'


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.graphml", "no xml", "not well-formed XML"),
        ("a.graphml", "", "not well-formed XML"),
        ("a.graphml", '<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>', "declares a DOCTYPE or entities"),
        ("a.graphml", "<a>" * 50, "line 1: elements are nested more than 32 deep"),
        ("a.graphml", "<graphml><graph/></graphml>", "holds no edge"),
        ("a.graphml", f"<g><graph>{NODE}{NODE}</graph></g>", "line 1: node '0' is given twice"),
        (
            "a.graphml",
            '<g><graph>\n<node id="k"/></graph></g>',
            "line 2: node 'k' has no attribute",
        ),
        (
            "a.graphml",
            f'<g><graph>{NODE}<edge source="0" target="1"/></graph></g>',
            "node '1' is none of the 1 nodes",
        ),
        ("a.geojson", "{", "not JSON"),
        ("a.geojson", "[]", "at its top: is '[]'; it must be a GeoJSON object with a 'type'"),
        ("a.geojson", "[" * 100, "brackets are nested more than 32 deep"),
        ("a.geojson", '{"type": "Point", "coordinates": [0, 0]}', "holds no edge"),
        ("a.geojson", '{"type": "FeatureCollection"}', "a FeatureCollection without a list"),
        ("a.geojson", '{"type": "LineString", "coordinates": [[0, 0]]}', "it must be two places"),
        (
            "a.geojson",
            '{"type": "LineString", "coordinates": [0, 1]}',
            "a place is '0'; it must",
        ),
        (
            "a.geojson",
            '{"type": "LineString", "coordinates": [[0, "1"], [1, 1]]}',
            "it must be [x, y]",
        ),
        ("a.geojson", '{"type": "LineString", "coordinates": [[0, NaN], [1, 1]]}', "y is 'nan'"),
        ("a.geojson", '{"type": "MultiLineString", "coordinates": 3}', "coordinates are no list"),
        (
            "a.geojson",
            '{"type": "Feature", "properties": {"width": true},'
            ' "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}}',
            "feature 1: width is 'True'; it must be a number",
        ),
        ("a.txt", "# NEFI\n(0, 1)|1\n(2, 3)|{'width': 2.0}\nhello\n", "line 4: is 'hello'"),
        (
            "a.txt",
            "(0, 1)|2\n(2, 3)|{'width': 2.0}\n",
            "and 1 edges of the last node",
        ),
        ("a.txt", "(0, 1)|one\n", "line 1: is '(0, 1)|one'; it must be (row, column)|n"),
        ("a.txt", "(0, 1)|1\n(0, 1)|{}\n", "line 2: from node"),
        (
            "a.txt",
            "(0, 1)|1\n(2, 3)|{'width': 0.0}\n",
            "line 2: width is '0.0'; it must be above 0",
        ),
        ("a.txt", "(0, 1e300)|1\n(2, 3)|{}\n", "line 1: column is '1e300'"),
        ("a.txt", "", "holds no edge"),
        ("a.xyz", "", "a network cannot be read from '.xyz'; known are .csv, .graphml"),
    ],
)
def test_wrong_files_in_one_line(tmp_path, name, text, said):
    (tmp_path / name).write_text(text)
    with pytest.raises(NetworkError) as caught:
        read_network(tmp_path / name)
    assert said in str(caught.value)
    assert name in str(caught.value)
    assert len(str(caught.value)) < 300


class TestFiles:
    def test_missing(self, tmp_path):
        with pytest.raises(
            NetworkError, match=r"there is no leaf_nodes\.csv, nor leaf_nodes\.csv\.gz"
        ):
            read_network(tmp_path / "leaf.csv")
        with pytest.raises(NetworkError, match="cannot be read: No such file"):
            read_network(tmp_path / "leaf.graphml")
        (tmp_path / "folder.txt").mkdir()
        with pytest.raises(NetworkError, match="cannot be read: Is a directory"):
            read_network(tmp_path / "folder.txt")

    def test_damaged_and_not_text(self, tmp_path):
        path = tmp_path / "a.json.gz"
        whole = gzip.compress(b'{"type": "LineString", "coordinates": [[0, 0], [1, 1]]}')
        path.write_bytes(whole)
        assert read_network(path).network.n_segments == 1
        path.write_bytes(whole[:-12])
        with pytest.raises(NetworkError, match="damaged gzip file: it ends too early"):
            read_network(path)
        path.write_bytes(whole[:12] + b"xxxx" + whole[16:])
        with pytest.raises(NetworkError, match="damaged gzip file"):
            read_network(path)
        path.write_bytes(b"\xff\xfe\x00")
        with pytest.raises(NetworkError, match=r"not a text in UTF-8 \(byte 0\)"):
            read_network(path)

    def test_too_large(self, tmp_path, monkeypatch):
        monkeypatch.setattr("vasc.networks_in.reading.NETWORK_BYTES", 1000)
        path = tmp_path / "a.json.gz"
        for content in (b" " * 5000, gzip.compress(b" " * 5_000_000)):
            path.write_bytes(content)
            with pytest.raises(NetworkError, match="larger than 1,000 bytes"):
                read_network(path)

    def test_too_many(self, tmp_path, monkeypatch):
        monkeypatch.setattr("vasc.networks_in.edges.NETWORK_ROWS", 3)
        with pytest.raises(NetworkError, match="more than 3 nodes"):
            read_network(write_tables(tmp_path))

    @given(st.binary(max_size=200), st.sampled_from(["a.txt", "a.json", "a.graphml"]))
    def test_any_bytes_are_refused_or_read(self, tmp_path_factory, content, name):
        path = tmp_path_factory.mktemp("bytes") / name
        path.write_bytes(content)
        with pytest.raises(NetworkError):
            read_network(path)


NEFI_OLD = """#nefi2.py
# GMT Tue Mar 15 10:20:30 2016
#
(12, 40)|2
(12, 95)|{'length': 56.41421356237309, 'pixels': 55, 'width': 4.25, 'width_var': 0.31}
(60, 41)|{'pixels': 48, 'width': 2.0, 'length': 48.41421356237309, 'width_var': 0.0}
(12, 95)|1
(60, 41)|{'width_var': 0.12, 'width': 1.5, 'length': 75.0, 'pixels': 70}
(60, 41)|0
"""


def test_the_text_of_nefi_from_old_and_new_libraries(tmp_path):
    numbers = re.compile(r"(?<=: )\d+\.\d+|(?<=[( ])\d+(?=[,)])")
    new = "".join(
        line if line.startswith("#") else numbers.sub(r"np.float64(\g<0>)", line)
        for line in NEFI_OLD.splitlines(keepends=True)
    )
    assert "(np.float64(12), np.float64(40))|2" in new
    leaves = []
    for name, text in (("old.txt", NEFI_OLD), ("new.txt", new)):
        (tmp_path / name).write_text(text)
        leaves.append(read_network(tmp_path / name))
    for leaf in leaves:
        assert leaf.network.positions.tolist() == [[40, -12], [95, -12], [41, -60]]
        assert leaf.network.segments.tolist() == [[0, 1], [0, 2], [1, 2]]
        assert leaf.widths.tolist() == [4.25, 2.0, 1.5]
        assert leaf.lengths.tolist() == [56.41421356237309, 48.41421356237309, 75.0]
