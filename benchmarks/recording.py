"""What it costs to record every step: CPU seconds with and without a recorder, in turn.

The plain run keeps no record of what sources perceive; recorded ones are made
with each value of ``record.perceived``. As the difference of two runs is as small as
what other work on the machine makes of it, the time within the recorder is measured,
too (``recorder_percent``, of the rest of the same run). What a recorded run of a single step costs
more than a plain one is told apart: making and closing the file, and the summary.
"""

import argparse
import json
import os
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch

from vasc.config import load
from vasc.experiment import run
from vasc.simulation import simulate
from vasc.streams import Streams
from vasc.timeline import Recorder

CASES = ("poplar-leaf", "param-kill-distance-e")
PERCEIVED = ("none", "veins", "nodes")


def configured(name, perceived):
    """A bundled config that records some of what sources perceive."""
    return load(name, [(("record", "perceived"), perceived)])


def plain_seconds(experiment, steps=None):
    """CPU seconds of a run that nobody watches."""
    started = time.process_time()
    parameters = experiment.parameters
    model = parameters.model(experiment.folder)
    for _ in simulate(model, Streams(parameters.seed), max_steps=steps):
        pass
    return time.process_time() - started


def recorded_seconds(experiment, output, steps=None):
    """CPU seconds and summary of a run with a recorder."""
    started = time.process_time()
    summary = run(experiment, output, force=True, steps=steps)
    return time.process_time() - started, summary


@contextmanager
def watched(spent):
    """Add up the CPU seconds that recorders spend in a run, in ``spent[0]``."""

    def timed(method):
        def called(*arguments, **named):
            started = time.process_time()
            try:
                return method(*arguments, **named)
            finally:
                spent[0] += time.process_time() - started

        return called

    with (
        patch.object(Recorder, "observe", timed(Recorder.observe)),
        patch.object(Recorder, "close", timed(Recorder.close)),
    ):
        yield


def recorder_percent(experiment, output):
    """Share of the recorder in a run, in percent of the rest."""
    spent = [0.0]
    with watched(spent):
        seconds, _ = recorded_seconds(experiment, output)
    return 100.0 * spent[0] / (seconds - spent[0])


def measure(name, repeats):
    """Best of some runs of each sort, all in turn; the first of each loads kernels."""
    plain, recorded = [], {perceived: [] for perceived in PERCEIVED}
    fixed, sizes, shares = [], {}, {}
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "run.h5"
        for _ in range(repeats + 1):
            found = configured(name, "none")
            plain.append(plain_seconds(found))
            begun = recorded_seconds(found, output, steps=1)[0] - plain_seconds(found, steps=1)
            fixed.append(begun)
            for perceived in PERCEIVED:
                seconds, summary = recorded_seconds(configured(name, perceived), output)
                recorded[perceived].append(seconds)
                sizes[perceived] = output.stat().st_size
        for perceived in PERCEIVED:
            shares[perceived] = recorder_percent(configured(name, perceived), output)
    without, begin = min(plain[1:]), min(fixed[1:])
    rows = []
    for perceived in PERCEIVED:
        seconds = min(recorded[perceived][1:])
        rows.append(
            {
                "case": name,
                "perceived": perceived,
                "steps": summary.steps,
                "nodes": summary.nodes,
                "plain_s": round(without, 3),
                "recorded_s": round(seconds, 3),
                "percent": round(100.0 * (seconds - without) / without, 1),
                "recorder_percent": round(shares[perceived], 1),
                "file_and_summary_ms": round(1e3 * begin, 1),
                "us_per_step": round(1e6 * (seconds - without - begin) / summary.steps),
                "file_bytes_per_node": round(sizes[perceived] / summary.nodes),
            }
        )
    return rows


def main():
    """Print a row a case and a value of ``record.perceived``."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", help="names of bundled configs")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--repeats", type=int, default=3)
    chosen = parser.parse_args()
    rows = [row for name in chosen.cases or CASES for row in measure(name, chosen.repeats)]
    if chosen.json:
        print(json.dumps({"load": os.getloadavg()[0], "rows": rows}, indent=2))
        return
    print("| " + " | ".join(rows[0]) + " |")
    for row in rows:
        print("| " + " | ".join(f"{value}" for value in row.values()) + " |")


if __name__ == "__main__":
    main()
