"""Slow twins of tissues: sides compared one with another."""

import itertools

import numpy as np

from vasc.domain.rings import signed_area


def walls(tissue):
    """Give the walls of a tissue, from a pair of cells to the length, side by side."""
    found = {}
    polygons = tissue.polygons
    for a, one in enumerate(polygons):
        for b in range(a + 1, len(polygons)):
            other = polygons[b]
            for start, end in zip(one, np.roll(one, -1, axis=0), strict=True):
                for first, second in zip(other, np.roll(other, -1, axis=0), strict=True):
                    if (start == second).all() and (end == first).all():
                        found[a, b] = found.get((a, b), 0.0) + float(np.hypot(*(end - start)))
    return found


def centroid(polygon):
    """Give the centroid of a polygon from a fan of triangles with signed areas."""
    corners = list(polygon)
    total, moment = 0.0, np.zeros(2)
    for second, third in itertools.pairwise(corners):
        area = signed_area(np.array([corners[0], second, third]))
        total += area
        moment += area * (corners[0] + second + third) / 3.0
    return moment / total
