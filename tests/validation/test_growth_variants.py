"""Which growth makes which sequence: the changes, and what comes of them."""

from copy import deepcopy

import pytest

from vasc.config import load
from vasc.validation.growth_variants import (
    REFERENCE,
    VARIANTS,
    birth_distance_times,
    steps_of,
    uniform_from,
    validate_growth,
    without_frame,
)


@pytest.fixture
def tables():
    return deepcopy(load(REFERENCE).tables)


def test_a_key_frame_is_left_out(tables):
    times = [frame["time"] for frame in without_frame(114.0)(tables)["growth"]["frames"]]
    assert times == [0.0, 60.0, 160.0, 276.0, 600.0]


def test_a_blade_is_only_scaled(tables):
    frames = uniform_from(114.0)(tables)["growth"]["frames"]
    shape = [[value / 44.0 for value in row] for row in frames[2]["rows"]]
    for frame, length in zip(frames[2:], (44.0, 54.8, 103.0, 290.0), strict=True):
        for row, first in zip(frame["rows"], shape, strict=True):
            assert row == pytest.approx([length * value for value in first])


def test_shorter_steps_are_more(tables):
    changed = steps_of(0.5)(tables)
    assert changed["growth"]["step_duration"] == 0.5
    assert changed["stop"]["steps"] == changed["placement"]["until"] == 1280


def test_the_birth_distance_is_changed(tables):
    assert birth_distance_times(1.05)(tables)["placement"]["birth_distance"] == 10.5


def test_each_variant_is_another_experiment():
    reference = load(REFERENCE).tables
    changed = [variant.change(deepcopy(reference)) for variant in VARIANTS]
    assert changed[0] == reference
    for number, one in enumerate(changed):
        assert one not in changed[:number]


@pytest.mark.slow
def test_each_growth_fails_the_criteria_that_are_expected_of_it():
    names = []
    suite = validate_growth(names.append)
    assert names == [check["name"] for check in suite["checks"]]
    assert [check["name"] for check in suite["checks"] if not check["pass"]] == []
    assert sum(bool(check["expected_fails"]) for check in suite["checks"]) == 5
