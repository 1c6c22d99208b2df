"""Space colonization in plain Python: every distance measured anew in every step.

Written from the rules, not from the kernels: a node v is a relative neighbour of a
source s when no other node u has (|u - s|, id of u) < (|v - s|, id of v) and is
nearer to v than s is; of nodes at one place only the first counts.
"""

from dataclasses import dataclass, field
from math import sqrt


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
    ids = range(len(nodes))
    found = [v for v in ids if not any(excludes(u, v, s, nodes) for u in ids if u != v)]
    return sorted(found, key=lambda v: (square(nodes[v], s), v))


def nearest(s, nodes):
    """The nearest node of s, of equals the oldest."""
    if not nodes:
        return []
    return [min(range(len(nodes)), key=lambda v: (square(nodes[v], s), v))]


@dataclass
class Leaf:
    """Veins and sources of one run, in material coordinates."""

    nodes: list
    parents: list
    births: list
    sources: dict = field(default_factory=dict)
    tags: dict = field(default_factory=dict)
    joins: list = field(default_factory=list)
    removed: list = field(default_factory=list)
    n_placed: int = 0
    n_stalled: int = 0


@dataclass
class Rules:
    """What a run is made of; ``scale`` gives the size of a material unit at a step."""

    is_closed: bool
    kill: float
    length: float = 1.0
    influence: float = float("inf")
    bias: tuple = (0.0, 0.0)
    stall_rule: bool = True
    scale: object = staticmethod(lambda step: 1.0)

    def perceive(self, s, nodes):
        """The nodes a source attracts."""
        return relative_neighbors(s, nodes) if self.is_closed else nearest(s, nodes)


def is_tagged(leaf, s, v):
    """Whether v is of a lineage that source s waits for."""
    step, tagged = leaf.tags[s]
    while v >= 0 and leaf.births[v] >= step:
        v = leaf.parents[v]
    return v in tagged


def pulled(leaf, rules, s, attracted, scale):
    """The nodes that a source pulls."""
    kill, influence = (rules.kill / scale) ** 2, (rules.influence / scale) ** 2
    place = leaf.sources[s]
    near = [v for v in attracted if kill <= square(leaf.nodes[v], place) <= influence]
    return [v for v in near if s not in leaf.tags or is_tagged(leaf, s, v)]


def child_of(v, pullers, leaf, rules, scale):
    """Where the child of a node goes, or None."""
    x, y = leaf.nodes[v]
    total_x = total_y = 0.0
    for s in pullers:
        sx, sy = leaf.sources[s]
        distance = sqrt(square((x, y), (sx, sy)))
        total_x += (sx - x) / distance
        total_y += (sy - y) / distance
    closest = min(pullers, key=lambda s: (square(leaf.nodes[v], leaf.sources[s]), s))
    dmin = sqrt(square(leaf.nodes[v], leaf.sources[closest]))
    length = rules.length / scale
    norm = sqrt(total_x * total_x + total_y * total_y)
    if rules.stall_rule and len(pullers) > 1 and 2.0 * dmin * norm <= length * len(pullers):
        leaf.n_stalled += 1
        dx, dy = leaf.sources[closest][0] - x, leaf.sources[closest][1] - y
        return (x + length * (dx / dmin), y + length * (dy / dmin))
    if norm == 0.0:
        return None
    nx, ny = total_x / norm, total_y / norm
    if rules.bias != (0.0, 0.0):
        bx, by = nx + rules.bias[0], ny + rules.bias[1]
        norm = sqrt(bx * bx + by * by)
        if norm > 0.0:
            nx, ny = bx / norm, by / norm
    return (x + length * nx, y + length * ny)


def extend(leaf, rules, attracted, step, scale):
    """One new node for every pulled node, oldest parent first."""
    pullers = {}
    for s in sorted(leaf.sources):
        for v in pulled(leaf, rules, s, attracted[s], scale):
            pullers.setdefault(v, []).append(s)
    children = [(v, child_of(v, pullers[v], leaf, rules, scale)) for v in sorted(pullers)]
    for v, place in children:
        if place is not None:
            leaf.nodes.append(place)
            leaf.parents.append(v)
            leaf.births.append(step)


def arrive(leaf, rules, before, step, scale):
    """Tag, wait, join and remove."""
    kill = (rules.kill / scale) ** 2
    for s in sorted(leaf.sources):
        place = leaf.sources[s]
        now = rules.perceive(place, leaf.nodes)
        near = [v for v in now if square(leaf.nodes[v], place) < kill]
        if not rules.is_closed:
            if near:
                leaf.removed.append((step, s))
                del leaf.sources[s]
            continue
        if s not in leaf.tags:
            if not near:
                continue
            leaf.tags[s] = (step, set(before[s]))
        limit = (rules.influence / scale) ** 2
        far = [v for v in now if kill <= square(leaf.nodes[v], place) <= limit]
        if any(is_tagged(leaf, s, v) for v in far):
            continue
        for other in near[1:]:
            join(leaf, rules, near[0], other, scale)
        leaf.removed.append((step, s))
        del leaf.sources[s]


def join(leaf, rules, a, b, scale):
    """Connect two veins that met, unless they are far apart or connected already."""
    pair = (min(a, b), max(a, b))
    if leaf.parents[pair[1]] == pair[0] or pair in leaf.joins:
        return
    if square(leaf.nodes[a], leaf.nodes[b]) <= (2.0 * rules.length / scale) ** 2:
        leaf.joins.append(pair)


def grow(seeds, given, rules, n_steps):
    """Run for a number of steps; ``given`` is a list of (step, place) in material units."""
    leaf = Leaf(list(seeds), [-1] * len(seeds), [0] * len(seeds))
    for step in range(1, n_steps + 1):
        scale = rules.scale(step)
        for birth, place in given:
            if birth == step:
                leaf.sources[leaf.n_placed] = place
                leaf.n_placed += 1
        attracted = {s: rules.perceive(p, leaf.nodes) for s, p in leaf.sources.items()}
        extend(leaf, rules, attracted, step, scale)
        arrive(leaf, rules, attracted, step, scale)
    return leaf
