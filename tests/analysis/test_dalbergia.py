"""A real leaflet, measured beforehand by another program: see tests/data/dalbergia.

Values agree within 1 %, or within half a unit of the last digit that was written down.
Not reproduced, for reasons given at the tests: the numbers of junctions in each class of
the angle law, one of its nine medians, and the shuffled force residual.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from vasc.analysis import find_sections, network_statistics
from vasc.analysis.areoles import areoles_of, looped_veins
from vasc.analysis.junctions import balanced_angles, find_junctions, murray_exponents
from vasc.networks_in import read_network

FOLDER = Path(__file__).parent.parent / "data" / "dalbergia"
EXPECTED = json.loads((FOLDER / "expected.json").read_text())
SHORTEST = 12.0
"""In px: the other program left out junctions with a shorter vein."""


@pytest.fixture(scope="module")
def leaf():
    return read_network(FOLDER / "dalbergia.csv")


@pytest.fixture(scope="module")
def sections(leaf):
    return find_sections(leaf.network, leaf.widths, leaf.lengths)


@pytest.fixture(scope="module")
def areoles(sections):
    return areoles_of(looped_veins(sections), sections.drawing)


@pytest.fixture(scope="module")
def junctions(sections):
    return find_junctions(sections).long(SHORTEST)


@pytest.fixture(scope="module")
def found(leaf):
    return network_statistics(leaf)


def near(expected):
    """One percent, or half a unit of the third decimal place."""
    return pytest.approx(expected, rel=0.01, abs=0.0005)


@pytest.mark.parametrize(
    ("key", "expected"),
    [
        ("nodes", "nodes"),
        ("segments", "edges"),
        ("areoles", "loops"),
        ("free_ends_per_areole", "free_ends_per_areole"),
        ("free_end_length_share", "free_end_length_fraction"),
        ("density_x_sqrt_areole", "vla_times_sqrt_mean_areole_area"),
        ("density_x_distance", "vla_times_mean_distance_to_vein"),
        ("areole_area_cv", "areole_area_cv"),
        ("areole_corners_mean", "areole_corner_count_mean"),
        ("section_length_cv", "segment_length_cv"),
        ("mst_ratio", "mst_length_ratio"),
        ("box_dimension", "box_dimension_scales_L8_to_L128"),
        ("loop_asymmetry", "hld_mean_partition_asymmetry"),
        ("loop_asymmetry_shuffled", "hld_mean_partition_asymmetry_widths_shuffled"),
        ("loop_asymmetry_weighted", "hld_weighted_asymmetry"),
        ("loop_asymmetry_weighted_shuffled", "hld_weighted_asymmetry_shuffled"),
    ],
)
def test_a_key_of_the_statistics(found, key, expected):
    assert found[key] == near(EXPECTED[expected])


@pytest.mark.parametrize("part", ["median", "p95"])
def test_distances_to_the_nearest_vein(found, part):
    product = found["vein_density"] * found[f"distance_to_vein_{part}"]
    assert product == near(EXPECTED[f"vla_times_{part}_distance"])


def test_degrees_of_nodes(leaf):
    counts = np.bincount(leaf.network.degrees) / leaf.network.n_nodes
    assert {str(k): share for k, share in enumerate(counts.tolist()) if share} == near(
        EXPECTED["degree_fraction"]
    )


def test_shapes_of_areoles(areoles):
    shares = [5, 25, 50, 75, 95]
    relative = np.percentile(areoles.areas / areoles.mean_area, shares)
    assert relative == near(EXPECTED["areole_area_over_mean_pct_5_25_50_75_95"])
    assert np.percentile(areoles.circularities, shares) == near(EXPECTED["areole_circularity_pct"])
    assert np.percentile(areoles.elongations, shares) == near(EXPECTED["areole_elongation_pct"])


def test_corners_of_areoles(areoles):
    shares = np.bincount(areoles.corners) / areoles.n_areoles
    for corners, share in EXPECTED["areole_corner_count_fraction"].items():
        assert shares[int(corners)] == near(share)


def test_murray_exponents(junctions):
    exponents = murray_exponents(junctions.widths)
    widest, thinnest = junctions.widths[:, 0], junctions.widths[:, 2]
    assert np.nanpercentile(exponents, [5, 25, 50, 75, 95]) == near(
        EXPECTED["murray_exponent_pct_5_25_50_75_95"]
    )
    assert np.nanmedian(exponents[widest > 20.0]) == near(
        EXPECTED["murray_exponent_median_parent_width_over_20px"]
    )
    assert np.nanmedian(exponents[thinnest < 0.5 * widest]) == near(
        EXPECTED["murray_exponent_median_side_branch_ratio_below_0.5"]
    )


def test_force_residual(junctions):
    assert np.median(junctions.residuals) == near(EXPECTED["force_residual_median"])


def test_shuffled_force_residual(junctions):
    """Not reproduced to 1 %: every one of six orders alike gives 0.180, with any seed.

    The recorded 0.184 lies between this and 0.194, which leaves out the order as it is;
    how it was shuffled is not recorded. Both are well above the real 0.125.
    """
    medians = [np.median(junctions.shuffled_residuals(seed)) for seed in range(5)]
    assert np.ptp(medians) < 0.005
    assert medians == pytest.approx([EXPECTED["force_residual_width_permuted"]] * 5, rel=0.035)


def test_angles_between_the_two_widest_veins(junctions):
    """Medians agree within 1 %, the last within 1.1 %; numbers of junctions within 7 %.

    The recorded numbers, 9,380 junctions in all, are of coordinates before they were
    rounded to pixels; with the rounded ones 9,190 pass the limit of 12 px. Quartiles
    follow.
    """
    w = junctions.widths
    ratios = w[:, 2] / w[:, 0]
    angles, law = np.degrees(junctions.widest_angles), np.degrees(balanced_angles(w))
    for low, high, n, median, q25, q75, predicted in EXPECTED["bohn_two_thickest_angle_deg"][
        "rows"
    ]:
        high = 1.01 if high == 1.0 else high
        rows = (ratios >= low) & (ratios < high) & (w[:, 1] > 0.75 * w[:, 0])
        assert rows.sum() == pytest.approx(n, rel=0.07)
        assert np.median(angles[rows]) == pytest.approx(median, rel=0.011)
        assert np.percentile(angles[rows], [25, 75]) == pytest.approx([q25, q75], rel=0.02)
        assert np.median(law[rows]) == pytest.approx(predicted, abs=2.0)


def test_the_midvein_is_of_first_order(found, leaf):
    assert list(found["orders"]) == ["1", "2", "3", "4", "5", "6"]
    # one vein from the petiole to the tip, and pieces as wide as it
    height = np.ptp(leaf.network.positions[:, 1])
    assert found["orders"]["1"]["length"] == pytest.approx(height, rel=0.15)
    widths = [order["width_mean"] for order in found["orders"].values()]
    assert widths[0] > 3.0 * widths[1]
