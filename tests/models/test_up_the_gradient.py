"""Up the gradient: what is conserved, which waves grow, and where maxima form."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.pasts import assert_goes_on_from, whole_run
from reference.transport import euler, polarized

from vasc.config import load, parse_override
from vasc.domain.tilings import hexagonal, rectangular
from vasc.errors import ConfigError, RunError
from vasc.kernels import up_the_gradient as kernel
from vasc.models import UpTheGradientParameters
from vasc.models.up_the_gradient import (
    HEXAGON,
    AuxinRates,
    StartParameters,
    UpTheGradient,
    check_time_step,
)
from vasc.simulation import simulate
from vasc.streams import Streams

SIDE = 24
PATTERNED = {"production": 2.5e-3, "diffusion": 0.1}
"""Less diffusion than printed, and the production of Figure 7A: maxima form by themselves."""


def rates_of(**values):
    """Rates as the kernel takes them."""
    one = AuxinRates(**values)
    return kernel.Rates(
        one.production, one.decay, one.diffusion, one.transport, one.carriers, one.base
    )


def torus(side):
    """Hexagons without a border: an even number of rows that shift to and fro."""
    tissue = hexagonal(side, side)
    inner = int(np.argmin(np.abs(tissue.positions - tissue.positions.mean(axis=0)).sum(axis=1)))
    near = np.flatnonzero(
        np.isclose(np.hypot(*(tissue.positions - tissue.positions[inner]).T), 1.0)
    )
    assert len(near) == 6
    period = np.array([side, side * 3.0**0.5 / 2.0])
    pairs = set()
    for cell in range(side * side):
        apart = tissue.positions - tissue.positions[cell]
        apart -= np.round(apart / period) * period
        for other in np.flatnonzero(np.isclose(np.hypot(*apart.T), 1.0)).tolist():
            pairs.add((min(cell, other), max(cell, other)))
    walls = np.array(sorted(pairs), dtype=np.int32)
    assert len(walls) == 3 * side * side
    return replace(
        tissue,
        volumes=np.full(side * side, 3.0**0.5 / 2.0),
        walls=walls,
        lengths=np.full(len(walls), 3.0**-0.5),
        distances=np.ones(len(walls)),
    )


def model_on(tissue, rates, start, time_step=0.05, recorded=400, rest=1e-4):
    """The model on a tissue."""
    parameters = UpTheGradientParameters.model_validate(
        {
            "domain": {"kind": "rectangular", "columns": 2, "rows": 2},
            "auxin": rates,
            "start": start,
            "times": {"time_step": time_step, "recorded": recorded, "rest": rest},
        }
    )
    return UpTheGradient(
        tissue=tissue,
        last_step=400,
        width=HEXAGON,
        auxin=parameters.auxin,
        start=parameters.start,
        times=parameters.times,
    )


def last_of(model, seed=1):
    """The last state of a run."""
    *_, last = simulate(model, Streams(seed, ("noise",)))
    return last


@given(st.integers(2, 5), st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_the_kernel_does_what_its_slow_twin_does(columns, rows, seed):
    rng = np.random.default_rng(seed)
    tissue = rectangular(columns, rows)
    rates = rates_of(base=float(rng.uniform(1.5, 30)), diffusion=float(rng.uniform(0, 3)))
    auxin = rng.uniform(0, 5, tissue.n_cells)
    around = kernel.exits(tissue.walls, tissue.n_cells)
    np.testing.assert_allclose(
        kernel.polarize(around, rates, auxin),
        polarized(tissue.walls, tissue.n_cells, auxin, rates.carriers, rates.base),
        rtol=1e-12,
    )
    of_tissue = (tissue.walls, tissue.lengths, tissue.volumes)
    before = auxin.copy()
    found = kernel.advance(*of_tissue, around, rates, auxin, 0.01, 5)
    np.testing.assert_allclose(found, euler(*of_tissue, rates, auxin, 0.01, 5), rtol=1e-12)
    np.testing.assert_array_equal(auxin, before)


def test_a_large_difference_overflows_nothing():
    tissue = rectangular(3, 1)
    around = kernel.exits(tissue.walls, 3)
    found = kernel.polarize(around, rates_of(base=1e12), np.array([0.0, 1.0, 1e4]))
    np.testing.assert_allclose(found, [[0.1, 0.0], [0.1, 0.1]], atol=1e-300)


def test_auxin_is_made_and_destroyed_and_nothing_else():
    model = model_on(hexagonal(9, 8), PATTERNED, {"noise": 0.5, "concentration": 0.4})
    total = None
    for state in simulate(model, Streams(1, ("noise",)), max_steps=20):
        area = state.tissue.volumes * HEXAGON**2
        found = float((state.fields.concentration * area).sum())
        if total is not None:
            # explicit steps of the sum over all cells
            for _ in range(400):
                total += 0.05 * (2.5e-3 * area.sum() - 5e-3 * total)
            assert found == pytest.approx(total, rel=1e-11)
        total = found


def test_carriers_of_each_cell_are_conserved():
    state = last_of(model_on(hexagonal(9, 8), PATTERNED, {"concentration": 0.5}))
    sums = np.zeros(state.tissue.n_cells)
    for side in (0, 1):
        np.add.at(sums, state.tissue.walls[:, side], state.fields.carriers[:, side])
    np.testing.assert_allclose(sums, 0.1, rtol=1e-12)


def test_without_noise_and_border_auxin_stays_even():
    start = {"concentration": 0.5, "noise": 0.0}
    state = last_of(model_on(torus(12), PATTERNED, start))
    assert state.step == 1
    # production and decay are in balance at rho / mu
    np.testing.assert_allclose(state.fields.concentration, 0.5, rtol=1e-12)
    np.testing.assert_allclose(state.fields.flux, 0.0, atol=1e-12)


def growth_rate(kappa, rates):
    """How fast a wave grows on hexagons without a border, 1/s.

    ``kappa`` is the mean of the wave over the six neighbors of a cell, over the wave in
    it. Linear in a small wave around A0 = rho / mu, P_ij = P / 6 (1 + ln b (a_j - mean_k a_k)),
    and sum_j phi_ij = 6 a [(D + T P / 6) (1 - kappa) - T P / 6 A0 ln b (1 - kappa^2)].
    """
    even, share = rates.production / rates.decay, rates.transport * rates.carriers / 6.0
    spread = (rates.diffusion + share) * (1.0 - kappa)
    gathered = share * even * np.log(rates.base) * (1.0 - kappa**2)
    length, area = 10.0, 150.0 * 3.0**0.5
    return -rates.decay - 6.0 * length / area * (spread - gathered)


@pytest.mark.parametrize("wave", [(1, 0), (2, 0), (3, 0), (0, 4), (4, 4), (6, 0), (12, 0)])
@pytest.mark.parametrize("name", ["printed", "patterned"])
def test_small_waves_grow_as_fast_as_theory_says(wave, name):
    rates = rates_of(**({} if name == "printed" else PATTERNED))
    tissue = torus(SIDE)
    period = np.array([SIDE, SIDE * 3.0**0.5 / 2.0])
    phase = 2.0 * np.pi * (tissue.positions / period) @ np.array(wave)
    shape = np.cos(phase - phase[0])
    angles = np.arange(6) * np.pi / 3.0
    steps = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    kappa = np.cos(2.0 * np.pi * (steps / period) @ np.array(wave)).mean()
    even, small, time_step = rates.production / rates.decay, 1e-6, 1e-4
    found = kernel.advance(
        tissue.walls,
        tissue.lengths * HEXAGON,
        tissue.volumes * HEXAGON**2,
        kernel.exits(tissue.walls, tissue.n_cells),
        rates,
        even * (1.0 + small * shape),
        time_step,
        100,
    )
    amplitude = ((found / even - 1.0) * shape).sum() / (shape**2).sum()
    measured = np.log(amplitude / small) / (100 * time_step)
    assert measured == pytest.approx(growth_rate(kappa, rates), rel=2e-3, abs=2e-6)


def test_with_the_printed_values_no_wave_grows():
    kappa = np.linspace(-0.5, 1.0, 1001)
    for production in (3e-4, 2.5e-3):
        # longest waves change little but by decay
        assert growth_rate(kappa, rates_of(production=production)).max() <= -5e-3 + 1e-12
    assert growth_rate(kappa, rates_of(**PATTERNED)).max() > 0.02


def maxima_of(state):
    """The cells that hold more than all of their neighbors, and more than an even tissue."""
    auxin = state.fields.concentration
    is_lower = np.zeros(len(auxin), dtype=bool)
    first, second = state.tissue.walls.T
    is_lower[np.where(auxin[first] < auxin[second], first, second)] = True
    return np.flatnonzero(~is_lower & (auxin > auxin.mean()))


def test_evenly_spaced_maxima_form_and_carriers_point_to_them():
    tissue = torus(SIDE)
    state = last_of(model_on(tissue, PATTERNED, {"concentration": 0.5}))
    assert state.is_finished
    assert state.step < 400
    peaks = maxima_of(state)
    auxin = state.fields.concentration
    assert (auxin[peaks] > 5.0 * auxin.mean()).all()
    # of the carriers around a maximum nearly all are in the walls to it, but for cells
    # between maxima, which share them out
    carriers, walls, toward = state.fields.carriers, tissue.walls, []
    for peak in peaks.tolist():
        for wall in np.flatnonzero((walls == peak).any(axis=1)).tolist():
            side = int(walls[wall, 0] == peak)
            toward.append(carriers[wall, side] / 0.1)
    assert min(toward) > 0.3
    assert np.median(toward) > 0.95
    # even: distances to the nearest maximum vary far less than at random
    period = np.array([SIDE, SIDE * 3.0**0.5 / 2.0])
    apart = tissue.positions[peaks][:, None] - tissue.positions[peaks][None]
    apart = np.hypot(*np.moveaxis(apart - np.round(apart / period) * period, -1, 0))
    np.fill_diagonal(apart, np.inf)
    nearest = apart.min(axis=1)
    assert nearest.std() / nearest.mean() < 0.2
    # the wave that grows fastest: kappa = 1 - k^2 / 4 of a long wave, whatever its direction
    kappa = np.linspace(-0.5, 1.0, 1001)
    fastest = kappa[growth_rate(kappa, rates_of(**PATTERNED)).argmax()]
    wavelength = 2.0 * np.pi / np.sqrt(4.0 * (1.0 - fastest))
    spacing = np.sqrt(2.0 / 3.0**0.5 * tissue.volumes.sum() / len(peaks))
    assert 0.85 < spacing / wavelength < 1.15


def test_with_the_printed_values_noise_fades():
    state = last_of(model_on(torus(12), {}, {"concentration": 0.06, "noise": 0.1}, 0.02, 500))
    auxin = state.fields.concentration
    assert auxin.std() / auxin.mean() < 1e-4


def test_too_long_steps_are_refused():
    model = model_on(hexagonal(5, 5), {}, {"noise": 0.1}, time_step=2.0)
    with pytest.raises(RunError, match=r"times\.time_step \(2 s\) is too long"):
        last_of(model)


@pytest.mark.parametrize("step", [0, 1, 5, 9])
def test_every_step_is_a_place_to_go_on_from(step):
    parameters = UpTheGradientParameters.model_validate(
        {
            "domain": {"kind": "hexagonal", "columns": 7, "rows": 6},
            "auxin": PATTERNED,
            "stop": {"steps": 10},
        }
    )
    assert parameters.start == StartParameters()
    states, words = whole_run(parameters)
    assert states[-1].time == pytest.approx(100.0)
    assert_goes_on_from(parameters, states, words, step)


@pytest.mark.parametrize(
    ("table", "key", "value", "allowed"),
    [
        ("auxin", "production", "1e30", "of at most 1"),
        ("auxin", "diffusion", "1e30", "of at most 10000"),
        ("auxin", "transport", "1e300", "of at most 100000"),
        ("auxin", "decay", "1e9", "of at least 1e-06 and of at most 10"),
        ("auxin", "carriers", "1e30", "of at most 100"),
        ("start", "concentration", "1e30", "of at most 1000"),
        ("times", "time_step", "1e-300", "of at least 1e-06 and of at most 1000"),
    ],
)
def test_absurd_values_are_refused_by_their_own_key(table, key, value, allowed):
    with pytest.raises(ConfigError) as caught:
        load("up-the-gradient", [parse_override(f"{table}.{key}={value}")])
    (line,) = caught.value.problems
    assert f"{table}.{key} = " in line
    assert allowed in line


@pytest.mark.parametrize(
    ("change", "blamed"),
    [
        ("auxin.diffusion=1000.0", r"auxin\.diffusion = 1000: a cell may lose"),
        ("auxin.transport=50000.0", r"auxin\.transport = 50000 and auxin\.carriers = 0\.1"),
        ("auxin.decay=10.0", r"auxin\.decay = 10: .*must be at most 0\.0\d+ s"),
        ("times.time_step=900.0", r"times\.time_step, 900 s, must be at most"),
    ],
)
def test_the_rate_that_needs_shorter_steps_is_named(change, blamed):
    overrides = [parse_override("times.time_step=0.5"), parse_override(change)]
    experiment = load("up-the-gradient", overrides)
    with pytest.raises(ConfigError, match=blamed):
        experiment.model()


def test_the_longest_step_that_is_allowed_keeps_concentrations_in_their_range():
    tissue = hexagonal(6, 5)
    auxin = AuxinRates(**PATTERNED)
    longest = 1000.0
    with pytest.raises(ConfigError) as caught:
        check_time_step(tissue, HEXAGON, auxin, longest)
    longest = 0.99 * float(str(caught.value).partition("at most ")[2].split(" ")[0])
    check_time_step(tissue, HEXAGON, auxin, longest)
    state = last_of(model_on(tissue, PATTERNED, {"noise": 0.9}, longest, 50))
    assert state.fields.concentration.min() > 0.0
