"""Networks whose statistics are known beforehand."""

import numpy as np
from reference.networks import network

from vasc.network import Origin


def without_seeds(net):
    """The same drawing, as of a real leaf: nobody says where its base is."""
    return network(net.positions, net.segments, origins=[Origin.EXTENSION] * net.n_nodes)


def honeycomb(columns, rows):
    """Regular hexagons of side 1, columns x rows of them."""
    corners = np.arange(6) * np.pi / 3.0 + np.pi / 6.0
    places, edges = {}, set()
    for row in range(rows):
        for column in range(columns):
            middle = np.array([np.sqrt(3.0) * (column + 0.5 * (row % 2)), 1.5 * row])
            around = []
            for angle in corners:
                place = middle + np.array([np.cos(angle), np.sin(angle)])
                place = tuple(place.round(9).tolist())
                around.append(places.setdefault(place, len(places)))
            for one, other in zip(around, around[1:] + around[:1], strict=True):
                edges.add((min(one, other), max(one, other)))
    return network(list(places), sorted(edges))


def binary_tree(depth, *, side=2):
    """A tree that forks ``depth`` - 1 times, every vein cut into ``side`` segments."""
    points, segments, level = [(0.0, 0.0)], [], [(0, 0.0, 2.0**depth)]
    for height in range(depth):
        above = []
        for node, x, spread in level:
            targets = [x] if height == 0 else [x - spread / 2.0, x + spread / 2.0]
            for target in targets:
                before = node
                for step in range(1, side + 1):
                    share = step / side
                    points.append((x + share * (target - x), height + share))
                    segments.append((before, len(points) - 1))
                    before = len(points) - 1
                above.append((before, target, spread if height == 0 else spread / 2.0))
        level = above
    return network(points, segments)


def pinnate_leaf():
    """A bent midvein of 5 sections, 4 secondary veins in pairs, a tertiary between two of them.

    Gives the network, the widths of its segments, and the orders they have.
    """
    points = [
        *[(0, 0), (0.1, 2), (0, 4), (0.2, 6)],
        *[(-3, 3), (3, 3.2), (-3, 5), (3, 5.2)],
        *[(-1.45, 2.5), (-1.5, 4.5)],
    ]
    midvein = [(0, 1), (1, 2), (2, 3)]
    left, right = [(1, 8), (8, 4), (2, 9), (9, 6)], [(1, 5), (2, 7)]
    segments = [*midvein, *left, *right, (8, 9)]
    widths = [9.0, 8.0, 6.0, 3.0, 2.8, 2.5, 2.3, 3.0, 2.4, 0.8]
    orders = [1, 1, 1, 2, 2, 2, 2, 2, 2, 3]
    return network(points, segments), np.array(widths), orders


def junction(angles, widths, length=5.0):
    """Veins that leave one point at angles, in degrees; gives the network and the widths."""
    turns = np.radians(angles)
    ends = length * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    net = network(np.vstack([[0.0, 0.0], ends]), [(0, k + 1) for k in range(len(ends))])
    return net, np.asarray(widths, dtype=float)
