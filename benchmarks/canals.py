"""Canals in a tissue: what a recorded run costs as the tissue gets larger.

Facilitated diffusion on square cells, one source and two veins at a quarter and three
quarters of the width; tolerance 1, which is that of sweeps. The ratio of two tissues in
one session says by which power of the number of cells the cost rises.
"""

import json
import math
import sys
import tempfile
import time
from pathlib import Path

from vasc.config import load_text
from vasc.experiment import run

SIDES = (25, 50, 100, 200)
CONFIG = """
kind = "canalization"
[domain]
kind = "rectangular"
columns = {side}
rows = {side}
[veins]
lines = [[[{left}, {top}]], [[{right}, {top}]]]
[placement]
kind = "given"
points = [[{x}, {y}]]
[transport]
kind = "{kind}"
{numbers}
[settling]
tolerance = 1.0
"""
MODELS = {"facilitated": "gain = 1e5", "pool": ""}


def text(side, kind):
    """Give the config of a tissue."""
    places = {"left": side // 4, "right": 3 * side // 4, "top": side - 2}
    places |= {"x": round(0.4 * side), "y": side // 4}
    return CONFIG.format(side=side, kind=kind, numbers=MODELS[kind], **places)


def measure(side, kind):
    """Numbers of one recorded run."""
    with tempfile.TemporaryDirectory() as folder:
        experiment = load_text(text(side, kind), name=f"{kind}-{side}")
        path = Path(folder) / "run.h5"
        started = time.process_time()
        summary = run(experiment, path)
        seconds = time.process_time() - started
        size = path.stat().st_size
    return {
        "transport": kind,
        "cells": side * side,
        "steps": summary.steps,
        "cpu_seconds": round(seconds, 3),
        "ms_a_step": round(1e3 * seconds / summary.steps, 2),
        "megabytes": round(size / 1e6, 1),
    }


def main():
    """Print a line a run, and the powers of the cost."""
    measure(10, "facilitated")  # what is loaded at first use does not count
    largest = int(sys.argv[1]) if len(sys.argv) > 1 else max(SIDES)
    for kind in MODELS:
        rows = [measure(side, kind) for side in SIDES if side <= largest]
        for row in rows:
            print(json.dumps(row))
        by_cells = {row["cells"]: row["cpu_seconds"] for row in rows}
        if 2500 in by_cells and 40000 in by_cells:
            power = math.log(by_cells[40000] / by_cells[2500]) / math.log(16.0)
            ratio = by_cells[40000] / by_cells[2500]
            print(
                json.dumps({"transport": kind, "ratio": round(ratio, 1), "power": round(power, 2)})
            )


if __name__ == "__main__":
    main()
