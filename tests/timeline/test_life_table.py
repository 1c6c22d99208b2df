"""Survival of sources against numbers published for a sample that textbooks use."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.lineages import life_table as plain_life_table

from vasc.timeline.life_table import life_table, median_life

DIED = [6, 6, 6, 7, 10, 13, 16, 22, 23]
CENSORED = [6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35]
"""Weeks in remission under 6-mercaptopurine (Freireich et al. 1963, Blood 21, 699-716)."""
PUBLISHED = {
    6: (0.8571, 0.0764, 0.6197, 0.9516),
    7: (0.8067, 0.0869, 0.5631, 0.9228),
    10: (0.7529, 0.0963, 0.5032, 0.8894),
    13: (0.6902, 0.1068, 0.4316, 0.8491),
    16: (0.6275, 0.1141, 0.3675, 0.8049),
    22: (0.5378, 0.1282, 0.2678, 0.7468),
    23: (0.4482, 0.1346, 0.1881, 0.6801),
}
"""Survival, Greenwood's error and the log-log interval, as statistics programs print them."""


def test_survival_and_its_error_are_the_published_ones():
    last_step = 40
    births = np.array([0] * len(DIED) + [last_step - age for age in CENSORED], dtype=np.int32)
    deaths = np.array(DIED + [-1] * len(CENSORED), dtype=np.int32)
    table = life_table(births, deaths, last_step)
    for age, expected in PUBLISHED.items():
        row = [table[name][age] for name in ("survival", "standard_error", "low", "high")]
        # four digits are published
        assert row == pytest.approx(expected, abs=6e-5)


def test_before_the_first_death_and_after_the_last_one_nothing_is_in_doubt_or_known():
    table = life_table(np.zeros(3, dtype=np.int32), np.array([2, 2, 2], dtype=np.int32), 9)
    assert table["low"][:2].tolist() == table["high"][:2].tolist() == [1.0, 1.0]
    assert table["standard_error"][:2].tolist() == [0.0, 0.0]
    assert table["survival"][2] == 0.0
    assert all(np.isnan(table[name][2]) for name in ("standard_error", "low", "high"))


LIVES = st.lists(st.tuples(st.integers(0, 20), st.one_of(st.none(), st.integers(0, 10))))


@given(LIVES)
def test_any_lives_give_the_numbers_that_counting_gives(lives):
    last_step = 30
    births = np.array([birth for birth, _ in lives], dtype=np.int32)
    deaths = np.array([-1 if age is None else birth + age for birth, age in lives], dtype=np.int32)
    table = life_table(births, deaths, last_step)
    expected = plain_life_table(births.tolist(), deaths.tolist(), last_step)
    assert list(zip(table["at_risk"], table["deaths"], strict=True)) == [
        row[:2] for row in expected
    ]
    assert table["survival"] == pytest.approx([row[2] for row in expected], abs=1e-12)
    is_known = ~np.isnan(table["low"])
    survival, low, high = (table[name][is_known] for name in ("survival", "low", "high"))
    assert ((low <= survival) & (survival <= high)).all()
    assert ((low >= 0.0) & (high <= 1.0)).all()


def test_the_median_and_its_interval_are_the_published_ones():
    last_step = 40
    births = np.array([0] * len(DIED) + [last_step - age for age in CENSORED], dtype=np.int32)
    deaths = np.array(DIED + [-1] * len(CENSORED), dtype=np.int32)
    found = median_life(life_table(births, deaths, last_step))
    # 23 weeks; by the log-log interval from 13 on, without an upper limit
    assert (found.age, found.low, found.high) == (23, 13, None)
    assert (found.n, found.deaths, found.censored) == (21, 9, 12)


def test_a_median_may_not_be_reached_and_nobody_has_none():
    found = median_life(life_table(np.array([0, 0, 0]), np.array([2, -1, -1]), 9))
    assert found.age is None
    assert found.least_survival == pytest.approx(2.0 / 3.0)
    nobody = median_life(life_table(np.empty(0, "i4"), np.empty(0, "i4"), 9))
    assert (nobody.age, nobody.n) == (None, 0)


@given(LIVES)
def test_a_median_is_the_first_age_that_at_most_half_outlive(lives):
    births = np.array([birth for birth, _ in lives], dtype=np.int32)
    deaths = np.array([-1 if age is None else birth + age for birth, age in lives], dtype=np.int32)
    expected = plain_life_table(births.tolist(), deaths.tolist(), 30)
    halves = [age for age, row in enumerate(expected) if row[2] <= 0.5 + 1e-9]
    found = median_life(life_table(births, deaths, 30))
    assert found.age == (halves[0] if halves else None)
