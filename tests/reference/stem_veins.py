"""Stems whose veins are laid out by hand: known links, forks above primordia, noise."""

from itertools import pairwise

import numpy as np

FORK = 7.0
"""Height of the fork above a primordium, in D."""


class Veins:
    """Nodes and segments of a stem that is laid out vein by vein."""

    def __init__(self):
        self.nodes, self.segments = [], []

    def add(self, position):
        """Add a node."""
        self.nodes.append(np.asarray(position, dtype=float))
        return len(self.nodes) - 1

    def lead(self, start, end):
        """Lead a vein straight from node to node, in pieces of about 1."""
        way = self.nodes[end] - self.nodes[start]
        n_pieces = max(1, round(float(np.linalg.norm(way))))
        between = [self.add(self.nodes[start] + way * k / n_pieces) for k in range(1, n_pieces)]
        path = [start, *between, end]
        self.segments += list(pairwise(path))


def laid_out(divergence, radius, rise, steps, *, noise=0.0, seed=0, fork=FORK, per_level=1):
    """Lay out a stem: ``steps[m]`` are the numbers of primordia that m leads up to.

    Angle in degrees. Returns positions, segments, ids of the primordia, and of the ring.
    """
    veins, primordia = Veins(), []
    n_ring = int(2 * np.pi * radius) + 1

    def place(angle, height):
        return radius * np.cos(angle), radius * np.sin(angle), height

    ring = [veins.add(place(2 * np.pi * k / n_ring, 0.0)) for k in range(n_ring)]
    veins.segments += [(k, (k + 1) % n_ring) for k in ring]
    angles = []
    for m in range(len(steps)):
        level, member = divmod(m, per_level)
        angles.append(level * np.radians(divergence) + 2 * np.pi * member / per_level)
        primordia.append(veins.add(place(angles[m], (level + 1) * rise)))
    reached = {n for ups in steps for n in ups}
    for m, ups in enumerate(steps):
        if m not in reached:
            turns = angles[m] / (2 * np.pi) % 1.0
            veins.lead(ring[round(turns * n_ring) % n_ring], primordia[m])
        if any(n < len(steps) for n in ups):
            top = veins.add(place(angles[m], (m // per_level + 1) * rise + fork))
            veins.lead(primordia[m], top)
            for n in ups:
                if n < len(steps):
                    veins.lead(top, primordia[n])
    positions = np.array(veins.nodes)
    positions += noise * np.random.default_rng(seed).normal(size=positions.shape)
    return positions, np.array(veins.segments), np.array(primordia), np.array(ring)
