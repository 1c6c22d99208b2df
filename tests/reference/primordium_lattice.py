"""Relative neighbours of a lattice of primordia by definition: every rival in turn."""

import math

TIE = 1e-9


def length(levels, members, divergence, ratio, per_level, metric):
    """Length of a separation in rises."""
    turn = levels * divergence + 2 * math.pi * members / per_level
    across = 2 * math.sin(turn / 2) if metric == "chord" else math.remainder(turn, 2 * math.pi)
    return math.hypot(ratio * across, levels)


def edges(divergence, ratio, per_level=1, metric="chord", slack=1 - TIE):
    """Give the separations (levels, members) upward that no third primordium excludes."""
    half_turn = ratio * (2 if metric == "chord" else math.pi)
    # from here on the primordium below and the first one are both nearer
    top = math.ceil(half_turn**2 / 2 + 1) + 1
    upward = [(m, i) for m in range(top) for i in range(per_level) if (m, i) != (0, 0)]

    def of(m, i):
        return length(m, i, divergence, ratio, per_level, metric)

    # what is long is excluded by what is short: rivals from the shortest on
    rivals = [(s * m, s * i % per_level) for m, i in upward for s in (1, -1)]
    rivals = sorted((of(*one), one) for one in set(rivals))
    found = []
    for m, i in upward:
        limit = slack * of(m, i)
        for short, (k, j) in rivals:
            if short >= limit:
                found.append((m, i))
                break
            is_itself = k == m and (i - j) % per_level == 0
            if not is_itself and of(m - k, i - j) < limit:
                break
        else:
            found.append((m, i))
    return found


def step(levels, members, per_level):
    """Give the step in the order of birth; within a level the short way round."""
    if levels == 0:
        return min(members, per_level - members)
    return levels * per_level + members


def steps(divergence, ratio, per_level=1, metric="chord", slack=1 - TIE):
    """Give the steps of all edges, ascending."""
    found = edges(divergence, ratio, per_level, metric, slack)
    return tuple(sorted({step(m, i, per_level) for m, i in found}))
