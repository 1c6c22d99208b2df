"""``vasc compare``: two runs, or a run and a real leaf, side by side."""

from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from vasc.cli.options import AsJson, Step
from vasc.cli.stats import Seed, measured

if TYPE_CHECKING:
    from vasc.timeline import Events

EXAMPLES = ("vasc compare poplar-leaf.h5 leaf_edges.csv", "vasc compare near.h5 far.h5")

Input = Annotated[Path, typer.Argument(help="A recorded run, or a real network.")]

EVENT = ("step", "kind", "subject", "object")
WHERE = ("step", "table", "column", "row")


def compare(
    one: Input, other: Input, step: Step = -1, seed: Seed = 0, as_json: AsJson = False
) -> None:
    """Put the statistics of two runs or real leaves side by side; of two runs, events as well."""
    from vasc.cli.printing import print_json, print_table
    from vasc.networks_in import is_network_file

    files = (one, other)
    is_run = [not is_network_file(path) for path in files]
    if step != -1 and not any(is_run):
        raise typer.BadParameter(f"--step {step}: neither {one} nor {other} is a run with steps")
    asked = [step if runs else -1 for runs in is_run]
    columns = [measured(path, at, seed) for path, at in zip(files, asked, strict=True)]
    runs = two_runs(one, other) if all(is_run) else None
    if as_json:
        print_json({"a": str(one), "b": str(other), "statistics": columns, "runs": runs})
        return
    print_table(("", str(one), str(other), "b / a"), rows_of(*columns))
    if runs is not None:
        typer.echo()
        counts = [(kind, *pair) for kind, pair in runs["events"].items()]
        print_table(("events", str(one), str(other)), counts)
        typer.echo(f"\n{said(runs['first_difference'])}")
        if parting := runs["first_event"]:
            values = (" ".join(map(str, (parting[run] or {}).values())) for run in "ab")
            typer.echo(f"first event that differs: {' | '.join(value or '-' for value in values)}")


def rows_of(one: dict[str, Any], other: dict[str, Any]) -> Iterator[tuple[Any, ...]]:
    """Give name, both values, and their ratio where both are in one unit."""
    from vasc.analysis.statistics import POWERS

    is_one_unit = one["length_unit"] == other["length_unit"]
    flat = [dict(flattened(numbers)) for numbers in (one, other)]
    for name in dict.fromkeys([*flat[0], *flat[1]]):
        values = flat[0].get(name), flat[1].get(name)
        has_unit = name.rpartition(".")[2] in POWERS
        are_numbers = all(isinstance(value, int | float) for value in values)
        ratio = None
        if are_numbers and values[0] and (is_one_unit or not has_unit) and name != "step":
            ratio = f"{values[1] / values[0]:.3f}"
        yield name, *values, ratio


def flattened(numbers: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Give names and values, those of a dictionary within as ``name.key``."""
    for key, value in numbers.items():
        if isinstance(value, dict):
            yield from flattened(value, f"{before}{key}.")
        else:
            yield before + key, value


def two_runs(one: Path, other: Path) -> dict[str, Any]:
    """Give the number of events of each kind in two runs, and where they first differ."""
    from vasc.timeline import Timeline
    from vasc.timeline.comparison import timeline_differences

    with Timeline(one) as first, Timeline(other) as second:
        counts = first.events.counts(), second.events.counts()
        event = first_event(first.events, second.events)
        differences = timeline_differences(first, second)
    kinds = dict.fromkeys([*counts[0], *counts[1]])
    found = None
    if differences:
        difference = differences[0]
        found = {name: getattr(difference, name) for name in WHERE}
        found |= {"a": difference.recorded, "b": difference.repeated}
    return {
        "events": {kind: [count.get(kind, 0) for count in counts] for kind in kinds},
        "first_event": event,
        "first_difference": found,
    }


def first_event(one: "Events", other: "Events") -> dict[str, Any] | None:
    """Give the first event at which the sequences of two runs part, None if they do not."""
    columns = [[events[name].tolist() for name in EVENT] for events in (one, other)]
    rows = (zip(*each, strict=True) for each in columns)
    for row, pair in enumerate(zip_longest(*rows)):
        if pair[0] != pair[1]:
            return {"row": row, "a": _named(pair[0], one), "b": _named(pair[1], other)}
    return None


def _named(event: tuple[int, ...] | None, events: "Events") -> dict[str, Any] | None:
    """Give an event with the name of its kind; None where a run has ended."""
    if event is None:
        return None
    found: dict[str, Any] = dict(zip(EVENT, event, strict=True))
    return found | {"kind": events.names.get(found["kind"], f"kind {found['kind']}")}


def said(difference: dict[str, Any] | None) -> str:
    """Say in one line where two runs first differ."""
    if difference is None:
        return "the two runs are the same, bit for bit"
    step, table, column, row = (difference[name] for name in WHERE)
    where = f"{table}/{column} row {row}" if table else column
    return f"first difference: step {step}, {where}: {difference['a']} and {difference['b']}"
