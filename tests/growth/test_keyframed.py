"""Key-framed growth: surfaces, linear in time between those that are given."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from reference.leaves import ARABIDOPSIS, FOLDING, SMALL, keyframed

from vasc import kernels
from vasc.errors import ConfigError
from vasc.growth import MARGIN_SPACING, KeyframedParameters
from vasc.growth.keyframed import least_determinants

LEAVES = {"arabidopsis": ARABIDOPSIS, "small": SMALL, "one frame": {0.0: SMALL[0.0]}}


def growth_of(frames, **tables):
    return KeyframedParameters.model_validate(keyframed(frames, **tables)).growth()


GROWTHS = {name: growth_of(frames) for name, frames in LEAVES.items()}


def points(n=200):
    """Material points of all sorts."""
    rng = np.random.default_rng(3)
    return np.stack([rng.uniform(-1.0, 1.0, n), rng.random(n)], axis=1)


@pytest.mark.parametrize("name", ["arabidopsis", "small"])
@pytest.mark.parametrize("duration", [1.0, 0.25, 7.0])
def test_points_move_straight_and_evenly_between_key_frames(name, duration):
    frames, growth = LEAVES[name], growth_of(LEAVES[name], step_duration=duration)
    times = list(frames)
    shape = kernels.bspline.surface(len(frames[0.0]), 5)
    given = [
        kernels.bspline.evaluate(shape, np.array(rows).T.copy(), points())
        for rows in frames.values()
    ]
    for step in np.unique(np.linspace(0, growth.last_step - 1, 80).astype(int)).tolist():
        time = step * duration
        after = next(k for k, other in enumerate(times) if other > time)
        share = (time - times[after - 1]) / (times[after] - times[after - 1])
        expected = given[after - 1] + share * (given[after] - given[after - 1])
        np.testing.assert_allclose(growth.position(points(), step), expected, atol=1e-10)
        assert growth.time(step) == time


@pytest.mark.parametrize(
    ("duration", "last_step"), [(1.0, 130), (2.0, 65), (7.0, 19), (0.1, 1300), (50.0, 3)]
)
def test_the_last_step_reaches_the_last_frame_and_all_later_ones_keep_it(duration, last_step):
    growth = growth_of(SMALL, step_duration=duration)
    assert growth.last_step == last_step
    final = np.array(SMALL[130.0]).T
    for step in (last_step, last_step + 1, last_step + 1000):
        np.testing.assert_array_equal(growth.rows(step), final)
    assert (growth.rows(last_step - 1) != final).any()
    ends = [growth.position(points(), step) for step in (last_step, last_step + 77)]
    np.testing.assert_array_equal(*ends)


def test_one_frame_never_grows():
    growth = GROWTHS["one frame"]
    assert growth.last_step == 0
    np.testing.assert_array_equal(growth.position(points(), 0), growth.position(points(), 9))


@pytest.mark.parametrize("name", GROWTHS)
def test_the_margin_is_close_sampled_and_mirrored_at_all_steps(name):
    growth = GROWTHS[name]
    for step in [*range(0, growth.last_step, 4), growth.last_step, growth.last_step + 5]:
        margin = growth.margin_places(step)
        gaps = np.sqrt(((np.roll(margin, -1, axis=0) - margin) ** 2).sum(axis=1))
        assert gaps.min() > 0.0
        assert gaps.max() <= MARGIN_SPACING * (1.0 + 1e-12)
        images = {(-x + 0.0, y) for x, y in margin.tolist()}
        assert images == {(x + 0.0, y) for x, y in margin.tolist()}


@pytest.mark.parametrize("name", GROWTHS)
def test_the_first_points_of_the_margin_are_the_base(name):
    growth = GROWTHS[name]
    base, rest = growth.margin[: growth.n_base], growth.margin[growth.n_base :]
    assert (base[:, 1] == 0.0).all()
    assert (np.diff(base[:, 0]) > 0.0).all()
    assert base[[0, -1], 0].tolist() == [-1.0, 1.0]
    # the others go up on the right and down on the left, and none is given twice
    assert (rest[:, 1] > 0.0).all()
    assert ((np.abs(rest[:, 0]) == 1.0) | (rest[:, 1] == 1.0)).all()
    assert rest[0, 0] == 1.0
    assert rest[-1, 0] == -1.0
    assert len(np.unique(growth.margin, axis=0)) == len(growth.margin)
    assert growth.domain(0).bounds[1] >= growth.margin_places(0)[0, 1] - 1e-12


@pytest.mark.parametrize("name", GROWTHS)
def test_places_between_points_of_the_margin_are_on_it(name):
    growth = GROWTHS[name]
    rows = np.arange(len(growth.margin))
    for share in (0.0, 0.3, 1.0):
        material, places = growth.along_margin(rows, np.full(len(rows), share), 9)
        is_on = (np.abs(material[:, 0]) == 1.0) | (material[:, 1] == 0.0) | (material[:, 1] == 1.0)
        assert is_on.all()
        np.testing.assert_array_equal(places, growth.position(material, 9))
        assert growth.domain(9).margin_distance(places).max() < 0.05
    np.testing.assert_array_equal(places, np.roll(growth.margin_places(9), -1, axis=0))


@pytest.mark.parametrize("name", GROWTHS)
def test_the_box_holds_all_places_of_all_steps(name):
    growth = GROWTHS[name]
    low_x, low_y, high_x, high_y = growth.box
    for step in [*range(0, growth.last_step, 4), growth.last_step]:
        places = np.concatenate([growth.margin_places(step), growth.position(points(), step)])
        assert (places >= [low_x, low_y]).all()
        assert (places <= [high_x, high_y]).all()


@pytest.mark.parametrize("name", GROWTHS)
def test_position_and_material_are_inverse(name):
    growth = GROWTHS[name]
    for step in {0, 1, growth.last_step // 3, growth.last_step, growth.last_step + 5}:
        there = growth.position(points(), step)
        np.testing.assert_allclose(growth.material(there, step), points(), atol=1e-9)
        near = np.clip(points() + 0.01, [-1.0, 0.0], 1.0)
        material, position = growth.embed(there, step, near)
        np.testing.assert_allclose(material, points(), atol=1e-9)
        np.testing.assert_array_equal(position, growth.position(material, step))


def test_veins_begin_in_the_middle_of_the_base():
    for growth in GROWTHS.values():
        for step in (0, 7):
            np.testing.assert_array_equal(growth.domain(step).seeds, [[0.0, 0.0]])


def determinants(frames, time, material):
    """Jacobian determinants at a time, from differences of positions that are interpolated."""
    times = np.array(list(frames))
    rows = np.array([np.array(rows).T for rows in frames.values()])
    now = np.array(
        [[np.interp(time, times, rows[:, i, j]) for j in range(rows.shape[2])] for i in range(3)]
    )
    shape = kernels.bspline.surface(rows.shape[2], 5)
    x_c, y_c, x_v, y_v = kernels.bspline.jacobians(shape, now, material).T
    return x_c * y_v - x_v * y_c


CROSSING = {
    0.0: [(0.0, 17.0, 8.0), (6.0, 1.0, -5.0), (12.0, 2.0, 0.0), (18.0, 4.0, 5.0)],
    8.0: [(0.0, 6.0, -6.0), (6.0, 22.0, -8.0), (12.0, 17.0, -7.0), (18.0, 29.0, 8.0)],
}
"""Sound in both key-frames, and not between them."""

GRID = np.stack(np.meshgrid(np.linspace(0, 1, 21), np.linspace(0, 1, 121)), axis=2).reshape(-1, 2)


@pytest.mark.parametrize("frames", [FOLDING, {0.0: FOLDING[10.0]}, CROSSING])
def test_a_fold_is_refused_with_its_time_and_place(frames):
    with pytest.raises(ConfigError, match="the surface folds at time") as caught:
        growth_of(frames)
    time, c, v = (
        float(value)
        for value in re.search(
            r"time (\S+) at c = (\S+) .*, v = (\S+) ", str(caught.value)
        ).groups()
    )
    assert 0.0 <= time <= list(frames)[-1]
    assert determinants(frames, time, np.array([[c, v]]))[0] < 0.0
    # it is the worst place and time
    times = np.linspace(0.0, list(frames)[-1], 33)
    least = min(determinants(frames, now, GRID).min() for now in times)
    told = float(re.search(r"stretch is (\S+) there", str(caught.value)).group(1))
    assert told == pytest.approx(least, rel=0.02)


def test_key_frames_that_are_sound_may_fold_between_each_other():
    assert all(determinants(CROSSING, time, GRID).min() > 1.0 for time in CROSSING)
    with pytest.raises(ConfigError, match="folds at time") as caught:
        growth_of(CROSSING)
    time = float(re.search(r"time (\S+) ", str(caught.value)).group(1))
    assert 0.0 < time < 8.0
    for rows in CROSSING.values():
        assert growth_of({0.0: rows}).last_step == 0


@pytest.mark.parametrize("name", ["arabidopsis", "small"])
def test_sound_leaves_fold_at_no_time(name):
    frames = LEAVES[name]
    rng = np.random.default_rng(2)
    material = np.abs(points())
    for time in rng.uniform(0.0, list(frames)[-1], 60):
        assert determinants(frames, time, material).min() > 0.0


@given(st.integers(0, 2**32 - 1))
def test_least_determinants_are_the_least_of_many_times(seed):
    rng = np.random.default_rng(seed)
    first, second = rng.normal(size=(2, 20, 4)) * rng.choice([0.01, 1.0, 100.0])
    if rng.random() < 0.3:
        second = first * rng.uniform(0.5, 2.0)
    if rng.random() < 0.1:
        second = first.copy()
    least, shares = least_determinants(first, second)
    assert ((shares >= 0.0) & (shares <= 1.0)).all()
    size = (np.abs(first).max() + np.abs(second).max()) ** 2

    def determinant(share):
        now = (1.0 - share)[:, None] * first + share[:, None] * second
        return now[:, 0] * now[:, 3] - now[:, 2] * now[:, 1]

    np.testing.assert_allclose(determinant(shares), least, atol=1e-12 * size)
    tried = np.array([determinant(np.full(20, share)) for share in np.linspace(0.0, 1.0, 201)])
    assert (least <= tried.min(axis=0) + 1e-12 * size).all()
    assert (least >= tried.min(axis=0) - 1e-4 * size).all()


SOUND = [(0.0, 5.0, 0.0), (4.0, 5.0, 0.0), (8.0, 5.0, 0.0), (12.0, 5.0, 0.0)]


def changed(row, values):
    """The sound rows with another one in the place of one."""
    return [values if k == row else old for k, old in enumerate(SOUND)]


@pytest.mark.parametrize(
    ("frames", "message"),
    [
        ({5.0: SOUND}, "the first key-frame is of time 5; it must be 0"),
        ({0.0: SOUND, -1.0: SOUND}, "greater than or equal to 0"),
        (
            {0.0: SOUND, 9.0: SOUND, 8.0: SOUND},
            "time is 8; times must ascend, and the one before is 9",
        ),
        ({0.0: SOUND, 9.0: [*SOUND, (20.0, 5.0, 0.0)]}, "time 9 has 5 rows; all must have as many"),
        ({0.0: SOUND[:3]}, "at least 4 items"),
        ({0.0: changed(2, (4.0, 5.0, 0.0))}, r"row 2 has the height 4; .* above that of row 1 \(4"),
        ({0.0: changed(2, (3.0, 5.0, 0.0))}, "row 2 has the height 3"),
        ({0.0: SOUND, 3.0: changed(3, (12.0, 0.0, 0.0))}, "time 3: row 3 has the half-width 0"),
        ({0.0: changed(0, (0.0, -2.0, 0.0))}, "row 0 has the half-width -2"),
        ({0.0: changed(0, (0.0, float("nan"), 0.0))}, "finite"),
        ({}, "give either 'frames' or 'outlines'"),
    ],
)
def test_key_frames_that_make_no_sense_are_refused_with_the_reason(frames, message):
    with pytest.raises(ValidationError, match=message):
        KeyframedParameters.model_validate(keyframed(frames))


def test_two_frames_of_one_time_are_refused():
    frames = [{"time": 0.0, "rows": SOUND}, {"time": 0.0, "rows": SOUND}]
    with pytest.raises(ValidationError, match="times must ascend"):
        KeyframedParameters.model_validate({"kind": "keyframed", "frames": frames})


def test_growth_that_would_hardly_end_is_refused():
    with pytest.raises(ConfigError, match=r"growth\.step_duration = 1e-05.*allowed are 1,000,000"):
        growth_of(SMALL, step_duration=1e-5)
