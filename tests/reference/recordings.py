"""A recording of a leaf by hand, with what pictures and films ask of a timeline."""

from dataclasses import dataclass, field

import numpy as np
from reference.networks import PlainBlade, PlainMoment, network, sources


def cross_leaf(scale=1.0, step=2):
    """A square blade, a midvein up its middle and one pair of side veins."""
    points = np.array([[0, 0], [0, 5], [0, 9], [-4, 7], [4, 7]]) * scale
    veins = network(points, [(0, 1), (1, 2), (1, 3), (1, 4)])
    ring = np.array([[-5, 0], [5, 0], [5, 10], [-5, 10]]) * scale
    places = np.array([[-3.0, 2.0], [3.0, 2.0]]) * scale
    return PlainMoment(
        veins, PlainBlade((ring,), 10.0 * scale), sources(places, [0, 1]), step, float(step)
    )


@dataclass
class Recording:
    """Three steps of isogonic growth."""

    scales: tuple = (0.5, 0.75, 1.0)
    units: dict = field(default_factory=dict)
    config: dict = field(default_factory=dict)
    dimensions: int = 2
    tissue: None = None

    @property
    def last_step(self):
        return len(self.scales) - 1

    def frame(self, step=-1):
        step = self.last_step if step == -1 else step
        return cross_leaf(self.scales[step], step)
