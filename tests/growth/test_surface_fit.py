"""Key-frames from outlines and landmarks: a known leaf is found again; what cannot be is told."""

import numpy as np
import pytest
from pydantic import ValidationError

from vasc import kernels
from vasc.errors import ConfigError, OutlineError
from vasc.growth import KeyframedParameters
from vasc.growth.fit_problem import FitProblem
from vasc.growth.half_outlines import distances_to, half_outline, nearest_on
from vasc.growth.outline_frames import fit_outlines
from vasc.growth.surface_fit import Landmark, fit_keyframes
from vasc.growth.surfaces import N_COLUMNS, Places, grid_places, heights_of_rows, margin_places

MIRROR = np.array([-1.0, 1.0])
# three ages of the first leaf of Arabidopsis: y, w and s of nine rows
YOUNG = [
    [0, 5, 0], [0.44, 5, 0], [1.33, 5, 0], [2.67, 5, 0], [4.0, 4.9, 0], [5.33, 4.6, -0.3],
    [6.67, 4, -0.5], [7.56, 2.9, -0.6], [8, 1.5, -0.2],
]  # fmt: skip
MIDDLE = [
    [0, 6.4, 0], [3.4, 6.6, 0], [9.4, 6.9, 0], [17.8, 9.6, 0.5], [27.4, 13.4, 2], [37.8, 15.6, 2],
    [46.4, 13.6, 0], [52, 8.8, -1.5], [54.8, 4.5, -0.83],
]  # fmt: skip
OLD = [
    [0, 7.5, 0], [30, 8.8, 0], [63, 80, 3], [108, 130, 28], [167, 130, 50], [210, 110, 28],
    [256, 82, 2], [283, 44, -5], [290, 12, -1.1],
]  # fmt: skip
TIMES = [0.0, 160.0, 600.0]
ROWS = [np.array(rows, dtype=float) for rows in (YOUNG, MIDDLE, OLD)]
LENGTHS = np.array([8.0, 54.8, 290.0])
MARKS = Places(
    np.array([0.9, 1.0, -0.5, 0.0, 0.4, 0.9, 0.0, 0.0, 0.0, 0.5, -0.8, 0.7]),
    np.array([0.5, 0.3, 0.6, 0.35, 0.8, 0.85, 0.55, 0.15, 0.75, 0.2, 0.4, 0.7]),
    9,
)


def ring_of(rows):
    """Give the outline of a surface, counter-clockwise from the right corner of the base."""
    right = margin_places(9, 200, 60).positions(rows)
    return np.concatenate([right, right[-2::-1] * MIRROR])


def landmarks_of(places):
    """Give points of the known leaf as they are seen at the three ages."""
    seen = np.array([places.positions(rows) for rows in ROWS])
    return [Landmark(f"mark {row}", seen[:, row]) for row in range(len(places.c))]


RINGS = [ring_of(rows) for rows in ROWS]


def fit(*given, n_rows=9, tolerance=0.02):
    return fit_keyframes(*given, n_rows=n_rows, tolerance=tolerance)


@pytest.fixture(scope="module")
def fitted():
    return fit(RINGS, TIMES, landmarks_of(MARKS))


def test_a_surface_is_that_of_the_runs():
    c, v = np.random.default_rng(1).uniform([-1.0, 0.0], [1.0, 1.0], (50, 2)).T
    shape = kernels.bspline.surface(9, N_COLUMNS)
    rows = np.ascontiguousarray(ROWS[1].T)
    twin = kernels.bspline.evaluate(shape, rows, np.stack([c, v], axis=1))
    np.testing.assert_allclose(Places(c, v, 9).positions(ROWS[1]), twin, atol=1e-12)


