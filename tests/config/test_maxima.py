"""What a description says of the largest value of a number is what is allowed."""

import re

import pytest

from vasc.config.schema import json_schema

TABLES = {
    "canalization": (
        "FacilitatedDiffusion PolarTransport PooledTransport Settling CellDartParameters"
        " RectangularCells HexagonalCells VoronoiCells"
    ),
    "up-the-gradient": "AuxinRates StartParameters TimeParameters",
    "constant-production": "",
    "gottlieb": "",
}
"""Tables of the models on cells, and of straight veins, that no other model has."""
NATURAL = {"seed": "what a generator takes", "rest": "a share", "noise": "a share"}
"""Largest values that need no word."""


def largest(key):
    """Give the largest value that a key takes."""
    parts = [key, *key.get("anyOf", ())]
    names = ("maximum", "exclusiveMaximum")
    return [part[name] for part in parts for name in names if name in part]


@pytest.mark.parametrize("kind", TABLES)
def test_the_largest_value_of_every_number_is_said(kind):
    schema = json_schema(kind)
    tables = [schema, *(schema["$defs"][name] for name in TABLES[kind].split())]
    keys = {name: key for table in tables for name, key in table["properties"].items()}
    asked = {name: key for name, key in keys.items() if largest(key) and name not in NATURAL}
    assert asked
    for name, key in asked.items():
        said = re.findall(r"[Aa]t most ([\d.e]*\d)", key["description"])
        assert [float(number) for number in said][:1] == [float(largest(key)[0])], name
