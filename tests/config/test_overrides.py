"""Values that are set outside of the file."""

import pytest

from vasc.config import load, load_text, parse_override
from vasc.config.overrides import overridden
from vasc.errors import ConfigError


@pytest.mark.parametrize(
    ("text", "keys", "value"),
    [
        ("seed=2", ("seed",), 2),
        ("growth.final_length=2e3", ("growth", "final_length"), 2000.0),
        ("growth.kind=none", ("growth", "kind"), "none"),
        ('growth.kind="none"', ("growth", "kind"), "none"),
        ("extension.bias=[0.0, 0.1]", ("extension", "bias"), [0.0, 0.1]),
        ("extension.stall_rule=false", ("extension", "stall_rule"), False),
        ('growth={kind = "none"}', ("growth",), {"kind": "none"}),
        ('printed.values."a b"=x = y', ("printed", "values", "a b"), "x = y"),
        ("title=A leaf, 1 = 2", ("title",), "A leaf, 1 = 2"),
        ("title=", ("title",), ""),
        ("title=1\nseed=2", ("title",), "1\nseed=2"),
        (" seed = 2 ", ("seed",), 2),
    ],
)
def test_a_value_is_toml_or_else_a_text(text, keys, value):
    assert parse_override(text) == (keys, value)


@pytest.mark.parametrize(
    "text", ["seed", "=2", ".seed=2", "a b=2", "a..b=2", "[a]=2", "a\nb=2", "title=\udcff"]
)
def test_what_is_no_key_is_refused(text):
    with pytest.raises(ConfigError, match="--set"):
        parse_override(text)


def test_tables_that_are_not_there_are_made_and_the_given_ones_stay():
    tables = {"a": {"b": 1}}
    changed = overridden(tables, [(("a", "c"), 2), (("d", "e", "f"), [3]), (("a", "b"), 4)])
    assert changed == {"a": {"b": 4, "c": 2}, "d": {"e": {"f": [3]}}}
    assert tables == {"a": {"b": 1}}


def test_a_key_through_a_value_is_refused():
    with pytest.raises(ConfigError, match=r"--set seed\.x\.y: seed is not a table"):
        overridden({"seed": 1}, [(("seed", "x", "y"), 2)])


def test_the_recorded_config_is_the_changed_one():
    plain = load("poplar-leaf")
    changed = load("poplar-leaf", [parse_override("seed=7"), parse_override("stop.steps=3")])
    assert plain.parameters.seed != 7
    assert changed.parameters.seed == 7
    assert changed.toml.startswith(
        "# set outside the file: seed = 7\n# set outside the file: stop.steps = 3\n"
    )
    again = load_text(changed.toml)
    assert again.parameters == changed.parameters
    assert again.parameters != plain.parameters


def test_without_changes_the_recorded_config_is_the_file_itself():
    plain = load("poplar-leaf")
    assert plain.toml == (plain.folder / "poplar-leaf.toml").read_text()


@pytest.mark.parametrize(
    ("change", "part"),
    [
        ("growth.final_lenght=3", 'nearest: "final_length"'),
        ("arrival.kill_distance=0.5", "at least extension.segment_length"),
        ("seed=x", 'seed = "x": must be a whole number'),
        ("x." * 40 + "x=1", "nested too deeply"),
    ],
)
def test_a_change_is_checked_as_the_file_is(change, part):
    with pytest.raises(ConfigError, match="poplar-leaf: ") as caught:
        load("poplar-leaf", [parse_override(change)])
    assert part in str(caught.value)
