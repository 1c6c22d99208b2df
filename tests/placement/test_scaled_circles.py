"""Circles in a blade that is scaled: centres are where there is room."""

import numpy as np

from vasc.models import MODELS
from vasc.placement.room import Room
from vasc.simulation import simulate
from vasc.streams import Streams


def test_a_circle_within_an_isogonic_blade_is_where_its_room_is(monkeypatch):
    whole, n_filled = Room.fill, 0

    def fill(room, place):
        nonlocal n_filled
        n_filled += 1
        gap = np.sqrt(((room._sites - place) ** 2).sum(axis=1)).min()
        assert gap > room.limit, f"the place {place} has the clearance {gap}"
        outline = room.moment.growth.domain(room.moment.step)
        assert (
            outline.contains(place * room.moment.scale)[0]
            or outline.margin_distance(place * room.moment.scale)[0] < 1e-6
        )
        whole(room, place)

    monkeypatch.setattr(Room, "fill", fill)
    config = {
        "kind": "closed",
        "domain": {"shape": "ovate", "length": 12.0},
        "growth": {"kind": "isogonic", "final_length": 60.0, "length_per_step": 0.7},
        "placement": {"kind": "empty_circles", "birth_distance": 6.0},
        "arrival": {"kill_distance": 1.5},
    }
    for _ in simulate(MODELS["closed"].model_validate(config).model(), Streams(1), max_steps=90):
        pass
    assert n_filled > 10
