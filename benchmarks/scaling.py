"""How the cost grows with the leaf: final lengths that double, and the exponents.

An exponent is the binary logarithm of the ratio of two neighbouring rows; where
veins keep up, source-iterations grow as the area (2), where they lag, as its
product with the length (3).
"""

import argparse
import json
import math
import os

from leaves import param, timed_run, warm

from vasc.config import load, load_text

POPLAR = (875.0, 1750.0, 3500.0)
NEAR = (400.0, 800.0, 1600.0)
STATIC = (325.0, 650.0, 1300.0)
GINKGO = (1250.0, 2500.0)


def series(name):
    """Final lengths and the configs of one regime."""
    if name == "marginal, v = 0.8":
        for last in NEAR:
            yield last, load_text(param("closed", 0.8, 1.0, 70.0, last), name=name)
    elif name == "isogonic (poplar)":
        # T stays: the blade grows by the same factor, and by as much in a step
        for last in POPLAR:
            first = 115.0 * last / POPLAR[-1]
            lengths = [(("domain", "length"), first), (("growth", "final_length"), last)]
            yield last, load("poplar-leaf", lengths)
    elif name == "no growth (orchid)":
        for last in STATIC:
            yield last, load("orchid-leaf", [(("domain", "length"), last)])
    else:
        for last in GINKGO:
            yield last, load("ginkgo-leaf", [(("growth", "final_length"), last)])


SERIES = ("marginal, v = 0.8", "isogonic (poplar)", "no growth (orchid)", "open (ginkgo)")


def exponent(before, now):
    """Binary logarithm of a ratio, for a doubling."""
    return round(math.log2(now / before), 2)


def measure(name):
    """Rows of one regime."""
    rows = []
    for last, experiment in series(name):
        state, n_pairs, seconds = timed_run(experiment.parameters)
        row = {
            "regime": name,
            "final_length": last,
            "steps": state.step,
            "nodes": state.n_rows("nodes"),
            "source_iterations": n_pairs,
            "cpu_s": round(seconds, 3),
        }
        for key in ("nodes", "source_iterations", "cpu_s"):
            row[f"exponent_{key}"] = exponent(rows[-1][key], row[key]) if rows else None
        rows.append(row)
    return rows


def main():
    """Print a row a regime and a length."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", action="store_true")
    chosen = parser.parse_args()
    warm()
    rows = [row for name in SERIES for row in measure(name)]
    if chosen.json:
        print(json.dumps({"load": os.getloadavg()[0], "rows": rows}, indent=2))
        return
    print("| " + " | ".join(rows[0]) + " |")
    for row in rows:
        print("| " + " | ".join("" if v is None else f"{v}" for v in row.values()) + " |")


if __name__ == "__main__":
    main()
