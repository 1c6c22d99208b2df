"""Numbers of transport with and without dimensions."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vasc.models.dimensions import (
    FacilitatedRates,
    PolarRates,
    facilitated_numbers,
    facilitated_rates,
    polar_numbers,
    polar_rates,
)

numbers = st.floats(1e-3, 1e3)


@given(st.tuples(*[numbers] * 5))
def test_facilitated_rates_come_back(values):
    rates = FacilitatedRates(*values)
    units = {"beta": rates.beta, "gamma": rates.gamma, "source": rates.source}
    assert facilitated_rates(facilitated_numbers(rates), **units) == pytest.approx(rates)


@given(st.tuples(*[numbers] * 6))
def test_polar_rates_come_back(values):
    rates = PolarRates(*values)
    units = {"gamma": rates.gamma, "source": rates.source, "passive": rates.passive}
    assert polar_rates(polar_numbers(rates), **units) == pytest.approx(rates)


@given(st.tuples(*[numbers] * 5), st.floats(-2.0, 2.0))
def test_the_rate_of_change_is_the_same_in_both(values, flux):
    rates = FacilitatedRates(*values)
    found = facilitated_numbers(rates)
    state = 3.0
    scale = rates.beta / rates.gamma
    # dD/dt with dimensions, in units of permeability and time
    printed = rates.alpha * (flux * rates.source) ** 2 + rates.beta - rates.gamma * state * scale
    plain = found.gain * flux**2 + 1.0 - state
    assert printed / (scale * rates.gamma) == pytest.approx(plain, rel=1e-9, abs=1e-9)


@given(st.tuples(*[numbers] * 6), st.floats(-2.0, 2.0))
def test_the_rate_of_change_of_carriers_is_the_same_in_both(values, flux):
    rates = PolarRates(*values)
    found = polar_numbers(rates)
    out, state = max(flux, 0.0), 3.0
    printed = (
        rates.alpha * (out * rates.source) ** 2 + rates.beta - rates.gamma * state * rates.passive
    )
    plain = found.gain * out**2 + found.baseline - state
    assert printed / (rates.passive * rates.gamma) == pytest.approx(plain, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan])
def test_rates_are_above_zero(wrong):
    with pytest.raises(ValueError, match=r"gamma = .*greater than 0"):
        facilitated_numbers(FacilitatedRates(1.0, 1.0, wrong, 1.0, 1.0))
    rates = PolarRates(1.0, 1.0, 1.0, 1.0, wrong, 1.0)
    with pytest.raises(ValueError, match=r"passive = .*greater than 0"):
        polar_numbers(rates)
    numbers = polar_numbers(rates._replace(passive=1.0))
    with pytest.raises(ValueError, match=r"must be greater than 0"):
        polar_rates(numbers, gamma=1.0, source=1.0, passive=wrong)
