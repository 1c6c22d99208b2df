"""The prediction from the lattice of primordia, against its definition and known thresholds."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from reference import primordium_lattice

from vasc.errors import VascError
from vasc.validation.stem_phyllotaxis import (
    PrimordiumLattice,
    contact_parastichies,
    crossing,
    intervals,
    n_sympodia,
    predict,
)
from vasc.validation.stem_references import ARC_THRESHOLDS, CHORD_THRESHOLDS, STEM_PATTERNS


def lattice(degrees, ratio, per_level=1):
    """Give a lattice of rise 1."""
    return PrimordiumLattice(math.radians(degrees), 1.0, ratio, per_level)


def pairs(degrees, metric="chord", **options):
    """Give the predicted pairs of a divergence with the thresholds between them."""
    return [
        (one.pair, one.high) for one in intervals(math.radians(degrees), metric=metric, **options)
    ]


@given(
    degrees=st.floats(1.0, 180.0),
    ratio=st.floats(0.3, 7.0),
    per_level=st.integers(1, 3),
    metric=st.sampled_from(["chord", "arc"]),
)
@example(degrees=180.0, ratio=3.0, per_level=1, metric="chord")
@example(degrees=90.0, ratio=2.0, per_level=2, metric="chord")
@example(degrees=60.0, ratio=0.5, per_level=3, metric="arc")
@example(degrees=137.5, ratio=1.6, per_level=1, metric="chord")
def test_the_prediction_is_the_definition(degrees, ratio, per_level, metric):
    found = predict(lattice(degrees, ratio, per_level), metric)
    angle = math.radians(degrees)
    loose, strict = (
        primordium_lattice.steps(angle, ratio, per_level, metric, slack)
        for slack in (1 - primordium_lattice.TIE, 1 + primordium_lattice.TIE)
    )
    assert found.steps == loose
    assert found.firm == tuple(step for step in loose if step in strict)


@pytest.mark.parametrize("pattern", STEM_PATTERNS, ids=str)
def test_chords_predict_every_stem_of_the_thesis(pattern):
    assert predict(lattice(pattern.divergence, pattern.ratio)).pair == pattern.pair


def test_arcs_contradict_seven_of_them():
    wrong = [
        (pattern.divergence, pattern.ratio)
        for pattern in STEM_PATTERNS
        if predict(lattice(pattern.divergence, pattern.ratio), "arc").pair != pattern.pair
    ]
    assert len(wrong) == 7
    assert all(ratio < 5.0 for _, ratio in wrong)


@pytest.mark.parametrize("degrees", CHORD_THRESHOLDS)
def test_thresholds_along_chords(degrees):
    found = pairs(degrees)
    for (pair, high), (asked, threshold) in zip(found, CHORD_THRESHOLDS[degrees], strict=False):
        assert pair == asked
        # the coarse ones are given to two decimals or three digits
        assert high == pytest.approx(threshold, rel=1e-2 if degrees < 90 or degrees > 140 else 1e-3)


@pytest.mark.parametrize("degrees", ARC_THRESHOLDS)
def test_thresholds_along_arcs(degrees):
    found = pairs(degrees, "arc")
    for (pair, high), (asked, threshold) in zip(found, ARC_THRESHOLDS[degrees], strict=False):
        assert pair == asked
        assert high == pytest.approx(threshold, rel=1e-3)


@pytest.mark.parametrize(
    ("degrees", "metric", "low", "high"),
    [
        *[(137.5, "chord", a, b) for a, b in ((2, 5), (3, 8), (5, 13))],
        *[(99.5, "chord", a, b) for a, b in ((1, 4), (3, 7), (4, 11))],
        *[(137.5, "arc", a, b) for a, b in ((2, 5), (3, 8))],
        *[(77.96, "chord", a, b) for a, b in ((1, 5), (4, 9))],
        *[(151.14, "chord", a, b) for a, b in ((2, 7),)],
    ],
)
def test_a_threshold_is_where_two_steps_are_equally_long(degrees, metric, low, high):
    angle = math.radians(degrees)
    threshold = crossing(low, high, angle, metric=metric)
    ends = [one.high for one in intervals(angle, metric=metric)]
    assert min(abs(end / threshold - 1.0) for end in ends) < 2e-6


@given(degrees=st.floats(20.0, 180.0), low=st.integers(1, 8), high=st.integers(2, 12))
def test_steps_are_equally_long_at_their_crossing(degrees, low, high):
    ratio = crossing(low, high, math.radians(degrees))
    assume(low != high and 0.01 < ratio < 1e3)
    lengths = lattice(degrees, ratio).distances(np.array([[low, 0], [high, 0]]))
    assert lengths[0] == pytest.approx(lengths[1], rel=1e-9)


def test_no_ratio_makes_a_step_equal_to_one_that_is_longer_in_both_ways():
    assert math.isnan(crossing(2, 3, math.radians(20.0)))
    assert math.isnan(crossing(5, 5, math.radians(20.0)))


@pytest.mark.parametrize("degrees", [137.5, 99.5, 77.96, 151.14, 64.08])
def test_between_thresholds_the_prediction_is_one(degrees):
    for one in intervals(math.radians(degrees), low=0.5, high=20.0):
        for part in (0.02, 0.5, 0.98):
            low, high = max(one.low, 0.5), min(one.high, 20.0)
            ratio = low + part * (high - low)
            assert predict(lattice(degrees, ratio)).steps == one.steps
            assert one.margin(ratio) > 0.0


def test_only_scale_free_numbers_matter():
    for scale in (0.01, 1.0, 1000.0):
        found = predict(PrimordiumLattice(math.radians(137.5), 10.0 * scale, 50.0 * scale))
        assert found.pair == (3, 5)
    turned = predict(PrimordiumLattice(math.radians(137.5 - 720.0), 10.0, 50.0))
    mirrored = predict(PrimordiumLattice(math.radians(-137.5), 10.0, 50.0))
    assert turned.steps == mirrored.steps == (3, 5)


def test_one_and_two_are_tied_where_they_are_predicted():
    for ratio in (1.36, 1.5, 1.7):
        found = predict(lattice(137.5, ratio))
        assert (found.pair, found.tied, found.firm) == ((1, 2), (1,), (2,))
    assert [one.pair for one in intervals(math.radians(137.5)) if one.tied] == [(1, 2)]
    assert [one.pair for one in intervals(math.radians(99.5)) if one.tied] == []


def test_distichous_and_decussate_lattices():
    # leaves of one row face each other's gaps: along the row once the stem is thick
    assert predict(lattice(180.0, 0.5)).steps == (1,)
    thick = predict(lattice(180.0, 3.0))
    assert (thick.steps, thick.tied) == ((1, 2), (1,))
    # both leaves of the next pair, a quarter turn away, are equally near
    assert predict(lattice(90.0, 1.0, per_level=2)).steps == (2, 3)
    assert predict(lattice(90.0, 1.0, per_level=2)).tied == ()
    # on a thick stem the leaf two pairs up, right above, is nearer
    assert 5 in predict(lattice(90.0, 3.0, per_level=2)).firm
    assert crossing(2, 5, math.pi / 2, per_level=2) == pytest.approx(math.sqrt(1.5))


@given(degrees=st.floats(3.0, 177.0), ratio=st.floats(3.0, 20.0))
def test_on_the_surface_relative_neighbours_are_contact_parastichies(degrees, ratio):
    found = predict(lattice(degrees, ratio), "arc")
    contact = contact_parastichies(lattice(degrees, ratio))
    near = contact_parastichies(lattice(degrees, ratio * (1 + 1e-6)))
    assume(not found.tied and near.numbers == contact.numbers)
    # three longer sides could go right round the stem
    turns = zip(contact.angles, contact.numbers, strict=True)
    longest = max(math.hypot(ratio * angle, number) for angle, number in turns)
    assume(longest < 2 * math.pi * ratio / 3)
    assert set(found.steps) == set(contact.steps)


@pytest.mark.parametrize(
    ("degrees", "ratio", "per_level", "numbers", "is_opposed"),
    [
        (137.5, 11.5, 1, (5, 8), True),
        (137.5, 5.0, 1, (3, 5), True),
        (99.5, 18.0, 1, (7, 11), True),
        (180.0, 0.4, 1, (1, 1), True),
        (90.0, 1.0, 2, (2, 2), True),
        (60.0, 1.0, 3, (3, 3), True),
        (77.96, 5.0, 1, (4, 5), True),
        (151.14, 5.0, 1, (2, 5), True),
        (122.0, 2.0, 1, (1, 3), False),
    ],
)
def test_contact_parastichies(degrees, ratio, per_level, numbers, is_opposed):
    found = contact_parastichies(lattice(degrees, ratio, per_level))
    assert (found.numbers, found.is_opposed) == (numbers, is_opposed)


def test_sympodia_are_as_many_as_the_greatest_common_divisor():
    assert [n_sympodia(one) for one in ((5, 8), (5,), (2, 4), (3, 5, 8), (1,))] == [1, 5, 2, 1, 1]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"divergence": math.nan}, "divergence"),
        ({"rise": 0.0}, "rise"),
        ({"radius": math.inf}, "radius"),
        ({"radius": -1.0}, "radius"),
        ({"per_level": 0}, "per_level"),
    ],
)
def test_numbers_that_make_no_lattice_are_refused(change, words):
    good = {"divergence": 2.4, "rise": 1.0, "radius": 1.0, "per_level": 1}
    with pytest.raises(VascError, match=words):
        PrimordiumLattice(**good | change)
    with pytest.raises(VascError, match="ratios"):
        intervals(2.4, low=2.0, high=1.0)
