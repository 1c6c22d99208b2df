"""What ``vasc check strand`` tells people."""

from pathlib import Path

import typer

from vasc.cli.printing import print_pairs, print_table
from vasc.validation.strands import StrandReport


def print_strand(report: StrandReport, path: Path) -> None:
    """Write the report on a strand for people."""
    found = report.as_json()
    rows = [
        (
            one["sink"],
            one["n_nodes"],
            f"{one['flux_share']:.3f}",
            f"{one['distance']:.4g}",
            f"{one['way']:.4g}",
            ", ".join(
                word
                for word, number in (
                    ("reached", found["reached"]),
                    ("nearest", found["nearest"]),
                    ("nearest over cells", found["nearest_by_cells"]),
                )
                if number == one["sink"]
            ),
        )
        for one in found["sinks"]
    ]
    print_table(("vein", "nodes", "share of flux", "distance, D", "over cells, D", ""), rows)
    typer.echo()
    names = ("formed", "loop", "vortex", "strands", "width", "tortuosity", "is_nearest")
    pairs = {name.replace("_", " "): found[name] for name in names}
    print_pairs(
        {"source": found["source"], "read at step": found["step"]}
        | pairs
        | {"is nearest over cells": found["is_nearest_by_cells"], "ends at node": found["end_node"]}
    )
    verdict = "pass" if report.passed else "FAIL"
    typer.echo(f"{path}: {verdict}; asked: a canal from the source to a vein")
