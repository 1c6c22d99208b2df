"""Urquhart neighbours by a triangulation from nothing (Runions 2008, section 4.4.2)."""

from reference.relative_neighbors import excludes, square
from scipy.spatial import Delaunay


def delaunay_neighbors(s, nodes):
    """The nodes that share an edge with s in the triangulation of nodes and s."""
    pointers, neighbors = Delaunay([*nodes, s]).vertex_neighbor_vertices
    return neighbors[pointers[len(nodes)] : pointers[len(nodes) + 1]].tolist()


def urquhart(s, nodes):
    """Delaunay neighbours of s that no other of them excludes, nearest first.

    The nodes must be distinct and not all on one line.
    """
    around = delaunay_neighbors(s, nodes)
    kept = [v for v in around if not any(excludes(u, v, s, nodes) for u in around if u != v)]
    return sorted(kept, key=lambda v: (square(nodes[v], s), v))
