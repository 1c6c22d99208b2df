"""Random small runs of all kinds, record for record against the obvious program."""

from math import ceil, inf

import numpy as np
import pytest
from reference import colonization as slow
from reference.comparing import assert_same, config, model_of
from reference.urquhart import urquhart

from vasc.simulation import simulate
from vasc.streams import Streams

SEED_NODES = (
    [(0.0, 0.0)],
    [(0.0, 0.0), (-0.1, 0.3), (0.2, 0.3)],
    [(-0.25, 0.5), (0.25, 0.5)],
)
BIASES = ((0.0, 0.0), (0.0, 0.0), (0.2, 0.1), (1.0, 0.0))
MOST_NODES = 330


def places(rng, n_sources, is_on_lattice):
    """Places in a disc that touches the origin, perhaps where ties are many."""
    found = []
    while len(found) < n_sources:
        x, y = rng.uniform(-7.0, 7.0), rng.uniform(0.0, 14.0)
        if is_on_lattice:
            x, y = float(round(x)), float(round(y))
        if x * x + (y - 7.0) ** 2 < 45.0:
            found.append((x, y))
    return found


def random_growth(rng, kind):
    """The growth table, and the scale of a material unit and the last step of growth."""
    if kind == "none":
        return {"kind": "none"}, lambda step: 1.0, 0
    final = float(rng.choice([20.0, 40.0]))
    # no round number: at an exact ratio of lengths rounding would decide what is halved
    increase = float(rng.choice([0.47, 0.97, 3.1]))
    last = ceil((final - 14.0) / increase)
    table = {"kind": kind, "final_length": final, "length_per_step": increase}
    if kind == "marginal":
        return table, lambda step: 1.0, last
    return table, lambda step: min(final, 14.0 + step * increase) / 14.0, last


def random_rules(rng, kind, scale, last_growth, neighbors):
    """Rules, and the tables of a config that say the same."""
    rules = slow.Rules(
        is_closed=kind == "closed",
        kill=float(rng.choice([1.0, 1.2, 2.0, 3.0])),
        length=float(rng.choice([1.0, 0.7])),
        influence=float(rng.choice([inf, inf, 8.0, 4.0])),
        bias=BIASES[rng.integers(len(BIASES))],
        stall_rule=bool(rng.random() < 0.8),
        longest=float(rng.choice([inf, 1.5, 2.0])),
        last_growth=last_growth,
        scale=scale,
        neighbors=neighbors,
    )
    name = "relative" if neighbors is slow.relative_neighbors else "urquhart"
    tables = {
        "perception": {"kind": "nearest" if kind == "open" else name},
        "extension": {
            "segment_length": rules.length,
            "bias": rules.bias,
            "stall_rule": rules.stall_rule,
        },
        "arrival": {"kill_distance": rules.kill},
    }
    if rules.influence < inf:
        tables["perception"]["influence_radius"] = rules.influence
    if rules.longest < inf:
        tables["refinement"] = {"kind": "subdivision", "longest": rules.longest}
    return rules, tables


def compare(seed, kind, growth_kind, neighbors=slow.relative_neighbors):
    """Run both programs on one random config."""
    rng = np.random.default_rng(seed)
    points = places(rng, int(rng.integers(1, 22)), is_on_lattice=bool(rng.random() < 0.35))
    births = np.sort(rng.integers(1, 1 + int(rng.choice([1, 10, 30])), len(points))).tolist()
    growth, scale, last_growth = random_growth(rng, growth_kind)
    rules, tables = random_rules(rng, kind, scale, last_growth, neighbors)
    real = [(x * scale(b), y * scale(b)) for (x, y), b in zip(points, births, strict=True)]
    tables = {**config(kind, real, births), "growth": growth, **tables}
    tables["domain"]["seeds"] = SEED_NODES[rng.integers(len(SEED_NODES))]
    for state in simulate(model_of(tables), Streams(1), max_steps=90):
        if state.n_rows("nodes") > MOST_NODES:
            break
    seeds = state.rows("nodes", "material")[: len(tables["domain"]["seeds"])]
    given = [(b, (x / scale(b), y / scale(b))) for (x, y), b in zip(real, births, strict=True)]
    leaf = slow.grow([tuple(p) for p in seeds.tolist()], given, rules, state.step)
    assert_same(state, leaf)
    return leaf


@pytest.mark.parametrize("growth", ["none", "marginal", "isogonic"])
@pytest.mark.parametrize("kind", ["open", "closed"])
def test_runs_are_those_of_the_obvious_program(kind, growth):
    leaves = [compare(seed, kind, growth) for seed in range(60)]
    # the runs are of all sorts, or the comparison says little
    assert {leaf.reason for leaf in leaves} >= {"NO_SOURCES", "LIVELOCK"}
    assert sum(leaf.n_stalled > 0 for leaf in leaves) >= 3
    assert sum(len(leaf.initiated) for leaf in leaves) > 100
    if kind == "closed":
        assert sum(len(leaf.joins) for leaf in leaves) > 20
        assert sum(len(leaf.loops) for leaf in leaves) > 10
    if growth == "isogonic":
        assert sum(len(leaf.refined) for leaf in leaves) > 100


@pytest.mark.parametrize("growth", ["none", "marginal", "isogonic"])
def test_urquhart_runs_are_those_of_the_obvious_program(growth):
    for seed in range(6):
        compare(1000 + seed, "closed", growth, urquhart)


def test_a_larger_leaf():
    rng = np.random.default_rng(3)
    points = places(rng, 60, is_on_lattice=False)
    rules = slow.Rules(is_closed=True, kill=0.15, length=0.15)
    tables = config("closed", points, extension={"segment_length": 0.15})
    tables["arrival"] = {"kill_distance": 0.15}
    *_, state = simulate(model_of(tables), Streams(1))
    assert 500 < state.n_rows("nodes") < 900
    assert_same(state, slow.grow([(0.0, 0.0)], [(1, p) for p in points], rules, state.step))