def test_derivatives_are_those_of_differences():
    c, v = np.random.default_rng(2).uniform([-0.9, 0.1], [0.9, 0.9], (50, 2)).T
    places, step = Places(c, v, 9), 1e-6
    by_c, by_v = places.derivatives(ROWS[2])
    for found, dc, dv in ((by_c, step, 0.0), (by_v, 0.0, step)):
        ahead, behind = (
            Places(c + sign * dc, v + sign * dv, 9).positions(ROWS[2]) for sign in (1.0, -1.0)
        )
        np.testing.assert_allclose(found, (ahead - behind) / (2.0 * step), atol=1e-4)
    stretch, by_rows = places.stretch(ROWS[2])
    width = places.positions(ROWS[2])[:, 0] / c
    determinant = by_c[:, 0] * by_v[:, 1] - by_c[:, 1] * by_v[:, 0]
    np.testing.assert_allclose(stretch * width, determinant, rtol=1e-9)
    change = np.random.default_rng(3).normal(size=(9, 3))
    ahead, behind = (places.stretch(ROWS[2] + sign * step * change)[0] for sign in (1.0, -1.0))
    expected = (ahead - behind) / (2.0 * step)
    np.testing.assert_allclose(by_rows @ change.ravel(), expected, rtol=1e-5, atol=1e-5)


def test_the_fit_knows_its_derivatives():
    seen = np.array([mark.positions for mark in landmarks_of(MARKS)])
    problem = FitProblem([half_outline(ring) for ring in RINGS], seen, 9)
    rng = np.random.default_rng(4)
    unknowns = problem.start + rng.normal(size=len(problem.start)) * 1e-3
    change, step = rng.normal(size=len(unknowns)), 1e-7
    ahead = problem.residuals(unknowns + step * change)
    behind = problem.residuals(unknowns - step * change)
    slope = problem.jacobian(unknowns) @ change
    off = np.abs((ahead - behind) / (2.0 * step) - slope)
    # the outline is a polygon: at its corners the nearest edge changes
    assert np.quantile(off, 0.98) < 1e-5
    assert off.max() < 0.2 * np.abs(slope).max()


def test_even_rows_are_a_strap():
    heights = heights_of_rows(9)
    rows = np.stack([heights, np.ones(9), np.zeros(9)], axis=1)
    places = grid_places(9)
    expected = np.stack([places.c, places.v], axis=1)
    np.testing.assert_allclose(places.positions(rows), expected, atol=1e-12)
    np.testing.assert_allclose(places.stretch(rows)[0], 1.0, rtol=1e-12)


def test_outlines_are_followed_within_a_percent(fitted):
    assert (fitted.residuals < 0.01 * LENGTHS).all()
    for (_, rows), ring, residual in zip(fitted.frames, RINGS, fitted.residuals, strict=True):
        margin = margin_places(9, 500, 100).positions(rows)
        assert distances_to(margin, half_outline(ring)).max() < 1.05 * residual


def test_landmarks_keep_their_place_in_the_tissue(fitted):
    assert (fitted.landmark_residuals < 0.01 * LENGTHS).all()
    known = np.stack([MARKS.c, MARKS.v], axis=1)
    np.testing.assert_allclose(fitted.landmarks, known, atol=0.06)


def test_tissue_between_landmarks_is_where_it_was(fitted):
    places = grid_places(9)
    for (_, rows), known, length in zip(fitted.frames, ROWS, LENGTHS, strict=True):
        offsets = places.positions(rows) - places.positions(known)
        assert np.sqrt((offsets**2).sum(axis=1)).max() < 0.06 * length
        assert np.sqrt((offsets**2).sum(axis=1)).mean() < 0.02 * length


def test_rows_begin_at_the_base_end_at_the_tip_and_do_not_fold(fitted):
    for (time, rows), expected, ring in zip(fitted.frames, TIMES, RINGS, strict=True):
        assert time == expected
        assert rows[0, [0, 2]].tolist() == [0.0, 0.0]
        tip = Places(np.zeros(1), np.ones(1), 9).positions(rows)
        assert tip.tolist() == [[0.0, pytest.approx(ring[:, 1].max(), rel=4e-3)]]
        assert (rows[:, 1] > 0.0).all()
        assert (grid_places(9, 21, 161).stretch(rows)[0] > 0.0).all()
        # so coarse that no processor makes a difference
        assert (rows * 1024.0 == np.round(rows * 1024.0)).all()


