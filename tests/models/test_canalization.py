"""Canalization: what is conserved, what is symmetric, where canals lead, and going on."""

import numpy as np
import pytest
from reference.canalization_ode import shares_of_sinks
from reference.pasts import assert_goes_on_from, whole_run
from scipy.sparse.csgraph import dijkstra

from vasc.errors import RunError
from vasc.events import EventKind
from vasc.fields import Role
from vasc.kernels.transport import arrivals
from vasc.models import CanalizationParameters
from vasc.network import Origin
from vasc.simulation import simulate
from vasc.streams import Streams

FACILITATED = {"kind": "facilitated"}
POLAR = {"kind": "polar"}
POOL = {"kind": "pool"}
BACKGROUND = {"facilitated": 0.0, "polar": 0.1, "pool": 0.5}
SINKS = [[(5.0, 16.0)], [(25.0, 16.0)]]
"""Of Figure 4.9: two veins of one cell each."""


def canalization(transport, points, size=(31, 17), sinks=SINKS, **tables):
    """A rectangular tissue with veins and sources."""
    placement = {"kind": "given", "points": points, **tables.pop("placement", {})}
    return CanalizationParameters.model_validate(
        {
            "domain": {"kind": "rectangular", "columns": size[0], "rows": size[1]},
            "veins": {"lines": sinks},
            "placement": placement,
            "transport": transport,
            "background": BACKGROUND[transport["kind"]],
            **tables,
        }
    )


def states_of(parameters):
    """The states of a run."""
    streams = Streams(parameters.seed, parameters.stream_names)
    yield from simulate(parameters.model(), streams)


def end_of(parameters):
    """The last state of a run."""
    *_, last = states_of(parameters)
    return last


def canal_of(state):
    """The cells of the canal, from the vein to the source; the vein first."""
    network = state.network
    rows = np.flatnonzero(network.origins == Origin.CANAL)
    assert len(rows)
    chain = [int(network.parents[rows[0]]), *rows.tolist()]
    np.testing.assert_array_equal(network.parents[rows], chain[:-1])
    return state.tissue.nearest_cells(network.positions[chain])


def shares_of(state, sinks):
    """The share of all that is made that each sink takes."""
    inflow = arrivals(state.tissue.walls, state.fields.flux, state.tissue.n_cells)
    return inflow[sinks] / inflow[state.fields.roles == Role.VEIN].sum()


@pytest.mark.parametrize("transport", [FACILITATED, POLAR, POOL], ids=lambda one: one["kind"])
@pytest.mark.parametrize(("source", "vein"), [((12.0, 4.0), 0), ((18.0, 4.0), 1)])
def test_a_canal_forms_from_the_source_to_the_nearer_vein(transport, source, vein):
    state = end_of(canalization(transport, [source]))
    cells = canal_of(state)
    ends = state.tissue.nearest_cells([SINKS[vein][0], source])
    assert (cells[0], cells[-1]) == tuple(ends)
    kinds = state.rows("events", "kind").tolist()
    # walls of a pool still creep when the canal stands
    assert (EventKind.CANALS_UNSETTLED in kinds) == (transport is POOL)
    assert kinds.count(EventKind.VEIN_INITIATED) == 1
    assert len(state.live) == 0


@pytest.mark.parametrize("transport", [FACILITATED, POLAR, POOL], ids=lambda one: one["kind"])
def test_veins_take_what_is_made_in_every_step(transport):
    parameters = canalization(transport, [(12.0, 4.0), (20.0, 7.0)], placement={"rounds": [1, 2]})
    model = parameters.model()
    worst, n_steps = 0.0, 0
    for state in states_of(parameters):
        roles, flux = state.fields.roles, state.fields.flux
        made = model.injection.production(state.tissue, roles)[roles != Role.VEIN].sum()
        inflow = arrivals(state.tissue.walls, flux, state.tissue.n_cells)
        worst = max(worst, abs(inflow[roles == Role.VEIN].sum() - made))
        # and every other cell passes on what it gets and makes
        made = model.injection.production(state.tissue, roles)
        is_ground = roles != Role.VEIN
        worst = max(worst, np.abs(inflow[is_ground] + made[is_ground]).max())
        n_steps += 1
    assert n_steps > 20
    assert worst <= 1e-12


