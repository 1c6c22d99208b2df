"""Stems: the obvious program's veins, exact counts, record and resumption, and what is refused."""

from itertools import pairwise

import numpy as np
import pytest
from pydantic import ValidationError

from vasc.events import EventKind, StopReason
from vasc.models import StemVasculature
from vasc.network import Origin, SegmentKind
from vasc.simulation import simulate
from vasc.state import Tables
from vasc.streams import Streams


def stem(radius, rise, n_primordia, plastochron, divergence=137.5, **placement):
    """The parameters of a stem."""
    return StemVasculature.model_validate(
        {
            "kind": "stem",
            "domain": radius if isinstance(radius, dict) else {"radius": radius},
            "placement": {
                "divergence": divergence,
                "rise": rise,
                "primordia": n_primordia,
                "plastochron": plastochron,
                **placement,
            },
        }
    )


def states_of(parameters, seed=1):
    """All states of a stem."""
    return list(simulate(parameters.model(), Streams(seed, parameters.stream_names)))


def components(state):
    """How many pieces the veins are in."""
    roots = list(range(state.n_rows("nodes")))

    def root(node):
        while roots[node] != node:
            node = roots[node]
        return node

    for a, b in state.rows("segments", "nodes").tolist():
        roots[max(root(a), root(b))] = min(root(a), root(b))
    return sum(root(node) == node for node in range(len(roots)))


@pytest.mark.parametrize(
    ("radius", "n_primordia", "plastochron", "nodes", "segments"),
    [(16, 30, 5, 1294, 1351), (50, 30, 5, 3238, 3309), (115, 14, 5, 2097, 2109)],
)
def test_counts_of_known_stems(radius, n_primordia, plastochron, nodes, segments):
    last = states_of(stem(radius, 10, n_primordia, plastochron))[-1]
    assert last.n_rows("nodes") == pytest.approx(nodes, rel=0.01)
    assert last.n_rows("segments") == pytest.approx(segments, rel=0.01)
    assert last.rows("events", "subject")[-1] == StopReason.NO_SOURCES
    assert components(last) == 1


def test_every_state_is_in_order():
    states = states_of(stem(16, 10, 12, 5))
    last = states[-1]
    assert last.blade is None
    origins, parents = last.rows("nodes", "origin"), last.rows("nodes", "parent")
    births, sources = last.rows("nodes", "birth"), last.rows("nodes", "source")
    assert (np.diff(births) >= 0).all()
    assert ((parents < 0) == np.isin(origins, [Origin.SEED, Origin.PRIMORDIUM])).all()
    grown = origins == Origin.EXTENSION
    # a strand belongs to the primordium it came from, or to none if it came from the ring
    assert (sources[grown] == sources[parents[grown]]).all()
    assert sources[origins == Origin.PRIMORDIUM].tolist() == list(range(12))
    assert (sources[origins == Origin.SEED] == -1).all()
    positions = last.positions("nodes")
    np.testing.assert_array_equal(positions, last.rows("nodes", "position"))
    np.testing.assert_array_equal(
        positions[origins == Origin.PRIMORDIUM], last.rows("sources", "position")
    )
    ends = positions[last.rows("segments", "nodes")]
    lengths = np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1))
    assert lengths.max() <= 1.0 + 1e-8
    for before, after in pairwise(states):
        assert all(a >= b for a, b in zip(after.counts, before.counts, strict=True))


def test_joins_and_loops_are_events():
    last = states_of(stem(16, 10, 12, 5))[-1]
    kinds, subjects = last.rows("events", "kind"), last.rows("events", "subject")
    joined = subjects[kinds == EventKind.VEIN_JOINED]
    np.testing.assert_array_equal(
        joined, np.flatnonzero(last.rows("segments", "kind") == SegmentKind.JOIN)
    )
    n_loops = int((kinds == EventKind.LOOP_CLOSED).sum())
    assert n_loops == last.n_rows("segments") - last.n_rows("nodes") + components(last)


def test_primordia_are_where_and_when_they_should_be():
    last = states_of(stem(20, 12, 9, 4, divergence=90.0, per_level=2))[-1]
    births = last.rows("sources", "birth").tolist()
    assert births == [6, 6, 10, 10, 14, 14, 18, 18, 22]
    positions = last.rows("sources", "position")
    np.testing.assert_allclose(positions[:4, 2], [12, 12, 24, 24])
    np.testing.assert_allclose(positions[0], [20, 0, 12], atol=1e-12)
    np.testing.assert_allclose(positions[1], [-20, 0, 12], atol=1e-12)
    np.testing.assert_allclose(positions[2], [0, 20, 24], atol=1e-12)


