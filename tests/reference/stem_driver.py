"""A plain loop over the kernels of a stem: primordia at their times, growth until all is still."""

import math

from vasc.kernels import cylinder
from vasc.kernels import stem as steps

FIRST_TIME = 5


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
    stem = steps.place(steps.stem(length, period), cylinder.ring(radius, length, period))
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
            where = cylinder.primordia(
                n_placed, n_placed + 1, radius, rise, math.radians(degrees), period
            )
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
