"""Patterns of stems, entered a second time: a change of one is noticed here."""

from vasc.validation.references import OURS, THESIS
from vasc.validation.stem_references import (
    ARC_THRESHOLDS,
    CHORD_THRESHOLDS,
    LEAST_FRACTION,
    MISSING_FIRST_LINKS,
    STEM_CITATIONS,
    STEM_OBSERVATIONS,
    STEM_PATTERNS,
)


def test_the_thirteen_stems():
    rows = [
        (one.divergence, one.radius, one.rise, one.pair, one.plastochron) for one in STEM_PATTERNS
    ]
    assert rows == [
        (137.5, 115, 10, (5, 8), 5),
        (137.5, 115, 23, (3, 5), 12),
        (137.5, 115, 33, (2, 3), 7),
        (137.5, 115, 96, (1, 1), 48),
        (137.5, 50, 10, (3, 5), 5),
        (137.5, 35, 10, (2, 3), 2),
        (137.5, 16, 10, (1, 2), 5),
        (137.5, 12, 10, (1, 1), 5),
        (99.5, 180, 10, (7, 11), 10),
        (99.5, 115, 10, (4, 7), 5),
        (99.5, 50, 10, (3, 4), 5),
        (99.5, 25, 10, (1, 3), 5),
        (99.5, 12, 10, (1, 1), 5),
    ]


def test_shares_below_one_say_whose_they_are():
    assert [(one.pair, one.least_fraction, one.basis) for one in STEM_PATTERNS
            if one.least_fraction < 1.0] == [
        ((2, 3), 0.9, OURS),
        ((2, 3), 0.9, OURS),
        ((1, 2), 0.0, THESIS),
    ]  # fmt: skip
    assert [one.words for one in STEM_PATTERNS if one.words] == ["predominantly (1,2)"]
    assert LEAST_FRACTION == 0.9


def test_figures_of_the_thesis():
    figures = [one.figure for one in STEM_PATTERNS]
    assert figures == [
        *("6.8, 6.9", "6.8", "6.8", "6.8", "6.7, 6.9", "6.9", "6.9", "6.9"),
        *["6.10"] * 5,
    ]
    assert MISSING_FIRST_LINKS == (2, 3, 7, 9, 10, 12, 14, 15, 17, 18, 20, 21, 23)
    # of two links that follow each other one at least is missing, from the sixth on
    assert all(m in MISSING_FIRST_LINKS or m + 1 in MISSING_FIRST_LINKS for m in range(6, 23))


def test_plants():
    assert [(one.plant.split(",")[0], one.pair) for one in STEM_OBSERVATIONS] == [
        ("Arabidopsis thaliana", (5, 8)),
        ("Ginkgo biloba", (5, 8)),
        ("Linum usitatissimum", (7, 11)),
    ]
    assert {one.source for one in STEM_OBSERVATIONS} < set(STEM_CITATIONS)


def test_thresholds_of_radius_over_rise():
    chords = {angle: [high for _, high in rows] for angle, rows in CHORD_THRESHOLDS.items()}
    assert chords == {
        137.5: [1.349, 1.724, 3.726, 9.116, 23.275],
        99.5: [1.326, 2.805, 6.743, 17.072],
        77.96: [1.95, 4.27, 10.7],
        151.14: [1.03, 2.2, 3.03, 7.56],
        64.08: [2.14, 6.08],
    }
    arcs = {angle: [high for _, high in rows] for angle, rows in ARC_THRESHOLDS.items()}
    assert arcs == {
        137.5: [0.918, 1.276, 3.343, 8.755],
        99.5: [0.861, 2.414, 6.379, 16.718],
    }
    pairs = {angle: [pair for pair, _ in rows] for angle, rows in CHORD_THRESHOLDS.items()}
    assert pairs[137.5] == [(1, 1), (1, 2), (2, 3), (3, 5), (5, 8)]
    assert pairs[99.5] == [(1, 1), (1, 3), (3, 4), (4, 7)]
