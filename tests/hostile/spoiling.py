"""Ways to spoil what is sound: tables of a config, and the bytes of any file."""

import copy
from datetime import date, datetime, time
from typing import Any

from hypothesis import strategies as st

NUMBERS = (
    *(0, -1, 1, 2, 0.0, -0.0, 0.5, -1.5, 1e-300, 5e-324, 1e300, 1.7e308, 1e6, 1e9, 123456789),
    *(float("inf"), float("-inf"), float("nan"), 2**31 - 1, 2**31, 2**63 - 1, -(2**63), 10**18),
)
TEXTS = ("", "x", "a\0b", "\x1b[31m", "\ufeff", "é" * 300, "none", "../..", ".", "/dev/zero")
TABLES = ({}, {"kind": "none"}, {"kind": 3}, {"kind": []}, {"kind": {}}, {"count": 10**9})
LISTS = ([], [[]], [0], [[0, 0], [1, 1]], [1e308] * 4, ["a", "b"], [{}], list(range(1000)))
OTHERS = (True, False, datetime(2020, 1, 1), date(2020, 1, 1), time(1, 2), {"file": "x"})
VALUES = (*NUMBERS, *TEXTS, *TABLES, *LISTS, *OTHERS)
KEYS = ("file", "files", "kind", "points", "seed", "steps", "domain", "", "\x1b", "a.b", "\0")

MARKS = (
    *(b'"', b"'", b"[", b"]", b"{", b"(", b")", b"<", b">", b"&", b"=", b",", b"|", b";"),
    *(b"\0", b"\x1b[2J", b"\x7f", b"\xff", b"\xef\xbb\xbf", b"\r", b"\n", b"\xc2\x9b"),
    *(b"1e999", b"-1e308", b"1e308", b"5e-324", b"inf", b"nan", b"NaN", b"9" * 5000, b"-", b"0"),
    *(b"null", b"true", b"EMPTY", b"Z", b"M", b"A", b"&#0;", b"<!DOCTYPE a>", b"<g>", b'"""'),
)
"""What is put into files: marks of all formats, and numbers that are hard to hold."""


def places(tables: Any, above: tuple = ()) -> list[tuple]:
    """Give the way to every value of nested tables and lists, of long lists the first few."""
    items: Any = ()
    if isinstance(tables, dict):
        items = tables.items()
    elif isinstance(tables, list):
        items = list(enumerate(tables))[:6]
    found = []
    for key, value in items:
        found += [(*above, key), *places(value, (*above, key))]
    return found


@st.composite
def spoilt_tables(draw: st.DrawFn, sound: list[dict[str, Any]]) -> dict[str, Any]:
    """Draw tables of which a few values or keys are not what they should be."""
    tables = copy.deepcopy(draw(st.sampled_from(sound)))
    for _ in range(draw(st.sampled_from([1, 1, 1, 2, 3]))):
        way = draw(st.sampled_from(places(tables) or [()]))
        if not way:
            return tables
        around = tables
        for key in way[:-1]:
            around = around[key]
        last, value = way[-1], copy.deepcopy(draw(st.sampled_from(VALUES)))
        how = draw(st.sampled_from(["value"] * 5 + ["none", "typo", "new"]))
        if how == "value" or isinstance(around, list):
            around[last] = value
        elif how == "none":
            del around[last]
        elif how == "typo":
            at = draw(st.integers(0, len(last)))
            mark = draw(st.sampled_from(["x", "", "\0", "é", '"', ".", "\n"]))
            around[last[:at] + mark + last[at + 1 :]] = around.pop(last)
        else:
            around[draw(st.sampled_from(KEYS))] = value
    return tables


@st.composite
def spoilt_bytes(draw: st.DrawFn, sound: list[bytes]) -> bytes:
    """Draw a file of which a few bytes are changed, cut out, repeated or put in."""
    content = bytearray(draw(st.sampled_from(sound)))
    for _ in range(draw(st.sampled_from([1, 1, 2, 3, 8]))):
        at = draw(st.integers(0, len(content)))
        how = draw(st.sampled_from(["byte", "cut", "repeat", "mark", "mark", "mark", "end"]))
        if how == "byte":
            content[at : at + 1] = bytes([draw(st.integers(0, 255))])
        elif how == "cut":
            del content[at : at + draw(st.integers(1, 12))]
        elif how == "repeat":
            begin = draw(st.integers(0, len(content)))
            content[at:at] = content[begin : begin + draw(st.integers(1, 40))]
        elif how == "mark":
            content[at : at + draw(st.sampled_from([0, 0, 1, 5]))] = draw(st.sampled_from(MARKS))
        elif at > 1:
            del content[at:]
    return bytes(content)
