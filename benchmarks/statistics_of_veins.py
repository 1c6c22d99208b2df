"""Statistics of networks of growing size: CPU seconds, and microseconds a node.

The networks are the borders of regions around even random points, where three veins
meet at each junction as in a leaf, with random widths.
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


def measure(n_nodes):
    """A row of the table."""
    real = borders(n_nodes, np.random.default_rng(n_nodes))
    started = time.process_time()
    network_statistics(real)
    seconds = time.process_time() - started
    n_found = real.network.n_nodes
    return {
        "nodes": n_found,
        "cpu_seconds": round(seconds, 2),
        "us_a_node": round(1e6 * seconds / n_found, 1),
        "load": os.getloadavg()[0],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    as_json = parser.parse_args().json
    measure(200)
    rows = [measure(size) for size in SIZES]
    if as_json:
        print(json.dumps(rows, indent=2))
        return
    print(f"{'nodes':>8} {'CPU s':>8} {'us a node':>10}")
    for row in rows:
        print(f"{row['nodes']:8,} {row['cpu_seconds']:8.2f} {row['us_a_node']:10.1f}")


if __name__ == "__main__":
    main()
