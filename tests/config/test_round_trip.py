"""What can be said in parameters can be said in TOML, and comes back the same."""

import json
import tomllib

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vasc.config.schema import json_schema, parameters_from, resolved_tables, to_toml
from vasc.errors import ConfigError

LENGTHS = st.floats(min_value=1e-6, max_value=1e9)
TEXTS = st.text(st.characters(blacklist_categories=["Cs"]), max_size=20)
PAIRS = st.tuples(LENGTHS, LENGTHS).map(list)


def table(required, **optional):
    """Draw a table; optional keys may be absent."""
    return st.fixed_dictionaries(required, optional=optional)


DOMAINS = table(
    {"shape": st.sampled_from(["ovate", "cordate", "fan"]), "length": st.floats(1.0, 100.0)},
    width=st.floats(0.1, 2.0),
    seeds=st.one_of(
        st.lists(PAIRS, min_size=1, max_size=3),
        st.fixed_dictionaries({"count": st.integers(2, 50)}),
    ),
    teeth=st.fixed_dictionaries(
        {
            "amplitudes": st.lists(LENGTHS, min_size=2, max_size=2),
            "frequencies": st.lists(st.integers(1, 99), min_size=2, max_size=2),
        }
    ),
)
GROWTHS = st.one_of(
    st.just({"kind": "none"}),
    table(
        {
            "kind": st.sampled_from(["marginal", "isogonic"]),
            "final_length": st.floats(100.0, 1e6),
            "length_per_step": LENGTHS,
        }
    ),
    table(
        {
            "kind": st.just("local_to_global"),
            "heights": st.just([0.0, 0.4, 1.0]),
            "g_x": st.lists(st.floats(-0.9, 9.0), min_size=3, max_size=3),
            "g_y": st.lists(st.floats(-0.9, 9.0), min_size=3, max_size=3),
            "end": LENGTHS,
        },
        steps_per_unit=st.integers(1, 1000),
    ),
)
PLACEMENTS = st.one_of(
    table(
        {
            "kind": st.just("darts"),
            "density": LENGTHS,
            "birth_distance_sources": LENGTHS,
            "birth_distance_veins": LENGTHS,
        },
        until=st.integers(1, 10**6),
    ),
    table({"kind": st.just("given"), "points": st.lists(PAIRS, min_size=1, max_size=4)}),
)
CONFIGS = table(
    {
        "kind": st.sampled_from(["open", "closed"]),
        "domain": DOMAINS,
        "growth": GROWTHS,
        "placement": PLACEMENTS,
        "arrival": st.fixed_dictionaries({"kill_distance": st.floats(1.0, 100.0)}),
    },
    seed=st.integers(0, 2**63 - 1),
    title=TEXTS,
    reference=TEXTS,
    extension=table({}, bias=PAIRS, stall_rule=st.booleans()),
    stop=table({}, steps=st.integers(1, 10**6)),
    record=table({"perceived": st.sampled_from(["veins", "nodes", "none"])}),
    units=table({}, length=st.sampled_from(["um", "mm"]), segment=LENGTHS),
    widths=table({}, exponent=st.floats(1.0, 20.0)),
    printed=table({}, values=st.dictionaries(TEXTS, TEXTS, max_size=3)),
)


@given(CONFIGS)
def test_parameters_written_as_toml_read_back_equal(tables):
    parameters = parameters_from(tables)
    text = to_toml(parameters)
    # not by load, which refuses the blades that are drawn here without a thought for geometry
    assert parameters_from(tomllib.loads(text)) == parameters
    # and as the JSON that a timeline keeps
    assert parameters_from(json.loads(json.dumps(resolved_tables(parameters)))) == parameters


@given(CONFIGS)
def test_what_is_given_is_what_is_resolved(tables):
    resolved = resolved_tables(parameters_from(tables))

    def agrees(given, found):
        if isinstance(given, dict):
            return all(agrees(value, found[key]) for key, value in given.items())
        return given == found

    assert agrees(tables, resolved)


@given(CONFIGS)
def test_the_schema_takes_what_the_parameters_take(tables):
    for kind in (None, tables["kind"]):
        jsonschema.Draft202012Validator(json_schema(kind)).validate(tables)


@pytest.mark.parametrize(
    ("table_name", "key", "value"),
    [
        ("arrival", "kill_distance", "x"),
        ("domain", "length", -1.0),
        ("growth", "kind", "fast"),
        ("stop", "steps", 0),
        ("widths", "exponet", 2.0),
    ],
)
def test_the_schema_refuses_what_the_parameters_refuse(table_name, key, value):
    tables = {
        "kind": "closed",
        "domain": {"shape": "ovate", "length": 20.0},
        "growth": {"kind": "none"},
        "placement": {"kind": "given", "points": [[0.0, 5.0]]},
        "arrival": {"kill_distance": 1.0},
    }
    parameters_from(tables)
    jsonschema.validate(tables, json_schema())
    tables[table_name] = tables.get(table_name, {}) | {key: value}
    with pytest.raises(ConfigError):
        parameters_from(tables)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(tables, json_schema())


def test_the_schema_gives_units_and_meanings():
    schema = json_schema("closed")
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.Draft202012Validator.check_schema(json_schema())
    length = schema["$defs"]["BladeParameters"]["properties"]["length"]
    assert length["unit"] == "D"
    assert length["description"]


def test_an_unknown_schema_is_refused():
    with pytest.raises(ConfigError, match=r'"clos".*nearest: "closed"'):
        json_schema("clos")
