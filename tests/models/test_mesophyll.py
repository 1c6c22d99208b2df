"""When mesophyll differentiates, and what an early event does to the veins."""

from functools import cache

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError
from reference.leaves import ARABIDOPSIS, SMALL, keyframed, leaf

from vasc.analysis.topology import count_components, count_cycles
from vasc.domain import BladeParameters
from vasc.events import EventKind
from vasc.growth import IsogonicParameters, KeyframedParameters, NoGrowthParameters
from vasc.models import AreoleVenation
from vasc.models.mesophyll import AnyMesophyll
from vasc.simulation import simulate
from vasc.states import CanalState, Kind
from vasc.streams import Streams


def growth_of(frames, duration=1.0):
    tables = keyframed(frames, step_duration=duration)
    return KeyframedParameters.model_validate(tables).growth()


SMALL_LEAF, FINE, COARSE = growth_of(SMALL), growth_of(SMALL, 0.25), growth_of(SMALL, 7.0)
GROWTHS = {"small": SMALL_LEAF, "coarse": COARSE}


def step_of(growth, kind, **tables):
    """The step of the event."""
    return TypeAdapter(AnyMesophyll).validate_python({"kind": kind, **tables}).step(growth)


def test_it_never_happens_unless_told():
    assert step_of(SMALL_LEAF, "never") is None
    assert AreoleVenation.model_validate(leaf("areole")).mesophyll.kind == "never"


@pytest.mark.parametrize(
    ("growth", "time", "step"),
    [
        (SMALL_LEAF, 90.0, 90),
        (SMALL_LEAF, 89.5, 90),
        (SMALL_LEAF, 0.0, 1),
        (SMALL_LEAF, 1.0, 1),
        (SMALL_LEAF, 500.0, 500),
        (FINE, 90.0, 360),
        (FINE, 90.1, 361),
        (COARSE, 90.0, 13),
        (COARSE, 91.0, 13),
        (COARSE, 91.1, 14),
    ],
)
def test_the_first_step_at_a_time_or_later(growth, time, step):
    assert step_of(growth, "time", time=time) == step


@pytest.mark.parametrize("growth", [SMALL_LEAF, FINE, COARSE])
@pytest.mark.parametrize("length", [12.0, 30.0, 60.0, 79.0])
def test_the_first_step_with_a_blade_as_long(growth, length):
    step = step_of(growth, "length", length=length)
    assert growth.domain(step).length >= length
    assert growth.domain(step - 1).length < length


def test_a_length_that_the_blade_never_has_or_has_from_the_beginning():
    assert step_of(SMALL_LEAF, "length", length=80.1) is None
    assert step_of(SMALL_LEAF, "length", length=5.0) == 1
    blade = BladeParameters(shape="ovate", length=10.0).blade()
    growth = IsogonicParameters(final_length=33.0, length_per_step=2.0).growth(blade)
    assert step_of(growth, "length", length=20.0) == 5
    assert step_of(growth, "length", length=33.1) is None


@cache
def rates(name):
    """Relative areal growth per unit of time, over each step."""
    growth = GROWTHS[name]
    areas = [growth.domain(step).area for step in range(growth.last_step + 1)]
    times = [growth.time(step) for step in range(growth.last_step + 1)]
    return np.r_[np.inf, np.diff(areas) / areas[:-1] / np.diff(times)]


@pytest.mark.parametrize(
    ("name", "rate", "after"),
    [
        ("small", 0.03, 0.0),
        ("coarse", 0.05, 0.0),
        ("coarse", 0.03, 0.0),
        ("coarse", 0.03, 70.0),
        ("coarse", 0.001, 0.0),
        ("coarse", 0.05, 35.0),
    ],
)
def test_the_first_step_over_which_the_blade_grows_more_slowly(name, rate, after):
    growth = GROWTHS[name]
    step = step_of(growth, "growth_rate", rate=rate, after=after)
    late = [s for s in range(1, growth.last_step + 1) if growth.time(s) > after]
    slow = [s for s in late if rates(name)[s] < rate]
    assert step == (slow[0] if slow else growth.last_step + 1)


def test_growth_that_is_fast_to_its_end_ends_with_the_event():
    assert step_of(COARSE, "growth_rate", rate=1e-9) == 20
    assert step_of(COARSE, "growth_rate", rate=0.03, after=1000.0) == 20
    blade = BladeParameters(shape="ovate", length=10.0).blade()
    assert step_of(NoGrowthParameters().growth(blade), "growth_rate", rate=0.1) == 1


@pytest.mark.parametrize(
    "tables",
    [
        {"kind": "time"},
        {"kind": "time", "time": -1.0},
        {"kind": "length", "length": 0.0},
        {"kind": "growth_rate", "rate": 0.0},
        {"kind": "growth_rate"},
        {"kind": "later"},
        {"kind": "never", "time": 3.0},
    ],
)
def test_events_that_make_no_sense_are_refused(tables):
    with pytest.raises(ValidationError):
        step_of(SMALL_LEAF, **tables)


