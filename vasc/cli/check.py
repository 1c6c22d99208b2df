"""``vasc check``: a run held against what is expected of it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vasc.cli.options import AsJson, Force, RunFile, Step

if TYPE_CHECKING:
    from vasc.validation.arabidopsis import SequenceReport

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
    from vasc.cli.outputs import check_picture
    from vasc.cli.printing import print_json
    from vasc.validation.arabidopsis import check_sequence

    if output is not None:
        check_picture(output, force=force)
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
    from vasc.cli.connectivity import print_connectivity, told
    from vasc.cli.outputs import check_picture
    from vasc.cli.printing import print_json
    from vasc.timeline import Timeline
    from vasc.validation.stem_phyllotaxis import check_connectivity, reading

    if output is not None:
        check_picture(output, force=force)
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
            title=f"{path.name}: {told(report.steps, report.prediction)},"
            f" predicted {told(report.prediction.steps, report.prediction)}",
        )
    if as_json:
        print_json(report.as_json() | {"files": [] if output is None else [str(output)]})
    else:
        print_connectivity(report, path, output)
    if not report.passed:
        raise typer.Exit(1)


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
    from vasc.cli.strand import print_strand
    from vasc.timeline import Timeline
    from vasc.validation.strands import check_strand

    with Timeline(path) as timeline:
        report = check_strand(timeline, source, step)
    if as_json:
        print_json(report.as_json())
    else:
        print_strand(report, path)
    if not report.passed:
        raise typer.Exit(1)
