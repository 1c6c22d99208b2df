"""Urquhart neighbours: relative neighbours tested among Delaunay neighbours (section 4.4.2)."""

from math import inf

from reference.relative_neighbors import excludes, square
from scipy.spatial import Delaunay


def delaunay_neighbors(s, nodes):
    """The nodes that share an edge with s in scipy's triangulation of nodes and s.

    The nodes must be distinct and not all on one line with s.
    """
    pointers, neighbors = Delaunay([*nodes, s]).vertex_neighbor_vertices
    return neighbors[pointers[len(nodes)] : pointers[len(nodes) + 1]].tolist()


def voronoi_neighbors(s, nodes):
    """The nodes v with a place as near to v as to s and nearer to no other node.

    Such places lie on the bisector of s and v: every other node leaves a half of it.
    Needs neither distinct nodes nor any that are not on one line; of nodes at one
    place the oldest counts.
    """
    found = []
    for v, (vx, vy) in enumerate(nodes):
        dx, dy = vx - s[0], vy - s[1]
        low, high = -inf, inf
        for u, (ux, uy) in enumerate(nodes):
            if (ux, uy) == (vx, vy):
                high = -inf if u < v else high
                continue
            ax, ay = ux - s[0], uy - s[1]
            # the place s + (d/2 + t * d turned left) is no nearer to u than to s
            slope = ay * dx - ax * dy
            room = 0.5 * (ax * ax + ay * ay - ax * dx - ay * dy)
            if slope > 0.0:
                high = min(high, room / slope)
            elif slope < 0.0:
                low = max(low, room / slope)
            elif room < 0.0:
                high = -inf
        # where four points lie on a circle the edge is a point: no neighbour
        if high - low > 1e-9:
            found.append(v)
    return found


def urquhart(s, nodes, neighbors=voronoi_neighbors):
    """Delaunay neighbours of s that no other of them excludes, nearest first."""
    around = neighbors(s, nodes)
    kept = [v for v in around if not any(excludes(u, v, s, nodes) for u in around if u != v)]
    return sorted(kept, key=lambda v: (square(nodes[v], s), v))
