"""Leaves of several regimes: what a source-iteration costs, and the ratio to the baseline.

A source-iteration is one live source in one step; it is what a step costs. The
baseline (``baselines.py``) associates sources and nodes anew in every step. It is
compared in two ways, both per source-iteration, and both with all of vasc's run:

``same states``
    The baseline's association alone on states of vasc's run, ``N_STATES`` of them
    spread evenly over its steps; its darts, extension and arrival are left out.
``same steps``
    The baseline's own whole run, cut after ``--baseline-seconds``, against vasc's
    run cut at the step that the baseline reached. An early cut compares small leaves.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import time

from baselines import association_seconds, grow

from vasc.config import load, load_text
from vasc.simulation import simulate
from vasc.streams import Streams

N_STATES = 24
PARAM = """
kind = "{kind}"
[domain]
shape = "elliptic"
width = 0.6
length = {first}
[growth]
kind = "marginal"
final_length = {last}
length_per_step = {speed}
[placement]
kind = "darts"
density = 600e-6
birth_distance_sources = 10.0
birth_distance_veins = 10.0
[arrival]
kill_distance = {kill}
"""


def param(kind, speed, kill, first=270.0, last=1600.0):
    """The leaf of Figure 4.14 with the lengths as printed, or others."""
    return PARAM.format(kind=kind, speed=speed, kill=kill, first=first, last=last)


CASES = {
    "param-kill-distance-e": ("closed, v = 2", None),
    "param-far": ("closed, v = 8, far", param("closed", 8.0, 1.0)),
    "param-near": ("closed, v = 0.8, near", param("closed", 0.8, 1.0)),
    "param-open": ("open, d_k = 40, v = 8, far", param("open", 8.0, 40.0)),
    "poplar-leaf": ("closed, isogonic, T = 0.57", None),
    "ginkgo-leaf": ("open, d_k = 100, v = 1.5", None),
    "orchid-leaf": ("closed, no growth", None),
}


def parameters_of(name):
    """The parameters of a bundled config, or of one of those above."""
    text = CASES[name][1]
    return (load(name) if text is None else load_text(text, name=name)).parameters


def warm():
    """Load the compiled kernels by growing tiny leaves."""
    for kind in ("open", "closed"):
        timed_run(load_text(param(kind, 8.0, 1.0, 20.0, 100.0), name="warm").parameters)
    timed_run(load("poplar-leaf").parameters, most_steps=60)
    timed_run(load("orchid-leaf").parameters, most_steps=60)


def timed_run(parameters, most_steps=None, look=None):
    """Last state, source-iterations and CPU seconds of a run, without those of ``look``."""
    n_pairs, looked = 0, 0.0
    started = time.process_time()
    model = parameters.model()
    for state in simulate(model, Streams(parameters.seed), max_steps=most_steps):
        n_pairs += len(state.live)
        if look is not None:
            paused = time.process_time()
            look(state)
            looked += time.process_time() - paused
    return state, n_pairs, time.process_time() - started - looked


class SameStates:
    """Times the baseline's association at some of the steps of a run."""

    def __init__(self, kind, n_steps, most_seconds):
        self.kind, self.every = kind, max(1, n_steps // N_STATES)
        self.n_pairs, self.seconds, self.most_seconds = 0, 0.0, most_seconds

    def __call__(self, state):
        """Look at one state."""
        is_due = state.step % self.every == 0 and self.seconds < self.most_seconds
        if is_due and len(state.live):
            sources, nodes = state.sources.positions, state.network.positions
            self.seconds += association_seconds(self.kind, sources, nodes)
            self.n_pairs += len(sources)


def peak_bytes(name):
    """Memory that a run needs beyond that of the interpreter, in a process of its own."""
    said = subprocess.run(
        [sys.executable, __file__, name, "--memory"], capture_output=True, text=True, check=True
    )
    return int(said.stdout)


def print_memory(name):
    """Print the memory in use at the highest point of a run, less that before it."""
    warm()
    with open("/proc/self/statm") as file:
        before = int(file.read().split()[1]) * resource.getpagesize()
    timed_run(parameters_of(name))
    print(1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)


def measure(name, baseline_seconds):
    """One row of the table."""
    parameters = parameters_of(name)
    state, n_pairs, seconds = timed_run(parameters)
    n_nodes, cost = state.n_rows("nodes"), seconds / n_pairs
    row = {
        "case": name,
        "regime": CASES[name][0],
        "steps": state.step,
        "nodes": n_nodes,
        "sources": state.n_rows("sources"),
        "source_iterations": n_pairs,
        "cpu_s": round(seconds, 3),
        "ns_per_source_iteration": round(1e9 * cost),
        "us_per_node": round(1e6 * seconds / n_nodes, 2),
        "bytes_per_node": round(peak_bytes(name) / n_nodes),
    }
    if baseline_seconds:
        look = SameStates(parameters.kind, state.step, baseline_seconds)
        timed_run(parameters, look=look)
        step, _, n_theirs, theirs = grow(parameters, most_seconds=baseline_seconds)
        _, n_ours, ours = timed_run(parameters, most_steps=step)
        row["ratio_same_states"] = round(look.seconds / look.n_pairs / cost, 1)
        row["ratio_same_steps"] = round((theirs / n_theirs) / (ours / n_ours), 1)
        row["baseline_steps"] = step
    return row


def main():
    """Print a row a case."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", choices=[[], *CASES], help="all by default")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--memory", action="store_true", help="bytes of one case alone")
    parser.add_argument("--baseline-seconds", type=float, default=15.0, help="0: no baseline")
    chosen = parser.parse_args()
    if chosen.memory:
        print_memory(chosen.cases[0])
        return
    warm()
    rows = [measure(name, chosen.baseline_seconds) for name in chosen.cases or CASES]
    if chosen.json:
        print(json.dumps({"load": os.getloadavg()[0], "rows": rows}, indent=2))
        return
    print("| " + " | ".join(rows[0]) + " |")
    for row in rows:
        print(
            "| "
            + " | ".join(f"{v:,}" if isinstance(v, int) else f"{v}" for v in row.values())
            + " |"
        )


if __name__ == "__main__":
    main()
