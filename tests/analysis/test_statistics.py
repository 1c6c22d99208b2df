"""The dictionary of numbers."""

import json
from dataclasses import replace

import numpy as np
import pytest
from reference.networks import PlainMoment, grid, network, sources, square_blade

from vasc.analysis import statistics
from vasc.analysis.units import LengthUnit
from vasc.network import Origin

KEYS = {
    "step",
    "time",
    "blade_length",
    "blade_area",
    "nodes",
    "segments",
    "components",
    "cycles",
    "vein_length",
    "vein_density",
    "areoles",
    "areole_area_mean",
    "areole_area_cv",
    "free_ends",
    "junction_degree",
}
GRID = PlainMoment(grid(4, 4), square_blade(10.0), sources())


def test_a_grid_measured_by_hand():
    found = statistics(GRID)
    assert found.keys() >= KEYS
    assert (found["nodes"], found["segments"]) == (25, 40)
    assert (found["components"], found["cycles"], found["areoles"]) == (1, 16, 16)
    assert found["blade_length"] == 10.0
    assert found["blade_area"] == pytest.approx(100.0)
    assert found["vein_length"] == pytest.approx(40.0)
    assert found["vein_density"] == pytest.approx(0.4)
    assert found["areole_area_mean"] == pytest.approx(1.0)
    assert found["free_ends"] == 0
    assert found["junction_degree"] == {"3": pytest.approx(12 / 21), "4": pytest.approx(9 / 21)}


def test_units_scale_lengths_and_areas():
    plain, real = statistics(GRID), statistics(GRID, {"length": "um", "segment": 4.0})
    assert (plain["length_unit"], real["length_unit"]) == ("D", "um")
    assert real["blade_length"] == pytest.approx(4 * plain["blade_length"])
    assert real["blade_area"] == pytest.approx(16 * plain["blade_area"])
    assert real["vein_length"] == pytest.approx(4 * plain["vein_length"])
    assert real["vein_density"] == pytest.approx(plain["vein_density"] / 4)
    assert real["areole_area_mean"] == pytest.approx(16 * plain["areole_area_mean"])
    assert real["areole_area_cv"] == pytest.approx(plain["areole_area_cv"])


def test_json_takes_it_as_it_is():
    tree = PlainMoment(network([(0, 0), (0, 1)], [(0, 1)]), square_blade(), sources())
    found = statistics(tree)
    assert json.loads(json.dumps(found, allow_nan=False)) == found
    assert found["areole_area_mean"] is None


def test_a_stem_measured_by_hand():
    # a ring of three, a vein from it to a primordium, a fork with a blind branch
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 2), (0, 0, 4), (1, 0, 2)]
    flat = network(
        [point[:2] for point in points],
        [(0, 1), (1, 2), (2, 0), (0, 3), (3, 4), (3, 5)],
        origins=[Origin.SEED] * 3 + [Origin.EXTENSION, Origin.PRIMORDIUM, Origin.EXTENSION],
    )
    stem = PlainMoment(replace(flat, positions=np.array(points, dtype=float)), None, sources())
    found = statistics(stem, {"length": "um", "segment": 4.0})
    assert found.keys() == statistics(GRID).keys()
    assert (found["nodes"], found["segments"]) == (6, 6)
    assert (found["components"], found["cycles"], found["free_ends"]) == (1, 1, 1)
    assert found["vein_length"] == pytest.approx(4.0 * (1 + np.sqrt(2) + 1 + 2 + 2 + 1))
    assert found["junction_degree"] == {"3": 1.0}
    blade = ("blade_length", "blade_area", "vein_density", "areoles")
    assert [found[key] for key in (*blade, "areole_area_mean", "areole_area_cv")] == [None] * 6


def test_units_of_a_config_without_units():
    assert LengthUnit.from_table(None) == LengthUnit.from_table({}) == LengthUnit("D", 1.0)
    assert LengthUnit.from_table({"length": "mm"}) == LengthUnit("mm", 1.0)
