"""Relative neighbours by definition: every node against every other.

V(s) holds every node v for which no other node u is at once nearer to s than v,
of equals the older (the order of (|u - s|, id of u)), and nearer to v than s is
(Runions 2008, equation 4.1); of nodes at one place only the oldest counts. The
comparison is of squared distances, all by one expression, so that ties agree.
"""


def square(a, b):
    """Squared distance, by the one expression that makes ties agree."""
    dx, dy = a[0] - b[0], a[1] - b[1]
    return dx * dx + dy * dy


def excludes(u, v, s, nodes):
    """Whether node u keeps node v out of the neighbourhood of s."""
    to_u, to_v = square(nodes[u], s), square(nodes[v], s)
    between = square(nodes[u], nodes[v])
    return (to_u, u) < (to_v, v) and (between < to_v or between == 0.0)


def relative_neighbors(s, nodes):
    """All relative neighbours of s, nearest first."""
    order = sorted(range(len(nodes)), key=lambda v: (square(nodes[v], s), v))
    return [
        v
        for place, v in enumerate(order)
        if not any(excludes(u, v, s, nodes) for u in order[:place])
    ]
