"""How many cases a property gets: few with every change, many in the slow tests."""

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis.strategies import SearchStrategy

FAST = 60
"""Cases of a property in the fast tests."""

SLOW = 1500
"""Cases of the same property in the slow tests."""

every_tier = pytest.mark.parametrize(
    "n_cases", [FAST, pytest.param(SLOW, marks=pytest.mark.slow)], ids=["fast", "slow"]
)
"""A test once with few cases, and once with many."""


def hold(check: Callable[[Any], object], cases: SearchStrategy[Any], n_cases: int) -> None:
    """Check so many cases, the same ones each time; the one that fails is made small."""

    @settings(max_examples=n_cases)
    @given(cases)
    def holds(case: Any) -> None:
        check(case)

    holds()
