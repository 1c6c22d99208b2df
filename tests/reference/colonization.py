"""Space colonization in plain Python: every distance measured anew in every step.

One step, in material coordinates (lengths in D are divided by the scale of the step):
halve stretched segments; let the given sources of the step appear; ask which nodes each
source attracts; extend the nodes that are pulled; tag, join and remove. Nothing is kept
between steps but what a record holds.
"""

from dataclasses import dataclass, field
from math import sqrt

from reference.nearest import nearest
from reference.relative_neighbors import excludes, relative_neighbors, square

__all__ = ["Leaf", "Rules", "excludes", "grow", "nearest", "relative_neighbors", "square"]


@dataclass
class Rules:
    """What a run is made of; ``scale`` gives the size of a material unit at a step.

    Where a blade is deformed, places are positions: ``carry`` moves them at the
    beginning of a step, and ``embed`` tells where a new node is.
    """

    is_closed: bool
    kill: float
    length: float = 1.0
    influence: float = float("inf")
    bias: tuple = (0.0, 0.0)
    stall_rule: bool = True
    longest: float = float("inf")
    last_growth: int = 0
    scale: object = staticmethod(lambda step: 1.0)
    neighbors: object = staticmethod(relative_neighbors)
    carry: object = staticmethod(lambda leaf: None)
    embed: object = staticmethod(lambda leaf, place, parent: place)

    def perceive(self, leaf):
        """The nodes that each live source attracts."""
        rule = self.neighbors if self.is_closed else nearest
        return {s: rule(place, leaf.nodes) for s, place in sorted(leaf.sources.items())}


@dataclass
class Leaf:
    """Veins and sources of one run, in material coordinates."""

    nodes: list
    parents: list
    births: list
    causes: list
    segments: list = field(default_factory=list)
    refined: list = field(default_factory=list)
    sources: dict = field(default_factory=dict)
    tags: dict = field(default_factory=dict)
    tagged: list = field(default_factory=list)
    joins: list = field(default_factory=list)
    loops: list = field(default_factory=list)
    removed: list = field(default_factory=list)
    ended: list = field(default_factory=list)
    initiated: list = field(default_factory=list)
    n_placed: int = 0
    n_stalled: int = 0
    reason: str = ""
    step: int = 0

    def add_node(self, place, parent, cause):
        """Append a node of this step."""
        self.nodes.append(place)
        self.parents.append(parent)
        self.births.append(self.step)
        self.causes.append(cause)
        return len(self.nodes) - 1

    def has_child(self, node):
        """Whether a vein runs on from a node: one extends it, or it halves a segment."""
        halves = [middle for _, middle in self.refined]
        return node in halves or any(
            p == node for child, p in enumerate(self.parents) if child not in halves
        )

    def are_linked(self, a, b):
        """Whether one can walk from a to b along segments, by looking everywhere."""
        met, edge = {a}, [a]
        while edge:
            node = edge.pop()
            for pair in self.segments:
                if node in pair:
                    edge += [end for end in pair if end not in met]
                    met.update(pair)
        return b in met


def halve(leaf, rules, scale):
    """Put a node into the middle of every segment that is too long, until none is."""
    while True:
        replaced = {segment for segment, _ in leaf.refined}
        long = [
            segment
            for segment, (a, b) in enumerate(leaf.segments)
            if segment not in replaced
            and sqrt(square(leaf.nodes[a], leaf.nodes[b])) * scale > rules.longest
        ]
        if not long:
            return
        for segment in long:
            a, b = leaf.segments[segment]
            (ax, ay), (bx, by) = leaf.nodes[a], leaf.nodes[b]
            middle = leaf.add_node(((ax + bx) / 2, (ay + by) / 2), a, leaf.causes[b])
            leaf.refined.append((segment, middle))
        for segment, middle in leaf.refined[-len(long) :]:
            a, b = leaf.segments[segment]
            leaf.segments += [(a, middle), (middle, b)]


def is_awaited(leaf, s, v):
    """Whether v is a node that source s tagged, or has grown from one since."""
    step, tagged = leaf.tags[s]
    while leaf.births[v] >= step:
        v = leaf.parents[v]
    return v in tagged


def pullers_of_nodes(leaf, rules, attracted, scale):
    """Which sources pull each node, in ascending id."""
    pullers = {}
    for s, members in sorted(attracted.items()):
        for v in members:
            distance = sqrt(square(leaf.nodes[v], leaf.sources[s])) * scale
            if not rules.kill < distance <= rules.influence:
                continue
            if s not in leaf.tags or is_awaited(leaf, s, v):
                pullers.setdefault(v, []).append(s)
    return pullers


