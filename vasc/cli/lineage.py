"""``vasc lineage``: where a vein came from, and what became of a source or an areole."""

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any

import typer

from vasc.cli.options import AsJson, RunFile

if TYPE_CHECKING:
    from vasc.timeline import Timeline
    from vasc.timeline.areole_lineage import AreoleFate

LONGEST_LIST = 12
"""Ids of a list that are shown to people; JSON holds all."""

LISTED = {
    "--node": {"ancestors": "node", "descendants": "node"},
    "--source": {"awaited_nodes": "node", "joins": "segment", "nodes": "node"},
    "--areole": {
        "ancestors": "areole",
        "children": "areole",
        "sources": "source",
        "drained": "step",
        "blind_ends": "node",
    },
    "--loop": {"ancestors": "areole"},
    "--at": {"areoles": "areole", "areole_births": "step"},
}
"""What the numbers of the lists in an answer are."""

OPTIONS = {"areoles": "--genealogy"}
"""Options whose table is called otherwise."""

EXAMPLES = (
    "vasc lineage poplar-leaf.h5 --node 1000",
    "vasc lineage poplar-leaf.h5 --source 10 --json",
    "vasc lineage arabidopsis-first-leaf.h5 --areole 0",
    "vasc lineage poplar-leaf.h5 --competitors 10",
    "vasc lineage poplar-leaf.h5 --life-table --csv",
    "vasc lineage poplar-leaf.h5 --at 20,150",
)

# short names of what the options below are
Node = typer.Option("--node", min=0, help="A vein node: its descent.")
Source = typer.Option("--source", min=0, help="An auxin source: what became of it.")
Areole = typer.Option("--areole", min=0, help="An areole: where it came from, how it was split.")
Loop = typer.Option("--loop", min=0, help="A vein node: the loop in which its vein lies.")
At = typer.Option("--at", metavar="X,Y", help="A place, in D: its vein, source and areoles.")
Competitors = typer.Option("--competitors", min=0, help="A source: the veins it ever attracted.")
LifeTable = typer.Option("--life-table", help="Survival of sources against age.")
Fates = typer.Option("--fates", help="What became of every source.")
Births = typer.Option("--births", help="When veins of each order were born; all, as CSV or JSON.")
Genealogy = typer.Option("--genealogy", help="Which areole was split from which.")


def lineage(
    path: RunFile,
    node: Annotated[int | None, Node] = None,
    source: Annotated[int | None, Source] = None,
    areole: Annotated[int | None, Areole] = None,
    loop: Annotated[int | None, Loop] = None,
    at: Annotated[str | None, At] = None,
    step: Annotated[
        int | None, typer.Option("--step", min=-1, help="The step of --at; the last if left out.")
    ] = None,
    competitors: Annotated[int | None, Competitors] = None,
    life_table: Annotated[bool, LifeTable] = False,
    fates: Annotated[bool, Fates] = False,
    births: Annotated[bool, Births] = False,
    genealogy: Annotated[bool, Genealogy] = False,
    limit: Annotated[
        int | None, typer.Option("--limit", min=0, help="At most that many rows of a table.")
    ] = None,
    as_csv: Annotated[bool, typer.Option("--csv", help="Write a table as CSV.")] = False,
    as_json: AsJson = False,
) -> None:
    """Tell where a vein node came from, what became of a source or an areole; tables of all."""
    from vasc.cli import lineage_tables
    from vasc.cli.printing import print_json, print_pairs
    from vasc.timeline import Timeline

    ids: tuple[tuple[str, Callable[..., dict[str, Any]], Any], ...] = (
        ("--node", node_lineage, node),
        ("--source", source_fate, source),
        ("--areole", areole_fate, areole),
        ("--loop", vein_loop, loop),
        ("--at", partial(history, step=-1 if step is None else step), at),
    )
    flags = {
        "life_table": life_table,
        "fates": fates,
        "births": births,
        "areoles": genealogy,
        "competitors": competitors is not None,
    }
    answers = {name: (tell, value) for name, tell, value in ids if value is not None}
    tables = [name for name, is_asked in flags.items() if is_asked]
    options = [OPTIONS.get(name, "--" + name.replace("_", "-")) for name in tables]
    _check_choice([*answers, *options])
    if step is not None and at is None:
        raise typer.BadParameter("--step is for --at")
    if as_csv and (as_json or answers):
        raise typer.BadParameter("--csv is for tables, and excludes --json")
    with Timeline(path) as timeline:
        # refuses a run without a step
        timeline.frame()
        if tables:
            table = lineage_tables.asked_for(timeline, tables[0], competitors)
            lineage_tables.write(tables[0], table, limit, as_csv=as_csv, as_json=as_json)
            return
        ((asked, (tell, value)),) = answers.items()
        found = tell(timeline, value)
    if as_json:
        print_json(found)
    else:
        kinds = LISTED[asked]
        print_pairs({name: _shortened(value, kinds.get(name)) for name, value in found.items()})


