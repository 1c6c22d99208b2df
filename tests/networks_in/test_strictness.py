"""Files of networks: what is nearly a number, or steers a terminal, is refused in a line."""

import json

import pytest

from vasc.errors import NetworkError
from vasc.networks_in import read_network

NODES = "id,x,y\n1,0,0\n2,3,4\n"
EDGES = "u,v\n1,2\n"
NEFI = (
    "(12, 40)|2\n(30, 44)|{{'pixels': 18, 'width': {}, 'length': 19.1}}\n(12, 61)|{{'width': 3}}\n"
)


def complaint(path):
    with pytest.raises(NetworkError) as caught:
        read_network(path)
    said = str(caught.value)
    assert said.isprintable()
    assert len(said) < 300
    return said


@pytest.mark.parametrize(
    ("nodes", "edges", "said"),
    [
        (
            NODES.replace("3,4", "1_0,4"),
            EDGES,
            "a_nodes.csv, row 3: x is '1_0'; it must be a number",
        ),
        (NODES.replace("3,4", "\u0663,4"), EDGES, "row 3: x is '\u0663'"),
        (NODES, "u,v,length\n1,2,1\n", "a_edges.csv, row 2: length is 1, and its ends are 5 apart"),
        ("id,node,x,y\n1,1,0,0\n2,2,3,4\n", EDGES, "columns 'id, node'; only one may be id"),
        (NODES, "u,u,v\n1,1,2\n", "columns 'u, u'; only one may be u"),
        (NODES.replace("\n", "\r"), EDGES, "lines end with a carriage return alone"),
        ("id,x,y\n\x1b[2J,0,0\n\x1b[2J,3,4\n", EDGES, r"node '\x1b[2J' is given twice"),
        ("id,x,y\na\0,0,0\na\0,3,4\n", EDGES, r"node 'a\x00' is given twice"),
    ],
)
def test_tables(tmp_path, nodes, edges, said):
    (tmp_path / "a_nodes.csv").write_bytes(nodes.encode())
    (tmp_path / "a_edges.csv").write_bytes(edges.encode())
    assert said in complaint(tmp_path / "a.csv")


def test_lengths_of_places_in_pixels_may_be_a_little_short(tmp_path):
    (tmp_path / "a_nodes.csv").write_text(NODES)
    (tmp_path / "a_edges.csv").write_text("u,v,length\n1,2,4\n")
    assert read_network(tmp_path / "a.csv").lengths.tolist() == [4.0]


@pytest.mark.parametrize(
    "value", ["4,2", "abc", "", "'4'", "1_0", "4.2.1", "4.2 5", "np.float64(x)"]
)
def test_nefi_reads_a_number_or_names_the_line(tmp_path, value):
    (tmp_path / "a.txt").write_text(NEFI.format(value))
    assert complaint(tmp_path / "a.txt").startswith("a.txt, line 2: width is ")


def test_nefi_tells_nodes_apart_by_their_numbers(tmp_path):
    (tmp_path / "a.txt").write_text("(12, 40)|1\n(30, 44)|{}\n(30.0, 4.4e1)|1\n(12.0, 61)|{}\n")
    assert read_network(tmp_path / "a.txt").network.n_nodes == 3


@pytest.mark.parametrize("digits", [1000, 4000, 5000])
def test_long_numbers_of_geojson(tmp_path, digits):
    text = '{"type": "LineString", "coordinates": [[%s, 0], [1, 1]]}' % ("9" * digits)
    (tmp_path / "a.json").write_text(text)
    assert complaint(tmp_path / "a.json").startswith("a.json")


def test_marks_in_geojson_steer_no_terminal(tmp_path):
    line = {"type": "LineString", "coordinates": [["\x1b[2J", 0], [1, 1]]}
    (tmp_path / "a.json").write_text(json.dumps(line))
    assert r"\x1b" in complaint(tmp_path / "a.json")


@pytest.mark.parametrize("place", ["1e-100", "1e-162", "1e-13"])
def test_networks_too_small_to_square(tmp_path, place):
    (tmp_path / "a_nodes.csv").write_text(f"id,x,y\n1,0,0\n2,{place},0\n")
    (tmp_path / "a_edges.csv").write_text(EDGES)
    assert "too small for squares of lengths" in complaint(tmp_path / "a.csv")
