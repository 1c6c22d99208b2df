"""Sources and veins of a tissue: rounds, darts, files, margins."""

import numpy as np
import pytest

from vasc.fields import Role
from vasc.models import CanalizationParameters
from vasc.models.canal_cells import CanalCells
from vasc.models.injection import DartInjection
from vasc.simulation import simulate
from vasc.state import Tables
from vasc.streams import Streams

TABLES = {
    "domain": {"kind": "voronoi", "columns": 15, "rows": 11},
    "veins": {"lines": [[(7.0, 10.0)]]},
    "placement": {"points": [(3.0, 2.0)]},
    "transport": {"kind": "facilitated", "gain": 1e4},
    "settling": {"tolerance": 1.0},
}
DARTS = {"kind": "darts", "count": 6, "first_distance": 6.0, "last_distance": 1.5}


def parameters(**tables):
    """Give parameters with tables replaced."""
    return CanalizationParameters.model_validate(TABLES | tables)


def states(made):
    """Give all states of a run."""
    return list(simulate(made.model(), Streams(made.seed, made.stream_names)))


def test_a_dart_a_round_keeps_a_distance_that_shrinks():
    made = parameters(placement=DARTS)
    model = made.model()
    run = states(made)
    births = run[-1].rows("sources", "birth")
    assert len(births) == DARTS["count"]
    assert (np.diff(births) > 0).all()
    before = {state.step: state for state in run}
    cells = model.tissue.nearest_cells(run[-1].rows("sources", "material"))
    for row, (cell, birth) in enumerate(zip(cells, births, strict=True)):
        veins = np.flatnonzero(before[birth].fields.roles == Role.VEIN)
        far = model.tissue.distances_from(np.isin(np.arange(model.tissue.n_cells), veins))
        assert far[cell] >= min(6.0 - 4.5 * row / 5, far.max())


def test_darts_fall_evenly_where_there_is_room():
    model = parameters(placement=DARTS).model()
    injection, streams = model.injection, Streams(1, ["placement"])
    hits = np.zeros(model.tissue.n_cells)
    for _ in range(2000):
        cells = CanalCells(model.tissue, Tables())
        injection.begin(cells)
        injection.place(cells, 1, streams)
        hits[cells.source_cells] += 1
    has_room = model.tissue.distances_from(cells.is_vein) >= 6.0
    assert hits[~has_room].sum() == 0
    expected = 2000 / has_room.sum()
    # chi squared is within five standard deviations of its mean
    deviation = ((hits[has_room] - expected) ** 2 / expected).sum()
    assert deviation < has_room.sum() + 5 * np.sqrt(2 * has_room.sum())


def test_where_no_cell_is_far_enough_the_farthest_is_taken_and_none_is_the_end():
    made = parameters(
        domain={"columns": 2, "rows": 2},
        veins={"lines": [[(0.0, 0.0)]]},
        placement={"points": [(1.0, 1.0)]},
    )
    model = made.model()
    injection = DartInjection(model.injection.veins, 0.0, 9, 50.0, 50.0)
    cells, streams = CanalCells(model.tissue, Tables()), Streams(1, ["placement"])
    injection.begin(cells)
    for _ in range(5):
        injection.place(cells, 1, streams)
    assert cells.source_cells[0] == 3
    assert sorted(cells.source_cells) == [1, 2, 3]
    assert injection.is_over(cells)


def test_sources_come_in_rounds_from_points_or_a_file(tmp_path):
    points = [(3.0, 2.0), (11.0, 2.0), (7.0, 5.0)]
    given = parameters(placement={"points": points, "rounds": [2, 1, 2]})
    (tmp_path / "s.csv").write_text("x,y,birth\n3,2,2\n11,2,1\n7,5,2\n")
    filed = parameters(placement={"file": "s.csv"})
    one, other = given.model().injection, filed.model(tmp_path).injection
    assert one.rounds.tolist() == other.rounds.tolist() == [1, 2, 2]
    assert one.cells.tolist() == other.cells.tolist()


@pytest.mark.parametrize("kind", ["rectangular", "hexagonal", "voronoi"])
def test_the_margin_is_one_closed_vein(kind):
    made = parameters(
        domain={"kind": kind, "blade": {"shape": "ovate", "length": 16.0}},
        veins={"margin": True},
        placement={"points": [(0.0, 7.0)]},
    )
    run = states(made)
    nodes = CanalCells(run[0].tissue, run[0].tables)
    segments = run[0].rows("segments", "nodes")
    is_vein = run[0].fields.roles == Role.VEIN
    assert (is_vein | ~run[0].tissue.is_margin).all()
    assert len(segments) >= run[0].n_rows("nodes")
    # a cell at a tip has one neighbor
    n_tips = int((np.bincount(run[0].tissue.walls.ravel()) == 1).sum())
    assert (np.bincount(segments.ravel()) == 1).sum() <= n_tips
    walls = {tuple(pair) for pair in run[0].tissue.walls.tolist()}
    cells = np.sort(run[0].tissue.nearest_cells(run[0].rows("nodes", "position"))[segments])
    assert {tuple(pair) for pair in cells.tolist()} <= walls
    assert nodes.is_vein.sum() >= is_vein.sum()
    assert len(run[-1].live) == 0


def test_lines_that_share_a_way_have_its_segments_once():
    made = parameters(
        domain={"columns": 9, "rows": 9},
        veins={"lines": [[(0.0, 4.0), (8.0, 4.0)], [(8.0, 4.0), (2.0, 4.0), (2.0, 8.0)]]},
        placement={"points": [(4.0, 0.0)]},
    )
    state = made.model().initial_state(Streams(1, made.stream_names))
    assert state.n_rows("nodes") == 13
    assert state.n_rows("segments") == 12


def test_the_seed_draws_the_tissue_alone():
    one, other = (parameters(seed=seed).model().tissue for seed in (1, 2))
    assert not np.array_equal(one.positions, other.positions)
    same = parameters(seed=1, placement=DARTS).model().tissue
    assert np.array_equal(one.corners, same.corners)
