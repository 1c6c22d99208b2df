"""Veins of a stem: what a node costs as the stem gets higher, and the ratio to triangulations.

Golden angle, H = 10, a plastochron of 5 iterations, segments of length 1. A second
run in the same process is timed (CPU seconds), so that loading compiled kernels is
not counted. The baseline triangulates all nodes anew in every iteration, as a search
among Delaunay neighbours has to; it is timed on ``N_STATES`` states of the same run,
spread evenly over its iterations, against the whole of vasc's run.
"""

import json
import os
import sys
import time
from collections import deque

import numpy as np

from vasc.kernels import cylinder, urquhart_3d
from vasc.kernels import stem as steps
from vasc.placement.primordia import on_stem

ANGLE = 137.5
RISE = 10.0
PLASTOCHRON = 5
HEIGHTS = (20, 40, 80, 160, 320, 640)
RADIUS = 115.0
SMALL = ((16.0, 30), (50.0, 30), (115.0, 14))
N_STATES = 16


def primordia(numbers, radius):
    """Places of the primordia of some numbers."""
    heights = (numbers + 1.0) * RISE
    return on_stem(numbers * ANGLE, heights, np.full(len(numbers), radius))


def states(radius, n_primordia):
    """Yield the stem after every iteration."""
    stem = steps.insert(steps.place(steps.stem(1.0), cylinder.ring(radius, 1.0)), 0, 1.0)
    n_placed, iteration = 0, 0
    while n_placed < n_primordia or len(stem.pairs) > 0:
        if n_placed < n_primordia and iteration >= n_placed * PLASTOCHRON:
            where = primordia(np.array([n_placed]), radius)
            stem = steps.insert(steps.place(stem, where), stem.n_nodes, 1.0)
            n_placed += 1
        start, n_edges = stem.n_nodes, stem.n_edges
        stem = steps.insert(steps.extend(stem, *steps.directions(stem), 1.0), start, 1.0)
        iteration += 1
        yield stem
        if n_placed == n_primordia and (stem.n_nodes, stem.n_edges) == (start, n_edges):
            return


def run(radius, n_primordia):
    """Grow a stem; gives the last one, the number of iterations and CPU seconds."""
    started = time.process_time()
    ((n_iterations, stem),) = deque(enumerate(states(radius, n_primordia), 1), maxlen=1)
    return stem, n_iterations, time.process_time() - started


def measure(radius, n_primordia):
    """Numbers of one run, the quickest of three."""
    stem, n_iterations, seconds = min(
        (run(radius, n_primordia) for _ in range(3)), key=lambda result: result[2]
    )
    return {
        "radius": radius,
        "primordia": n_primordia,
        "iterations": n_iterations,
        "nodes": stem.n_nodes,
        "edges": stem.n_edges,
        "cpu_seconds": round(seconds, 4),
        "us_a_node": round(1e6 * seconds / stem.n_nodes, 2),
    }


def baseline_seconds(radius, n_primordia, n_iterations):
    """CPU seconds of triangulating in every iteration, from some of them."""
    chosen = {round((k + 0.5) * n_iterations / N_STATES) for k in range(N_STATES)}
    spent = 0.0
    for iteration, stem in enumerate(states(radius, n_primordia)):
        if iteration in chosen:
            positions = stem.positions[: stem.n_nodes].copy()
            started = time.process_time()
            urquhart_3d.urquhart_pairs(positions)
            spent += time.process_time() - started
    return spent * n_iterations / len(chosen)


def main():
    """Print a row a case; with --json as JSON."""
    run(5.0, 3)
    urquhart_3d.urquhart_pairs(primordia(np.arange(9), 5.0))
    rows = [measure(RADIUS, n_primordia) for n_primordia in HEIGHTS]
    for case in SMALL:
        row = measure(*case)
        seconds = baseline_seconds(*case, row["iterations"])
        ratio = round(seconds / row["cpu_seconds"])
        rows.append({**row, "triangulating": round(seconds, 1), "ratio": ratio})
    if "--json" in sys.argv:
        print(json.dumps({"load": os.getloadavg()[0], "cases": rows}, indent=2))
        return
    print("  ".join(f"{key:>13}" for key in rows[-1]))
    for row in rows:
        print("  ".join(f"{value!s:>13}" for value in row.values()))


if __name__ == "__main__":
    main()
