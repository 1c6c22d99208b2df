"""How long ``vasc run`` takes to start: a tiny leaf without a picture, as a program of its own.

The first start finds no compiled kernels (an empty ``NUMBA_CACHE_DIR``) and no
compiled Python; warm starts find both. Where a warm start takes longer than the
target, the modules that take longest to load are listed.
"""

import argparse
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TARGET = 0.8
LEAF = """
kind = "closed"
[domain]
shape = "elliptic"
length = 10.0
[growth]
kind = "marginal"
final_length = 20.0
length_per_step = 1.0
[placement]
kind = "darts"
density = 0.01
birth_distance_sources = 4.0
birth_distance_veins = 4.0
[arrival]
kill_distance = 2.0
"""
RUN = ("-m", "vasc", "run", "leaf.toml", "-o", "leaf.h5", "--force", "--no-figure", "--quiet")


def child_seconds():
    """CPU seconds of all programs started so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def timed(folder, environment):
    """CPU and wall seconds of one run."""
    cpu, wall = child_seconds(), time.perf_counter()
    subprocess.run([sys.executable, *RUN], cwd=folder, env=environment, check=True)
    return child_seconds() - cpu, time.perf_counter() - wall


def loading(folder, environment, n_modules):
    """Cumulative milliseconds of the modules that take longest to load."""
    said = subprocess.run(
        [sys.executable, "-X", "importtime", *RUN],
        cwd=folder,
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    ).stderr
    rows = re.findall(r"import time: +\d+ \| +(\d+) \| +(\S+)", said)
    longest = sorted(rows, key=lambda row: -int(row[0]))[:n_modules]
    return {name: int(microseconds) / 1000.0 for microseconds, name in longest}


def main():
    """Print the seconds of a first start and of warm ones."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--loading", type=int, default=0, help="modules to list in any case")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "leaf.toml").write_text(LEAF)
        environment = os.environ | {
            "NUMBA_CACHE_DIR": f"{folder}/kernels",
            "PYTHONPYCACHEPREFIX": f"{folder}/python",
        }
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        first = timed(folder, environment)
        warm = sorted(timed(folder, environment) for _ in range(chosen.repeats))
        found = {
            "first_cpu_seconds": round(first[0], 2),
            "first_wall_seconds": round(first[1], 2),
            "warm_cpu_seconds": round(warm[0][0], 2),
            "warm_cpu_seconds_median": round(warm[len(warm) // 2][0], 2),
            "warm_wall_seconds": round(min(wall for _, wall in warm), 2),
            "load": round(os.getloadavg()[0], 1),
        }
        n_modules = chosen.loading or (20 if warm[0][0] > TARGET else 0)
        if n_modules:
            found["loading_ms"] = loading(folder, environment, n_modules)
    if chosen.json:
        print(json.dumps(found, indent=2))
        return
    for key, value in found.items():
        print(f"{key:>24}  {value}")


if __name__ == "__main__":
    main()