def test_outlines_alone_are_followed_too():
    fitted = fit(RINGS, TIMES)
    assert (fitted.residuals < 0.01 * LENGTHS).all()
    assert fitted.landmarks.shape == (0, 2)
    assert fitted.landmark_residuals.shape == (0, 3)


def test_a_landmark_need_not_be_seen_at_every_age():
    marks = landmarks_of(MARKS)
    late = marks[2].positions.copy()
    late[0] = np.nan
    marks[2] = Landmark("late", late)
    fitted = fit(RINGS, TIMES, marks)
    assert np.isnan(fitted.landmark_residuals[2]).tolist() == [True, False, False]
    assert (fitted.landmark_residuals[2, 1:] < 0.01 * LENGTHS[1:]).all()


def test_another_number_of_rows_does():
    fitted = fit(RINGS[:1], TIMES[:1], n_rows=6)
    assert fitted.frames[0][1].shape == (6, 3)
    assert fitted.residuals[0] < 0.02 * 8.0


def test_halves_are_averaged():
    right = RINGS[0][: len(RINGS[0]) // 2 + 1]
    left = right[::-1] * [-0.8, 1.0]
    lopsided = np.concatenate([right, left[1:]])
    half = half_outline(lopsided)
    assert half[0, 0] == pytest.approx(0.9 * 5.0, rel=1e-9)
    assert half[-1].tolist() == [0.0, pytest.approx(8.0, rel=1e-2)]


def test_normals_point_to_the_right():
    line = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
    feet, normals = nearest_on(line, np.array([[0.2, 0.5], [0.5, 2.0]]))
    np.testing.assert_allclose(feet, [[0.0, 0.5], [0.5, 1.0]])
    np.testing.assert_allclose(normals, [[1.0, 0.0], [0.0, -1.0]])


# what is refused


def test_an_outline_that_no_surface_follows_is_refused():
    angles = np.linspace(-np.pi / 2, np.pi * 1.5, 400, endpoint=False)
    radius = 4.0 * (1.0 + 0.35 * np.cos(9.0 * (angles - np.pi / 2)))
    lobed = np.stack([radius * np.cos(angles), radius * np.sin(angles)], axis=1)
    lobed -= lobed[0]
    lobed[0] = 0.0
    with pytest.raises(ConfigError, match=r"outline at t = 0: a surface of 9 rows stays .* D"):
        fit([lobed], [0.0])


def test_a_landmark_that_jumps_is_refused():
    # from the left to the right half
    jumping = np.array([[-3.0, 4.0], [8.0, 27.0]])
    with pytest.raises(ConfigError, match=r"landmark 'jumping' at t = \d+: one place .* is"):
        fit(RINGS[:2], TIMES[:2], [Landmark("jumping", jumping)])


@pytest.mark.parametrize("place", [(9.0, 20.0), (-19.0, 20.0), (0.0, -3.0), (2.0, 58.0)])
def test_a_landmark_beside_the_leaf_is_named(place):
    marks = [Landmark("within", np.array([[0.0, 3.0], [0.0, 30.0]]))]
    # the young leaf is narrower and lower than the next one
    for age, beside in ((0, place), (1, (2.0 * place[0], 1.1 * place[1]))):
        seen = np.full((2, 2), np.nan)
        seen[age] = beside
        with pytest.raises(ConfigError, match=rf"landmark 'beside' at t = {TIMES[age]:g}: .*D out"):
            fit(RINGS[:2], TIMES[:2], [*marks, Landmark("beside", seen)])


def test_landmarks_that_change_places_are_refused():
    marks = [
        Landmark("a", np.array([[0.0, 3.0], [0.0, 35.0]])),
        Landmark("b", np.array([[0.0, 5.0], [0.0, 20.0]])),
    ]
    with pytest.raises(ConfigError, match=r"landmark '[ab]' at t = \d+: one place"):
        fit(RINGS[:2], TIMES[:2], marks)


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (([], []), "0 outlines for 0 times"),
        ((RINGS, TIMES[:2]), "3 outlines for 2 times"),
        ((RINGS, [0.0, 60.0, 60.0]), "must ascend"),
        ((RINGS, TIMES, [Landmark("a", np.zeros((2, 2)))]), "landmark 'a': positions of shape"),
        ((RINGS, TIMES, [Landmark("a", np.full((3, 2), np.nan))]), "landmark 'a': seen at no age"),
    ],
)
def test_what_does_not_go_together_is_refused(arguments, problem):
    with pytest.raises(ConfigError, match=problem):
        fit(*arguments)


