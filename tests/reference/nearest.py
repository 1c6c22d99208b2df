"""The nearest node by definition: the least of all."""

from reference.relative_neighbors import square


def nearest(s, nodes):
    """The nearest node of s as a list, of equals the oldest; empty if there is none."""
    order = sorted(range(len(nodes)), key=lambda v: (square(nodes[v], s), v))
    return order[:1]
