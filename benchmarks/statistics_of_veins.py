"""Statistics of networks of growing size: CPU seconds, and microseconds a node.

The networks are the borders of regions around even random points, where three veins
meet at each junction as in a leaf, with random widths. The ratio is the cost a node over that
of the network with about 10,000 nodes, of the same run of this program: 1 throughout would be
flat. Every size is measured several times in turn, and the least time counts.
"""

import argparse
import json
import os
import time

import numpy as np
from scipy.spatial import Voronoi

from vasc.analysis import network_statistics
from vasc.real_network import RealNetwork

SIZES = (1_000, 5_000, 10_000, 50_000, 100_000)
AGAINST = 10_000
REPEATS = 3


def borders(n_nodes, rng):
    """A network with about so many nodes: two for each region."""
    across = int(np.sqrt(n_nodes / 2.0))
    grid = np.stack(np.meshgrid(np.arange(across), np.arange(across)), axis=2).reshape(-1, 2)
    found = Voronoi(grid + rng.uniform(-0.4, 0.4, grid.shape))
    pairs = np.array(found.ridge_vertices)
    pairs = pairs[(pairs >= 0).all(axis=1)]
    is_near = (np.abs(found.vertices[pairs] - across / 2.0) < across).all(axis=(1, 2))
    used, rows = np.unique(pairs[is_near], return_inverse=True)
    segments = rows.reshape(-1, 2)
    widths = rng.lognormal(0.0, 0.6, len(segments))
    return RealNetwork.from_edges(found.vertices[used], segments, widths=widths)


def seconds(real):
    """CPU seconds of all statistics of a network."""
    started = time.process_time()
    network_statistics(real)
    return time.process_time() - started


def measure(sizes, repeats):
    """The rows of the table."""
    networks = [borders(size, np.random.default_rng(size)) for size in sizes]
    # in turn, so that what else the machine does falls on all alike
    turns = [[seconds(real) for real in networks] for _ in range(repeats)]
    least = np.min(turns, axis=0)
    n_nodes = np.array([real.network.n_nodes for real in networks])
    costs = 1e6 * least / n_nodes
    return [
        {
            "nodes": int(n),
            "cpu_seconds": round(float(took), 2),
            "us_a_node": round(float(cost), 1),
            "ratio": round(float(cost / costs[sizes.index(AGAINST)]), 2),
            "load": os.getloadavg()[0],
        }
        for n, took, cost in zip(n_nodes, least, costs, strict=True)
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--repeats", type=int, default=REPEATS, help="of every size")
    arguments = parser.parse_args()
    seconds(borders(200, np.random.default_rng(0)))
    rows = measure(SIZES, arguments.repeats)
    if arguments.json:
        print(json.dumps(rows, indent=2))
        return
    print(f"{'nodes':>8} {'CPU s':>8} {'us a node':>10} {'ratio':>6}")
    for row in rows:
        print(
            f"{row['nodes']:8,} {row['cpu_seconds']:8.2f} {row['us_a_node']:10.1f}"
            f" {row['ratio']:6.2f}"
        )


if __name__ == "__main__":
    main()
