"""A stream is its seed and its name: who else draws numbers, and how many, makes no difference."""

import numpy as np
import pytest

from vasc.config import load_text
from vasc.simulation import simulate
from vasc.streams import Streams

LEAF = """kind = "{kind}"
seed = 5
[domain]
shape = "ovate"
length = 12.0
[growth]
kind = "isogonic"
final_length = 24.0
length_per_step = 1.0
[placement]
kind = "darts"
density = 0.05
birth_distance_sources = 3.0
birth_distance_veins = 3.0
[arrival]
kill_distance = 1.0
"""


def test_what_one_process_draws_does_not_shift_another():
    alone, together = Streams(7, ["placement"]), Streams(7, ["placement", "wander"])
    expected = alone["placement"].random(20)
    drawn = []
    for _ in range(20):
        together["wander"].normal(size=3)
        drawn.append(together["placement"].random())
    assert np.array_equal(drawn, expected)


def test_the_order_of_names_makes_no_difference():
    one, other = Streams(7, ["a", "b"]), Streams(7, ["b", "a"])
    assert all(one[name].random() == other[name].random() for name in ("a", "b"))


@pytest.mark.parametrize(("seed", "name"), [(8, "placement"), (7, "wander")])
def test_another_seed_or_name_is_another_stream(seed, name):
    first, second = Streams(7, ["placement"]), Streams(seed, [name])
    assert not np.array_equal(first["placement"].random(20), second[name].random(20))


class Consumer:
    """An observer that draws from a stream of its own at every step."""

    def observe(self, state, streams):
        streams["consumer"].random(1 + state.step)


@pytest.mark.parametrize("kind", ["open", "closed"])
def test_a_new_consumer_leaves_a_leaf_as_it_was(kind):
    parameters = load_text(LEAF.format(kind=kind)).parameters
    ends = []
    for names, observers in (((), ()), (("consumer",), (Consumer(),))):
        streams = Streams(parameters.seed, (*parameters.stream_names, *names))
        *_, last = simulate(parameters.model(), streams, observers=observers)
        ends.append(last.tables.tables)
    first, second = ends
    assert first["nodes"].n_rows > 20
    assert first.keys() == second.keys()
    for name, table in first.items():
        assert table.n_rows == second[name].n_rows
        for column in table.arrays:
            rows, others = (each[name].arrays[column][: each[name].n_rows] for each in ends)
            assert rows.tobytes() == others.tobytes(), (name, column)
