"""The stem of Runions (2008, chapter 6) by brute force: every node against every other.

Nodes at which a ring and primordia are placed, and all that grow, are sources to each
other. Two nodes are relative neighbours when no third is nearer to both of them than
they are to each other, by more than 1e-9 of squared distances. Sums are taken in the
order in which pairs came to be, so that positions agree to the last bit.
"""

import numpy as np

MARGIN = 1e-9


def around(dx, period):
    """Differences along the arc of an unrolled surface, the short way; a period of 0 is none."""
    if period > 0.0:
        dx = np.where(dx > 0.5 * period, dx - period, np.where(dx < -0.5 * period, dx + period, dx))
    return dx


def squares(points, place, period=0.0):
    """Squared distances of points to a place, by the one expression that makes ties agree."""
    dx, dy, dz = points[:, 0] - place[0], points[:, 1] - place[1], points[:, 2] - place[2]
    dx = around(dx, period)
    return dx * dx + dy * dy + dz * dz


def relative_neighbors(points, x, period=0.0):
    """All relative neighbours of point x, ascending."""
    to_x = squares(points, points[x], period)
    limits = to_x * (1.0 - MARGIN)
    return [
        v
        for v in range(len(points))
        if v != x
        and not np.any((to_x < limits[v]) & (squares(points, points[v], period) < limits[v]))
    ]


def is_in_lune(u, a, b, period=0.0):
    """Whether place u lies in the open lune of two others."""
    (limit,) = squares(a[None], b, period) * (1.0 - MARGIN)
    return squares(a[None], u, period)[0] < limit and squares(b[None], u, period)[0] < limit


class Stem:
    """A stem with its nodes, its segments as sets of two, and its active pairs in order."""

    def __init__(self, length=1.0, period=0.0):
        self.length = length
        self.period = period
        self.positions = np.empty((0, 3))
        self.segments = set()
        self.pairs = []

    def insert(self, places, segments):
        """New nodes come, and segments with them: section 6.2.1, the connect rule."""
        start = len(self.positions)
        self.positions = np.concatenate((self.positions, np.reshape(places, (-1, 3))))
        self.segments |= segments
        points, new = self.positions, range(start, len(self.positions))
        self.pairs = [
            (a, b)
            for a, b in self.pairs
            if frozenset((a, b)) not in self.segments
            and not any(is_in_lune(points[u], points[a], points[b], self.period) for u in new)
        ]
        reach = self.length * (1.0 + MARGIN)
        for x in new:
            for v in relative_neighbors(points, x, self.period):
                if v > x or frozenset((x, v)) in self.segments:
                    continue
                if squares(points[x][None], points[v], self.period)[0] < reach * reach:
                    self.segments.add(frozenset((x, v)))
                else:
                    self.pairs.append((x, v))

    def directions(self):
        """Sums of unit vectors toward the other nodes of active pairs, by node."""
        sums = {v: np.zeros(3) for v in sorted({v for pair in self.pairs for v in pair})}
        for a, b in self.pairs:
            away = self.positions[b] - self.positions[a]
            away[0] = around(away[0], self.period)
            distance = np.sqrt(squares(self.positions[b][None], self.positions[a], self.period)[0])
            sums[a] = sums[a] + away / distance
            sums[b] = sums[b] - away / distance
        return sums

    def extend(self):
        """Every node in an active pair grows; tells whether there is anything new."""
        n_nodes, n_segments = len(self.positions), len(self.segments)
        places, segments = np.empty((0, 3)), set()
        for v, total in self.directions().items():
            norm = np.sqrt(squares(total[None], np.zeros(3))[0])
            if norm < 1e-6:
                continue
            place = self.positions[v] + self.length * total / norm
            if self.period > 0.0:
                place[0] = place[0] + self.period if place[0] < 0.0 else place[0]
                place[0] = place[0] - self.period if place[0] >= self.period else place[0]
            everything = np.concatenate((self.positions, places))
            to_place = squares(everything, place, self.period)
            w = int(np.argmin(to_place))
            if to_place[w] > (1e-3 * self.length) * (1e-3 * self.length):
                w = len(everything)
                places = np.concatenate((places, place[None]))
            if w != v:
                segments.add(frozenset((v, w)))
        self.insert(places, segments)
        return len(self.positions) > n_nodes or len(self.segments) > n_segments


def ring_and_primordia(radius, rise, degrees, n_primordia, length, period):
    """Places of the ring and of the primordia; arc, 0 and height on an unrolled surface."""
    n_ring = int(np.ceil(2.0 * np.pi * radius / length))
    ring, numbers = np.arange(n_ring), np.arange(n_primordia)
    angles, heights = numbers * np.deg2rad(degrees), (numbers + 1) * rise
    if period > 0.0:
        turns = angles / (2.0 * np.pi)
        ring_arcs, arcs = ring * (period / n_ring), (turns - np.floor(turns)) * period
        return (
            np.stack((ring_arcs, 0.0 * ring, 0.0 * ring), axis=1),
            np.stack((arcs, 0.0 * arcs, heights), axis=1),
        )
    turns = 2.0 * np.pi * ring / n_ring
    return (
        np.stack((radius * np.cos(turns), radius * np.sin(turns), 0.0 * turns), axis=1),
        np.stack((radius * np.cos(angles), radius * np.sin(angles), heights), axis=1),
    )


def grow(radius, rise, degrees, n_primordia, plastochron, length=1.0, is_unrolled=False, first=5):
    """Grow a stem to its end; primordium k comes before iteration first + k plastochron."""
    period = 2.0 * np.pi * radius if is_unrolled else 0.0
    stem = Stem(length, period)
    ring, primordia = ring_and_primordia(radius, rise, degrees, n_primordia, length, period)
    stem.insert(ring, set())
    n_placed = 0
    for iteration in range(100_000):
        while n_placed < n_primordia and first + n_placed * plastochron <= iteration:
            stem.insert(primordia[n_placed], set())
            n_placed += 1
        is_new = stem.extend()
        if n_placed == n_primordia and (not stem.pairs or not is_new):
            return stem
    raise AssertionError("the stem grows for ever")
