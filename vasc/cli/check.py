"""``vasc check``: a run held against what is expected of it."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vasc.cli.options import AsJson, Force, RunFile, Step

if TYPE_CHECKING:
    from vasc.validation.arabidopsis import SequenceReport
    from vasc.validation.stem_phyllotaxis import ConnectivityReport
    from vasc.validation.strands import StrandReport

EXAMPLES = (
    "vasc check sequence arabidopsis.h5",
    "vasc check connectivity stem.h5",
    "vasc check strand canals.h5",
)
"""Examples of the group."""

SEQUENCE_EXAMPLES = (
    "vasc check sequence arabidopsis.h5 -o sequence.png",
    "vasc check sequence arabidopsis.h5 --json",
)
"""Examples of ``vasc check sequence``."""

CONNECTIVITY_EXAMPLES = (
    "vasc check connectivity stem.h5 -o unrolled.png",
    "vasc check connectivity stem.h5 --json",
)
"""Examples of ``vasc check connectivity``."""

STRAND_EXAMPLES = (
    "vasc check strand canals.h5",
    "vasc check strand canals.h5 --source 0 --json",
)
"""Examples of ``vasc check strand``."""

WORDS = {True: "pass", False: "FAIL", None: "open"}
"""What a verdict is called in the table."""


def sequence(
    path: RunFile,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="PICTURE", help="Draw the events: png, svg or pdf."),
    ] = None,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Hold a leaf against the sequence observed in the first leaf of Arabidopsis.

    Exit code 1 if a criterion fails; one that cannot be decided is no failure.
    """
    from vasc.cli.printing import print_json
    from vasc.cli.run import check_picture
    from vasc.validation.arabidopsis import check_sequence

    if output is not None:
        from vasc.render.saving import PICTURE_SUFFIXES, checked_output

        check_picture(output, force=force)
        checked_output(output, PICTURE_SUFFIXES)
    report = check_sequence(path)
    found = report.as_json()
    if output is not None:
        from vasc.render import draw_sequence

        draw_sequence(found, output)
    if as_json:
        print_json(found | {"files": [] if output is None else [str(output)]})
    else:
        _print(report, path, output)
    if not report.passed:
        raise typer.Exit(1)


def _print(report: "SequenceReport", path: Path, output: Path | None) -> None:
    """Write the report for people."""
    from vasc.cli.printing import print_table, shown

    found = report.as_json()
    rows = [
        (row["id"], WORDS[row["passed"]], row["value"], f"{row['threshold']}{_mark(row)}")
        for row in found["criteria"]
    ]
    print_table(("", "verdict", "found", "asked (*: a number of ours)"), rows)
    others = [row for row in found["criteria"] if row["passed"] is not True]
    for index, row in enumerate(others):
        line = f"{row['id']} {WORDS[row['passed']]}: {row['text']} Here: {row['reason']}."
        typer.echo(line if index else f"\n{line}")
    typer.echo("\nevents")
    events = [
        (one["name"], one["step"], one["leaf_length"], one["height"]) for one in found["events"]
    ]
    print_table(("", "step", "leaf length", "place"), events)
    typer.echo("\nfeatures of the wild type, at the last step (they do not decide)")
    for row in found["feature_details"]:
        typer.echo(f"({row['id']}) {WORDS[row['passed']]}: {row['text']}: {shown(row['value'])}")
        typer.echo(f"    measured as: {row['measure']}")
    typer.echo(f"\nfarthest from mirror symmetry: {report.symmetry.largest:.3g}")
    typer.echo(
        f"final areas at step {found['final_areas']['step']}: {found['final_areas']['note']}"
    )
    if output is not None:
        typer.echo(f"written: {output}")
    failed, n_open = len(report.failures), len(report.undecided)
    passed = len(report.criteria) - failed - n_open
    typer.echo(f"{path}: {passed} criteria pass, {failed} fail, {n_open} cannot be decided")


def _mark(row: dict[str, str]) -> str:
    """Mark a threshold that is in no paper."""
    return "*" if row["threshold_from"] == "ours" else ""


