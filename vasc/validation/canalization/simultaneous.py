"""Experiment 4: canals of many sources at once, beside two trees of geometry.

Hypothesis H3: the pattern that the canals of many sources make is that of open venation by
space colonization (Runions 2008, section 4.2). The minimum spanning tree of the same
points is what least length would make.
"""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

import numpy as np

from vasc import kernels
from vasc.arrays import Floats, Ids, Points
from vasc.domain import Tissue
from vasc.models.open import OpenVenation
from vasc.models.transport import FacilitatedDiffusion
from vasc.simulation import simulate
from vasc.streams import Streams
from vasc.validation.canalization.geometric import spanning_tree
from vasc.validation.canalization.leaves import LENGTH, SHAPE, leaf
from vasc.validation.canalization.settled import settle

N_SOURCES = 30
"""Sources of a leaf."""
GAIN = 1e6
"""Feedback gain A, and saturation, counted in what all sources make together: a wall is
saturated by no less, so that the more it carries the better it carries."""
SPACING = 3.0
"""Sources are not nearer to each other or to the base, in D."""
KILL_DISTANCE = 1.0
"""Of the space colonization, in D."""
COARSE = 1.0
"""Tolerance of a step: only where canals run is asked for."""
NEAR = 1.5
"""Two patterns are at one place if they are not farther apart, in D."""
SAMPLING = 0.25
"""Distance of the points at which patterns are compared, in D."""


class Pattern(NamedTuple):
    """Straight pieces between points, and which points are the sources and the base."""

    points: Points
    """Shape (n, 2)."""
    pieces: Ids
    """Shape (m, 2)."""
    sources: Ids
    """The point at, or nearest to, each source."""
    base: int
    """The point at the base."""


def canalized(tissue: Tissue, sources: Ids, base: int) -> tuple[Pattern, dict[str, Any]]:
    """Let the canals of all sources form at once; the pattern is that of their trunks.

    Returns
    -------
    tuple of Pattern and dict
        With how many canals have ``formed``, and the ``cycles`` of activated walls.
    """
    transport = FacilitatedDiffusion(gain=GAIN / len(sources) ** 2, saturation=GAIN)
    settled = settle(tissue, transport, [np.array([base], np.int32)], sources, tolerance=COARSE)
    pieces = {
        (min(a, b), max(a, b))
        for strand in settled.strands
        for a, b in zip(strand.path[:-1].tolist(), strand.path[1:].tolist(), strict=True)
    }
    active = settled.fields.carriers.max(axis=1) >= transport.activation(tissue)
    facts = {
        "formed": sum(strand.is_formed for strand in settled.strands),
        "cycles": count_cycles(tissue.walls[active]),
        "trunk_cycles": count_cycles(np.array(sorted(pieces), dtype=np.int32)),
    }
    return Pattern(tissue.positions, np.array(sorted(pieces), np.int32), sources, base), facts


def colonized(tissue: Tissue, sources: Ids, base: int) -> Pattern:
    """Grow open venation in the outline of a leaf, from the base to the same sources."""
    from scipy.spatial import cKDTree

    x, y = (tissue.positions[base] / LENGTH).tolist()
    venation = OpenVenation.model_validate(
        {
            "domain": {"shape": SHAPE, "length": LENGTH, "seeds": [(x, y)]},
            "placement": {"kind": "given", "points": tissue.positions[sources].tolist()},
            "arrival": {"kill_distance": KILL_DISTANCE},
        }
    )
    *_, last = simulate(venation.model(), Streams(1, venation.stream_names))
    network = last.network
    # the last piece, from the vein that has reached a source to it, is not longer than D
    near = cKDTree(network.positions).query(tissue.positions[sources])[1]
    n_nodes = network.n_nodes
    ends = np.arange(n_nodes, n_nodes + len(sources))
    points = np.concatenate([network.positions, tissue.positions[sources]])
    pieces = np.concatenate([network.segments, np.stack([near, ends], axis=1)])
    return Pattern(points, pieces.astype(np.int32), ends.astype(np.int32), 0)


def spanned(tissue: Tissue, sources: Ids, base: int) -> Pattern:
    """Give the minimum spanning tree of sources and base."""
    points = tissue.positions[np.concatenate([[base], sources])]
    edges, _ = spanning_tree(points)
    return Pattern(points, edges, np.arange(1, len(points), dtype=np.int32), 0)


def total_length(pattern: Pattern) -> float:
    """Give the length of all pieces of a pattern."""
    return float(_lengths(pattern).sum())


