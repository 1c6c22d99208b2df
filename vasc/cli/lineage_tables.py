"""Tables of lineage on the terminal: rows for people, CSV and JSON for programs."""

import csv
import math
import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from vasc.timeline import Timeline
    from vasc.timeline.life_table import MedianLife

LONGEST_TABLE = 40
"""Rows that people are shown without a limit; CSV and JSON hold all."""

NEVER_NULL = {"time", "height", "survival", "standard_error", "low", "high", "median"}
"""Columns of real numbers, in which -1 would be a number like others."""

RECORDED = (
    "recorded: steps and nodes of the sets in the file, which holds a set when a vein enters or"
    ' leaves it (record.perceived = "veins"), or also when a vein grows (= "nodes")'
)
"""What the columns of competitors mean."""


def asked_for(timeline: "Timeline", name: str, source: int | None) -> "dict[str, NDArray]":
    """Give a table of lineage by its name; births with vein orders at the last step."""
    if name == "competitors":
        return timeline.lineage.competitors(source)
    if name == "births":
        from vasc.analysis.run_widths import widths_of
        from vasc.analysis.segment_orders import run_node_orders

        asked = widths_of(timeline.config)
        n_nodes = timeline.n_rows("nodes")
        orders = run_node_orders(timeline.frame, timeline.last_step, asked, n_nodes)
        return timeline.lineage.births(orders)
    return timeline.lineage.table(name)


def write(
    name: str,
    table: "Mapping[str, NDArray]",
    limit: int | None,
    *,
    as_csv: bool,
    as_json: bool,
) -> None:
    """Write a table.

    Parameters
    ----------
    name : str
        Its name, the key of its rows in JSON.
    table : mapping of str to ndarray
        Columns of one length.
    limit : int or None
        Rows at most.
    as_csv, as_json : bool
        How; for people if neither.
    """
    from vasc.cli.printing import print_json, print_table
    from vasc.timeline.life_table import median_life
    from vasc.timeline.veins import births_by_order

    n_rows = len(next(iter(table.values())))
    if as_csv:
        writer = csv.writer(sys.stdout, lineterminator="\n")
        writer.writerow(table)
        writer.writerows(
            ["" if cell is None else cell for cell in row] for row in rows(table, limit)
        )
    elif as_json:
        found: dict[str, Any] = {"found": n_rows, name: records(table, limit)}
        if name == "births":
            found["by_order"] = records(births_by_order(table), None)
        if name == "life_table":
            found["median"] = _in_json(median_life(table))
        print_json(found)
    else:
        if name == "life_table":
            typer.echo(f"{said(median_life(table))}\n")
        shown = births_by_order(table) if name == "births" else table
        at_most = LONGEST_TABLE if limit is None else limit
        print_table(list(shown), rows(shown, at_most))
        n_more = len(next(iter(shown.values()))) - at_most
        if n_more > 0:
            how = " (--limit N shows N rows; --csv and --json give all)" if limit is None else ""
            typer.echo(f"... and {n_more:,} more{how}")
        if name == "competitors":
            typer.echo(f"\n{RECORDED}")


def said(median: "MedianLife") -> str:
    """Say the median of a life table in one line."""
    if not median.n:
        return "median life: none, for there is no source"
    sources = "1 source" if median.n == 1 else f"{median.n:,} sources"
    of = f"{sources}: {median.deaths:,} removed, {median.censored:,} alive at the last step"
    if median.age is None:
        left = f"{median.least_survival:.3g} live on at the greatest age"
        return f"median life: not reached, {left}; {of}"
    if median.low is None and median.high is None:
        interval = "without a 95 % interval"
    elif median.high is None:
        interval = f"95 % interval from {median.low:,} on, without an upper end"
    elif median.low is None:
        interval = f"95 % interval up to {median.high:,}, without a lower end"
    else:
        interval = f"95 % interval {median.low:,} to {median.high:,}"
    return f"median life: {_steps(median.age)} ({interval}); {of}"


def _steps(number: int) -> str:
    """Give a number of steps in words."""
    return "1 step" if number == 1 else f"{number:,} steps"


def _in_json(median: "MedianLife") -> dict[str, Any]:
    """Give a median in JSON values."""
    from dataclasses import asdict

    found = asdict(median)
    survival = found.pop("least_survival")
    return found | {"least_survival": survival if math.isfinite(survival) else None}


def records(table: "Mapping[str, NDArray]", limit: int | None) -> list[dict[str, Any]]:
    """Give the rows of a table as JSON objects."""
    return [dict(zip(table, row, strict=True)) for row in rows(table, limit)]


def rows(table: "Mapping[str, NDArray]", limit: int | None) -> list[tuple[Any, ...]]:
    """Give the rows of a table in JSON values: names for codes, None for null and nan."""
    columns = (_values(name, column[:limit].tolist()) for name, column in table.items())
    return list(zip(*columns, strict=True))


def _values(name: str, values: list[Any]) -> list[Any]:
    """Give the values of a column as people and JSON know them."""
    from vasc.timeline import Fate

    if name == "fate":
        return [Fate(code).name.lower() for code in values]
    if name in NEVER_NULL:
        return [None if math.isnan(value) else value for value in values]
    return [None if value == -1 else value for value in values]
