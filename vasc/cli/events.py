"""``vasc events``: what happened in a run."""

import csv
import sys
from typing import TYPE_CHECKING, Annotated

import typer

from vasc.cli.options import AsJson, RunFile

if TYPE_CHECKING:
    from vasc.timeline import Timeline

HEADER = ("step", "kind", "subject", "object")
Row = tuple[int, str, int, int]


EXAMPLES = ("vasc events poplar-leaf.h5 --kind loop_closed --from 100 --to 200 --csv",)


def events(
    path: RunFile,
    kinds: Annotated[
        list[str] | None, typer.Option("--kind", help="Only this kind, as loop_closed; repeat.")
    ] = None,
    first: Annotated[int, typer.Option("--from", min=0, help="The first step.")] = 0,
    last: Annotated[int | None, typer.Option("--to", min=0, help="The last step.")] = None,
    limit: Annotated[int | None, typer.Option("--limit", min=0, help="At most that many.")] = None,
    as_csv: Annotated[bool, typer.Option("--csv", help="Write CSV.")] = False,
    as_json: AsJson = False,
) -> None:
    """List the events of a run: sources placed, veins joined, loops closed, ...

    Subject and object are rows of the tables of the run. They are, by kind:

    \b
    source_placed       source / -
    source_tagged       source / node that it waits for
    source_removed      source / node, the nearest then
    source_enclosed     source / areole in which it appeared
    vein_initiated      node, the first of the vein / node, its parent
    vein_joined         segment between two veins / source where they met
    vein_ended_blindly  node at the end / source that it reached
    loop_closed         segment that closed it / source
    stall_resolved      node whose pulls cancelled / source that it took
    segment_refined     segment that two replace / node that halves it
    node_retired        node whose corner was cut / -
    strand_extended     canal / node, the new tip of its strand
    canal_retargeted    canal / node that it leads to from now on
    areole_born         areole / segment that closed it
    areole_split        areole / segment that divides it
    vortex_formed       cell / -
    run_finished        reason / -: 0 no_sources, 1 nothing_pulled, 2 livelock, 3 step_limit,
                        4 at_rest
    growth_ended, mesophyll_event, canals_settled, canals_unsettled    - / -
    """  # noqa: D301 - the mark keeps the lines apart
    from vasc.cli.printing import print_json, print_table
    from vasc.timeline import Timeline

    if as_csv and as_json:
        raise typer.BadParameter("--csv and --json exclude each other")
    with Timeline(path) as timeline:
        # refuses a run without a step
        timeline.frame()
        rows, n_found = select(timeline, kinds or [], first, last, limit)
    if as_json:
        found = [dict(zip(HEADER, row, strict=True)) for row in rows]
        print_json({"found": n_found, "events": found})
    elif as_csv:
        writer = csv.writer(sys.stdout, lineterminator="\n")
        writer.writerow(HEADER)
        writer.writerows(rows)
    else:
        print_table(HEADER, [[None if one == -1 else one for one in row] for row in rows])
        if len(rows) < n_found:
            typer.echo(f"... and {n_found - len(rows):,} more")


def select(
    timeline: "Timeline", kinds: list[str], first: int, last: int | None, limit: int | None
) -> tuple[list[Row], int]:
    """Give the events that are asked for, and how many there are without the limit.

    Raises
    ------
    VascError
        If there is no such kind of event.
    """
    import numpy as np

    from vasc.errors import VascError

    columns, names = timeline.events, timeline.event_names
    codes = {name: code for code, name in names.items()}
    for kind in kinds:
        if kind not in codes:
            known = ", ".join(codes)
            raise VascError(f"--kind {kind}: there is no such kind of event; kinds are {known}")
    is_asked = columns["step"] >= first
    if last is not None:
        is_asked &= columns["step"] <= last
    if kinds:
        is_asked &= np.isin(columns["kind"], [codes[kind] for kind in kinds])
    ids = np.flatnonzero(is_asked)
    chosen = (columns[name][ids[:limit]].tolist() for name in HEADER)
    rows = [
        (step, names.get(kind, f"kind {kind}"), subject, other)
        for step, kind, subject, other in zip(*chosen, strict=True)
    ]
    return rows, len(ids)
