"""The dictionary of numbers."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from reference.drawn_networks import binary_tree, honeycomb, pinnate_leaf, without_seeds
from reference.networks import PlainMoment, grid, network, sources, square_blade

from vasc.analysis import network_statistics, statistics
from vasc.analysis.statistics import POWERS
from vasc.analysis.units import LengthUnit
from vasc.network import Origin
from vasc.real_network import RealNetwork

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
    "areole_circularity_median",
    "areole_elongation_median",
    "areole_corners_mean",
    "free_ends_per_areole",
    "mst_ratio",
    "density_x_sqrt_areole",
    "distance_to_vein_mean",
    "bohn_residual_median",
    "bohn_residual_shuffled",
    "loop_asymmetry",
    "loop_asymmetry_shuffled",
    "orders",
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


def real(net, widths=None):
    return RealNetwork.from_edges(net.positions, net.segments, widths=widths, unit="px")


def test_a_honeycomb_and_a_grid_have_the_known_densities():
    # length per area times the root of the mean area: 1.86 for hexagons, 2 for squares;
    # the rim of forty areoles a side adds up to a thirtieth
    hexagons, squares = (network_statistics(real(net)) for net in (honeycomb(40, 40), grid(40, 40)))
    assert 1.861 < hexagons["density_x_sqrt_areole"] < 1.861 * (1.0 + 1.0 / 30.0)
    assert squares["density_x_sqrt_areole"] == pytest.approx(2.0 + 2.0 / 40.0)
    assert hexagons["areole_corners_mean"] == pytest.approx(6.0, abs=0.2)
    assert hexagons["junction_degree"] == {"3": 1.0}


def test_a_real_network_and_a_run_are_measured_alike():
    net, widths, _ = pinnate_leaf()
    moment = PlainMoment(without_seeds(net), square_blade(20.0), sources())
    run, leaf = statistics(moment, widths=widths), network_statistics(real(net, widths))
    assert run.keys() == leaf.keys()
    assert leaf["length_unit"] == "px"
    assert [leaf[key] for key in ("step", "time", "blade_length", "blade_area")] == [None] * 4
    of_the_blade = {"step", "time", "length_unit", "blade_length", "blade_area", "vein_density"}
    by_area = {"density_x_sqrt_areole", "density_x_distance"}
    for key in run.keys() - of_the_blade - by_area:
        if not key.startswith("distance"):
            assert run[key] == leaf[key], key


def test_without_widths_what_needs_them_is_none():
    net, widths, _ = pinnate_leaf()
    with_widths, without = (network_statistics(real(net, w)) for w in (widths, None))
    changed = {key for key in without if without[key] != with_widths[key]}
    assert {key for key in changed if without[key] is not None} == set()
    assert {"orders", "bohn_residual_median", "loop_asymmetry", "strahler_order"} <= {
        key for key in without if without[key] is None
    }


def test_enclosed_density_counts_enclosed_veins_alone():
    # a square of side 4 in two halves, with a spur in one and a loop on its own in the other;
    # a tail outside, and a bridge to a triangle
    points = [(0, 0), (4, 0), (4, 4), (0, 4), (2, 0), (2, 4)]
    points += [(1, 0), (1, 1), (0, -3), (2.5, 1), (3.5, 1), (3, 2)]
    points += [(9, 4), (10, 4), (9, 5)]
    veins = [(0, 6), (6, 4), (4, 1), (1, 2), (2, 5), (5, 3), (3, 0), (4, 5)]
    veins += [(6, 7), (0, 8), (9, 10), (10, 11), (11, 9), (2, 12), (12, 13), (13, 14), (14, 12)]
    net = network(points, veins)
    found = network_statistics(real(net))
    side = np.sqrt(0.25 + 1.0)
    inside = 16.0 + 4.0 + 1.0 + (1.0 + 2.0 * side) + (2.0 + np.sqrt(2.0))
    assert found["enclosed_area"] == pytest.approx(16.5)
    assert found["enclosed_vein_density"] == pytest.approx(inside / 16.5)
    assert found["vein_density"] == pytest.approx((inside + 3.0 + 5.0) / 16.5)
    on_a_blade = statistics(PlainMoment(without_seeds(net), square_blade(40.0), sources()))
    assert on_a_blade["enclosed_vein_density"] == found["enclosed_vein_density"]
    assert on_a_blade["vein_density"] == pytest.approx((inside + 8.0) / 1600.0)


def test_a_seed_makes_the_shuffles():
    net = honeycomb(12, 12)
    widths = np.random.default_rng(5).uniform(1.0, 9.0, net.n_segments)
    first, again, other = (network_statistics(real(net, widths), seed=s) for s in (1, 1, 2))
    assert first == again
    differing = {key for key in first if first[key] != other[key]}
    assert differing == {key for key in first if key.endswith("shuffled")}


def test_turning_and_scaling_a_leaf():
    net, widths, _ = pinnate_leaf()
    turn, size = np.array([[0.6, -0.8], [0.8, 0.6]]), 7.0
    moved = network(size * net.positions @ turn.T, net.segments)
    plain, large = (
        network_statistics(real(net, widths)),
        network_statistics(real(moved, size * widths)),
    )
    for key, value in plain.items():
        if isinstance(value, float) and key != "box_dimension":
            by_places = key.startswith(("distance", "density_x_distance"))
            expected = value * size ** POWERS.get(key, 0)
            assert large[key] == pytest.approx(expected, rel=0.02 if by_places else 1e-6), key
    assert [o["segments"] for o in large["orders"].values()] == [3, 6, 1]


@pytest.mark.parametrize(
    "net",
    [
        network([], []),
        network([(0, 0)], []),
        network([(1, 1), (1, 1)], [(0, 1)]),
        network([(0, 0), (0, 1)], [(0, 1)]),
        network([(0, 0), (0, 1), (0, 2)], [(0, 1), (1, 0), (0, 1), (1, 2), (0, 2)]),
        network([(0, 0), (0, 1), (5, 5), (6, 6), (7, 5)], [(0, 1), (2, 3), (3, 4), (4, 2)]),
        binary_tree(4),
        network([(0, 0), (2, 2), (0, 2), (2, 0)], [(0, 1), (2, 3)]),
    ],
    ids=["nothing", "a node", "no length", "a line", "twice", "pieces", "tree", "a crossing"],
)
def test_degenerate_networks_have_numbers_or_none(net):
    moment = PlainMoment(net, square_blade(20.0), sources())
    for found in (statistics(moment), network_statistics(real(net, np.ones(net.n_segments)))):
        assert found.keys() >= KEYS
        assert json.loads(json.dumps(found, allow_nan=False)) == found


def test_a_tree_has_no_loops_and_is_its_own_spanning_tree():
    found = network_statistics(real(binary_tree(5)))
    assert (found["areoles"], found["cycles"]) == (0, 0)
    assert found["mst_ratio"] == pytest.approx(1.0)
    assert found["free_end_length_share"] == pytest.approx(1.0)
    assert found["vein_density"] is found["areole_area_mean"] is None


def test_the_page_names_every_number_and_no_other():
    page = (Path(__file__).parents[2] / "docs" / "statistics.md").read_text(encoding="utf-8")
    table = page.partition("## The numbers")[2].partition("### ")[0]
    cells = re.findall(r"^\| (`[^|]*) \|", table, re.MULTILINE)
    named = [name for cell in cells for name in re.findall(r"`([^`]+)`", cell)]
    net = grid(2, 2)
    real = RealNetwork(net, np.ones(net.n_segments), net.lengths)
    found = network_statistics(real)
    assert sorted(named) == sorted(found)


def test_a_lone_ring_has_nothing_to_connect():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    ring = RealNetwork.from_edges(square, np.array([[0, 1], [1, 2], [2, 3], [3, 0]]))
    assert network_statistics(ring)["mst_ratio"] is None
