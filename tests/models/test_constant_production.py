"""Constant production: concentration tells distance, and veins climb to its maximum."""

import numpy as np
import pytest
from reference.pasts import assert_goes_on_from, whole_run

from vasc.analysis.topology import count_cycles
from vasc.events import EventKind, StopReason
from vasc.fields import Role
from vasc.models import ConstantProductionParameters
from vasc.network import Origin
from vasc.simulation import simulate
from vasc.streams import Streams

RING = [(0.0, 0.0), (30.0, 0.0), (30.0, 20.0), (0.0, 20.0), (0.0, 0.0)]


def production(lines, size=(31, 21), kind="rectangular", threshold=1e9, **tables):
    """A tissue with veins."""
    return ConstantProductionParameters.model_validate(
        {
            "domain": {"kind": kind, "columns": size[0], "rows": size[1]},
            "veins": {"lines": lines},
            "threshold": threshold,
            **tables,
        }
    )


def states_of(parameters):
    """All states of a run."""
    return list(simulate(parameters.model(), Streams(parameters.seed, parameters.stream_names)))


def first_of(parameters):
    """The state before the first step."""
    return parameters.model().initial_state(Streams(1, parameters.stream_names))


@pytest.mark.parametrize("half", [3, 10, 20])
def test_between_two_veins_the_peak_is_that_of_a_parabola(half):
    width = 2.0 * half
    lines = [[(0.0, 0.0), (0.0, 2.0)], [(width, 0.0), (width, 2.0)]]
    state = first_of(production(lines, size=(2 * half + 1, 3)))
    rows = state.fields.concentration.reshape(3, -1)
    x = np.arange(2 * half + 1)
    # K L^2 / (2 D) at the peak; second differences of a parabola are exact
    np.testing.assert_allclose(rows, np.tile(x * (width - x) / 2.0, (3, 1)), rtol=1e-11, atol=1e-9)
    assert rows.max() == pytest.approx(half**2 / 2.0)
    # K L / D at the wall, less half of what the first cell makes
    assert rows[0, 1] - rows[0, 0] == pytest.approx(half - 0.5)


def test_destruction_limits_the_concentration():
    state = first_of(production([RING], destruction=1.0))
    centre = state.tissue.nearest_cells([(15.0, 10.0)])[0]
    # far from veins K / k, nearer by the distance sqrt(D / k)
    assert state.fields.concentration[centre] == pytest.approx(1.0, abs=2e-3)


@pytest.mark.parametrize("kind", ["rectangular", "hexagonal", "voronoi"])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_peak_is_near_the_centre_of_the_largest_empty_circle(kind, seed):
    rng = np.random.default_rng(seed)
    a, b = rng.uniform([4.0, 4.0], [24.0, 13.0], (2, 2))
    size = (31, 21) if kind != "hexagonal" else (31, 23)
    parameters = production([[tuple(a), tuple(b)]], size, kind, seed=seed)
    parameters = parameters.model_copy(
        update={"veins": parameters.veins.model_copy(update={"margin": True})}
    )
    state = first_of(parameters)
    positions, fields = state.tissue.positions, state.fields
    veins = positions[fields.roles == Role.VEIN]
    apart = np.sqrt(((positions[:, None] - veins[None]) ** 2).sum(axis=2)).min(axis=1)
    peak = int(fields.concentration.argmax())
    # the peak has nearly as much room as the largest circle
    assert apart[peak] >= 0.8 * apart.max()
    # and concentration follows the distance over all cells
    assert np.corrcoef(np.sqrt(fields.concentration), apart)[0, 1] > 0.85


@pytest.mark.parametrize("kind", ["rectangular", "hexagonal", "voronoi"])
def test_a_strand_climbs_until_no_wall_is_steep(kind):
    states = states_of(production([[(15.0, 1.0), (15.0, 2.0)]], (31, 21), kind, threshold=10.0))
    maxima = [state.fields.concentration.max() for state in states]
    assert (np.diff(maxima[:-1]) <= 1e-9).all()
    assert maxima[-1] < 0.2 * maxima[0]
    last = states[-1]
    assert last.rows("events", "subject")[-1] == StopReason.AT_REST
    is_vein = last.fields.roles == Role.VEIN
    walls, concentration = last.tissue.walls, last.fields.concentration
    is_border = is_vein[walls[:, 0]] != is_vein[walls[:, 1]]
    assert concentration[walls[is_border]].max() <= 10.0
    # each cell was steep, beside its parent, when it became vein
    network = last.network
    cells = last.tissue.nearest_cells(network.positions)
    pairs = {tuple(sorted(pair)) for pair in walls.tolist()}
    for node in np.flatnonzero(network.origins == Origin.CANAL).tolist():
        before = states[network.births[node] - 1].fields.concentration
        assert before[cells[node]] > 10.0
        assert tuple(sorted((cells[node], cells[network.parents[node]]))) in pairs


def test_mirrored_strands_form_together():
    last = states_of(production([[(15.0, 0.0), (15.0, 1.0)]], threshold=10.0))[-1]
    roles = last.fields.roles.reshape(21, 31)
    np.testing.assert_array_equal(roles, roles[:, ::-1])
    assert (roles == Role.VEIN).sum() > 60


@pytest.mark.parametrize("kind", ["rectangular", "voronoi"])
def test_strands_that_meet_are_joined_and_loops_are_noted(kind):
    # two lines so near that cells between them are beside both
    lines = [[(1.0, 2.0), (10.0, 2.0)], [(1.0, 6.0), (10.0, 6.0)]]
    last = states_of(production(lines, (12, 9), kind, threshold=0.3))[-1]
    kinds = last.rows("events", "kind")
    n_joins, n_loops = (
        (kinds == EventKind.VEIN_JOINED).sum(),
        (kinds == EventKind.LOOP_CLOSED).sum(),
    )
    assert n_joins > 0
    network = last.network
    assert n_loops == count_cycles(network)
    # the first join connects the two veins and closes no loop
    assert n_joins == n_loops + 1


@pytest.mark.parametrize("kind", ["rectangular", "voronoi"])
def test_every_step_is_a_place_to_go_on_from(kind):
    lines = [[(1.0, 2.0), (10.0, 2.0)], [(1.0, 6.0), (10.0, 6.0)]]
    parameters = production(lines, (12, 9), kind, threshold=0.6)
    states, words = whole_run(parameters)
    assert states[-1].step > 5
    for step in range(states[-1].step):
        assert_goes_on_from(parameters, states, words, step)
