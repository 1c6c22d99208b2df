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
        names = {"a": str(one), "b": str(other)}
        apart = on_different_areas(*columns)
        print_json(names | {"statistics": columns, "on_different_areas": apart, "runs": runs})
        return
    header = ("", "unit", f"a: {one}", f"b: {other}", "b / a", "n of a", "n of b")
    print_table(header, rows_of(*columns))
    if apart := on_different_areas(*columns):
        typer.echo(
            f"\non different areas, the blade and what veins enclose: {', '.join(apart)};"
            "\ncompare enclosed_vein_density and enclosed_density_x_sqrt_areole instead"
        )
    if runs is not None:
        typer.echo()
        counts = [(kind, *pair) for kind, pair in runs["events"].items()]
        print_table(("events", str(one), str(other)), counts)
        typer.echo(f"\n{said(runs['first_difference'])}")
        if parting := runs["first_event"]:
            values = (" ".join(map(str, (parting[run] or {}).values())) for run in "ab")
            typer.echo(f"first event that differs: {' | '.join(value or '-' for value in values)}")


def rows_of(one: dict[str, Any], other: dict[str, Any]) -> Iterator[tuple[Any, ...]]:
    """Give name, unit, both values, their ratio where it has a meaning, and of how many each is."""
    from vasc.analysis.statistics import POWERS, flattened

    units = [numbers["length_unit"] for numbers in (one, other)]
    apart = on_different_areas(one, other)
    flat = [dict(flattened(numbers)) for numbers in (one, other)]
    for name in in_order([*flat[0], *flat[1]]):
        key = name.rpartition(".")[2]
        values = flat[0].get(name), flat[1].get(name)
        is_comparable = name not in apart and (units[0] == units[1] or key not in POWERS)
        are_numbers = all(isinstance(value, int | float) for value in values)
        ratio = None
        if are_numbers and values[0] and is_comparable and name != "step":
            ratio = f"{values[1] / values[0]:.3f}"
        counts = (_sample(numbers, name) for numbers in flat)
        yield name, _units(key, units), *values, ratio, *counts


def in_order(names: list[str]) -> list[str]:
    """Give each name once: as they come, but kin together, and numbered kin by number.

    Examples
    --------
    >>> in_order(["orders.1", "orders.3", "cycles", "orders.2", "streams.1"])
    ['orders.1', 'orders.2', 'orders.3', 'cycles', 'streams.1']
    """
    beginnings = (name.split(".")[: k + 1] for name in names for k in range(name.count(".") + 1))
    ranks = {tuple(one): rank for rank, one in reversed(list(enumerate(beginnings)))}

    def place(name: str) -> list[int]:
        words = name.split(".")
        ranked = enumerate(words, start=1)
        return [int(word) if word.isdigit() else ranks[tuple(words[:k])] for k, word in ranked]

    return sorted(dict.fromkeys(names), key=place)


def on_different_areas(one: dict[str, Any], other: dict[str, Any]) -> list[str]:
    """Give the numbers that are of a blade on one side and of the enclosed area on the other."""
    from vasc.analysis.statistics import ON_TISSUE

    # a stem has none of them
    has_blade = [numbers["blade_area"] is not None for numbers in (one, other)]
    return [key for key in one if key in ON_TISSUE] if has_blade[0] != has_blade[1] else []


def _units(key: str, units: list[str | None]) -> str | None:
    """Give the unit of a number on both sides, once if it is the same."""
    from vasc.analysis.statistics import unit_of

    return " | ".join(dict.fromkeys(unit_of(key, unit or "?") for unit in units)) or None


def _sample(flat: dict[str, Any], name: str) -> int | None:
    """Give over how many things a number is taken, None where it is no mean."""
    from vasc.analysis.statistics import SAMPLES

    before, dot, key = name.rpartition(".")
    if key not in SAMPLES or flat.get(name) is None:
        return None
    found: int | None = flat.get(before + dot + SAMPLES[key])
    return found


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
