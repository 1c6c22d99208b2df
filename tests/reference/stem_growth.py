"""Veins of a stem by definition: every new node against every other, one after the other.

All vein nodes are sources. The relative neighbourhood of a node is kept as pairs that are
born with a node and die when a node comes between them (Runions 2008, section 6.2). The
unit of length is D.
"""

import math
from dataclasses import dataclass, field

import numpy as np

TIE = 1e-9
MERGED = 1e-3
STILL = 1e-6
N_RULERS = 12
"""Near nodes that rule out most of the others before the exact comparison."""
FIRST_TIME = 5
"""Iteration before which the first primordium is placed."""


def squares(point, others):
    """Squared distances of a point to others."""
    return ((others - point) ** 2).sum(axis=-1)


def neighbors(x, nodes):
    """Give the relative neighbours of node x: none is nearer to both than they are."""
    to_x = squares(nodes[x], nodes)
    left = np.argsort(to_x, kind="stable")
    left = left[left != x]
    # near ones and those left rule out most of the others before the comparison with all
    for u in left[:N_RULERS].tolist():
        left = ruled(u, left, nodes, to_x)
    row = 0
    while row < len(left):
        left = ruled(left[row], left, nodes, to_x)
        row += 1
    return [v for v in left.tolist() if not excluded(x, v, nodes, to_x)]


def ruled(u, others, nodes, to_x):
    """Give those of others that u does not exclude."""
    limit = (1 - TIE) * to_x[others]
    return others[~((to_x[u] < limit) & (squares(nodes[u], nodes[others]) < limit))]


def excluded(x, v, nodes, to_x):
    """Tell whether any node excludes v: it is nearer to x and to v than they are."""
    limit = (1 - TIE) * to_x[v]
    between = (to_x < limit) & (squares(nodes[v], nodes) < limit)
    between[[x, v]] = False
    return between.any()


@dataclass
class Stem:
    """Nodes, edges and active pairs of a stem while it grows."""

    nodes: np.ndarray
    edges: set = field(default_factory=set)
    active: set = field(default_factory=set)

    def insert(self, positions):
        """Put new nodes in; pairs that they separate die, near neighbours are joined."""
        first = len(self.nodes)
        self.nodes = np.vstack([self.nodes, np.reshape(positions, (-1, 3))])
        self.active = {pair for pair in self.active if not self._separated(pair, first)}
        for x in range(first, len(self.nodes)):
            for v in neighbors(x, self.nodes):
                pair = (min(x, v), max(x, v))
                if pair in self.edges:
                    continue
                if math.sqrt(squares(self.nodes[x], self.nodes[v])) < 1 + TIE:
                    self.edges.add(pair)
                    self.active.discard(pair)
                else:
                    self.active.add(pair)

    def _separated(self, pair, first):
        """Tell whether a node from ``first`` on lies between the two of a pair."""
        a, b = self.nodes[list(pair)]
        limit = (1 - TIE) * squares(a, b)
        new = self.nodes[first:]
        return bool(((squares(a, new) < limit) & (squares(b, new) < limit)).any())

    def iterate(self):
        """Let every node of an active pair grow; tell whether anything was added."""
        pulls = {}
        for a, b in sorted(self.active):
            pull = self.nodes[b] - self.nodes[a]
            pull = pull / np.linalg.norm(pull)
            pulls[a] = pulls.get(a, 0.0) + pull
            pulls[b] = pulls.get(b, 0.0) - pull
        created, n_before = [], len(self.edges)
        for v in sorted(pulls):
            size = np.linalg.norm(pulls[v])
            if size < STILL:
                continue
            place = self.nodes[v] + pulls[v] / size
            nodes = np.vstack([self.nodes, *created])
            nearest = int(np.argmin(squares(place, nodes)))
            if squares(place, nodes[nearest]) <= MERGED**2:
                if nearest != v:
                    self.edges.add((min(v, nearest), max(v, nearest)))
            else:
                created.append(place)
                self.edges.add((v, len(nodes)))
        self.insert(np.reshape(created, (-1, 3)))
        self.active -= self.edges
        return bool(created) or len(self.edges) > n_before


def grow_stem(divergence, radius, rise, n_primordia, plastochron):
    """Grow the veins of a stem; angle in degrees, lengths in D, plastochron in iterations.

    Returns positions, segments, ids of the primordia, and ids of the ring.
    """
    n_ring = math.ceil(2 * math.pi * radius)
    angles = 2 * np.pi * np.arange(n_ring) / n_ring
    stem = Stem(np.zeros((0, 3)))
    stem.insert(np.c_[radius * np.cos(angles), radius * np.sin(angles), np.zeros(n_ring)])
    primordia, time = [], 0
    while True:
        n_placed = len(primordia)
        if n_placed < n_primordia:
            due = FIRST_TIME + n_placed * plastochron
            time = max(time, due) if not stem.active else time
            if time >= due:
                angle = np.radians(divergence) * n_placed
                primordia.append(len(stem.nodes))
                height = (n_placed + 1) * rise
                stem.insert([radius * np.cos(angle), radius * np.sin(angle), height])
        elif not stem.active:
            break
        if not stem.iterate() and len(primordia) == n_primordia:
            break
        time += 1
    return stem.nodes, np.array(sorted(stem.edges)), np.array(primordia), np.arange(n_ring)
