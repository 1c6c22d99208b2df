"""A circle may be largest between two points of the margin that have too little room."""

import numpy as np
from reference.leaves import SMALL, leaf
from scipy.spatial import cKDTree

from vasc.events import EventKind
from vasc.models import MODELS
from vasc.network import Origin
from vasc.simulation import simulate
from vasc.streams import Streams

BIRTH_DISTANCE = 8.589904816620537


def test_no_room_is_left_between_points_of_the_margin():
    tables = leaf("areole", SMALL, BIRTH_DISTANCE, until=150)
    model = MODELS["areole"].model_validate(tables).model()
    growth = model.growth
    before = None
    for state in simulate(model, Streams(1), max_steps=90):
        if before is not None:
            is_there = (state.rows("nodes", "birth") < state.step) | (
                state.rows("nodes", "origin") == Origin.REFINEMENT
            )
            is_retirement = state.rows("events", "kind") == EventKind.NODE_RETIRED
            is_there[state.rows("events", "subject")[is_retirement]] = False
            live = [*before.live, *range(before.n_rows("sources"), state.n_rows("sources"))]
            sites = np.concatenate(
                [state.positions("nodes")[is_there], state.positions("sources")[live]]
            )
            rows = np.repeat(np.arange(growth.n_base, len(growth.margin) - 1), 21)
            shares = np.tile(np.linspace(0, 1, 21), len(rows) // 21)
            _, places = growth.along_margin(rows, shares, state.step)
            left = cKDTree(sites).query(places)[0]
            assert left.max() <= BIRTH_DISTANCE + 1e-6, f"step {state.step}"
        before = state


def test_mirrored_sources_are_born_in_one_step():
    tables = leaf("areole", SMALL, BIRTH_DISTANCE, until=150)
    for state in simulate(
        MODELS["areole"].model_validate(tables).model(), Streams(1), max_steps=90
    ):
        places = (state.positions("sources") + 0.0).tolist()
        assert {(x, y) for x, y in places} == {(-x + 0.0, y) for x, y in places}, state.step
