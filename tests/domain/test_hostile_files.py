"""Files made to do harm are refused, in little time and memory."""

import json
import struct
import tracemalloc
import zlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vasc.domain import read_outline
from vasc.domain.readers import READERS
from vasc.errors import OutlineError

ENTITIES = "".join(
    f'<!ENTITY l{k} "{f"&l{k - 1};" * 10}">' if k else '<!ENTITY l0 "lol">' for k in range(10)
)
NESTED = 5000


def png_that_claims(width, height):
    """Give a small file whose header speaks of many pixels."""

    def chunk(kind, content):
        body = kind + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    pixels = zlib.compress(b"\0" * 1000)
    start = b"\x89PNG\r\n\x1a\n"
    return start + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def many(n, between=" "):
    return between.join(f"{k % 1000} {k}" for k in range(n))


HOSTILE = {
    "lol.svg": (f"<!DOCTYPE svg [{ENTITIES}]><svg>&l9;</svg>", "DOCTYPE or entities"),
    "external.svg": (
        '<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]><svg>&x;</svg>',
        "DOCTYPE or entities",
    ),
    "dtd.svg": ('<!DOCTYPE svg SYSTEM "http://example.org/svg.dtd"><svg/>', "DOCTYPE or entities"),
    "deep.svg": ("<g>" * NESTED + "</g>" * NESTED, "nested more than 64 deep"),
    "many.svg": (f'<svg><polygon points="{many(200_001)}"/></svg>', "more than 200,000 points"),
    "long-path.svg": (f'<svg><path d="M {many(200_001)} Z"/></svg>', "more than 200,000 points"),
    "curves.svg": (
        f'<svg><path d="M 0 0 Q {many(20_000)} Z"/></svg>',
        "more than 200,000 points",
    ),
    "many-shapes.svg": ("<svg>" + '<circle r="1"/>' * 1100 + "</svg>", "200,000 points"),
    "rings.svg": ("<svg>" + '<rect width="1" height="1"/>' * 1100 + "</svg>", "1100 rings"),
    "huge.svg": (
        f'<svg><polygon transform="scale(2)" points="{"9" * 400},1 1,2 2,{"9" * 400}"/></svg>',
        "not finite",
    ),
    "huge-path.svg": (f'<svg><path d="M {"9" * 400} 1 L 1 2 L 2 {"9" * 400} Z"/></svg>', "finite"),
    "scaled.svg": (
        f'<svg><g transform="scale({"9" * 200})"><circle r="1{"0" * 200}"/></g></svg>',
        "not finite",
    ),
    "turned.svg": (
        f'<svg><rect width="1" height="1" transform="rotate({"9" * 400})"/></svg>',
        "finite",
    ),
    "named.svg": (f'<svg><circle r="1" transform="{"9" * 5000}(1)"/></svg>', "known are matrix"),
    "href.svg": ('<svg><image href="http://example.org/leaf.png"/></svg>', "holds no closed"),
    "deep.json": ("[" * NESTED + "]" * NESTED, "nested more than 64 deep"),
    "deep-objects.json": ('{"geometry":' * NESTED, "nested more than 64 deep"),
    "many.json": (
        json.dumps({"type": "Polygon", "coordinates": [[[k, k * k] for k in range(200_002)]]}),
        "more than 200,000 points",
    ),
    "deep.wkt": ("GEOMETRYCOLLECTION(" * NESTED + ")" * NESTED, "nested more than 64 deep"),
    "many.wkt": (f"POLYGON (({many(202_000, ',')}))", "more than 200,000 points"),
    "many.csv": ("\n".join(f"{k},{k * k}" for k in range(200_001)), "more than 200,000 points"),
    "nul.csv": ("0,0\0\n1,1\n", "line 1"),
    "long-digits.json": ('{"type": "Polygon", "coordinates": [[' + "9" * 5000 + "]]}", "not JSON"),
    "pixels.png": (png_that_claims(8001, 8000), "8001 x 8000 pixels; at most 64,000,000"),
    "bomb.png": (png_that_claims(60_000, 60_000), "image"),
    "cut.png": (png_that_claims(100, 100)[:60], "not a PNG, TIFF or JPEG image"),
    "few-pixels.png": (png_that_claims(1000, 1000), "not a PNG, TIFF or JPEG image"),
    "gif.png": (b"GIF89a\x01\x00\x01\x00\x00\x00\x00;", "not a PNG, TIFF or JPEG image"),
    "nothing.jpg": (b"", "not a PNG, TIFF or JPEG image"),
    "noise.tif": (b"II*\0" + b"\xff" * 100, "not a PNG, TIFF or JPEG image"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_is_refused(name, tmp_path):
    content, said = HOSTILE[name]
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(OutlineError) as caught:
        read_outline(path)
    message = str(caught.value)
    assert said in message
    assert "\n" not in message
    assert len(message) < 400


@pytest.mark.parametrize(("n_bytes", "is_read"), [(20_000_000, True), (20_000_001, False)])
def test_the_limit_of_bytes_is_exact(n_bytes, is_read, tmp_path):
    path = tmp_path / "padded.csv"
    text = b"0,0\n1,1\n0,2\n#"
    path.write_bytes(text + b" " * (n_bytes - len(text)))
    if is_read:
        assert len(read_outline(path)[0]) == 3
    else:
        tracemalloc.start()
        with pytest.raises(OutlineError, match="larger than 20,000,000 bytes"):
            read_outline(path)
        assert tracemalloc.get_traced_memory()[1] < 50e6
        tracemalloc.stop()


@pytest.mark.parametrize(("depth", "is_read"), [(64, True), (65, False)])
def test_the_limit_of_depth_is_exact(depth, is_read, tmp_path):
    path = tmp_path / "groups.svg"
    groups = depth - 1
    drawing = '<polygon points="0 0 1 1 0 2"/>'
    path.write_text("<g>" * groups + drawing + "</g>" * groups)
    if is_read:
        assert len(read_outline(path)) == 1
    else:
        with pytest.raises(OutlineError, match="nested more than 64 deep"):
            read_outline(path)


FRAGMENTS = st.sampled_from(
    ["M0 0", "L 1 1", "c", "A1 1 0 0 1 5 5", "Z", "m", "1e9", "-", ".", "H", "T 2", "é", "\0", "<"]
)


@given(
    st.sampled_from(sorted(set(READERS) - {".tif", ".tiff", ".jpg", ".jpeg", ".png"})),
    st.one_of(
        st.binary(max_size=200),
        st.text(max_size=100).map(str.encode),
        st.lists(FRAGMENTS, max_size=12).map(
            lambda parts: f'<svg><path d="{" ".join(parts)}"/></svg>'.encode()
        ),
    ),
)
def test_any_bytes_are_read_or_refused(tmp_path_factory, suffix, content):
    path = tmp_path_factory.mktemp("any") / f"any{suffix}"
    path.write_bytes(content)
    try:
        rings = read_outline(path)
    except OutlineError:
        return
    assert all(np.isfinite(ring).all() for ring in rings)
