"""Memory and seconds that questions of lineage take, each in a program of its own.

A run is recorded, and every question is asked by a child process that opens the
file, asks and ends. Peak memory is the resident size that the system reports for the
child, less its size when the file was open; so what h5py holds counts, too. This program
loads nothing itself: a child begins with the peak of the program that starts it. For
comparison one child reads every column of the file.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

CASES = ("param-kill-distance-e", "orchid-leaf", "poplar-leaf", "arabidopsis-first-leaf")
QUESTIONS = {
    "ancestors": "lineage.ancestors(timeline.n_rows('nodes') - 1)",
    "descendants": "lineage.descendants(timeline.n_rows('nodes') // 50)",
    "a source": "lineage.fate_of(timeline.n_rows('sources') // 2)",
    "life table": "lineage.life_table()",
    "fates": "lineage.fate_table()",
    "births": "lineage.births()",
    "competitors": "lineage.competitors(timeline.n_rows('sources') // 2)",
    "loop of a vein": "lineage.loop_of(timeline.n_rows('nodes') - 1)",
    "every column": "[timeline.opened.read(name, 0, len(timeline.opened.item(name)))"
    " for name in timeline.opened.found.growing_columns]",
}
CHILD = """
import resource, sys, time
from vasc.timeline import Timeline
from vasc.timeline import lineage as loaded
import vasc.faces, scipy.sparse.csgraph
with Timeline(sys.argv[1]) as timeline:
    lineage = timeline.lineage
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    started = time.process_time()
    answer = {question}
    seconds = time.process_time() - started
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(timeline.n_rows("nodes"), before, peak, seconds)
"""


def ask(path, question):
    """Nodes, peak memory in kB when the file is open and after the answer, and CPU seconds."""
    said = subprocess.run(
        [sys.executable, "-c", CHILD.format(question=question), str(path)],
        check=True,
        capture_output=True,
        text=True,
    ).stdout.split()
    return int(said[0]), int(said[1]), int(said[2]), float(said[3])


def measure(name, folder):
    """One row a question."""
    path = Path(folder) / f"{name}.h5"
    recorded = ("-m", "vasc", "run", name, "-o", str(path), "--no-figure", "--quiet")
    subprocess.run([sys.executable, *recorded], check=True)
    rows = []
    for title, question in QUESTIONS.items():
        nodes, opened, answered, seconds = ask(path, question)
        rows.append(
            {
                "case": name,
                "nodes": nodes,
                "file_mb": round(path.stat().st_size / 1e6, 1),
                "question": title,
                "open_mb": round(opened / 1e3),
                "more_mb": round((answered - opened) / 1e3, 1),
                "cpu_s": round(seconds, 3),
            }
        )
    return rows


def main():
    """Print a row a case and a question."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", help="names of bundled configs")
    parser.add_argument("--json", action="store_true")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        rows = [row for name in chosen.cases or CASES for row in measure(name, folder)]
    if chosen.json:
        print(json.dumps({"load": os.getloadavg()[0], "rows": rows}, indent=2))
        return
    print("| " + " | ".join(rows[0]) + " |")
    for row in rows:
        print("| " + " | ".join(f"{value}" for value in row.values()) + " |")


if __name__ == "__main__":
    main()
