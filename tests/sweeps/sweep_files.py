"""What tests of sweeps share: a small leaf, sweeps of it, and what becomes of processes."""

import os
import subprocess
import sys
import time
from pathlib import Path

from vasc.timeline import Timeline

ROOT = Path(__file__).resolve().parents[2]

LEAF = """kind = "closed"
title = "A small leaf with loops"

[domain]
shape = "ovate"
length = 20.0

[growth]
kind = "marginal"
final_length = 50.0
length_per_step = 1.0

[placement]
kind = "darts"
density = 0.02
birth_distance_sources = 5.0
birth_distance_veins = 5.0

[arrival]
kill_distance = 1.0
"""

SHORT = """base = "leaf.toml"
title = "Small leaves"
seed = 5
replicates = 2
measures = ["summary.nodes", "stats.vein_density", "lineage.source_life_mean"]

[axes]
arrival.kill_distance = [1.0, 3.0]
placement.density = [0.01, 0.03]
"""

LONG = """base = "leaf.toml"
title = "Leaves that take a while"
measures = ["summary.nodes", "summary.steps", "stats.vein_length"]

[set]
growth.final_length = 400.0
placement.density = 2e-3

[axes]
arrival.kill_distance = [1.0, 1.5, 2.0]
"""


def write(folder, text=SHORT, name="small.toml"):
    """Write a sweep and its base into a folder, and give the sweep file."""
    (folder / "leaf.toml").write_text(LEAF)
    (folder / name).write_text(text)
    return folder / name


def start(folder, *arguments, **options):
    """Start the program."""
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True} | options
    return subprocess.Popen(
        [sys.executable, "-m", "vasc", *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        **options,
    )


def children(process_id):
    """Give the ids of the processes that a process has started."""
    tasks = Path(f"/proc/{process_id}/task").glob("*/children")
    return [int(word) for task in tasks for word in task.read_text().split()]


def is_told(process_id, number):
    """Tell whether a signal waits for a process that is held."""
    status = Path(f"/proc/{process_id}/status").read_text().splitlines()
    waiting = [int(line.split()[1], 16) for line in status if line.startswith("ShdPnd:")]
    return bool(waiting[0] >> (number - 1) & 1)


def is_under_way(folder, number, n_steps=40):
    """Tell whether a run has recorded some steps and has no result."""
    path = folder / "runs" / f"{number:04d}.h5"
    if not path.exists() or path.with_suffix(".json").exists():
        return False
    with Timeline(path) as timeline:
        return timeline.n_frames >= n_steps


def wait_until(is_so, seconds=120.0):
    """Wait until something is so."""
    end = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


def sessions(path):
    """Give how the sessions of a run ended."""
    with Timeline(path) as timeline:
        return [session.get("outcome", "killed") for session in timeline.provenance]
