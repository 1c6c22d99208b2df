"""Whatever a file holds that a config or a verb names, it is read or refused in one line."""

import json
import struct
import zlib

import pytest
from hostile.ending import ending, refused
from hostile.sound_files import (
    EDGES,
    NETWORKS,
    NODES,
    OUTLINES,
    PATH,
    POLYGON,
    SOURCES,
    STRETCH,
    leaf,
)
from hostile.spoiling import spoilt_bytes
from hostile.tiers import every_tier, hold

from vasc.limits import FILE_BYTES, FILE_DEPTH, IMAGE_PIXELS, NETWORK_DEPTH, OUTLINE_POINTS

LONG = "9" * 5000
DTD = '<!DOCTYPE x SYSTEM "http://example.org/x.dtd">'
EXTERNAL = '<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/hostname">]>'
BOMB = "".join(
    f'<!ENTITY l{k} "{f"&l{k - 1};" * 10}">' if k else '<!ENTITY l0 "lol">' for k in range(10)
)


def run_with(folder, config):
    """Run a config that cannot be run to its end, for its output has no folder."""
    path = folder / "leaf.toml"
    path.write_text(config)
    (line,) = refused("run", path, "-o", folder / "nowhere" / "leaf.h5")
    return line


def outline_with(folder, suffix, content):
    """Run a leaf with an outline of such a content."""
    (folder / f"o{suffix}").write_bytes(content)
    return run_with(folder, leaf(domain=f'file = "o{suffix}"'))


def network_with(folder, suffix, content, nodes=NODES):
    """Measure a network of such a content; give the lines of its refusal."""
    name = f"n{suffix}"
    if suffix == ".csv":
        (folder / "n_nodes.csv").write_bytes(nodes)
        name = "n_edges.csv"
    (folder / name).write_bytes(content)
    return refused("stats", folder / name)


