"""Canals in plain Python: relative neighbours in one order, and segments in the way.

V(s) holds every node v that no earlier node u is nearer to than the source s is:
none with |u - v| < |v - s|. Earlier means nearer to s; of nodes equally near (to
1e-6) the lowest comes first, then the one nearest to the midline, then the left
one. (Runions 2008, equation 4.1, gives no order: the centre of a largest empty
circle has three nodes or more equally near.)
"""

from math import dist


def in_order(source, nodes):
    """The rows of the nodes, nearest to the source first, ties resolved."""

    def key(v):
        x, y = nodes[v]
        return round(dist(nodes[v], source) / 1e-6), y, abs(x), x

    return sorted(range(len(nodes)), key=key)


def relative_neighbors(source, nodes):
    """The rows of all relative neighbours of a source, nearest first."""
    order = in_order(source, nodes)
    found = []
    for place, v in enumerate(order):
        earlier = order[:place]
        if all(dist(nodes[u], nodes[v]) >= dist(nodes[v], source) for u in earlier):
            found.append(v)
    return found


def closest(neighbors, source, nodes, veins, tie):
    """The neighbour where a strand begins: of those as near as the nearest, of the oldest vein.

    ``veins`` holds the source that made each node; the seed (-1) and the first vein are one.
    """
    least = min(dist(nodes[v], source) for v in neighbors)
    tied = [v for v in neighbors if dist(nodes[v], source) <= least + tie]
    return min(tied, key=lambda v: (max(veins[v], 0), nodes[v][1], abs(nodes[v][0])))