def test_too_few_rows_and_no_outlines_are_refused():
    with pytest.raises(ConfigError, match="n_rows = 3"):
        fit(RINGS, TIMES, n_rows=3)
    with pytest.raises(OutlineError, match="outline"):
        fit([np.zeros((4, 3))], [0.0])


# configs


def written(folder, name, ring):
    """Write an outline as CSV, in other units and off the origin."""
    lines = "\n".join(f"{x!r},{y!r}" for x, y in (3.0 * ring + [40.0, 7.0]).tolist())
    (folder / name).write_text("x,y\n" + lines)


@pytest.fixture
def frames(tmp_path):
    for row, ring in enumerate(RINGS):
        written(tmp_path, f"age{row}.csv", ring)
    return {
        "outlines": [
            {"time": time, "file": f"age{row}.csv", "height": length}
            for row, (time, length) in enumerate(zip(TIMES, LENGTHS.tolist(), strict=True))
        ],
        "landmarks": [
            {"name": mark.name, "positions": (mark.positions / LENGTHS[:, None]).tolist()}
            for mark in landmarks_of(MARKS)
        ],
    }


def test_a_config_gives_the_same_key_frames(frames, tmp_path, fitted):
    frames["landmarks"][1]["positions"][0] = []
    config = KeyframedParameters(**frames)
    given = config.outlines, config.landmarks, tmp_path
    found = fit_outlines(*given, n_rows=config.n_rows, tolerance=config.tolerance)
    for (_, rows), (_, same) in zip(config.keyframes(tmp_path), found.frames, strict=True):
        np.testing.assert_array_equal(rows, same)
    assert [time for time, _ in found.frames] == TIMES
    assert np.isnan(found.landmark_residuals[1, 0])
    assert (found.residuals < 0.01 * LENGTHS).all()
    places = grid_places(9)
    for (_, rows), (_, known), length in zip(found.frames, fitted.frames, LENGTHS, strict=True):
        offsets = places.positions(rows) - places.positions(known)
        assert np.abs(offsets).max() < 0.02 * length


def test_files_that_hold_no_leaf_are_named(frames, tmp_path):
    (tmp_path / "age1.csv").write_text("x,y\n1,2\n")
    with pytest.raises(ConfigError, match=r'growth\.outlines\[1\]\.file = "age1.csv"'):
        KeyframedParameters(**frames).keyframes(tmp_path)
    lines = [f"{x},{y},{ring}" for ring in range(2) for x, y in [(0, 0), (4, 0), (2, 3)]]
    moved = [line if line.endswith("0") else "1" + line for line in lines]
    (tmp_path / "age1.csv").write_text("x,y,ring\n" + "\n".join(moved))
    with pytest.raises(ConfigError, match="2 rings"):
        KeyframedParameters(**frames).keyframes(tmp_path)


@pytest.mark.parametrize(
    ("spoil", "problem"),
    [
        (lambda frames: frames["outlines"].reverse(), r"outlines\[0\]\.time is .*must be 0"),
        (lambda frames: frames["landmarks"][2]["positions"].pop(), r"landmarks\[2\]\.positions"),
        (lambda frames: frames["landmarks"][0]["positions"][1].pop(), r"positions\[1\] holds 1"),
        (
            lambda frames: frames["landmarks"].append({"name": "a", "positions": [[], [], []]}),
            "holds no pair",
        ),
        (lambda frames: frames["outlines"].clear(), "either 'frames' or 'outlines'"),
    ],
)
def test_unsound_configs_are_refused(frames, spoil, problem):
    spoil(frames)
    with pytest.raises(ValidationError, match=problem):
        KeyframedParameters(**frames)
