"""Darts: thinning to uncovered cells keeps the distribution of sources."""

import numpy as np
import pytest
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


def venation(growth):
    """A small leaf with given growth."""
    return ClosedVenation.model_validate(
        {
            "kind": "closed",
            "domain": {"shape": "ovate", "length": 12.0},
            "growth": {"kind": growth, "final_length": 36.0, "length_per_step": 1.5},
            "placement": {
                "kind": "darts",
                "density": DENSITY,
                "birth_distance_sources": DISTANCE,
                "birth_distance_veins": DISTANCE,
            },
            "arrival": {"kill_distance": 1.0},
        }
    )


class NaivePlacement:
    """Darts over the whole blade, each tested against everything."""

    spacing = DISTANCE

    def __init__(self, growth):
        self.growth = growth

    def begin(self, veins, rng):
        """Nothing is drawn before the first step."""

    def is_over(self, veins, step):
        """Darts end with growth."""
        return step >= self.growth.last_step

    def place(self, veins, moment, rng):
        """Throw a Poisson number of darts and keep those with room."""
        if self.is_over(veins, moment.step - 1):
            return
        blade = self.growth.domain(moment.step)
        low_x, low_y, high_x, high_y = blade.bounds
        box = (high_x - low_x) * (high_y - low_y)
        darts = rng.random((rng.poisson(DENSITY * box), 2))
        darts = darts * (high_x - low_x, high_y - low_y) + (low_x, low_y)
        for dart in darts[blade.contains(darts)]:
            material = dart / moment.scale
            nodes = veins.material("nodes")[: veins.nodes.n_rows]
            live = veins.material("sources")[veins.live]
            others = np.concatenate([nodes, live]) * moment.scale
            if (((others - dart) ** 2).sum(axis=1) <= DISTANCE**2).any():
                continue
            veins.reserve_sources(1)
            row = veins.sources.n_rows
            veins.material("sources")[row] = material
            veins.is_live[row] = 1
            kernels.hash_grid.insert(veins.source_grid, veins.material("sources"), row, row + 1)
            veins.add_sources(moment.step, 1, moment.scale, 0)


def placed(growth, is_naive):
    """Numbers of sources, and all their places and steps, over many runs."""
    counts, places, births = [], [], []
    parameters = venation(growth)
    for seed in range(N_RUNS):
        model = parameters.model()
        if is_naive:
            object.__setattr__(model, "placement", NaivePlacement(model.growth))
        *_, last = simulate(model, Streams(seed + (10_000 if is_naive else 0)))
        counts.append(last.n_rows("sources"))
        places.append(last.rows("sources", "position"))
        births.append(last.rows("sources", "birth"))
    return np.array(counts), np.concatenate(places), np.concatenate(births)


@pytest.mark.parametrize("growth", ["marginal", "isogonic"])
def test_thinned_darts_have_the_distribution_of_plain_ones(growth):
    counts, places, births = placed(growth, is_naive=False)
    plain_counts, plain_places, plain_births = placed(growth, is_naive=True)
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
