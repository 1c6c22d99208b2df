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
        shown = births_by_order(table) if name == "births" else table
        print_table(list(shown), rows(shown, limit))
        n_shown = len(next(iter(shown.values())))
        if limit is not None and limit < n_shown:
            typer.echo(f"... and {n_shown - limit:,} more")
        if name == "competitors":
            typer.echo(f"\n{RECORDED}")
        if name == "life_table":
            typer.echo(f"\n{said(median_life(table))}")


def said(median: "MedianLife") -> str:
    """Say the median of a life table in one line."""
    of = (
        f"of {median.n:,} sources, {median.deaths:,} of which died and {median.censored:,} lived"
        " at the last step"
    )
    if not median.n:
        return "median life: none, for there is no source"
    if median.age is None:
        left = f"{median.least_survival:.3g} live on at the greatest age"
        return f"median life: not reached, {left}; {of}"
    low, high = ("not reached" if age is None else f"{age:,}" for age in (median.low, median.high))
    return f"median life: {median.age:,} steps (95 % interval {low} to {high}); {of}"


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
