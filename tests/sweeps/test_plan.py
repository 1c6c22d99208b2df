"""The runs of a sweep: every combination once, with a seed of its own, the same each time."""

import itertools
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vasc.limits import SWEEP_RUNS
from vasc.streams import spawned_seed
from vasc.sweeps.parameters import Range, Span, SweepParameters
from vasc.sweeps.plan import plan

KEYS = ["arrival.kill_distance", "placement.density", "growth.kind", "stop.steps"]
VALUES = st.lists(
    st.one_of(st.integers(-5, 5), st.floats(-1e6, 1e6), st.text(max_size=4), st.booleans()),
    min_size=1,
    max_size=4,
)
AXES = st.dictionaries(st.sampled_from(KEYS), VALUES, max_size=3)


def parameters(**changes):
    """Give the parameters of a sweep."""
    tables = {"base": "poplar-leaf", "measures": ["summary.nodes"]} | changes
    return SweepParameters.model_validate(tables)


@given(axes=AXES, replicates=st.integers(1, 3), seed=st.integers(0, 2**62))
def test_every_combination_comes_once_a_replicate(axes, replicates, seed):
    runs = plan(parameters(axes=axes, replicates=replicates, seed=seed))
    expected = [
        (list(combination), replicate)
        for combination in itertools.product(*axes.values())
        for replicate in range(1, replicates + 1)
    ]
    assert [(list(run.values.values()), run.replicate) for run in runs] == expected
    assert [run.number for run in runs] == list(range(1, len(expected) + 1))
    assert all(list(run.values) == list(axes) for run in runs)
    assert [run.seed for run in runs] == [spawned_seed(seed, run.number) for run in runs]


@given(axes=AXES, draws=st.integers(1, 5), seed=st.integers(0, 1000))
def test_a_plan_is_the_same_each_time(axes, draws, seed):
    random = {"growth.final_length": {"from": 10.0, "to": 90.0, "scale": "log"}}
    one, other = (
        plan(parameters(axes=axes, random=random, draws=draws, seed=seed)) for _ in range(2)
    )
    assert one == other
    assert all(10.0 <= run.values["growth.final_length"] <= 90.0 for run in one)
    assert len({run.values["growth.final_length"] for run in one}) == draws


def test_a_random_key_changes_no_value_of_another():
    spans = {key: {"from": 1.0, "to": 2.0} for key in ("a.b", "c.d")}
    alone = plan(parameters(random={"a.b": spans["a.b"]}, draws=4))
    both = plan(parameters(random=spans, draws=4))
    assert [run.values["a.b"] for run in alone] == [run.values["a.b"] for run in both]
    assert all(run.values["a.b"] != run.values["c.d"] for run in both)


def test_seeds_differ_and_any_table_keeps_their_digits():
    seeds = [spawned_seed(seed, number) for seed in range(20) for number in range(500)]
    assert len(set(seeds)) == len(seeds)
    assert all(0 <= seed < 2**53 and int(float(seed)) == seed for seed in seeds)


@given(
    low=st.floats(1e-6, 1e6),
    ratio=st.floats(1.01, 1e4),
    num=st.integers(2, 50),
    scale=st.sampled_from(["linear", "log"]),
)
def test_a_range_begins_and_ends_as_it_says_and_is_even(low, ratio, num, scale):
    axis = Range.model_validate({"from": low, "to": low * ratio, "num": num, "scale": scale})
    values = axis.values()
    assert (values[0], values[-1], len(values)) == (low, low * ratio, num)
    assert values == sorted(values)
    pairs = list(itertools.pairwise(values))
    steps = [b / a for a, b in pairs] if scale == "log" else [b - a for a, b in pairs]
    # twelve digits of the values are kept
    assert max(steps) - min(steps) <= 1e-9 * max(values[-1], 1.0)


def test_a_range_of_whole_numbers_has_each_once():
    axis = Range.model_validate({"from": 1, "to": 4, "num": 10, "whole": True})
    assert axis.values() == [1, 2, 3, 4]
    assert all(isinstance(value, int) for value in axis.values())


def test_few_digits_of_a_logarithmic_range_show():
    axis = Range.model_validate({"from": 0.001, "to": 1.0, "num": 4, "scale": "log"})
    assert axis.values() == [0.001, 0.01, 0.1, 1.0]


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"axes": {"a.b": []}}, "must be a list of one or more values"),
        ({"draws": 3}, "no key in [random]"),
        ({"axes": {"a": [1]}, "set": {"a": 2}}, "is in two of"),
        ({"replicates": SWEEP_RUNS + 1}, "at most 100,000"),
        ({"axes": {"a": {"from": 1, "to": 1, "num": 3}}}, "must differ"),
        ({"axes": {"a": {"from": 0, "to": 1, "num": 3, "scale": "log"}}}, "greater than 0"),
    ],
)
def test_a_sweep_that_cannot_be_planned_is_refused(changes, part):
    with pytest.raises(ValueError, match=re.escape(part)):
        parameters(**changes)


def test_a_span_is_named_as_in_the_file():
    span = Span.model_validate({"from": 1.0, "to": 2.0})
    assert span.model_dump(by_alias=True, exclude_defaults=True) == {"from": 1.0, "to": 2.0}