def test_carriers_of_a_pool_are_never_more_than_the_pool():
    parameters = canalization(POOL, [(12.0, 4.0)])
    pool = parameters.transport.pool
    for state in states_of(parameters):
        carriers, tissue = state.fields.carriers, state.tissue
        assert (bound_of(tissue, carriers) <= pool * (1.0 + 1e-12)).all()
        assert (carriers > 0.0).all()
        # where carriers rest, what is free is in balance with what is bound
        targets = parameters.transport.targets(tissue, state.fields.flux)
        leaving = np.stack([state.fields.flux, -state.fields.flux], axis=1)
        weights = parameters.transport.baseline + parameters.transport.gain * np.where(
            leaving > 0.0, leaving**2, 0.0
        )
        free = pool - bound_of(tissue, targets)
        np.testing.assert_allclose(free[tissue.walls] * weights, targets, rtol=1e-9)


def bound_of(tissue, carriers):
    """All carriers in the walls of each cell."""
    bound = np.zeros(tissue.n_cells)
    for side in (0, 1):
        np.add.at(bound, tissue.walls[:, side], tissue.lengths * carriers[:, side])
    return bound


def test_walls_stay_between_rest_and_saturation():
    for transport in (FACILITATED, POLAR):
        parameters = canalization(transport, [(12.0, 4.0)])
        for state in states_of(parameters):
            carriers = state.fields.carriers
            least = parameters.transport.resting(state.tissue).min()
            assert (carriers >= least * (1.0 - 1e-12)).all()
            assert (carriers <= parameters.transport.most * (1.0 + 1e-12)).all()
            if transport is FACILITATED:
                np.testing.assert_array_equal(carriers[:, 0], carriers[:, 1])