def direction(leaf, rules, v, pullers, closest, scale):
    """Where a node grows: a unit vector, or None where the pulls cancel."""
    x, y = leaf.nodes[v]
    total_x = total_y = 0.0
    for s in pullers:
        sx, sy = leaf.sources[s]
        distance = sqrt(square(leaf.nodes[v], (sx, sy)))
        total_x += (sx - x) / distance
        total_y += (sy - y) / distance
    norm = sqrt(total_x * total_x + total_y * total_y)
    sx, sy = leaf.sources[closest]
    least = sqrt(square((x, y), (sx, sy)))
    if rules.stall_rule and norm / len(pullers) <= rules.length / (2.0 * least * scale):
        leaf.n_stalled += 1
        return (sx - x) / least, (sy - y) / least
    if norm == 0.0:
        return None
    ux, uy = total_x / norm, total_y / norm
    if rules.bias == (0.0, 0.0):
        return ux, uy
    bx, by = ux + rules.bias[0], uy + rules.bias[1]
    norm = sqrt(bx * bx + by * by)
    return (bx / norm, by / norm) if norm > 0.0 else (ux, uy)


def extend(leaf, rules, attracted, scale):
    """One new node for every pulled node, oldest parent first; gives their number."""
    pullers = pullers_of_nodes(leaf, rules, attracted, scale)
    length = rules.length / scale
    children = []
    for v in sorted(pullers):
        closest = min(pullers[v], key=lambda s: (square(leaf.nodes[v], leaf.sources[s]), s))
        way = direction(leaf, rules, v, pullers[v], closest, scale)
        if way is not None:
            x, y = leaf.nodes[v]
            children.append(((x + length * way[0], y + length * way[1]), v, closest))
    is_branch = [leaf.has_child(v) for _, v, _ in children]
    for (place, v, closest), branches in zip(children, is_branch, strict=True):
        node = leaf.add_node(rules.embed(leaf, place, v), v, closest)
        leaf.segments.append((v, node))
        if branches:
            leaf.initiated.append((node, v))
    return len(children)


def arrive(leaf, rules, before, after, scale):
    """Tag, wait, join and remove; gives the number of sources to which that happened."""
    n_changes = 0
    for s, place in sorted(leaf.sources.items()):
        gaps = {v: sqrt(square(leaf.nodes[v], place)) * scale for v in after[s]}
        arrived = [v for v in after[s] if gaps[v] <= rules.kill]
        if s not in leaf.tags:
            if not arrived:
                continue
            if rules.is_closed:
                leaf.tags[s] = (leaf.step, before[s])
                leaf.tagged += [(leaf.step, s, v) for v in before[s]]
                n_changes += 1
        coming = [v for v in after[s] if rules.kill < gaps[v] <= rules.influence]
        if rules.is_closed and any(is_awaited(leaf, s, v) for v in coming):
            continue
        joined = [join(leaf, rules, s, arrived[0], v, scale) for v in arrived[1:]]
        if not any(joined) and not leaf.has_child(after[s][0]):
            leaf.ended.append((after[s][0], s))
        leaf.removed.append((leaf.step, s, after[s][0]))
        n_changes += 1
    for _, s, _ in leaf.removed:
        leaf.sources.pop(s, None)
    return n_changes


def join(leaf, rules, s, a, b, scale):
    """Connect two veins that met, unless they are far apart or connected already."""
    pair = (min(a, b), max(a, b))
    if leaf.parents[pair[1]] == pair[0] or pair in leaf.joins:
        return False
    if sqrt(square(leaf.nodes[a], leaf.nodes[b])) * scale > 2.0 * rules.length:
        return False
    if leaf.are_linked(a, b):
        leaf.loops.append((len(leaf.segments), s))
    leaf.joins.append(pair)
    leaf.segments.append(pair)
    return True


def reason_to_stop(leaf, rules, n_extended, n_changes, before, after):
    """Why nothing more can happen, once the blade and its sources are complete."""
    if not leaf.sources:
        return "NO_SOURCES"
    if n_changes:
        return ""
    if n_extended == 0:
        return "NOTHING_PULLED"
    # what pulls what is as it was: the same nodes would be added again
    return "LIVELOCK" if all(before[s] == after[s] for s in leaf.sources) else ""


def grow(seeds, given, rules, n_steps):
    """Run until it stops, at most ``n_steps``; ``given``: (step, place) in material units."""
    n_seeds = len(seeds)
    leaf = Leaf(list(seeds), [-1] * n_seeds, [0] * n_seeds, [-1] * n_seeds)
    last = max([rules.last_growth, *(birth for birth, _ in given)])
    while leaf.step < n_steps and not leaf.reason:
        leaf.step += 1
        scale = rules.scale(leaf.step)
        rules.carry(leaf)
        halve(leaf, rules, scale)
        for birth, place in given:
            if birth == leaf.step:
                leaf.sources[leaf.n_placed] = place
                leaf.n_placed += 1
        before = rules.perceive(leaf)
        n_extended = extend(leaf, rules, before, scale)
        after = rules.perceive(leaf)
        n_changes = arrive(leaf, rules, before, after, scale)
        if leaf.step >= last:
            leaf.reason = reason_to_stop(leaf, rules, n_extended, n_changes, before, after)
    return leaf
