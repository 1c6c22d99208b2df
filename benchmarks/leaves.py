"""Leaves of several regimes: cost per source-iteration, and the ratio to the baseline.

A source-iteration is one live source in one step; it is what a step costs. The
baseline associates sources and nodes anew (``baseline.py``). It is timed on the
states of the same run, at every ``EVERY``-th step, and its mean cost per
source-iteration there is compared with the whole run of vasc per
source-iteration, darts and all else included: a ratio in disfavour of vasc.
"""

import json
import sys
import time

from baseline import association_seconds

from vasc.config import load, load_text
from vasc.simulation import simulate
from vasc.streams import Streams

EVERY = 97
PARAM = """
kind = "{kind}"
[domain]
shape = "elliptic"
width = 0.6
length = 270.0
[growth]
kind = "marginal"
final_length = 1600.0
length_per_step = {speed}
[placement]
kind = "darts"
density = 600e-6
birth_distance_sources = 10.0
birth_distance_veins = 10.0
[arrival]
kill_distance = {kill}
"""

CASES = {
    "closed, far (v = 8)": PARAM.format(kind="closed", speed=8.0, kill=1.0),
    "closed, near (v = 0.8)": PARAM.format(kind="closed", speed=0.8, kill=1.0),
    "open, far, d_k = 40": PARAM.format(kind="open", speed=8.0, kill=40.0),
    "poplar-leaf": None,
    "ginkgo-leaf": None,
    "orchid-leaf": None,
}


def experiment(name):
    """A bundled config, or one of those above."""
    text = CASES[name]
    return load(name) if text is None else load_text(text, name=name)


def timed_run(parameters):
    """Steps, nodes, source-iterations and CPU seconds of a run."""
    model, n_pairs = parameters.model(), 0
    started = time.process_time()
    for state in simulate(model, Streams(parameters.seed)):
        n_pairs += len(state.live)
    return state, n_pairs, time.process_time() - started


def baseline_cost(parameters):
    """CPU seconds a source-iteration of the baseline on states of the run."""
    seconds, n_pairs = 0.0, 0
    for state in simulate(parameters.model(), Streams(parameters.seed)):
        if state.step % EVERY == 0 and len(state.live) and seconds < 60.0:
            sources, nodes = state.sources.positions, state.network.positions
            seconds += association_seconds(parameters.kind, sources, nodes, time.process_time)
            n_pairs += len(state.live)
    return seconds / max(1, n_pairs)


def measure(name):
    """One row of the table."""
    found = experiment(name)
    parameters = found.parameters
    timed_run(load_text(PARAM.format(kind="closed", speed=400.0, kill=1.0), name="w").parameters)
    state, n_pairs, seconds = timed_run(parameters)
    return {
        "case": name,
        "steps": state.step,
        "nodes": state.n_rows("nodes"),
        "source_iterations": n_pairs,
        "cpu_seconds": round(seconds, 2),
        "ns_per_source_iteration": round(1e9 * seconds / n_pairs),
        "us_per_node": round(1e6 * seconds / state.n_rows("nodes"), 2),
        "ratio_to_baseline": round(baseline_cost(parameters) / (seconds / n_pairs), 1),
    }


def main():
    """Print a row a case; with --json as JSON. Names as arguments choose cases."""
    chosen = [name for name in sys.argv[1:] if name in CASES] or list(CASES)
    rows = [measure(name) for name in chosen]
    if "--json" in sys.argv:
        print(json.dumps(rows, indent=2))
        return
    for row in rows:
        print(", ".join(f"{key} {value}" for key, value in row.items()))


if __name__ == "__main__":
    main()
