"""Small networks for tests: by hand, at random, and grown by brute force."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from vasc.canals import NO_CANALS, CanalSet
from vasc.network import Origin, SegmentKind, VeinNetwork
from vasc.sources import SourceSet


def network(
    points,
    segments,
    *,
    kinds=None,
    origins=None,
    parents=None,
    births=None,
    retired=(),
    growths=None,
):
    """A network from points and pairs; the first pair that leads to a node names its parent."""
    points = np.asarray(points, dtype=float).reshape(-1, 2)
    segments = np.asarray(segments, dtype=np.int32).reshape(-1, 2)
    n, m = len(points), len(segments)
    if parents is None:
        parents = np.full(n, -1, dtype=np.int32)
        for first, second in segments[::-1].tolist():
            parents[second] = first
    parents = np.asarray(parents, dtype=np.int32)
    if origins is None:
        origins = np.where(parents < 0, Origin.SEED, Origin.EXTENSION)
    births = np.arange(n) if births is None else births
    births = np.asarray(births, dtype=np.int32)
    return VeinNetwork(
        positions=points,
        parents=parents,
        births=births,
        origins=np.asarray(origins, dtype=np.int8),
        causes=np.where(parents < 0, -1, np.arange(n) // 3).astype(np.int32),
        segments=segments,
        segment_ids=np.arange(m, dtype=np.int32),
        segment_births=births[segments].max(axis=1, initial=0).astype(np.int32),
        segment_kinds=np.asarray(np.zeros(m) if kinds is None else kinds, dtype=np.int8),
        retired=np.asarray(retired, dtype=np.int32),
        growths=growths,
    )


def grid(columns, rows, width=1.0, height=1.0):
    """A rectangular grid of areoles of width x height."""
    points = [
        (column * width, row * height) for row in range(rows + 1) for column in range(columns + 1)
    ]
    across = columns + 1
    level = [(k, k + 1) for k in range(len(points)) if (k + 1) % across]
    upright = [(k, k + across) for k in range(len(points) - across)]
    return network(points, level + upright)


def random_tree(rng, n_nodes):
    """A tree in which every node hangs on an older one, chosen at random."""
    parents = [int(rng.integers(0, node)) for node in range(1, n_nodes)]
    return network(rng.random((n_nodes, 2)), list(zip(parents, range(1, n_nodes), strict=True)))


def random_planar(rng, n_nodes, share):
    """Some edges of a Delaunay triangulation: planar, with loops, perhaps in pieces."""
    from scipy.spatial import Delaunay

    points = rng.random((n_nodes, 2))
    corners = Delaunay(points).simplices
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [0, 2]]]))
    edges = np.unique(edges, axis=0)
    return network(points, edges[rng.random(len(edges)) < share])


@dataclass(frozen=True)
class PlainBlade:
    """What pictures and statistics ask of a blade."""

    rings: tuple
    length: float

    @cached_property
    def polygon(self):
        polygon = shapely.Polygon(self.rings[0])
        for ring in self.rings[1:]:
            polygon = polygon.symmetric_difference(shapely.Polygon(ring))
        return polygon

    @property
    def area(self):
        return self.polygon.area

    @property
    def bounds(self):
        return self.polygon.bounds


@dataclass(frozen=True)
class PlainMoment:
    """What pictures and statistics ask of a frame."""

    network: VeinNetwork
    blade: PlainBlade
    sources: SourceSet
    step: int = 7
    time: float = 7.0
    canals: CanalSet = NO_CANALS


def sources(points=(), states=()):
    points = np.asarray(points, dtype=float).reshape(-1, 2)
    return SourceSet(
        ids=np.arange(len(points), dtype=np.int32),
        positions=points,
        births=np.zeros(len(points), dtype=np.int32),
        states=np.asarray(states if len(states) else np.zeros(len(points)), dtype=np.int8),
    )


def square_blade(side=10.0):
    ring = np.array([[-0.5, 0.0], [0.5, 0.0], [0.5, 1.0], [-0.5, 1.0]]) * side
    return PlainBlade((ring,), side)


def ovate_blade(length):
    angles = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    x = 0.34 * length * np.sin(angles) * (1.0 + 0.35 * np.cos(angles))
    y = 0.5 * length * (1.0 - np.cos(angles))
    return PlainBlade((np.stack([x, y], axis=1),), length)


def grown_leaf(length, n_sources, rng, *, kill=1.5, spacing=6.0):
    """Open venation toward sources that are all there at first, by brute force; then joins."""
    blade = ovate_blade(length)
    left, bottom, right, top = blade.bounds
    darts = rng.random((n_sources * 20, 2)) * [right - left, top - bottom] + [left, bottom]
    darts = darts[shapely.contains_xy(blade.polygon, darts)]
    live: list = []
    for dart in darts:
        if len(live) == n_sources:
            break
        if not live or (np.hypot(*(np.array(live) - dart).T) > spacing).all():
            live.append(dart)
    live = np.array(live)
    nodes, parents, births = np.zeros((1, 2)), [-1], [0]
    for step in range(1, 10_000):
        if not len(live):
            break
        offsets = live[:, None] - nodes[None]
        distances = np.sqrt((offsets**2).sum(axis=2))
        nearest = distances.argmin(axis=1)
        new = []
        for node in np.unique(nearest):
            mine = np.flatnonzero(nearest == node)
            pull = (offsets[mine, node] / distances[mine, node, None]).sum(axis=0)
            size = np.hypot(*pull)
            closest = mine[distances[mine, node].argmin()]
            if size / len(mine) <= 0.5 / distances[closest, node]:
                pull, size = offsets[closest, node], distances[closest, node]
            new.append(nodes[node] + pull / size)
            parents.append(int(node))
            births.append(step)
        nodes = np.vstack([nodes, new])
        live = live[(np.hypot(*(live[:, None] - nodes[None]).T) >= kill).all(axis=0)]
    segments = list(zip(parents[1:], range(1, len(nodes)), strict=True))
    return blade, _with_joins(nodes, segments, parents, births)


def _with_joins(nodes, segments, parents, births):
    """Join tips to the nearest node of another branch within 3 segments."""
    has_child = np.isin(np.arange(len(nodes)), parents)
    kinds = [SegmentKind.EXTENSION] * len(segments)
    for tip in np.flatnonzero(~has_child).tolist():
        distances = np.hypot(*(nodes - nodes[tip]).T)
        own = {tip}
        node = tip
        for _ in range(8):
            node = parents[node]
            own.add(node)
        distances[sorted(own)] = np.inf
        other = int(distances.argmin())
        if distances[other] < 3.0:
            segments.append((min(other, tip), max(other, tip)))
            kinds.append(SegmentKind.JOIN)
    return network(nodes, segments, kinds=kinds, parents=parents, births=births)
