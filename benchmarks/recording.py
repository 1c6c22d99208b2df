"""What it costs to record every step: CPU seconds with and without a recorder, in turn."""

import sys
import tempfile
import time
from pathlib import Path

from vasc.config import load
from vasc.experiment import run
from vasc.simulation import simulate
from vasc.streams import Streams

REPEATS = 3


def main():
    """Print the cost for a bundled config (poplar-leaf by default)."""
    name = sys.argv[1] if len(sys.argv) > 1 else "poplar-leaf"
    found = load(name)
    plain, recorded = [], []
    with tempfile.TemporaryDirectory() as folder:
        for k in range(REPEATS + 1):
            started = time.process_time()
            for _ in simulate(found.parameters.model(), Streams(found.parameters.seed)):
                pass
            plain.append(time.process_time() - started)
            started = time.process_time()
            run(found, Path(folder) / f"{k}.h5")
            recorded.append(time.process_time() - started)
    # the first of each loads compiled kernels
    without, with_record = min(plain[1:]), min(recorded[1:])
    share = 100.0 * (with_record - without) / without
    print(f"{name}: {without:.2f} s without, {with_record:.2f} s with a recorder: {share:.1f} %")


if __name__ == "__main__":
    main()
