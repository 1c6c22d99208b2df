"""Growth tensors: those of growth that has formulas, on grids that cover the blade."""

import numpy as np
import pytest
import shapely

from vasc.domain import Blade, BladeParameters
from vasc.growth import IsogonicParameters, LocalToGlobalParameters, MarginalParameters
from vasc.growth.tensor import growth_tensor, material_grid, positions_of, strain

DOME = BladeParameters(shape="dome", length=8.0).blade()
TABLE = {"heights": [0.0, 0.5, 1.0], "g_x": [0.2, 0.8, 1.0], "g_y": [1.0, 0.6, 0.4], "end": 4.0}


def stretched(g_x, g_y):
    """Give growth by the same factors at all heights."""
    table = {"heights": [0.0, 1.0], "g_x": [g_x] * 2, "g_y": [g_y] * 2}
    return LocalToGlobalParameters(**table, end=4.0).growth(DOME)


def test_a_grid_covers_the_blade_and_is_even_at_the_first_step():
    growth = LocalToGlobalParameters(**TABLE).growth(DOME)
    grid = material_grid(growth, 100, 400, n_rows=50, n_columns=20)
    points = positions_of(growth, grid, 100)
    assert points.shape == (50, 20, 2)
    corners = np.concatenate([points[0], points[1:, -1], points[-1, ::-1], points[::-1, 0]])
    covered = shapely.Polygon(corners).intersection(growth.domain(100).polygon)
    assert covered.area > 0.98 * growth.domain(100).area
    np.testing.assert_allclose(points[:, :, 1], points[:, :1, 1].repeat(20, axis=1), atol=1e-9)
    np.testing.assert_allclose(np.diff(points[:, 0, 1], n=2), 0.0, atol=1e-9)
    np.testing.assert_allclose(np.diff(points[:, :, 0], n=2, axis=1), 0.0, atol=1e-9)


def test_a_blade_that_gains_ground_outside_is_covered_at_the_last_step():
    growth = MarginalParameters(final_length=16.0, length_per_step=1.0).growth(DOME)
    points = positions_of(growth, material_grid(growth, 0, 8), 8)
    assert points[-1, 0, 1] == pytest.approx(16.0, rel=0.01)


def test_equal_stretch_has_one_tensor():
    growth = stretched(0.5, 1.0)
    grid = material_grid(growth, 0, 400)
    tensor = growth_tensor(growth, grid, 100, 200)
    expected = np.diag([1.5**2 - 1.0, 2.0**2 - 1.0]) / 200.0
    np.testing.assert_allclose(tensor, np.broadcast_to(expected, tensor.shape), atol=1e-9)
    found = strain(growth, grid, 100, 200)
    np.testing.assert_allclose(found.areal, np.log(3.0**2) / 200.0, rtol=1e-9)
    np.testing.assert_allclose(found.anisotropy, (2.0 / 1.5) ** 2, rtol=1e-9)
    np.testing.assert_allclose(np.abs(found.directions[..., 1]), 1.0, rtol=1e-9)


def test_a_tensor_is_the_derivative_of_later_by_earlier_positions():
    growth = LocalToGlobalParameters(**TABLE).growth(DOME)
    grid = material_grid(growth, 100, 150, n_rows=161, n_columns=21)
    tensor = growth_tensor(growth, grid, 100, 50)
    places, step = positions_of(growth, grid, 100), 1e-4
    some = places[40:120:20, 5:15:3].reshape(-1, 2)
    columns = []
    for axis in (0, 1):
        offset = step * np.eye(2)[axis]
        ends = [
            growth.position(growth.material(some + sign * offset, 100), 150) for sign in (1, -1)
        ]
        columns.append((ends[0] - ends[1]) / (2.0 * step))
    expected = (np.stack(columns, axis=-1) - np.eye(2)) / 50.0
    found = tensor[40:120:20, 5:15:3].reshape(-1, 2, 2)
    np.testing.assert_allclose(found, expected, rtol=0.02, atol=2e-5)


def test_isogonic_growth_is_equal_in_all_directions_and_marginal_none():
    growth = IsogonicParameters(final_length=32.0, length_per_step=1.0).growth(DOME)
    found = strain(growth, material_grid(growth, 0, 24), 0, 24)
    np.testing.assert_allclose(found.areal, np.log(16.0) / 24.0, rtol=1e-9)
    np.testing.assert_allclose(found.anisotropy, 1.0, rtol=1e-9)
    growth = MarginalParameters(final_length=32.0, length_per_step=1.0).growth(DOME)
    found = strain(growth, material_grid(growth, 0, 24), 0, 24)
    np.testing.assert_allclose(found.areal, 0.0, atol=1e-12)


def test_a_blade_of_parts_one_above_the_other_has_a_grid():
    square = np.array([[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 1.0]])
    blade = Blade.from_rings(
        [square, square + np.array([0.0, 5.0])], seeds=[[0.0, 0.0], [0.0, 5.0]]
    )
    growth = MarginalParameters(final_length=12.0, length_per_step=1.0).growth(blade)
    grid = material_grid(growth, 0, 6)
    assert np.isfinite(grid).all()
    np.testing.assert_allclose(np.abs(grid[:, 0, 0]), 2.0)