def last_of(frames, birth_distance, n_steps, mesophyll, **tables):
    tables = leaf("areole", frames, birth_distance, mesophyll=mesophyll, **tables)
    *_, last = simulate(
        AreoleVenation.model_validate(tables).model(), Streams(1), max_steps=n_steps
    )
    return last


def count(state, kind):
    return int(np.count_nonzero(state.rows("events", "kind") == kind))


@pytest.mark.parametrize(
    ("frames", "spacing", "n_steps"), [(SMALL, 6.0, 150), (ARABIDOPSIS, 10.0, 240)]
)
def test_an_event_at_the_beginning_leaves_no_loop(frames, spacing, n_steps):
    last = last_of(frames, spacing, n_steps, {"kind": "time", "time": 0.0})
    assert count(last, EventKind.MESOPHYLL_EVENT) == 1
    for kind in (EventKind.LOOP_CLOSED, EventKind.VEIN_JOINED, EventKind.AREOLE_BORN):
        assert count(last, kind) == 0
    assert last.n_rows("areoles") == 0
    assert count_components(last.network) == 1
    assert count_cycles(last.network) == 0
    assert count(last, EventKind.VEIN_ENDED_BLINDLY) > 3
    assert count(last_of(frames, spacing, n_steps, {"kind": "never"}), EventKind.LOOP_CLOSED) > 3


def test_veins_are_the_same_before_the_event_and_fewer_loops_close_the_earlier_it_is():
    ends = {
        time: last_of(SMALL, 6.0, 400, {"kind": "time", "time": time}, until=150)
        for time in (0.0, 40.0, 80.0, 1000.0)
    }
    loops = [count(last, EventKind.LOOP_CLOSED) for last in ends.values()]
    assert loops[0] == 0
    assert loops == sorted(loops)
    assert loops[-1] > loops[1]
    for time in (40.0, 80.0):
        births = ends[time].rows("nodes", "birth"), ends[1000.0].rows("nodes", "birth")
        first, other = (
            end.rows("nodes", "position")[rows < time]
            for end, rows in zip((ends[time], ends[1000.0]), births, strict=True)
        )
        np.testing.assert_array_equal(first, other)


def test_strands_under_way_obey_the_event_in_its_own_step():
    whole = last_of(SMALL, 6.0, 120, {"kind": "never"})
    joined = whole.rows("events", "step")[whole.rows("events", "kind") == EventKind.VEIN_JOINED]
    for step in np.unique(joined).tolist()[:4]:
        last = last_of(SMALL, 6.0, step, {"kind": "time", "time": step})
        kinds, steps = last.rows("events", "kind"), last.rows("events", "step")
        assert steps[kinds == EventKind.MESOPHYLL_EVENT].tolist() == [step]
        assert (steps[kinds == EventKind.VEIN_JOINED] < step).all()
        # they go on for the part of a segment that the gap leaves, and end
        n_ended = np.count_nonzero(steps[kinds == EventKind.VEIN_ENDED_BLINDLY] == step)
        assert n_ended == np.count_nonzero(joined == step)


@pytest.mark.parametrize("gap", [0.3, 0.9, 2.5])
def test_blind_veins_end_at_the_gap(gap):
    tables = leaf(
        "areole",
        SMALL,
        6.0,
        until=150,
        mesophyll={"kind": "time", "time": 90},
        extension={"blind_gap": gap},
    )
    n_at_gap = 0
    for state in simulate(AreoleVenation.model_validate(tables).model(), Streams(1), max_steps=200):
        for tip, canal in blind_now(state):
            # where the strand stopped, in the step in which it did
            goal = state.positions("nodes")[state.rows("perceived", "node")[canal]]
            left = np.hypot(*(state.positions("nodes")[tip] - goal))
            assert left <= gap * (1.0 + 1e-9)
            n_at_gap += left > gap * (1.0 - 1e-9)
    assert n_at_gap > 10


def blind_now(state):
    """Tips and canals of the strands that ended blindly in a step, retargeted ones left out."""
    kinds, now = state.rows("events", "kind"), state.rows("events", "step") == state.step
    tips = state.rows("events", "subject")[now & (kinds == EventKind.VEIN_ENDED_BLINDLY)].tolist()
    retargeted = state.rows("events", "subject")[kinds == EventKind.CANAL_RETARGETED].tolist()
    rows = (state.rows("states", "step") == state.step) & (
        state.rows("states", "what") == Kind.CANAL
    )
    rows &= state.rows("states", "state") == CanalState.ARRESTED
    canals = state.rows("states", "id")[rows].tolist()
    return [pair for pair in zip(tips, canals, strict=True) if pair[1] not in retargeted]


def test_an_event_that_no_run_lasts_to_see_never_happens():
    event = TypeAdapter(AnyMesophyll).validate_python({"kind": "time", "time": 1e300})
    growth = KeyframedParameters.model_validate(keyframed(SMALL)).growth()
    assert event.step(growth) is None
