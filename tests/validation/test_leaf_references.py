"""Numbers of mature leaves, entered a second time: a change of one is noticed here."""

import json
from math import inf
from pathlib import Path

import pytest

from vasc.validation.leaf_references import (
    DALBERGIA_ANGLES,
    DALBERGIA_NUMBERS,
    FEWEST,
    LAST_DIGIT,
    LEAF_CITATIONS,
    LEAF_RANGES,
    MOST_MAJOR,
    NEARLY_AS_WIDE,
    REPORTED,
    SAME,
    SPECIES_PERCENTILES,
)
from vasc.validation.references import THESIS

EXPECTED = Path(__file__).parent.parent / "data" / "dalbergia" / "expected.json"


def test_ranges():
    found = {key: (one.number, one.low, one.high) for key, one in LEAF_RANGES.items()}
    assert found == {
        "degree_three": (6, 0.9, 1),
        "degree_most": (6, 3, 5),
        "corners_mean": (7, 5.7, 6.1),
        "corners_variance": (7, 1.3, 3),
        "elongation": (7, 1.3, 1.7),
        "circularity": (7, 0.7, 0.85),
        "area_cv": (7, 0.4, 0.9),
        "density_x_sqrt_areole": (8, 1.9, 2.6),
        "density_x_distance": (9, 0.3, 0.45),
        "ends_with_event": (10, 1, inf),
        "ends_without_event": (10, 0, 0),
        "mst_closed": (11, 0.5, 0.75),
        "mst_open": (11, 1, 1),
        "force_residual": (12, 0, 1),
        "angle_off": (12, 0, 15),
        "hierarchy": (13, 0.05, 1),
        "murray": (14, 0, 1e-6),
        "minor_change": (15, 0, 0.2),
        "major_exponent": (15, -0.65, -0.35),
    }


def test_whose_the_ranges_are():
    assert {key for key, one in LEAF_RANGES.items() if one.basis == THESIS} == {
        "ends_with_event",
        "ends_without_event",
        "mst_open",
        "murray",
    }


def test_every_range_names_sources_and_what_they_saw():
    for one in LEAF_RANGES.values():
        assert one.sources
        assert set(one.sources) <= set(LEAF_CITATIONS)
        assert one.seen
        assert "memory" not in one.seen, "what is only remembered decides nothing"
    assert {source for one in REPORTED for source in one.sources} <= set(LEAF_CITATIONS)


def test_what_is_reported_alone():
    assert [(one.key, one.seen) for one in REPORTED] == [
        ("free_ends_per_areole", "0 to about 2, from memory"),
        ("free_end_length_share", "0.044 in Dalbergia"),
        ("section_length_cv", "0.54 in Dalbergia; near exponential"),
        ("murray_exponent_median", "3.1 in Dalbergia, quartiles 2.1 and 4.9"),
        ("loop_asymmetry", "0.418 in Dalbergia, 0.36 to 0.64 in 45 species"),
    ]


def test_dalbergia():
    assert tuple(DALBERGIA_NUMBERS.values()) == (
        *(16474, 22871, 6398, 0.288, 0.044, 2.205, 0.362, 0.569, 0.784, 1.464, 5.946),
        *(0.542, 0.543, 1.85, 0.418, 0.533, 0.857, 0.995),
    )
    assert (SAME, LAST_DIGIT) == (0.01, 0.0005)


@pytest.mark.parametrize(
    ("key", "recorded"),
    [
        ("nodes", "nodes"),
        ("segments", "edges"),
        ("areoles", "loops"),
        ("density_x_distance", "vla_times_mean_distance_to_vein"),
        ("density_x_sqrt_areole", "vla_times_sqrt_mean_areole_area"),
        ("areole_area_cv", "areole_area_cv"),
        ("mst_ratio", "mst_length_ratio"),
        ("loop_asymmetry", "hld_mean_partition_asymmetry"),
        ("loop_asymmetry_shuffled", "hld_mean_partition_asymmetry_widths_shuffled"),
    ],
)
def test_dalbergia_is_what_was_recorded_beside_its_data(key, recorded):
    assert DALBERGIA_NUMBERS[key] == json.loads(EXPECTED.read_text())[recorded]


def test_angles_of_dalbergia():
    lows, highs, medians, laws = zip(*DALBERGIA_ANGLES, strict=True)
    assert lows == (0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
    assert highs == (*lows[1:], 1.0)
    assert medians == (174, 174, 172, 162, 155, 145, 136, 129, 124)
    assert laws == (171, 166, 160, 153, 146, 140, 134, 128, 123)
    assert (NEARLY_AS_WIDE, FEWEST, MOST_MAJOR) == (0.75, 10, 3)


def test_species():
    assert SPECIES_PERCENTILES == {
        "mst_ratio": (0.501, 0.597, 0.655, 0.713, 0.786),
        "areole_area_cv": (0.65, 0.94, 1.11, 1.52, 3.43),
        "areole_circularity_median": (0.70, 0.74, 0.76, 0.82, 0.95),
        "areole_elongation_median": (1.45, 1.54, 1.59, 1.63, 1.75),
        "loop_asymmetry": (0.36, 0.42, 0.45, 0.53, 0.64),
        "density_x_sqrt_areole": (1.00, 1.80, 2.26, 2.52, 3.19),
    }
