"""The compiled walk of Murray's law and the plain one."""

import numpy as np
from reference.networks import random_tree

from vasc.analysis.ancestry import descent
from vasc.kernels import murray


def test_many_segments_give_the_same_bytes_as_few(monkeypatch):
    tree = random_tree(np.random.default_rng(3), 2000)
    directions = descent(tree)
    rows = directions.from_tips
    results = []
    for few in (0, 10_000):
        monkeypatch.setattr(murray, "FEW", few)
        amounts = np.where(directions.n_children == 0, 1.0, 0.3)
        carried = murray.add_pipes(
            directions.proximal[rows], directions.distal[rows], directions.n_parents, amounts
        )
        results.append((amounts.tobytes(), carried.tobytes()))
    assert results[0] == results[1]
