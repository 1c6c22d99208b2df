"""Sources in largest empty circles, against a fine grid of the blade and its margin."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from reference.leaves import ARABIDOPSIS, SMALL, keyframed
from scipy.spatial import cKDTree

from vasc.errors import ConfigError
from vasc.events import EventKind
from vasc.models import MODELS
from vasc.network import Origin
from vasc.simulation import simulate
from vasc.sources import Cause
from vasc.streams import Streams

BIRTH_DISTANCE = 6.0
STEP = 0.4
"""Spacing of the grid."""

BASE = 2.0
"""Height above a base in which circles are not compared."""

LINEAR = {"final_length": 60.0, "length_per_step": 0.7}
OVATE = {"shape": "ovate", "length": 12.0}
CORDATE = {"shape": "cordate", "length": 12.0}
RUNS = {
    "areole, Arabidopsis": ("areole", {"growth": keyframed(ARABIDOPSIS)}, 235),
    "areole, small": ("areole", {"growth": keyframed(SMALL)}, 160),
    "closed, small": ("closed", {"growth": keyframed(SMALL)}, 160),
    "open, small": ("open", {"growth": keyframed(SMALL)}, 160),
    "closed, marginal": (
        "closed",
        {"growth": {"kind": "marginal", **LINEAR}, "domain": CORDATE},
        90,
    ),
    "open, marginal": ("open", {"growth": {"kind": "marginal", **LINEAR}, "domain": OVATE}, 90),
    "areole, marginal": ("areole", {"growth": {"kind": "marginal", **LINEAR}, "domain": OVATE}, 90),
    "closed, no growth": ("closed", {"domain": {"shape": "ovate", "length": 40.0}}, 30),
    "open, no growth": ("open", {"domain": {"shape": "cordate", "length": 40.0}}, 30),
}


def states_of(name):
    """All states of a run, each with its network as it was."""
    kind, tables, n_steps = RUNS[name]
    birth_distance = 10.0 if "Arabidopsis" in name else BIRTH_DISTANCE
    config = {
        "kind": kind,
        "placement": {"kind": "empty_circles", "birth_distance": birth_distance, "until": n_steps},
        "arrival": {"kill_distance": 1.5},
        **tables,
    }
    if tables.get("growth", {}).get("kind") == "keyframed":
        config["refinement"] = {"kind": "corner_cutting"}
    model = MODELS[kind].model_validate(config).model()
    return model, list(simulate(model, Streams(1), max_steps=n_steps)), birth_distance


def margin_of(growth, step):
    """The margin without the base, as a line."""
    scale = growth.scale(step)
    ring = growth.margin_places(step) * scale
    return shapely.LineString(np.concatenate([ring[growth.n_base - 1 :], ring[:1]]))


def trial_points(growth, step):
    """A grid of points in the blade, and points along the margin."""
    margin = margin_of(growth, step)
    line = shapely.line_interpolate_point(margin, np.arange(0.0, margin.length, 0.5 * STEP))
    x0, y0, x1, y1 = growth.domain(step).bounds
    x, y = np.meshgrid(np.arange(x0, x1, STEP), np.arange(y0, y1, STEP))
    grid = np.stack([x.ravel(), y.ravel()], axis=1)
    ring = growth.margin_places(step) * growth.scale(step)
    inside = shapely.contains_xy(shapely.Polygon(ring), grid[:, 0], grid[:, 1])
    return np.concatenate([grid[inside], shapely.get_coordinates(line)])


def are_free(growth, points):
    """Tell which points are where sources appear: not near a base, which is no margin.

    On the base itself there may be more room than anywhere above it.
    """
    return (points[:, 1] - points[:, 1].min() > BASE) | (growth.n_base == 1)


def sites_of(before, state):
    """Live nodes when sources of a step were placed, and live sources before that."""
    # nodes born by extension in a step come after placement; cuts come before it
    is_there = state.rows("nodes", "birth") < state.step
    is_there |= state.rows("nodes", "origin") == Origin.REFINEMENT
    events = state.rows("events", "kind")
    retired = state.rows("events", "subject")[events == EventKind.NODE_RETIRED]
    is_there[retired] = False
    nodes = state.positions("nodes")[is_there]
    return np.concatenate([nodes, state.positions("sources")[before.live]])


@pytest.mark.parametrize("name", RUNS)
def test_sources_take_the_most_room_until_there_is_no_more(name):
    model, states, birth_distance = states_of(name)
    n_checked = 0
    for before, state in pairwise(states):
        born = state.positions("sources")[before.n_rows("sources") :]
        causes = state.rows("sources", "cause")[before.n_rows("sources") :]
        if len(born) == 0 and state.step % 20:
            continue
        points = trial_points(model.growth, state.step)
        sites = sites_of(before, state)
        is_free = are_free(model.growth, points)
        clearances = cKDTree(sites).query(points)[0]
        radii = []
        for position in born:
            radius = np.sqrt(((sites - position) ** 2).sum(axis=1).min())
            assert radius > birth_distance
            # as much room as at any other point of the grid
            assert radius >= clearances[is_free].max() - 1e-6
            # and hardly more: a point of the grid is near every place in the blade
            assert radius <= clearances.max() + STEP
            gaps = np.sqrt(((points - position) ** 2).sum(axis=1))
            clearances = np.minimum(clearances, gaps)
            sites = np.concatenate([sites, [position]])
            radii.append(radius)
        assert clearances[is_free].max() <= birth_distance + 1e-6
        assert (np.diff(radii) <= 2e-6).all()
        margin = margin_of(model.growth, state.step)
        whole = model.growth.domain(state.step)
        for position, cause in zip(born, causes, strict=True):
            gap = shapely.Point(position).distance(margin)
            assert whole.contains(position[None])[0] or gap < 0.05
            if cause == Cause.SPACE:
                assert gap >= 0.15 * birth_distance - 1e-6
        n_checked += len(born)
    assert n_checked > 10


@pytest.mark.parametrize("name", ["areole, Arabidopsis", "areole, small", "closed, no growth"])
def test_mirrored_sources_appear_in_one_step_the_left_one_first(name):
    _, states, _ = states_of(name)
    n_pairs = 0
    for before, state in pairwise(states):
        born = state.rows("sources", "position")[before.n_rows("sources") :]
        images = {(-x + 0.0, y) for x, y in born.tolist()}
        if name.startswith("areole"):
            assert images == {(x + 0.0, y) for x, y in born.tolist()}
        lateral = born[np.abs(born[:, 0]) > 1e-9]
        for row in range(0, len(lateral) - 1):
            left, right = lateral[row], lateral[row + 1]
            n_pairs += left[1] == right[1] and left[0] == -right[0] < 0.0
    assert n_pairs >= 2


def test_of_equal_circles_the_lowest_is_taken_first_and_then_the_left():
    # the two ends of the blade are equally far from its middle
    _, state = placed([(0.0, 0.5)], {"shape": "elliptic", "length": 40.0}, 12.0)
    born = state.rows("sources", "position")
    np.testing.assert_allclose(born[:2], [[0.0, 0.0], [0.0, 40.0]], atol=1e-9)
    # then four places on the margin are, lower ones first, and of these the left one
    _, state = placed([(0.0, 0.5)], {"shape": "elliptic", "length": 40.0}, 9.0)
    lateral = state.rows("sources", "position")[2:8]
    np.testing.assert_allclose(lateral[:, 1], [10.0, 10.0, 30.0, 30.0, 20.0, 20.0], atol=1e-6)
    np.testing.assert_allclose(lateral[::2] * [-1.0, 1.0], lateral[1::2], atol=1e-6)
    assert (lateral[::2, 0] < 0.0).all()


def placed(seeds, domain, birth_distance):
    """The model and the state after the first placement among given seeds."""
    config = {
        "kind": "open",
        "domain": {**domain, "seeds": seeds},
        "placement": {"kind": "empty_circles", "birth_distance": birth_distance, "until": 1},
        "arrival": {"kill_distance": 1.5},
    }
    model = MODELS["open"].model_validate(config).model()
    states = list(simulate(model, Streams(1), max_steps=1))
    return model, states[-1]


@pytest.mark.parametrize(
    "seeds",
    [
        [(0.0, 0.0)],
        [(0.0, 0.5)],
        [(0.0, 0.1), (0.0, 0.3), (0.0, 0.5), (0.0, 0.7), (0.0, 0.9)],
        [(0.0, 0.1), (0.0, 0.9)],
        [(-0.1, 0.3), (0.1, 0.3)],
        [(-0.1, 0.3), (0.1, 0.3), (-0.1, 0.5), (0.1, 0.5)],
        [(-0.2, 0.5), (-0.1, 0.5), (0.0, 0.5), (0.1, 0.5), (0.2, 0.5)],
    ],
)
@pytest.mark.parametrize("birth_distance", [5.0, 12.0, 19.0])
def test_few_nodes_and_nodes_on_a_line(seeds, birth_distance):
    model, state = placed(seeds, {"shape": "elliptic", "length": 40.0}, birth_distance)
    sites = state.positions("nodes")[: len(seeds)]
    points = trial_points(model.growth, 1)
    clearances = cKDTree(sites).query(points)[0]
    born = state.rows("sources", "position")
    assert len(born) == 0 or clearances.max() > birth_distance - STEP
    for position in born:
        radius = np.sqrt(((sites - position) ** 2).sum(axis=1).min())
        assert radius > birth_distance
        assert radius >= clearances.max() - 1e-6
        clearances = np.minimum(clearances, np.sqrt(((points - position) ** 2).sum(axis=1)))
        sites = np.concatenate([sites, [position]])
    assert clearances.max() <= birth_distance + 1e-6


def test_no_source_where_there_is_no_room():
    _, state = placed([(0.0, 0.5)], {"shape": "elliptic", "length": 40.0}, 41.0)
    assert state.n_rows("sources") == 0


def test_no_source_after_the_last_step():
    config = {
        "kind": "open",
        "growth": keyframed(SMALL),
        "placement": {"kind": "empty_circles", "birth_distance": 6.0, "until": 70},
        "arrival": {"kill_distance": 1.5},
    }
    births = {}
    for until in (70, None):
        config["placement"]["until"] = until
        model = MODELS["open"].model_validate(config).model()
        *_, last = simulate(model, Streams(1), max_steps=150)
        births[until] = last.rows("sources", "birth")
    assert births[70].max() <= 70
    # the last step of growth is the last with sources unless told otherwise
    assert 120 < births[None].max() <= 130
    early = births[None][births[None] <= 70]
    np.testing.assert_array_equal(births[70], early)


def test_a_blade_of_several_rings_is_refused(tmp_path):
    path = tmp_path / "blade.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 L10 0 L10 10 L0 10 Z'
        ' M3 3 L3 6 L6 6 L6 3 Z"/></svg>'
    )
    config = {
        "kind": "open",
        "domain": {"file": "blade.svg", "length": 40.0},
        "placement": {"kind": "empty_circles", "birth_distance": 6.0},
        "arrival": {"kill_distance": 1.5},
    }
    with pytest.raises(ConfigError, match="the outline has 2 rings; the margin must be one"):
        MODELS["open"].model_validate(config).model(tmp_path)


def test_a_blade_that_never_grows_has_one_step_with_sources():
    config = {
        "kind": "open",
        "domain": {"shape": "ovate", "length": 40.0},
        "placement": {"kind": "empty_circles", "birth_distance": 6.0},
        "arrival": {"kill_distance": 1.5},
    }
    *_, last = simulate(MODELS["open"].model_validate(config).model(), Streams(1), max_steps=200)
    assert set(last.rows("sources", "birth").tolist()) == {1}
    assert last.n_rows("sources") > 10
