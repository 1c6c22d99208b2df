"""Veins on a disc of static sources: the task that other programs are timed on, too.

A disc of radius R, one seed node at its lowest point, sources at least 8 apart,
kill distance 2, influence radius 30, segment length 1. A second run in the same
process is timed (CPU seconds), so that loading compiled kernels is not counted.
"""

import json
import random
import sys
import time

import numpy as np

from vasc.models import MODELS
from vasc.simulation import simulate
from vasc.streams import Streams

CASES = ((250, 110.0, 1), (1000, 220.0, 2), (4000, 440.0, 3))
SPACING = 8.0


def places(n_sources, radius, seed):
    """Random places in the disc, each at least ``SPACING`` from those before."""
    rng = random.Random(seed)
    found, cells = [], {}
    while len(found) < n_sources:
        x, y = rng.uniform(-radius, radius), rng.uniform(-radius, radius)
        column, row = int(x // SPACING), int(y // SPACING)
        near = [
            place
            for i in (-1, 0, 1)
            for j in (-1, 0, 1)
            for place in cells.get((column + i, row + j), ())
        ]
        is_free = all((x - a) ** 2 + (y - b) ** 2 >= SPACING**2 for a, b in near)
        if x * x + y * y <= radius * radius and is_free:
            cells.setdefault((column, row), []).append((x, y))
            found.append((x, y))
    return found


def config(kind, points, radius):
    """The config of one case; the disc stands on the origin."""
    angles = np.linspace(0.0, 2.0 * np.pi, 721)[:-1]
    ring = radius * 1.001 * np.stack([np.sin(angles), 1.0 - np.cos(angles)], axis=1)
    perception = {"open": "nearest", "closed": "relative"}[kind]
    return MODELS[kind].model_validate(
        {
            "kind": kind,
            "domain": {
                "points": [tuple(p) for p in ring.tolist()],
                "length": 2.0 * radius,
                "attachment": "lowest",
            },
            "placement": {"kind": "given", "points": [(x, y + radius) for x, y in points]},
            "arrival": {"kill_distance": 2.0},
            "perception": {"kind": perception, "influence_radius": 30.0},
        }
    )


def measure(kind, n_sources, radius, seed):
    """Run a case twice; numbers of the second run."""
    parameters = config(kind, places(n_sources, radius, seed), radius)
    for _ in range(2):
        model = parameters.model()
        started = time.process_time()
        *_, last = simulate(model, Streams(1))
        seconds = time.process_time() - started
    positions = last.rows("nodes", "position")
    network = last.network
    return {
        "kind": kind,
        "sources": n_sources,
        "sources_left": len(last.live),
        "steps": last.step,
        "nodes": network.n_nodes,
        "duplicates": network.n_nodes - len(np.unique(positions, axis=0)),
        "cycles": network.n_segments - network.n_nodes + 1,
        "cpu_seconds": round(seconds, 3),
    }


def main():
    """Print a row a case; with --json as JSON."""
    rows = [measure(kind, *case) for case in CASES for kind in ("open", "closed")]
    if "--json" in sys.argv:
        print(json.dumps(rows, indent=2))
        return
    print("  ".join(f"{key:>12}" for key in rows[0]))
    for row in rows:
        print("  ".join(f"{value!s:>12}" for value in row.values()))


if __name__ == "__main__":
    main()
