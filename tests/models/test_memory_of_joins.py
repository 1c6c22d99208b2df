"""What has been joined stays joined: loops are counted right, and no two veins meet twice."""

import numpy as np

from vasc.analysis.topology import count_components, count_cycles
from vasc.events import EventKind
from vasc.models import ClosedVenation
from vasc.simulation import simulate
from vasc.streams import Streams

BLADE = {"shape": "linear", "length": 60.0, "width": 0.5, "seeds": {"count": 4}}
DARTS = {
    "kind": "darts",
    "density": 0.01,
    "birth_distance_sources": 4.0,
    "birth_distance_veins": 4.0,
}


def last_state(placement):
    """Run closed venation from several seeds to its end."""
    config = {"domain": BLADE, "placement": placement, "arrival": {"kill_distance": 1.0}}
    *_, state = simulate(ClosedVenation.model_validate(config).model(), Streams(3))
    return state


def test_closed_loops_are_the_cycles_of_the_network():
    state = last_state(DARTS)
    network, kinds = state.network, state.rows("events", "kind")
    cycles = count_cycles(network, components=count_components(network))
    assert cycles > 10
    assert np.count_nonzero(kinds == EventKind.LOOP_CLOSED) == cycles


def test_no_two_nodes_are_joined_twice():
    segments = np.sort(last_state(DARTS).network.segments, axis=1)
    assert len(np.unique(segments, axis=0)) == len(segments)


def test_given_sources_are_reached_without_any_placement():
    state = last_state({"kind": "given", "points": [[0.0, 40.0], [3.0, 30.0]]})
    assert state.n_rows("sources") == 2
    assert len(state.live) == 0
