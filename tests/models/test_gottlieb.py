"""Gottlieb's model: a blade that doubles, and straight veins to every large space."""

import numpy as np
import pytest
from reference.pasts import assert_goes_on_from, whole_run

from vasc.analysis.topology import count_components, count_cycles
from vasc.config import load_text
from vasc.domain import Blade
from vasc.errors import ConfigError
from vasc.events import EventKind
from vasc.experiment import resume, run, verify
from vasc.kernels.contacts import segment_contacts
from vasc.kernels.crossings import is_crossed
from vasc.models import GottliebParameters
from vasc.models.gottlieb import stays_within
from vasc.network import Origin
from vasc.timeline import Timeline, validate

CONFIG = """kind = "gottlieb"
doublings = 3
space = 8.0
longest = 2.0
[domain]
shape = "ovate"
length = 12.0
"""


def gottlieb(**values):
    """A small leaf."""
    domain = {"shape": "ovate", "length": 12.0}
    return GottliebParameters.model_validate(
        {"domain": domain, "doublings": 3, "space": 8.0, "longest": 2.0, **values}
    )


@pytest.fixture(scope="module")
def runs():
    """Open and closed: all states, and the words of the streams."""
    return {reach: whole_run(gottlieb(reach=reach)) for reach in (None, 14.0)}


def test_the_blade_doubles_in_each_step(runs):
    states, _ = runs[None]
    assert [state.blade.length for state in states] == pytest.approx([12.0, 24.0, 48.0, 96.0])
    # positions are exact: what doubles is what was
    early, late = (state.network for state in states[1:3])
    np.testing.assert_array_equal(late.positions[: early.n_nodes], 2.0 * early.positions)


@pytest.mark.parametrize("reach", [None, 14.0])
def test_every_source_is_connected_and_no_large_space_is_left(runs, reach):
    states, _ = runs[reach]
    last = states[-1]
    assert len(last.live) == 0
    network = last.network
    ends = np.flatnonzero(network.origins == Origin.SOURCE)
    n_sources = last.n_rows("sources")
    assert n_sources > 15
    assert sorted(network.causes[ends].tolist()) == list(range(n_sources))
    np.testing.assert_allclose(
        network.positions[ends], last.positions("sources")[network.causes[ends]]
    )
    rng = np.random.default_rng(1)
    points = rng.uniform(*np.reshape(last.blade.bounds, (2, 2)), (4000, 2))
    points = points[last.blade.contains(points)]
    sites = network.positions
    apart = np.sqrt(((points[:, None] - sites[None]) ** 2).sum(axis=2)).min(axis=1)
    assert apart.max() <= 8.0


def test_an_open_pattern_is_a_tree_and_a_closed_one_has_loops(runs):
    one, other = (runs[reach][0][-1] for reach in (None, 14.0))
    assert count_cycles(one.network) == 0
    kinds = other.rows("events", "kind")
    n_joins = (kinds == EventKind.VEIN_JOINED).sum()
    assert n_joins == (kinds == EventKind.LOOP_CLOSED).sum() == count_cycles(other.network) > 15
    assert count_components(one.network) == count_components(other.network) == 1


@pytest.mark.parametrize("reach", [None, 14.0])
def test_no_veins_cross(runs, reach):
    network = runs[reach][0][-1].network
    assert len(segment_contacts(network.positions, network.segments, 8.0)) == 0


@pytest.mark.parametrize("reach", [None, 14.0])
def test_each_vein_comes_straight_from_the_closest_node(runs, reach):
    states, _ = runs[reach]
    for step in range(1, len(states)):
        network = states[step].network
        ends = np.flatnonzero((network.origins == Origin.SOURCE) & (network.births == step))
        earlier = np.flatnonzero(network.births < step)
        refined = np.flatnonzero((network.births == step) & (network.origins == Origin.REFINEMENT))
        veins = np.concatenate([earlier, refined])
        for end in ends.tolist():
            place = network.positions[end]
            length = np.hypot(*(network.positions[network.parents[end]] - place))
            nearest = np.hypot(*(network.positions[veins] - place).T).min()
            assert length <= nearest * (1.0 + 1e-12)
            pair = [network.parents[end], end]
            assert (network.segments == pair).all(axis=1).any()


def test_joins_are_within_reach(runs):
    states, _ = runs[14.0]
    for step in range(1, len(states)):
        network = states[step].network
        is_new = (network.segment_births == step) & (network.segment_kinds == 1)
        if is_new.any():
            assert network.lengths[is_new].max() <= 14.0


