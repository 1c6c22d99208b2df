"""A plain loop over the kernels of a stem: primordia at their times, growth until all is still."""

import math

import numpy as np

from vasc.kernels import cylinder
from vasc.kernels import stem as steps

FIRST_TIME = 5


def base(radius, length, period=0.0):
    """Places of the ring; with a period, arc, 0 and height on the surface laid flat."""
    places = cylinder.ring(radius, length)
    if period > 0.0:
        arcs = np.arange(len(places)) * (period / len(places))
        return np.stack((arcs, 0.0 * arcs, 0.0 * arcs), axis=1)
    return places


def spiral(first, last, radius, rise, angle, period=0.0):
    """Places of the primordia from one number up to another, on a spiral or laid flat."""
    numbers = np.arange(first, last)
    angles, heights = numbers * angle, (numbers + 1) * rise
    if period > 0.0:
        turns = angles / (2.0 * np.pi)
        arcs = (turns - np.floor(turns)) * period
        # a turn just below a whole one may round up to it
        arcs[arcs >= period] = 0.0
        return np.stack((arcs, np.zeros(len(numbers)), heights), axis=1)
    return np.stack((radius * np.cos(angles), radius * np.sin(angles), heights), axis=1)


def grow(
    radius,
    rise,
    degrees,
    n_primordia,
    plastochron,
    *,
    length=1.0,
    is_unrolled=False,
    insert=steps.insert,
    watch=None,
    most=10**9,
):
    """Grow a stem to its end; gives it and the number of iterations."""
    period = cylinder.circumference(radius) if is_unrolled else 0.0
    stem = steps.place(steps.stem(length, period), base(radius, length, period))
    stem = insert(stem, 0, length)
    if watch is not None:
        watch(stem, 0)
    time, n_placed = FIRST_TIME, 0
    n_iterations = 0
    while n_iterations < most:
        n_iterations += 1
        if len(stem.pairs) == 0 and n_placed < n_primordia:
            time = max(time, FIRST_TIME + n_placed * plastochron)
        while n_placed < n_primordia and time >= FIRST_TIME + n_placed * plastochron:
            angle = math.radians(degrees)
            where = spiral(n_placed, n_placed + 1, radius, rise, angle, period)
            stem = insert(steps.place(stem, where), stem.n_nodes, length)
            n_placed += 1
            if watch is not None:
                watch(stem, stem.n_nodes - 1)
        start, n_edges = stem.n_nodes, stem.n_edges
        tips, sums = steps.directions(stem)
        stem = insert(steps.extend(stem, tips, sums, length), start, length)
        if watch is not None:
            watch(stem, start)
        time += 1
        is_still = stem.n_nodes == start and stem.n_edges == n_edges
        if n_placed == n_primordia and (len(stem.pairs) == 0 or is_still):
            break
    return stem, n_iterations