@every_tier
@pytest.mark.parametrize("suffix", sorted(OUTLINES))
def test_any_outline_is_refused_or_taken(n_cases, suffix, tmp_path):
    def check(content):
        outline_with(tmp_path, suffix, content)

    hold(check, spoilt_bytes(OUTLINES[suffix]), n_cases // 3)


@every_tier
@pytest.mark.parametrize("suffix", [*sorted(NETWORKS), "_nodes.csv", "_edges.csv"])
def test_any_network_is_refused_or_measured(n_cases, suffix, tmp_path):
    sound = {"_nodes.csv": [NODES], "_edges.csv": [EDGES], **NETWORKS}

    def check(content):
        (tmp_path / f"n{suffix}").write_bytes(content)
        code, lines, said = ending("stats", tmp_path / f"n{suffix}", "--json")
        if code == 0:
            assert (lines, json.loads(said)["segments"] > 0) == ([], True)
        else:
            assert len(refused("stats", tmp_path / f"n{suffix}")) == 1

    (tmp_path / "n_nodes.csv").write_bytes(NODES)
    (tmp_path / "n_edges.csv").write_bytes(EDGES)
    hold(check, spoilt_bytes(sound[suffix]), n_cases // 4)


@every_tier
@pytest.mark.parametrize("table", ["sources", "stretch"])
def test_any_table_of_a_config_is_refused_or_taken(n_cases, table, tmp_path):
    stretch = 'kind = "local_to_global"\nfile = "t.csv"\nend = 0.01'
    config = {
        "sources": leaf(placement='kind = "given"\nfile = "t.csv"'),
        "stretch": leaf(growth=stretch),
    }[table]
    (tmp_path / "leaf.toml").write_text(config)
    run = tmp_path / "leaf.h5"

    def check(content):
        (tmp_path / "t.csv").write_bytes(content)
        run.unlink(missing_ok=True)
        code, lines, _ = ending(
            "run", tmp_path / "leaf.toml", "-o", run, "--steps", 1, "--no-figure", "-q"
        )
        assert code in (0, 2), lines
        assert run.exists() is (code == 0)
        assert all(line.isprintable() and len(line) < 600 for line in lines)
        assert bool(lines) is (code == 2)

    hold(check, spoilt_bytes([SOURCES if table == "sources" else STRETCH]), n_cases // 3)


def png_that_claims(width, height):
    """Give a small file whose header speaks of many pixels."""

    def chunk(kind, content):
        body = kind + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    pixels = zlib.compress(b"\0" * 1000)
    parts = [chunk(b"IHDR", header), chunk(b"IDAT", pixels), chunk(b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def groups(depth):
    """Give a drawing with a shape so many elements deep."""
    inside = PATH.split(b">", 1)[1].removesuffix(b"</svg>").decode()
    inside = inside.replace("<g ", "<g><g ").replace("</g>", "</g></g>")
    around = depth - 4
    return "<svg>" + "<g>" * around + inside + "</g>" * around + "</svg>"


HOSTILE_OUTLINES = {
    "pixels": (".png", png_that_claims(10**9, 10**9), "image"),
    "a pixel too many": (".png", png_that_claims(IMAGE_PIXELS // 8 + 1, 8), "at most 64,000,000"),
    "ten million points": (".csv", lambda: b"0,1\n" * 10**7, "larger than 20,000,000 bytes"),
    "points": (".wkt", lambda: b"POLYGON((" + b"1 2," * 2_000_000 + b"1 2))", "200,000 points"),
    "entity bomb": (".svg", f"<!DOCTYPE svg [{BOMB}]><svg>&l9;</svg>", "DOCTYPE or entities"),
    "external entity": (".svg", f"{EXTERNAL}<svg>&e;</svg>", "DOCTYPE or entities"),
    "external DTD": (".svg", f"{DTD}<svg/>", "DOCTYPE or entities"),
    "elements": (".svg", "<g>" * 100_000, "nested more than 64 deep"),
    "brackets": (".json", "[" * 100_000 + "]" * 100_000, "nested more than 64 deep"),
    "open braces": (".json", '{"geometry":' * 100_000, "nested more than 64 deep"),
    "digits": (".json", POLYGON.replace(b"20", LONG.encode()), "outline"),
    "exponent": (".json", POLYGON.replace(b"20", b"1e999"), "finite"),
    "not a number": (".json", POLYGON.replace(b"20", b"NaN"), "finite"),
    "exponent in a table": (".csv", b"0,0\n1e999,5\n0,20\n", "finite"),
    "digits in a path": (".svg", PATH.replace(b"20", LONG.encode()), "outline"),
    "NUL": (".csv", b"0,0\0\n5,5\n", r"'0, 0\x00'"),
    "escapes": (".csv", b"0,0\n\x1b[2J,5\n", r"\x1b[2J"),
    "a mark within": (".csv", b"0,0\n\xef\xbb\xbf5,5\n", r"\ufeff"),
    "bytes": (".svg", lambda: b" " * (FILE_BYTES + 1), "larger than 20,000,000 bytes"),
    "nothing": (".png", b"", "not a PNG"),
}


@pytest.mark.parametrize("name", HOSTILE_OUTLINES)
def test_a_hostile_outline_is_refused(name, tmp_path):
    suffix, content, said = HOSTILE_OUTLINES[name]
    content = content() if callable(content) else content
    content = content if isinstance(content, bytes) else content.encode()
    line = outline_with(tmp_path, suffix, content)
    assert "domain.file" in line
    assert said in line


@pytest.mark.parametrize(("more", "is_taken"), [(-1, True), (0, True), (1, False)])
def test_limits_of_an_outline_are_exact(more, is_taken, tmp_path):
    n_points = OUTLINE_POINTS + more
    arch = [(k, k * (n_points - k) / n_points) for k in range(n_points)]
    table = "".join(f"{x},{y}\n" for x, y in arch).encode()
    padded = OUTLINES[".txt"][0] + b"#" + b" " * (FILE_BYTES + more - 1 - len(OUTLINES[".txt"][0]))
    cases = [(".csv", table), (".txt", padded), (".svg", groups(FILE_DEPTH + more).encode())]
    for suffix, content in cases:
        assert ("nowhere" in outline_with(tmp_path, suffix, content)) is is_taken, suffix


def test_a_byte_order_mark_is_no_part_of_an_outline(tmp_path):
    for suffix in (".csv", ".json", ".svg"):
        line = outline_with(tmp_path, suffix, b"\xef\xbb\xbf" + OUTLINES[suffix][0])
        assert "does not exist" in line


GRAPH = NETWORKS[".graphml"][0].decode()
HOSTILE_NETWORKS = {
    "entity bomb": (".graphml", f"<!DOCTYPE g [{BOMB}]><g>&l9;</g>", "DOCTYPE or entities"),
    "external entity": (".graphml", f"{EXTERNAL}<g>&e;</g>", "DOCTYPE or entities"),
    "external DTD": (".graphml", DTD + GRAPH, "DOCTYPE or entities"),
    "elements": (".graphml", "<g>" * 100_000, "nested more than 32 deep"),
    "a long value": (".graphml", GRAPH.replace("2.5", LONG * 20), "width is '999"),
    "a long name": (".graphml", GRAPH.replace('target="1"', f'target="{LONG}"'), "node '999"),
    "an exponent": (".graphml", GRAPH.replace("2.5", "1e999"), "width is '1e999'"),
    "brackets": (".json", "[" * 100_000, "nested more than 32 deep"),
    "digits": (".json", NETWORKS[".json"][0].replace(b"20", LONG.encode()), "not JSON"),
    "NUL": (".csv", b"u,v\n0,1\0\n", r"node '1\x00'"),
    "escapes": (".csv", b"u,v\n0,\x1b[2J\n", r"node '\x1b[2J'"),
    "units": (".csv", f"u,v,width_{LONG},length_px\n0,1,1,1\n".encode(), "must be in one"),
    "columns": (".csv", b"u," * 100_000 + b"v\n", "more than 1000 columns"),
    "a large cell": (".csv", b"u,v\n0," + b"1" * 200_000, "field larger than field limit"),
    "counts": (".txt", "(0, 1)|9999999\n", "9999999 edges of the last node are missing"),
    "digits of a place": (".txt", f"({LONG}, 1)|1\n(2, 3)|{{}}\n", "it must be a number"),
}


@pytest.mark.parametrize("name", HOSTILE_NETWORKS)
def test_a_hostile_network_is_refused(name, tmp_path):
    suffix, content, said = HOSTILE_NETWORKS[name]
    content = content if isinstance(content, bytes) else content.encode()
    (line,) = network_with(tmp_path, suffix, content)
    assert line.startswith("n")
    assert said in line


@pytest.mark.parametrize(("more", "is_read"), [(-1, True), (0, True), (1, False)])
def test_the_depth_of_a_network_is_exact(more, is_read, tmp_path):
    depth = NETWORK_DEPTH + more
    deep = "<g>" * (depth - 4) + GRAPH + "</g>" * (depth - 4)
    collection = '{"type": "GeometryCollection", "geometries": ['
    line = '{"type": "LineString", "coordinates": [[0, 0], [1, 1]]}'
    n_around = (depth - 3) // 2
    nested = collection * n_around + line + "]}" * n_around
    nested = nested if (depth - 3) % 2 == 0 else nested.replace("[[0, 0]", "[[0, 0, [3]]")
    for suffix, text in ((".graphml", deep), (".json", nested)):
        (tmp_path / f"n{suffix}").write_text(text)
        code, lines, _ = ending("stats", tmp_path / f"n{suffix}")
        assert (code == 0) is is_read, lines
        assert is_read or "nested more than 32 deep" in lines[0]
