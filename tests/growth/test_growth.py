"""Growth is a map: forth and back, at every step."""

import numpy as np
import pytest

from vasc.domain import BladeParameters
from vasc.errors import ConfigError
from vasc.growth import IsogonicParameters, MarginalParameters, NoGrowthParameters

BLADE = BladeParameters(shape="ovate", length=10.0).blade()
GROWTHS = {
    "none": NoGrowthParameters().growth(BLADE),
    "marginal": MarginalParameters(final_length=33.0, length_per_step=2.0).growth(BLADE),
    "isogonic": IsogonicParameters(final_length=33.0, length_per_step=2.0).growth(BLADE),
}


@pytest.mark.parametrize("name", GROWTHS)
def test_position_and_material_are_inverse(name):
    growth = GROWTHS[name]
    points = np.random.default_rng(1).random((50, 2))
    for step in (0, 1, 7, 100):
        there = growth.position(points, step)
        np.testing.assert_allclose(growth.material(there, step), points, rtol=1e-14)


def test_what_moves():
    assert [GROWTHS[name].scale(100) for name in GROWTHS] == [1.0, 1.0, 3.3]
    assert [GROWTHS[name].outline_scale(100) for name in GROWTHS] == [1.0, 3.3, 3.3]


@pytest.mark.parametrize("name", ["marginal", "isogonic"])
def test_the_final_length_is_reached_in_the_last_step_and_kept(name):
    growth = GROWTHS[name]
    assert growth.last_step == 12
    assert growth.domain(11).length < 33.0
    assert growth.domain(12).length == pytest.approx(33.0, rel=1e-15)
    assert growth.domain(5000).length == growth.domain(12).length
    assert growth.domain(3).length == pytest.approx(16.0)


def test_a_blade_that_does_not_grow():
    assert GROWTHS["none"].last_step == 0
    assert GROWTHS["none"].domain(9).length == pytest.approx(10.0)


def test_nothing_grows_after_the_last_step_whatever_the_rounding():
    blade = BladeParameters(shape="ovate", length=29.9).blade()
    growth = MarginalParameters(final_length=766.6, length_per_step=5.3).growth(blade)
    last = growth.outline_scale(growth.last_step)
    assert growth.outline_scale(growth.last_step + 1) == last == 766.6 / blade.length


@pytest.mark.parametrize("name", ["marginal", "isogonic"])
@pytest.mark.parametrize("increase", [0.1, 0.3, 1.0 / 3.0, 2.0, 23.0, 500.0])
def test_the_length_increases_by_the_same_amount_up_to_the_last_step(name, increase):
    kinds = {"marginal": MarginalParameters, "isogonic": IsogonicParameters}
    growth = kinds[name](final_length=33.0, length_per_step=increase).growth(BLADE)
    lengths = [growth.domain(step).length for step in range(growth.last_step + 3)]
    steps = np.diff(lengths)
    np.testing.assert_allclose(steps[: growth.last_step - 1], increase, rtol=1e-9)
    assert 0.0 < steps[growth.last_step - 1] <= increase * (1.0 + 1e-9)
    assert steps[growth.last_step :].tolist() == [0.0, 0.0]
    assert growth.outline_scale(growth.last_step) == 33.0 / BLADE.length


@pytest.mark.parametrize("name", ["marginal", "isogonic"])
def test_a_blade_of_final_length_does_not_grow(name):
    kinds = {"marginal": MarginalParameters, "isogonic": IsogonicParameters}
    growth = kinds[name](final_length=BLADE.length, length_per_step=1.0).growth(BLADE)
    assert growth.last_step == 0
    assert [growth.outline_scale(step) for step in (0, 1, 50)] == [1.0, 1.0, 1.0]


def test_isogonic_points_keep_their_place_relative_to_the_margin():
    growth = GROWTHS["isogonic"]
    points = np.array([[0.0, 5.0], [1.0, 2.0]])
    for step in (1, 6, 12):
        there = growth.position(points, step)
        ratio = growth.domain(step).margin_distance(there) / BLADE.margin_distance(points)
        np.testing.assert_allclose(ratio, growth.scale(step), rtol=1e-9)


def test_marginal_growth_leaves_the_seed_and_moves_the_margin():
    growth = GROWTHS["marginal"]
    points = np.array([[0.0, 5.0], [1.0, 2.0]])
    np.testing.assert_array_equal(growth.position(points, 12), points)
    assert (growth.domain(12).margin_distance(points) > BLADE.margin_distance(points)).all()


@pytest.mark.parametrize("per_step", [1e-9, 1e-320])
def test_growth_that_would_hardly_end_is_refused(per_step):
    parameters = MarginalParameters(final_length=33.0, length_per_step=per_step)
    with pytest.raises(ConfigError, match=r"growth\.length_per_step.*allowed are 1,000,000"):
        parameters.growth(BLADE)
