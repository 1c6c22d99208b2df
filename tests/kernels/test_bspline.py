"""The surface of a blade: the tensor-product spline of its control net, forth and back."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from reference.leaves import ARABIDOPSIS, SMALL
from scipy.interpolate import BSpline, NdBSpline
from scipy.spatial import cKDTree

from vasc import kernels

bspline = kernels.bspline

N_COLUMNS = 5
FRAMES = [np.array(rows).T.copy() for rows in [*ARABIDOPSIS.values(), *SMALL.values()]]


def control_net(rows, n_columns=N_COLUMNS):
    """The points (w c, y + s c^2) of the thesis, shape (columns, rows, 2)."""
    knots = clamped(n_columns)
    greville = np.array([knots[k + 1 : k + 4].mean() for k in range(n_columns)])
    c = (2.0 * greville - 1.0)[:, None]
    heights, widths, rises = rows
    return np.stack([widths * c, heights + rises * c**2], axis=2)


def clamped(n_controls):
    """Clamped uniform knots of a cubic spline."""
    inner = np.linspace(0.0, 1.0, n_controls - 2)[1:-1]
    return np.r_[np.zeros(4), inner, np.ones(4)]


def full_surface(rows, n_columns=N_COLUMNS):
    """The tensor product of scipy over all control points; its arguments are u and v."""
    knots = clamped(n_columns), clamped(rows.shape[1])
    return NdBSpline(knots, control_net(rows, n_columns), 3)


def between(rng, n):
    """Control rows at random times between key-frames of one leaf, and those of the key-frames."""
    found = list(FRAMES)
    for _ in range(n):
        first = int(rng.choice([0, 1, 2, 3, 4, 6, 7]))
        share = rng.random()
        found.append((1.0 - share) * FRAMES[first] + share * FRAMES[first + 1])
    return found


def material_points(rng, n):
    """Pairs (c, v) within the leaf, on its margin, its midline and its base, and on knots."""
    points = np.stack([rng.uniform(-1.0, 1.0, n), rng.random(n)], axis=1)
    grid = np.stack(np.meshgrid([-1.0, -0.5, 0.0, 0.5, 1.0], np.linspace(0.0, 1.0, 7)), axis=2)
    return np.concatenate([points, grid.reshape(-1, 2)])


def surface_of(rows, n_columns=N_COLUMNS):
    return bspline.surface(rows.shape[1], n_columns)


@pytest.mark.parametrize("n_columns", [4, 5, 8])
def test_points_are_those_of_the_full_control_net(n_columns):
    rng = np.random.default_rng(1)
    for rows in between(rng, 12):
        points = material_points(rng, 60)
        found = bspline.evaluate(surface_of(rows, n_columns), rows, points)
        u_v = np.stack([0.5 * (1.0 + points[:, 0]), points[:, 1]], axis=1)
        expected = full_surface(rows, n_columns)(u_v)
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12 * np.abs(rows).max())


def test_tangents_are_those_of_the_full_control_net():
    rng = np.random.default_rng(2)
    for rows in between(rng, 12):
        points = np.abs(material_points(rng, 60))
        found = bspline.jacobians(surface_of(rows), rows, points)
        u_v = np.stack([0.5 * (1.0 + points[:, 0]), points[:, 1]], axis=1)
        full = full_surface(rows)
        # c = 2 u - 1
        along_c, along_v = 0.5 * full(u_v, nu=[1, 0]), full(u_v, nu=[0, 1])
        expected = np.concatenate([along_c, along_v], axis=1)
        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-11 * np.abs(rows).max())


def test_points_rise_by_the_tangents():
    rng = np.random.default_rng(3)
    rows = FRAMES[4]
    points = rng.uniform(0.01, 0.99, (200, 2))
    tangents = bspline.jacobians(surface_of(rows), rows, points).reshape(-1, 2, 2)
    for axis, tangent in enumerate(tangents.transpose(1, 0, 2)):
        shift = 1e-6 * np.eye(2)[axis]
        ahead, behind = (
            bspline.evaluate(surface_of(rows), rows, points + sign * shift) for sign in (1, -1)
        )
        np.testing.assert_allclose((ahead - behind) / 2e-6, tangent, rtol=1e-6, atol=1e-5)


@pytest.mark.parametrize("n_controls", [4, 5, 9, 16])
def test_splines_are_those_of_scipy_at_both_ends_and_on_knots(n_controls):
    rng = np.random.default_rng(n_controls)
    controls, knots = rng.normal(size=n_controls), bspline.clamped_knots(n_controls)
    np.testing.assert_allclose(knots, clamped(n_controls), atol=1e-15)
    whole = BSpline(knots, controls, 3)
    for t in [*knots.tolist(), *rng.random(50).tolist()]:
        value, slope = bspline.spline(knots, controls, t)
        assert value == pytest.approx(float(whole(t)), rel=1e-12, abs=1e-12)
        assert slope == pytest.approx(float(whole.derivative()(t)), rel=1e-11, abs=1e-11)


@pytest.mark.parametrize("guess", ["parent", "generic", "far"])
def test_inversion_finds_the_point_from_any_guess(guess):
    rng = np.random.default_rng(4)
    for rows in between(rng, 20):
        shape = surface_of(rows)
        points = material_points(rng, 120)
        positions = bspline.evaluate(shape, rows, points)
        near = {
            "parent": np.clip(points + rng.normal(scale=0.02, size=points.shape), [-1, 0], 1),
            "generic": np.full_like(points, 0.5),
            "far": np.stack([rng.uniform(-1, 1, len(points)), rng.random(len(points))], axis=1),
        }[guess]
        found = bspline.invert(shape, rows, positions, near)
        residual = bspline.evaluate(shape, rows, found) - positions
        assert np.abs(residual).max() < 1e-9
        assert (np.abs(found - points)).max() < 1e-9


def margin_of(rows, n_points=20_000):
    """Positions along the right margin and the tip, very close to each other, base excluded."""
    t = np.linspace(0.0, 1.0, n_points)
    side = np.stack([np.ones_like(t), t], axis=1)
    top = np.stack([t[::-1], np.ones_like(t)], axis=1)
    right = bspline.evaluate(surface_of(rows), rows, np.concatenate([side, top]))
    return np.concatenate([right, right * [-1.0, 1.0]])


def base_of(rows):
    """Positions along the base, where the leaf is attached."""
    t = np.linspace(-1.0, 1.0, 4001)
    return bspline.evaluate(surface_of(rows), rows, np.stack([t, np.zeros_like(t)], axis=1))


@pytest.mark.parametrize("frame", range(len(FRAMES)))
def test_outside_the_blade_the_nearest_point_of_its_border_is_found(frame):
    rng = np.random.default_rng(5)
    rows = FRAMES[frame]
    shape = surface_of(rows)
    # a strand leaves the blade by a segment at most, near to where its parent is
    inside = np.stack([rng.uniform(0.7, 1.0, 400), rng.uniform(0.0, 1.0, 400)], axis=1)
    positions = bspline.evaluate(shape, rows, inside) + rng.uniform(-1.0, 1.0, (400, 2))
    margin = margin_of(rows)
    half = len(margin) // 2
    ring = np.concatenate([margin[:half], margin[half:][::-1]])
    is_outside = ~shapely.contains_xy(shapely.Polygon(ring), positions[:, 0], positions[:, 1])
    is_outside &= positions[:, 0] > 0.0
    for corner in bspline.evaluate(shape, rows, np.array([[1.0, 0.0], [1.0, 1.0]])):
        is_outside &= np.hypot(*(positions - corner).T) > 2.0
    assert is_outside.sum() > 5
    border = cKDTree(np.concatenate([margin[:half], base_of(rows)]))
    positions, near = positions[is_outside], inside[is_outside]
    found = bspline.invert(shape, rows, positions, near)
    assert (np.abs(found) <= 1.0).all()
    assert (found[:, 1] >= 0.0).all()
    reached = np.hypot(*(bspline.evaluate(shape, rows, found) - positions).T)
    # no sample of the border is nearer
    assert (reached <= border.query(positions)[0] + 1e-9).all()


def test_mirror_images_are_mirrored_to_the_last_bit():
    rng = np.random.default_rng(6)
    mirror = np.array([-1.0, 1.0])
    for rows in between(rng, 12):
        shape = surface_of(rows)
        points = material_points(rng, 100)
        positions = bspline.evaluate(shape, rows, points)
        there = bspline.evaluate(shape, rows, points * mirror)
        np.testing.assert_array_equal(there, positions * mirror)
        shifted = positions + rng.uniform(-1.0, 1.0, positions.shape)
        near = np.clip(points + 0.01, [-1.0, 0.0], 1.0)
        one = bspline.invert(shape, rows, shifted, near)
        other = bspline.invert(shape, rows, shifted * mirror, near * mirror)
        np.testing.assert_array_equal(other, one * mirror)


def test_the_midline_stays_the_midline():
    for rows in FRAMES:
        shape = surface_of(rows)
        points = np.stack([np.zeros(50), np.linspace(0.0, 1.0, 50)], axis=1)
        positions = bspline.evaluate(shape, rows, points)
        assert (positions[:, 0] == 0.0).all()
        found = bspline.invert(
            shape, rows, positions + np.array([1e-12, 0.0]), points + np.array([0.3, 0.0])
        )
        assert (found[:, 0] == 0.0).all()
        np.testing.assert_allclose(found[:, 1], points[:, 1], atol=1e-11)


@st.composite
def valid_rows(draw):
    """Rows as the parameters allow them, of moderate rises: sound surfaces for the most part."""
    n_rows = draw(st.integers(4, 12))
    positive = st.floats(0.5, 20.0)
    heights = np.r_[0.0, np.cumsum([draw(positive) for _ in range(n_rows - 1)])]
    widths = [draw(st.floats(1.0, 60.0)) for _ in range(n_rows)]
    rises = [draw(st.floats(-0.4, 0.4)) for _ in range(n_rows)]
    return np.array([heights, widths, rises])


@given(valid_rows(), st.integers(0, 2**32 - 1))
def test_any_rows(rows, seed):
    rng = np.random.default_rng(seed)
    shape = surface_of(rows)
    points = material_points(rng, 30)
    positions = bspline.evaluate(shape, rows, points)
    u_v = np.stack([0.5 * (1.0 + points[:, 0]), points[:, 1]], axis=1)
    scale = np.abs(rows).max()
    np.testing.assert_allclose(positions, full_surface(rows)(u_v), rtol=0, atol=1e-12 * scale)
    near = np.clip(points + rng.normal(scale=0.01, size=points.shape), [-1, 0], 1)
    found = bspline.invert(shape, rows, positions, near)
    assert np.abs(bspline.evaluate(shape, rows, found) - positions).max() < 1e-9 * scale
