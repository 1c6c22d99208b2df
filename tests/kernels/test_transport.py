"""Concentrations, fluxes and trunks, against slow obvious twins."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.transport import dense_concentrations, followed, inflows

from vasc.domain.tilings import rectangular
from vasc.kernels import transport
from vasc.kernels.trunks import trunk


@st.composite
def flows(draw):
    """A small tissue with random walls, sinks, production and decay."""
    tissue = rectangular(draw(st.integers(2, 6)), draw(st.integers(1, 5)))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n_cells, n_walls = tissue.n_cells, tissue.n_walls
    is_sink = np.zeros(n_cells, dtype=bool)
    is_sink[rng.permutation(n_cells)[: draw(st.integers(1, max(1, n_cells // 2)))]] = True
    forth, back = 10.0 ** rng.uniform(-2, 3, (2, n_walls))
    made = np.where(rng.random(n_cells) < 0.5, rng.random(n_cells), 0.0)
    decay = rng.random(n_cells) * draw(st.sampled_from([0.0, 1.0]))
    return tissue.walls, is_sink, forth, back, made, decay


@given(flows())
def test_concentrations_are_those_of_a_dense_matrix(flow):
    walls, is_sink, forth, back, made, decay = flow
    found = transport.concentrations(transport.balance(walls, is_sink), forth, back, made, decay)
    expected = dense_concentrations(*flow)
    # the dense solution is pivoted: it is worse by the ratio of the largest to the least wall
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-10 * expected.max(initial=1.0))
    assert (found >= 0.0).all()
    assert (found[is_sink] == 0.0).all()


@given(flows())
def test_sinks_take_what_is_made_and_not_destroyed(flow):
    walls, is_sink, forth, back, made, decay = flow
    found = transport.concentrations(transport.balance(walls, is_sink), forth, back, made, decay)
    flux = transport.fluxes(walls, found, forth, back)
    taken = transport.arrivals(walls, flux, len(is_sink))
    left = taken[~is_sink] + made[~is_sink] - decay[~is_sink] * found[~is_sink]
    # a flux is the difference of two ways: rounding is relative to the larger one
    one_way = np.maximum(forth * found[walls[:, 0]], back * found[walls[:, 1]])
    assert np.abs(left).max(initial=0.0) <= 1e-13 * max(1.0, one_way.max())


@given(flows())
def test_inflow_and_what_passes_are_sums_over_walls(flow):
    walls, is_sink, forth, back, *_ = flow
    flux = forth - back
    net, out = inflows(walls, flux, len(is_sink))
    np.testing.assert_allclose(transport.arrivals(walls, flux, len(is_sink)), net, atol=1e-9)
    np.testing.assert_allclose(transport.through(walls, flux, len(is_sink)), out, atol=1e-9)


@given(flows(), st.booleans())
def test_a_trunk_follows_the_strongest_exits(flow, is_tied):
    walls, is_end, forth, back, *_ = flow
    flux = forth - back
    if is_tied:
        # many fluxes are equal, or none
        flux = np.round(np.sign(flux)) * (np.abs(flux) > 1.0)
    for start in range(len(is_end)):
        cells, passed, is_loop = trunk(walls, flux, start, is_end)
        assert (cells.tolist(), passed.tolist(), is_loop) == followed(walls, flux, start, is_end)


def test_cells_without_a_way_to_a_sink_are_refused():
    tissue = rectangular(4, 1)
    forth = np.array([1.0, 0.0, 1.0])
    is_sink = np.array([True, False, False, False])
    with pytest.raises(ArithmeticError, match="no way to a sink"):
        transport.concentrations(transport.balance(tissue.walls, is_sink), forth, forth, np.ones(4))


def test_swapped_cells_of_walls_change_nothing_but_the_sign_of_fluxes():
    tissue = rectangular(5, 4)
    rng = np.random.default_rng(1)
    forth, back = rng.random((2, tissue.n_walls)) + 0.1
    is_sink = np.arange(tissue.n_cells) == 3
    made = rng.random(tissue.n_cells)
    one = transport.concentrations(transport.balance(tissue.walls, is_sink), forth, back, made)
    swapped = tissue.walls[:, ::-1].copy()
    other = transport.concentrations(transport.balance(swapped, is_sink), back, forth, made)
    np.testing.assert_allclose(other, one, rtol=1e-12)
    np.testing.assert_allclose(
        transport.fluxes(swapped, other, back, forth),
        -transport.fluxes(tissue.walls, one, forth, back),
        atol=1e-12,
    )
