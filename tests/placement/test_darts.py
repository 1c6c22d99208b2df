"""Darts: thinning to uncovered cells keeps the distribution of sources."""

import numpy as np
import pytest
from reference.darts import PlainDarts, PlainLargestBlade, has_room
from scipy import stats

from vasc import kernels
from vasc.domain import BladeParameters
from vasc.growth import IsogonicGrowth, MarginalGrowth
from vasc.models import ClosedVenation
from vasc.placement.darts import blade_cells, epoch_of, poisson_count
from vasc.simulation import simulate
from vasc.streams import Streams

N_RUNS = 250
DISTANCE = 5.0
DENSITY = 0.01


def venation(growth, **placement):
    """A small leaf with given growth."""
    tables = {"kind": growth}
    if growth != "none":
        tables |= {"final_length": 36.0, "length_per_step": 1.5}
    return ClosedVenation.model_validate(
        {
            "kind": "closed",
            "domain": {"shape": "ovate", "length": 12.0},
            "growth": tables,
            "placement": {
                "kind": "darts",
                "density": DENSITY,
                "birth_distance_sources": DISTANCE,
                "birth_distance_veins": DISTANCE,
                **placement,
            },
            "arrival": {"kill_distance": 1.0},
        }
    )


READINGS = {
    "marginal": ("marginal", "each_step", PlainDarts),
    "isogonic": ("isogonic", "each_step", PlainDarts),
    "largest blade": ("marginal", "largest_blade", PlainLargestBlade),
}


def placed(name, is_plain):
    """Numbers of sources, and all their places and steps, over many runs."""
    growth, reading, plain = READINGS[name]
    counts, places, births = [], [], []
    parameters = venation(growth, reading=reading)
    for seed in range(N_RUNS):
        model = parameters.model()
        if is_plain:
            darts = plain(
                model.growth, density=DENSITY, source_distance=DISTANCE, node_distance=DISTANCE
            )
            object.__setattr__(model, "placement", darts)
        *_, last = simulate(model, Streams(seed + (10_000 if is_plain else 0)))
        counts.append(last.n_rows("sources"))
        places.append(last.rows("sources", "position"))
        births.append(last.rows("sources", "birth"))
    return np.array(counts), np.concatenate(places), np.concatenate(births)


@pytest.mark.parametrize("name", READINGS)
def test_sources_have_the_distribution_of_plain_darts(name):
    counts, places, births = placed(name, is_plain=False)
    plain_counts, plain_places, plain_births = placed(name, is_plain=True)
    spread = np.sqrt(counts.var() / N_RUNS + plain_counts.var() / N_RUNS)
    assert abs(counts.mean() - plain_counts.mean()) < 3.0 * spread
    # seeds are fixed, so that this is one draw: 0.001 for each of four comparisons
    for ours, plain in (
        (counts, plain_counts),
        (places[:, 0], plain_places[:, 0]),
        (places[:, 1], plain_places[:, 1]),
        (births, plain_births),
    ):
        assert stats.ks_2samp(ours, plain).pvalue > 0.001


def test_the_sources_of_the_largest_blade_appear_when_the_contour_reaches_them():
    parameters = venation("marginal", reading="largest_blade")
    growth = parameters.model().growth
    n_late = 0
    for seed in range(20):
        states = list(simulate(parameters.model(), Streams(seed)))
        last = states[-1]
        positions, births = last.rows("sources", "position"), last.rows("sources", "birth")
        assert births.max() <= growth.last_step
        for source, (place, birth) in enumerate(zip(positions, births.tolist(), strict=True)):
            # inside the blade of its step, and not yet in the one before
            assert growth.domain(birth).contains(place[None]).all()
            if birth > 1:
                n_late += 1
                assert not growth.domain(birth - 1).contains(place[None]).any()
            before = states[birth - 1]
            alive = set(before.live.tolist()) | {s for s in range(source) if births[s] == birth}
            nodes = before.rows("nodes", "position")
            assert has_room(place, positions[sorted(alive)], nodes, DISTANCE, DISTANCE)
    assert n_late > 100


def test_darts_on_a_static_blade_end_when_no_room_is_left():
    parameters = venation("none", density=0.2)
    model = parameters.model()
    states = list(simulate(model, Streams(3)))
    last = states[-1]
    assert len(last.live) == 0
    births = last.rows("sources", "birth")
    quiet = last.step - births.max()
    assert quiet >= 10
    # no place of the blade is farther than the birth distance from all veins
    rng = np.random.default_rng(1)
    points = rng.uniform(-12.0, 12.0, (4000, 2)) + np.array([0.0, 6.0])
    points = points[last.blade.contains(points)]
    nodes = last.network.positions
    gaps = np.sqrt(((points[:, None] - nodes[None]) ** 2).sum(axis=2)).min(axis=1)
    assert len(points) > 300
    assert (gaps > DISTANCE).mean() < 0.01


def test_darts_end_with_their_last_step():
    *_, last = simulate(venation("none", until=4).model(), Streams(1))
    assert last.n_rows("sources") > 0
    assert last.rows("sources", "birth").max() <= 4
    *_, growing = simulate(venation("marginal", until=4).model(), Streams(1))
    assert growing.rows("sources", "birth").max() <= 4


def test_poisson_counts_are_poisson():
    rng = np.random.default_rng(4)
    for mean in (0.0, 0.3, 4.0, 60.0):
        counts = np.array([poisson_count(rng, mean) for _ in range(4000)])
        assert abs(counts.mean() - mean) <= 4.0 * np.sqrt(mean / 4000)
        if mean:
            assert abs(counts.var() / mean - 1.0) < 0.12


@pytest.mark.parametrize("kind", [MarginalGrowth, IsogonicGrowth])
@pytest.mark.parametrize("shape", ["ovate", "cordate", "bilobed"])
def test_cells_hold_every_place_of_the_blade_and_covered_ones_no_room(kind, shape):
    blade = BladeParameters(shape=shape, length=10.0).blade()
    growth = kind(blade, 40.0, 0.5)
    rng = np.random.default_rng(2)
    for step in (1, 20, 60):
        start, end = epoch_of(growth, step)
        assert start <= step < end
        last = min(end - 1, growth.last_step)
        cells = blade_cells(growth, start, last, 0.6)
        for at in (start, (start + last) // 2, last):
            low_x, low_y, high_x, high_y = growth.domain(at).bounds
            points = rng.random((3000, 2)) * (high_x - low_x, high_y - low_y) + (low_x, low_y)
            inside = points[growth.domain(at).contains(points)] / growth.scale(at)
            corner, side = cells.corner[:2], cells.corner[2]
            columns = ((inside - corner) / side).astype(int)
            assert (cells.place[columns[:, 1] * cells.shape[0] + columns[:, 0]] >= 0).all()
        nodes = inside[:40]
        kernels.darts.cover(cells, nodes, 0, 40, 2.0)
        gaps = np.sqrt(((inside[:, None] - nodes[None]) ** 2).sum(axis=2)).min(axis=1)
        columns = ((inside - corner) / side).astype(int)
        is_open = cells.place[columns[:, 1] * cells.shape[0] + columns[:, 0]] >= 0
        assert is_open[gaps > 2.0].all()
        assert not is_open[gaps < 0.5].any()
