"""Corner cutting in plain Python (Runions 2008, section 5.2.6), one node after the other.

A node P2 with just two segments, to P1 and P3, is replaced by (1 - a) P1 + a P2 and
(1 - a) P3 + a P2 where |P1 P2| + |P2 P3| exceeds a threshold; not so where it is held.
Nodes that were too long before the step are looked at in ascending order, each as the
cuts before it have left it. A segment too long between two nodes that are never cut, as
they were before the step, gets a node in its middle.
"""

from math import dist


class Corners:
    """A graph that is cut: ``places`` by node, ``around``: the neighbours of each node."""

    def __init__(self, places, segments):
        self.places = {node: tuple(place) for node, place in enumerate(places)}
        self.around = {node: [] for node in self.places}
        for a, b in segments:
            self.around[a].append(b)
            self.around[b].append(a)
        self.n_nodes = len(self.places)
        self.cut_nodes = {}

    def add(self, place):
        """A new node without segments."""
        self.places[self.n_nodes] = place
        self.around[self.n_nodes] = []
        self.n_nodes += 1
        return self.n_nodes - 1

    def length(self, a, b):
        return dist(self.places[a], self.places[b])

    def is_long(self, node, threshold):
        """Whether a node has two segments that are too long together."""
        ends = self.around[node]
        return len(ends) == 2 and sum(self.length(node, end) for end in ends) > threshold

    def between(self, a, b, weight):
        """The place (1 - weight) a + weight b."""
        pairs = zip(self.places[a], self.places[b], strict=True)
        return tuple((1.0 - weight) * p + weight * q for p, q in pairs)

    def replace(self, neighbor, old, new):
        """Let a neighbour of the old node be one of the new node."""
        ends = self.around[neighbor]
        ends[ends.index(old)] = new
        self.around[new].append(neighbor)

    def cut(self, node, alpha):
        """Replace a node by two."""
        first_end, second_end = self.around.pop(node)
        first = self.add(self.between(first_end, node, alpha))
        second = self.add(self.between(second_end, node, alpha))
        self.replace(first_end, node, first)
        self.around[first].append(second)
        self.around[second].append(first)
        self.replace(second_end, node, second)
        self.cut_nodes[node] = (first, second)

    def edges(self):
        """All segments, as pairs of places."""
        return {
            frozenset((self.places[a], self.places[b]))
            for a, ends in self.around.items()
            for b in ends
        }


def cut_corners(places, segments, held, threshold, alpha):
    """The graph after one step of refinement."""
    graph = Corners(places, segments)
    never = {n for n, ends in graph.around.items() if len(ends) != 2} | set(held)
    halved = [
        (a, b) for a, b in segments if a in never and b in never and graph.length(a, b) > threshold
    ]
    long = [n for n in graph.around if n not in held and graph.is_long(n, threshold)]
    for node in long:
        if graph.is_long(node, threshold):
            graph.cut(node, alpha)
    for a, b in halved:
        middle = graph.add(graph.between(a, b, 0.5))
        graph.replace(a, b, middle)
        graph.replace(b, a, middle)
    return graph