def directness(pattern: Pattern) -> float:
    """Give the length of the way from a source to the base over the straight line, on average."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    # a sparse matrix drops pieces without length
    lengths = np.maximum(_lengths(pattern), 1e-12)
    n = len(pattern.points)
    graph = coo_array((lengths, (pattern.pieces[:, 0], pattern.pieces[:, 1])), shape=(n, n))
    ways = dijkstra(graph, directed=False, indices=pattern.base)[pattern.sources]
    apart = pattern.points[pattern.sources] - pattern.points[pattern.base]
    return float(np.mean(ways / np.sqrt((apart**2).sum(axis=1))))


def overlap(one: Pattern, other: Pattern) -> float:
    """Give how much of two patterns is at one place: the harmonic mean of both shares, F1."""
    from scipy.spatial import cKDTree

    points = [sampled(pattern) for pattern in (one, other)]
    shares = [float((cKDTree(b).query(a)[0] <= NEAR).mean()) for a, b in (points, reversed(points))]
    return 2.0 * shares[0] * shares[1] / max(sum(shares), 1e-300)


def sampled(pattern: Pattern) -> Points:
    """Give points along all pieces of a pattern, evenly by length."""
    ends = pattern.points[pattern.pieces]
    counts = np.maximum(1, np.round(_lengths(pattern) / SAMPLING).astype(int))
    pieces = np.repeat(np.arange(len(counts)), counts)
    first = np.repeat(np.cumsum(counts) - counts, counts)
    along = ((np.arange(len(pieces)) - first + 0.5) / counts[pieces])[:, None]
    return np.asarray((1.0 - along) * ends[pieces, 0] + along * ends[pieces, 1])


def count_cycles(edges: Ids) -> int:
    """Count the independent cycles of the graph that edges make."""
    names, numbers = np.unique(edges, return_inverse=True)
    labels = kernels.components.component_labels(numbers.reshape(edges.shape), len(names))
    return len(edges) - len(names) + int(labels.max(initial=-1)) + 1


def draw_sources(tissue: Tissue, base: int, seed: int) -> Ids:
    """Draw cells of sources, none near to another or to the base."""
    generator = Streams(seed, ("sources",))["sources"]
    kept = [base]
    for cell in generator.permutation(tissue.n_cells).tolist():
        apart = tissue.positions[kept] - tissue.positions[cell]
        if (apart**2).sum(axis=1).min() >= SPACING**2:
            kept.append(cell)
        if len(kept) == N_SOURCES + 1:
            break
    return np.array(kept[1:], dtype=np.int32)


def simultaneous(
    seeds: Iterable[int], progress: Callable[[str], None] = lambda name: None
) -> list[dict[str, Any]]:
    """Give a row for each kind of pattern, over many sets of sources in one leaf.

    The null is the overlap of space colonization with the canals of other sources.
    """
    seeds = list(seeds)
    tissue, base = leaf(seeds[0])
    sets: dict[str, list[Pattern]] = {
        "canalization": [],
        "space colonization": [],
        "minimum spanning tree": [],
    }
    facts = []
    for seed in seeds:
        progress(f"canals of {N_SOURCES} sources at once, set {seed}")
        sources = draw_sources(tissue, base, seed)
        canals, fact = canalized(tissue, sources, base)
        facts.append(fact)
        made = (canals, colonized(tissue, sources, base), spanned(tissue, sources, base))
        for patterns, pattern in zip(sets.values(), made, strict=True):
            patterns.append(pattern)
    rows = []
    for name, patterns in sets.items():
        of_sets = list(zip(patterns, sets["canalization"], strict=True))
        same = [overlap(a, b) for a, b in of_sets]
        null = [overlap(a, of_sets[k - 1][1]) for k, (a, _) in enumerate(of_sets)]
        row: dict[str, Any] = {"pattern": name, "n": len(seeds), "seeds": [seeds[0], seeds[-1]]}
        row |= {"cells": tissue.n_cells} | _spread("length", [total_length(p) for p in patterns])
        row |= _spread("directness", [directness(p) for p in patterns])
        row |= _spread("overlap", same) | _spread("overlap_null", null)
        if name == "canalization":
            row |= {key: [fact[key] for fact in facts] for key in facts[0]}
        rows.append(row)
    return rows


def _spread(name: str, values: list[float]) -> dict[str, float]:
    """Give mean and standard deviation."""
    deviation = float(np.std(values, ddof=1)) if len(values) > 1 else 0.0
    return {f"{name}_mean": float(np.mean(values)), f"{name}_sd": deviation}


def _lengths(pattern: Pattern) -> Floats:
    """Give the length of each piece."""
    ends = pattern.points[pattern.pieces]
    return np.asarray(np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1)))
