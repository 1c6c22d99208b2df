"""Development of the first leaf of Arabidopsis: cost per step against nodes, and a baseline.

The baseline finds the largest empty circle in the obvious way: in every step it
triangulates all veins and sources anew with scipy, keeps the centres inside the
blade, and asks a new search tree for their distances and for those of all
points of the margin. It looks at the same states, so that the work is the same.
"""

import argparse
import json
import os
import time

import numpy as np
import shapely
from scipy.spatial import Delaunay, QhullError, cKDTree

from vasc.config import load
from vasc.placement import Moment
from vasc.placement.room import Room, circumcentres
from vasc.simulation import simulate
from vasc.streams import Streams

CONFIGS = ("arabidopsis-first-leaf", "arabidopsis-closed", "mature-areoles-blind")
BOUNDS = (100, 500, 1_000, 2_000, 4_000, 8_000, 16_000)
"""Upper ends of the classes of sizes, in nodes."""
EVERY = 20
"""The baseline looks at every so many steps."""


def obvious_largest_circle(sites, blade):
    """The radius of the largest empty circle in a blade, without thinking."""
    ring = blade.rings[0]
    candidates = ring
    try:
        centres = circumcentres(sites[Delaunay(sites).simplices])
        polygon = shapely.Polygon(ring)
        inside = shapely.contains_xy(polygon, centres[:, 0], centres[:, 1])
        candidates = np.concatenate([centres[inside], ring])
    except (QhullError, ValueError):
        pass  # all sites on a line, or too few
    return float(cKDTree(sites).query(candidates)[0].max())


def timed(work, *arguments):
    """The CPU seconds of one call."""
    started = time.process_time()
    work(*arguments)
    return time.process_time() - started


def measure(name):
    """Run a config; seconds per step by size, and the ratio of the search for room."""
    parameters = load(name).parameters
    for _ in simulate(parameters.model(), Streams(1, parameters.stream_names), max_steps=30):
        pass  # loads the compiled kernels
    model, streams = parameters.model(), Streams(1, parameters.stream_names)
    steps, ratios, total = [], [], 0.0
    states = simulate(model, streams)
    started = time.process_time()
    for state in states:
        seconds = time.process_time() - started
        total += seconds
        n_nodes = state.network.n_vein_nodes
        steps.append((n_nodes, seconds))
        if state.step and state.step % EVERY == 0 and state.step <= model.placement.last_step:
            ratios.append((n_nodes, *search_seconds(model, state)))
        started = time.process_time()
    return {
        "config": name,
        "steps": len(steps) - 1,
        "nodes": n_nodes,
        "seconds": total,
        "milliseconds_per_step": by_size(steps),
        "search_ratio": by_size([(n, slow / fast) for n, fast, slow in ratios]),
        "load": os.getloadavg()[0],
    }


def search_seconds(model, state):
    """CPU seconds of the search for room in one state: ours, and the obvious one."""
    veins, moment = state.index, Moment.of(model.growth, state.step)
    limit = model.placement.birth_distance
    sites = np.concatenate(
        [
            np.delete(state.positions("nodes"), state.network.retired, axis=0),
            state.positions("sources")[state.live],
        ]
    )
    ours = timed(lambda: Room(veins, moment, limit).largest_circle())
    return ours, timed(obvious_largest_circle, sites, state.blade)


def by_size(rows):
    """Means of the second column (seconds as milliseconds), by classes of the first."""
    found, low = {}, 0
    for high in BOUNDS:
        values = [value for n, value in rows if low < n <= high]
        if values:
            found[f"{low:,}-{high:,}"] = float(np.mean(values))
        low = high
    return found


def main():
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("configs", nargs="*", default=CONFIGS)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    results = [measure(name) for name in arguments.configs]
    if arguments.json:
        print(json.dumps(results, indent=1))
        return
    for result in results:
        print(
            f"{result['config']}: {result['steps']} steps, {result['nodes']:,} nodes,"
            f" {result['seconds']:.2f} CPU s"
        )
        for size, seconds in result["milliseconds_per_step"].items():
            ratio = result["search_ratio"].get(size)
            shown = (
                ""
                if ratio is None
                else f", search for room {ratio:.1f} times as fast as the obvious"
            )
            print(f"  {size:>14} nodes: {1000 * seconds:6.2f} ms a step{shown}")


if __name__ == "__main__":
    main()
