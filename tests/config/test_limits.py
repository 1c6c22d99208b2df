"""Sizes that no run could hold are refused with a key; plausible ones are not."""

import tracemalloc

import pytest
from config.wrong_configs import config

from vasc.config import bundled_configs, load, load_text, parse_override
from vasc.config.limits import blade_problems, size_problems
from vasc.errors import ConfigError

STILL = {"growth": 'kind = "none"'}
DARTS = 'kind = "darts"\ndensity = {0}\nbirth_distance_sources = {1}\nbirth_distance_veins = {2}'
GROWTH = 'kind = "{0}"\nfinal_length = {1}\nlength_per_step = 2.0'


def shape(length, width=None):
    """Give the table of a blade."""
    return f'shape = "ovate"\nlength = {length}' + (f"\nwidth = {width}" if width else "")


def problems(**tables):
    """Give what is wrong with a sound config of which some tables are replaced."""
    try:
        load_text(config(**tables), label="leaf.toml")
    except ConfigError as error:
        return error.problems
    return []


@pytest.mark.parametrize(
    ("tables", "start", "reason"),
    [
        (STILL | {"domain": shape(1e9)}, "domain.length = 1000000000.0", "memory"),
        (STILL | {"domain": shape(1e300)}, "domain.length = 1e+300", "at most 1e+06"),
        (STILL | {"domain": shape(20.0, 1e9)}, "domain.width = 1000000000.0", "memory"),
        (STILL | {"domain": shape(20.0, 1e300)}, "domain.width = 1e+300", "memory"),
        ({"growth": GROWTH.format("marginal", 1e9)}, "growth.final_length = 10000", "memory"),
        ({"growth": GROWTH.format("isogonic", 1e9)}, "growth.final_length = 10000", "memory"),
        ({"placement": DARTS.format(1e6, 8, 8)}, "placement.density = 1000000.0", "darts"),
        ({"placement": DARTS.format(1e308, 8, 8)}, "placement.density = 1e+308", "darts"),
        ({"placement": DARTS.format("5e-324", 8, 8)}, "placement.density = 5e-324", "no source"),
        (
            {"placement": DARTS.format(2e4, 8, 8) + '\nreading = "largest_blade"'},
            "placement.density = 20000.0",
            "darts",
        ),
        (
            {"growth": GROWTH.format("marginal", 2e5), "placement": DARTS.format(1e-6, 2, 2)},
            "growth.final_length = 200000.0",
            "cells",
        ),
        (STILL | {"domain": shape(20.0, 1e-9)}, "domain.width = 1e-09", "no room"),
        (STILL | {"domain": shape(0.5)}, "domain.length = 0.5", "no room"),
        ({"domain": shape(1e-300)}, "domain.length = 1e-300", "at least 1e-06"),
        ({"placement": DARTS.format(0.1, 1e200, 8)}, "placement.birth_distance_sources", "1e+12"),
        ({"placement": DARTS.format(0.1, 8, 1e200)}, "placement.birth_distance_veins", "1e+12"),
        (
            {"refinement": 'kind = "subdivision"\nlongest = 1e-6'},
            "refinement.longest = 1e-06",
            "at least 0.01",
        ),
        (
            {"refinement": 'kind = "subdivision"', "placement": DARTS.format(0.1, 8, 1e-6)},
            "placement.birth_distance_veins = 1e-06",
            "1e+06 pieces",
        ),
        (
            {"placement": 'kind = "given"\npoints = [[0.0, 5.0]]\nbirths = [1_000_001]'},
            "placement.births[0] = 1000001",
            "at most 1,000,000",
        ),
        ({"arrival": "kill_distance = 1e200"}, "arrival.kill_distance = 1e+200", "1e+12"),
    ],
)
def test_an_absurd_size_is_refused_by_its_key(tables, start, reason):
    (line,) = problems(**tables)
    assert line.startswith(f"leaf.toml: {start}")
    assert reason in line


def test_a_large_outline_without_a_width_is_refused_by_its_length():
    points = "points = [[0, 0], [1e6, 0.5], [0, 1], [-1e6, 0.5]]\nlength = 20.0"
    (line,) = problems(**STILL, domain=points)
    assert line.startswith("leaf.toml: domain.length = 20.0: the blade would be 4e+07")


def test_nothing_large_is_made_before_a_size_is_refused():
    tracemalloc.start()
    try:
        assert problems(**STILL, domain=shape(1e9), placement=DARTS.format(1, 1, 1))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 100e6


@pytest.mark.parametrize(
    "tables",
    [
        {"growth": GROWTH.format("isogonic", 5000.0), "placement": DARTS.format(1e-3, 2, 2)},
        {"growth": GROWTH.format("marginal", 5000.0), "placement": DARTS.format(1.0, 1, 1)},
        {"domain": shape(1.0), "growth": GROWTH.format("marginal", 5000.0)},
        {"domain": shape(1e-3), "growth": GROWTH.format("isogonic", 500.0)},
        STILL | {"domain": shape(100.0, 0.01)},
        STILL | {"domain": shape(5000.0)},
    ],
)
def test_a_plausible_size_is_taken(tables):
    assert problems(**tables) == []


def test_every_bundled_config_could_be_half_as_long_again():
    for one in bundled_configs():
        tables = load(one.name).tables
        if tables["kind"] == "stem":
            rise = 1.5 * tables["placement"]["rise"]
            domain = tables["domain"]
            if "radii" in domain:
                wider = f"domain.radii={[[1.5 * z, 1.5 * radius] for z, radius in domain['radii']]}"
            else:
                wider = f"domain.radius={1.5 * domain['radius']}"
            larger = [f"placement.rise={rise}", wider]
            load(one.name, [parse_override(change) for change in larger])
            continue
        if "growth" not in tables:
            continue  # cells have a size of their own
        growth = tables["growth"]
        if growth["kind"] in ("keyframed", "local_to_global"):
            continue  # they tell no final length
        key = "domain.length" if growth["kind"] == "none" else "growth.final_length"
        length = load(one.name).tables["domain"]["length"]
        final = 1.5 * growth.get("final_length", length)
        load(one.name, [parse_override(f"{key}={final}")])


def test_a_blade_that_cannot_be_made_is_refused_when_the_config_is_read():
    (line,) = problems(domain=shape(20.0) + "\nseeds = [[5.0, 5.0]]")
    assert line.startswith("leaf.toml: domain.seeds[0] = (5, 5): outside the outline")
    (line,) = problems(domain="points = [[-1, 0], [1, 2], [1, 0], [-1, 2]]\nlength = 20.0")
    assert line.startswith("leaf.toml: domain.points: crosses or touches itself")


def test_what_only_the_model_finds_begins_with_the_label():
    text = config(placement='kind = "given"\npoints = [[500.0, 5.0]]')
    experiment = load_text(text, label="leaf.toml")
    with pytest.raises(ConfigError, match=r"^leaf.toml: .*\(500, 5\) lies outside"):
        experiment.model()


def test_a_blade_of_an_installed_growth_may_begin_small():
    parameters = load_text(config(**STILL)).parameters
    small = parameters.domain.model_copy(update={"length": 0.01})
    still = parameters.model_copy(update={"domain": small})
    assert "no room" in size_problems(still)[0]

    class Growth:
        kind = "slowing"

    growing = parameters.model_copy(update={"domain": small, "growth": Growth()})
    assert size_problems(growing) == []
    assert blade_problems(growing, small.blade()) == []