@pytest.mark.parametrize("reach", [None, 14.0])
def test_every_step_is_a_place_to_go_on_from(runs, reach):
    states, words = runs[reach]
    for step in range(states[-1].step):
        assert_goes_on_from(gottlieb(reach=reach), states, words, step)


def test_a_recorded_run_goes_on_and_repeats(tmp_path):
    experiment = load_text(CONFIG)
    whole, parts = tmp_path / "whole.h5", tmp_path / "parts.h5"
    assert run(experiment, whole).stop_reason == "no_sources"
    run(experiment, parts, steps=1)
    resume(parts)
    assert validate(whole) == validate(parts) == []
    assert verify(whole) == verify(parts) == []
    with Timeline(whole) as one, Timeline(parts) as other:
        assert (one.growth, one.model) == ("doubling", "gottlieb")
        assert one.last_step == other.last_step == 3
        for table in ("nodes", "segments", "sources", "events", "states"):
            for column in one.tables()[table].arrays:
                assert one.table(table, column).tobytes() == other.table(table, column).tobytes()


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("longest = 9.0", "longest = 9: must be at most space, 8 D"),
        (
            "doublings = 12\nspace = 0.5\nlongest = 0.5",
            "domain.length = 12 and doublings = 12: the blade would be 4.92e+04 D long",
        ),
        ("longest = 1e-300", "times longest = 1e-300, more than memory can hold; at most 20000"),
        ("length = 1e300", "domain.length = 1e+300 and doublings = 3: the blade would be"),
        ("length = 1e-300", "domain.length = 1e-300: must be at least 1e-06 D"),
        ("doublings = 13", "doublings"),
        ("reach = -1.0", "reach"),
    ],
)
def test_what_cannot_be_is_refused(line, message):
    keys = {one.split(" = ")[0] for one in line.split("\n")}
    kept = [one for one in CONFIG.split("\n") if one.split(" = ")[0] not in keys]
    at = len(kept) - 1 if line.startswith("length") else 1
    with pytest.raises(ConfigError) as caught:
        load_text("\n".join([*kept[:at], *line.split("\n"), *kept[at:]]))
    assert message in str(caught.value)


def test_a_space_that_no_blade_has_is_refused_by_its_key():
    with pytest.raises(ConfigError, match=r"space = 1e\+06: no source would ever appear"):
        gottlieb(space=1e6).model()


@pytest.mark.parametrize("shape", ["ovate", "cordate"])
def test_no_vein_leaves_the_blade(shape):
    # a tip that is drawn out has a bay on each side, a heart one at its base
    domain = {"shape": shape, "length": 12.0}
    states, _ = whole_run(gottlieb(domain=domain, reach=14.0))
    last = states[-1]
    network, blade = last.network, last.blade
    assert (network.origins == Origin.SOURCE).sum() > 10
    for pair in network.segments:
        way = network.positions[pair]
        points = way[0] + np.linspace(0.0, 1.0, 21)[:, None] * (way[1] - way[0])
        beyond = ~blade.contains(points)
        assert (blade.margin_distance(points)[beyond] < 1e-6).all()


def test_a_way_across_a_bay_leaves_the_blade():
    corners = [(-4.0, 0.0), (4.0, 0.0), (4.0, 8.0), (0.0, 2.0), (-4.0, 8.0)]
    blade = Blade.from_rings([corners])
    assert not stays_within(blade, np.array([[-3.5, 7.0], [3.5, 7.0]]))
    assert stays_within(blade, np.array([[-3.0, 1.0], [3.0, 1.0]]))
    # along the margin, and from it
    assert stays_within(blade, np.array([[-4.0, 0.0], [-4.0, 8.0]]))
    assert stays_within(blade, np.array([[4.0, 8.0], [2.0, 5.0]]))


def test_a_way_that_runs_along_a_vein_is_crossed():
    points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [3.0, 0.0]])
    segments = np.array([[0, 1], [0, 2]])
    ways = {(2.0, 0.0): True, (0.5, 0.0): True, (-1.0, 0.0): False, (1.0, 1.0): False}
    for place, expected in ways.items():
        assert is_crossed(points, segments, 0, np.array(place)) is expected
    # a way from elsewhere that only touches the end of a vein
    assert is_crossed(points, segments, 3, np.array([1.0, 0.0]))
    assert not is_crossed(points, segments, 3, np.array([1.5, 0.0]))
