"""The page on configs says what is so."""

import re
import tomllib
from pathlib import Path

import pytest

from vasc.config import load_text
from vasc.config.schema import json_schema, models
from vasc.errors import ConfigError

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGE = (DOCS / "configs.md").read_text()
BLADES = (DOCS / "blades.md").read_text()


def keys(schema):
    """Give every key of every table, and every word that a key takes."""
    for node in [schema, *schema.get("$defs", {}).values()]:
        for name, key in node.get("properties", {}).items():
            yield name
            yield from key.get("enum", ())
            if name == "kind" and "const" in key:
                yield key["const"]


@pytest.mark.parametrize("kind", models())
def test_the_page_names_every_key(kind):
    # shapes have a page of their own
    missing = [key for key in keys(json_schema(kind)) if f"`{key}`" not in PAGE + BLADES]
    assert [key for key in missing if key not in PAGE] == []


def test_the_config_of_the_page_is_sound():
    (text,) = re.findall(r"^```toml\n(.*?)^```$", PAGE, flags=re.MULTILINE | re.DOTALL)
    experiment = load_text(text)
    assert experiment.tables["arrival"] == {"kill_distance": 1.0}


def test_the_mistakes_of_the_page_are_told_as_shown():
    (text,) = re.findall(r"^```toml\n(.*?)^```$", PAGE, flags=re.MULTILINE | re.DOTALL)
    (shown,) = re.findall(r"^```text\n(.*?)^```$", PAGE, flags=re.MULTILINE | re.DOTALL)
    for before, after in (
        ('shape = "ovate"', 'shape = "cordat"'),
        ("final_length = 120.0", "final_length = 120.0\nfinal_lenght = 120.0"),
        ("density = 0.001", 'density = "0.1"'),
        ("kill_distance = 1.0", "kill_distance = 1.0\nsegment_length = 1.0"),
    ):
        assert before in text
        text = text.replace(before, after)
    tomllib.loads(text)
    with pytest.raises(ConfigError) as caught:
        load_text(text, name="leaf.toml")
    told = caught.value.problems
    assert len(told) == 4
    for line, pattern in zip(told, shown.splitlines(), strict=True):
        assert re.fullmatch(re.escape(pattern).replace(re.escape("..."), ".*"), line), line