def test_a_stem_whose_apex_grows_is_wider_above():
    domain = {"radii": [(0.0, 10.0), (50.0, 20.0)]}
    last = states_of(stem(domain, 10, 6, 5))[-1]
    places = last.rows("sources", "position")
    np.testing.assert_allclose(np.hypot(places[:, 0], places[:, 1]), [12, 14, 16, 18, 20, 20])


def test_noise_is_drawn_from_the_seed_alone():
    noisy = stem(16, 10, 10, 5, angle_noise=5.0, rise_noise=0.1)
    first, again, other = (
        states_of(noisy, seed)[-1].rows("sources", "position") for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert (np.abs(first - other).max(axis=1) > 0.0).all()
    plain = states_of(stem(16, 10, 10, 5))[-1].rows("sources", "position")
    assert 0.0 < np.abs(first[:, 2] - plain[:, 2]).max() < 5.0


@pytest.mark.parametrize("step", [0, 7, 40])
@pytest.mark.parametrize("metric", ["chord", "surface"])
def test_a_restored_stem_goes_on_as_before(step, metric):
    parameters = stem(12, 10, 8, 5, angle_noise=3.0)
    parameters = parameters.model_copy(
        update={"perception": parameters.perception.model_copy(update={"metric": metric})}
    )
    states = states_of(parameters)
    tables = Tables(dimensions=3)
    for name, table in states[step].tables.tables.items():
        n_rows = states[step].n_rows(name)
        if n_rows:
            tables[name].append(**{c: table.view(c, 0, n_rows) for c in table.columns})
    model, streams = parameters.model(), Streams(1, parameters.stream_names)
    state = model.restore(tables, step, streams)
    assert state.counts == states[step].counts
    for expected in states[step + 1 :]:
        state = model.advance(state, streams)
        assert state.counts == expected.counts
    for name, table in states[-1].tables.tables.items():
        for column in table.columns:
            np.testing.assert_array_equal(state.rows(name, column), table.view(column))


def test_a_state_that_has_a_successor_cannot_be_advanced_again():
    parameters = stem(12, 10, 1, 1, first_step=1)
    model, streams = parameters.model(), Streams(1, parameters.stream_names)
    first = model.initial_state(streams)
    model.advance(first, streams)
    with pytest.raises(ValueError, match="step 0 has been advanced already"):
        model.advance(first, streams)


def test_another_metric_connects_other_primordia():
    parameters = stem(12, 10, 8, 5)
    by_chord = states_of(parameters)[-1]
    surface = {"perception": parameters.perception.model_copy(update={"metric": "surface"})}
    on_surface = states_of(parameters.model_copy(update=surface))[-1]
    radii = np.hypot(*on_surface.positions("nodes")[:, :2].T)
    np.testing.assert_allclose(radii, 12.0)
    # straight chords run through the stem
    assert np.hypot(*by_chord.positions("nodes")[:, :2].T).min() < 10.0


@pytest.mark.parametrize(
    ("spoiled", "part"),
    [
        ({"domain": {"radius": 0.0}}, "greater than 0"),
        ({"domain": {"radius": 0.5}}, "domain.radius: a radius of 0.5 is less than"),
        ({"domain": {"radius": 1e9}}, "more than memory can hold"),
        ({"domain": {}}, "give either 'radius' or 'radii'"),
        ({"domain": {"radii": [(0.0, 5.0), (0.0, 6.0)]}}, "heights must ascend"),
        ({"internodes": [(0.0, 0.0), (0.5, 0.6)]}, "the last must have the height 1"),
        ({"internodes": [(0.0, 0.0), (0.5, 0.6), (1.0, 0.5)]}, "both numbers must be above"),
        ({"internodes": [(0.0, 0.0), (1.0, 1e300)]}, "no height may become more than 100"),
        ({"placement": {"rise": 1e300}}, "less than or equal to 100000"),
        ({"placement": {"rise": 0.5}}, "placement.rise is 0.5; it must be at least"),
        ({"placement": {"divergence": float("nan")}}, "finite"),
        ({"placement": {"plastochron": 10**18}}, "less than or equal to 1000000"),
        ({"placement": {"plastochron": 10**6}}, "would appear in step"),
        ({"placement": {"primordia": 0}}, "greater than or equal to 1"),
    ],
)
def test_bad_stems_are_refused(spoiled, part):
    tables = {
        "kind": "stem",
        "domain": {"radius": 20.0},
        "placement": {"divergence": 137.5, "rise": 10.0},
    }
    for table, values in spoiled.items():
        tables[table] = tables[table] | values if table == "placement" else values
    with pytest.raises(ValidationError, match=part):
        StemVasculature.model_validate(tables)