def connectivity(
    path: RunFile,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="PICTURE", help="Draw the stem unrolled: png, svg or pdf."
        ),
    ] = None,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Hold the veins of a stem against what its phyllotaxis predicts.

    Exit code 1 if they connect other primordia than predicted, or too few of them do.
    """
    from vasc.cli.printing import print_json
    from vasc.cli.run import check_picture
    from vasc.timeline import Timeline
    from vasc.validation.stem_phyllotaxis import check_connectivity, reading

    if output is not None:
        from vasc.render.saving import PICTURE_SUFFIXES, checked_output

        check_picture(output, force=force)
        checked_output(output, PICTURE_SUFFIXES)
    with Timeline(path) as timeline:
        graph = reading.read_stem(timeline)
    report = check_connectivity(graph)
    if output is not None:
        from vasc.render import draw_unrolled

        draw_unrolled(
            graph.positions,
            graph.segments,
            graph.primordia,
            output,
            radius=graph.radius,
            title=f"{path.name}: {_pair(report.pair)}, predicted {_pair(report.prediction.pair)}",
        )
    if as_json:
        print_json(report.as_json() | {"files": [] if output is None else [str(output)]})
    else:
        _print_connectivity(report, path, output)
    if not report.passed:
        raise typer.Exit(1)


def _print_connectivity(report: "ConnectivityReport", path: Path, output: Path | None) -> None:
    """Write the report on connectivity for people."""
    from vasc.cli.printing import print_pairs, print_table, shown

    found = report.as_json()
    low, high = (shown(end) for end in found["interval"])
    parastichies = found["parastichies"]
    print_pairs(
        {
            "divergence, in degrees": found["divergence"],
            "R, H, in D": f"{shown(found['radius'])}, {shown(found['rise'])}",
            "R/H": f"{found['ratio']:.4g}; the prediction holds from {low} to {high}",
            "primordia": f"{found['primordia']}; judged: {_span(found['judged'])}",
            "connected": _pair(report.pair),
            "predicted": f"{_pair(report.prediction.pair)}; on the surface it would be"
            f" {_pair(report.surface.pair)}",
            "contact parastichies": f"{_pair(parastichies['numbers'])},"
            f" {'opposed' if parastichies['opposed'] else 'not opposed'}",
            "separate sympodia": found["sympodia"],
            "exactly the pair": f"{found['fraction']:.3f} of those judged",
        }
    )
    if report.exceptions:
        typer.echo("\nexceptions")
        rows = [
            (one.primordium, _pair(one.steps), _pair(one.missing), _pair(one.extra))
            for one in report.exceptions
        ]
        print_table(("primordium", "connected to", "missing", "extra"), rows)
    if report.tie is not None:
        typer.echo(f"\n{WORDS[report.tie.passed]}: {report.tie.explanation}")
    if output is not None:
        typer.echo(f"written: {output}")
    asked = "the rule of the tie" if report.tie else f"a share of {report.least_fraction:g}"
    typer.echo(f"{path}: {WORDS[report.passed]}; asked: the predicted pair, and {asked}")


def _pair(steps: Iterable[int]) -> str:
    """Write steps as the papers do; a dash for none."""
    text = ", ".join(str(step) for step in steps)
    return f"({text})" if text else "-"


def _span(ends: Sequence[int]) -> str:
    """Write the first and the last of a range."""
    return f"{ends[0]} to {ends[-1]}"


def strand(
    path: RunFile,
    source: Annotated[
        int | None, typer.Option("--source", min=0, help="A source; the newest if left out.")
    ] = None,
    step: Step = -1,
    as_json: AsJson = False,
) -> None:
    """Read to which vein the canal of a source leads, and whether that is the nearest.

    A canal that has become a vein by the step is read when it did. Exit code 1 if there is
    none; one that leads to another vein than the nearest is no failure.
    """
    from vasc.cli.printing import print_json
    from vasc.timeline import Timeline
    from vasc.validation.strands import check_strand

    with Timeline(path) as timeline:
        report = check_strand(timeline, source, step)
    if as_json:
        print_json(report.as_json())
    else:
        _print_strand(report, path)
    if not report.passed:
        raise typer.Exit(1)


def _print_strand(report: "StrandReport", path: Path) -> None:
    """Write the report on a strand for people."""
    from vasc.cli.printing import print_pairs, print_table

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
    typer.echo(f"{path}: {WORDS[report.passed]}; asked: a canal from the source to a vein")