def _check_choice(given: list[str]) -> None:
    """Refuse no question and more than one, and tell which there are."""
    if len(given) > 1:
        raise typer.BadParameter(f"{' and '.join(given)} are questions of their own: give one")
    if not given:
        raise typer.BadParameter(
            "give one of --node ID, --source ID, --areole ID, --loop NODE, --at X,Y, or a table:"
            " --fates, --life-table, --births, --genealogy, --competitors SOURCE;"
            " for example: vasc lineage RUN.h5 --life-table"
        )


def history(timeline: "Timeline", at: str, step: int) -> dict[str, Any]:
    """Give what is at a place and how it came to be, in JSON values; null is None."""
    from dataclasses import asdict

    words = at.split(",")
    try:
        x, y = (float(word) for word in words)
    except ValueError:
        x = y = math.nan
    if not (math.isfinite(x) and math.isfinite(y)):
        raise typer.BadParameter(f"--at {at!r}: must be two numbers X,Y, in D, as 12.5,80")
    found = asdict(timeline.lineage.at(x, y, step))
    lists = {name: list(found[name]) for name in ("place", "areoles", "areole_births")}
    return {
        name: lists.get(name, _known(value) if isinstance(value, int) else value)
        for name, value in found.items()
    }


def node_lineage(timeline: "Timeline", node: int) -> dict[str, Any]:
    """Give the descent of a node, in JSON values; null is None."""
    lineage = timeline.lineage
    ancestors, descendants = lineage.ancestors(node), lineage.descendants(node)
    one = (node, node + 1)
    position = timeline.table("nodes", "position", *one)[0].tolist()
    return {
        "node": node,
        "birth": int(timeline.table("nodes", "birth", *one)[0]),
        "position_at_birth": position,
        "parent": _known(ancestors[0]) if len(ancestors) else None,
        "seed": int(ancestors[-1]) if len(ancestors) else node,
        "source": _known(lineage.source_of(node)),
        "ancestors": ancestors.tolist(),
        "descendants": descendants.tolist(),
    }


def source_fate(timeline: "Timeline", source: int) -> dict[str, Any]:
    """Give what became of a source, in JSON values; what did not happen is None."""
    fate = timeline.lineage.fate_of(source)
    position = timeline.table("sources", "position", source, source + 1)[0].tolist()
    return {
        "source": source,
        "birth": fate.birth,
        "position_at_birth": position,
        "tagged": _known(fate.tagged),
        "removed": _known(fate.removed),
        "nearest_node": _known(fate.nearest),
        "awaited_nodes": fate.tags.tolist(),
        "joins": fate.joins.tolist(),
        "nodes": fate.nodes.tolist(),
    }


def areole_fate(timeline: "Timeline", areole: int) -> dict[str, Any]:
    """Give what became of an areole, in JSON values; what did not happen is None.

    So is what the model does not record: sources in areoles, where it knows of no areoles.
    """
    fate = timeline.lineage.areole(areole)
    return {
        "areole": areole,
        "birth": fate.birth,
        "segment": fate.segment,
        "parent": _known(fate.parent),
        "ancestors": list(fate.ancestors),
        "split": _known(fate.split),
        "children": list(fate.children),
        "sources": None if fate.sources is None else fate.sources.tolist(),
        "drained": None
        if fate.drained is None
        else [_known(step) for step in fate.drained.tolist()],
        "blind_ends": None if fate.blind_ends is None else fate.blind_ends.tolist(),
        **_areas(timeline, fate),
    }


def vein_loop(timeline: "Timeline", node: int) -> dict[str, Any]:
    """Give the loop in which the vein of a node lies, in JSON values; open tissue is None."""
    found = timeline.lineage.loop_of(node)
    return {
        "node": node,
        "vein": found.vein,
        "branching_order": found.branching_order,
        "areole": _known(found.areole),
        "first_order_loop": _known(found.first_order),
        "ancestors": list(found.ancestors),
    }


def _areas(timeline: "Timeline", fate: "AreoleFate") -> dict[str, float | None]:
    """Give the area of an areole when it was born and when it was last whole."""
    from vasc.timeline.areas import area_of

    last = timeline.last_step if fate.split < 0 else fate.split - 1
    # a part may be split in the step in which it is born; and not all models record areoles
    if last < fate.birth or not timeline.n_rows("areoles"):
        return {"area_at_birth": None, "area_at_end": None}
    steps = {"area_at_birth": fate.birth, "area_at_end": last}
    return {name: area_of(timeline, fate.areole, step) for name, step in steps.items()}


def _known(number: int) -> int | None:
    """Give None for the null of a table."""
    return None if number < 0 else int(number)


def _shortened(value: Any, kind: str | None) -> Any:
    """Give a list of ids or steps as what they are, how many, and the first of them."""
    if value is None and kind is not None:
        return "not recorded"
    if not isinstance(value, list):
        return value
    if kind is None:
        return ", ".join(f"{number:.6g}" for number in value)
    if not value:
        return "none"
    first = ", ".join("-" if one is None else str(one) for one in value[:LONGEST_LIST])
    if len(value) == 1:
        return f"{kind} {first}"
    more = ", ..." if len(value) > LONGEST_LIST else ""
    return f"{len(value):,} {kind}s: {first}{more}"