UNTIL = 400.0
"""Turnover times after which what concentrations had stored has left."""
FULL = [
    pytest.param(FACILITATED, 1.0, id="facilitated"),
    pytest.param(POOL, 1.0, id="pool"),
    # with speed 1 the canal goes to the other vein: from a start without any pattern polar
    # transport is decided by its transients, which last as long as walls take to change
    pytest.param(POLAR, 100.0, id="polar", marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("transport", "speed"), FULL)
def test_the_full_equations_lead_to_the_same_vein(transport, speed):
    sinks = [[(3.0, 12.0)], [(13.0, 12.0)]]
    parameters = canalization(
        transport,
        [(6.0, 3.0)],
        size=(17, 13),
        sinks=sinks,
        background=0.0,
        settling={"rest": 1e-6, "until": UNTIL},
    )
    assert 17 * 13 == 221
    state = end_of(parameters)
    cells = state.tissue.nearest_cells([one[0] for one in sinks])
    found = shares_of(state, cells)
    made = parameters.model().injection.production(state.tissue, state.fields.roles)
    full = shares_of_sinks(state.tissue, parameters.transport, cells, made, UNTIL, speed)
    assert full.argmax() == found.argmax() == 0
    np.testing.assert_allclose(found, full, atol=1e-3)


@pytest.mark.parametrize("transport", [FACILITATED, POLAR, POOL], ids=lambda one: one["kind"])
def test_a_mirrored_config_gives_the_mirrored_strand(transport):
    size, sinks = (25, 15), [[(6.0, 13.0)], [(20.0, 13.0)]]
    mirrored = [[(24.0 - x, y) for x, y in line] for line in sinks]
    # straight below a vein there is one shortest way, so that rounding decides nothing
    one = end_of(canalization(transport, [(6.0, 3.0)], size, sinks))
    other = end_of(canalization(transport, [(18.0, 3.0)], size, mirrored))
    strand, image = (state.tissue.positions[canal_of(state)] for state in (one, other))
    np.testing.assert_allclose(image, strand * [-1.0, 1.0] + [24.0, 0.0], atol=1e-12)
    assert len(strand) == 11
    grid, flipped = (state.fields.concentration.reshape(15, 25) for state in (one, other))
    np.testing.assert_allclose(flipped, grid[:, ::-1], rtol=1e-6, atol=1e-9)
    assert other.step == one.step


SEEDS = [pytest.param(seed, marks=pytest.mark.slow if seed >= 10 else ()) for seed in range(60)]


@pytest.mark.parametrize("seed", SEEDS)
def test_facilitated_diffusion_finds_a_shortest_way_to_the_nearest_vein(seed):
    rng = np.random.default_rng(seed)
    columns, rows = 27, 21
    while True:
        points = rng.integers(0, [columns, rows], (3, 2)).astype(float)
        if np.abs(points[1:] - points[0]).sum(axis=1).min() >= 4.0:
            break
    gain = {"kind": "facilitated", "gain": 1e4}
    sinks = [[tuple(points[1])], [tuple(points[2])]]
    state = end_of(canalization(gain, [tuple(points[0])], (columns, rows), sinks))
    cells = canal_of(state)
    source, *veins = state.tissue.nearest_cells(points).tolist()
    distances = dijkstra(state.tissue.adjacency, indices=source)[veins]
    assert len(cells) - 1 == distances.min()
    assert cells[0] == veins[int(distances.argmin())] or distances[0] == distances[1]


def test_without_a_limit_flux_in_closed_loops_is_refused():
    transport = {"kind": "polar", "gain": 30.0, "saturation": "none"}
    parameters = canalization(transport, [(0.0, 4.0)], background=0.0)
    with pytest.raises(RunError, match=r"grows without bound.*transport\.saturation"):
        end_of(parameters)


GOING_ON = {
    "facilitated": (FACILITATED, {}),
    "facilitated noise": (FACILITATED, {"settling": {"noise": 0.2}}),
    "polar": (POLAR, {"settling": {"noise": 0.1}}),
    "pool": (POOL, {}),
    "not waited for": (POOL, {"settling": {"until": 3.0}}),
    "stopped": (FACILITATED, {"stop": {"steps": 25}}),
}


@pytest.mark.parametrize("name", GOING_ON)
def test_every_step_is_a_place_to_go_on_from(name):
    transport, tables = GOING_ON[name]
    parameters = canalization(
        transport,
        [(4.0, 3.0), (9.0, 4.0), (7.0, 6.0)],
        size=(13, 10),
        sinks=[[(2.0, 9.0)], [(10.0, 9.0)]],
        placement={"rounds": [1, 2, 2]},
        **tables,
    )
    states, words = whole_run(parameters)
    kinds = states[-1].rows("events", "kind")
    rests = (
        states[-1]
        .rows("events", "step")[
            np.isin(kinds, [EventKind.CANALS_SETTLED, EventKind.CANALS_UNSETTLED])
        ]
        .tolist()
    )
    last = states[-1].step
    # around each rest, where the most happens, and in between
    steps = {0, 1, last // 3, last - 1, *(one + off for one in rests for off in (-1, 0, 1))}
    for step in sorted(one for one in steps if 0 <= one < last):
        assert_goes_on_from(parameters, states, words, step)


def test_noise_comes_from_the_seed_alone():
    ends = [
        end_of(canalization(FACILITATED, [(12.0, 4.0)], settling={"noise": 0.2}, seed=seed))
        for seed in (1, 1, 2)
    ]
    fluxes = [state.fields.flux for state in ends]
    assert fluxes[0].tobytes() == fluxes[1].tobytes() != fluxes[2].tobytes()


def test_a_state_that_has_a_successor_cannot_be_advanced_again():
    parameters = canalization(FACILITATED, [(12.0, 4.0)])
    model, streams = parameters.model(), Streams(1, parameters.stream_names)
    first = model.initial_state(streams)
    model.advance(first, streams)
    with pytest.raises(ValueError, match="advanced already"):
        model.advance(first, streams)
