"""``vasc lineage``: where a vein came from, and what became of a source or an areole."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from vasc.cli.options import AsJson, RunFile

if TYPE_CHECKING:
    from vasc.timeline import Timeline

LONGEST_LIST = 12
"""Ids of a list that are shown to people; JSON holds all."""


EXAMPLES = (
    "vasc lineage poplar-leaf.h5 --node 1000",
    "vasc lineage poplar-leaf.h5 --source 10 --json",
    "vasc lineage arabidopsis-first-leaf.h5 --areole 0",
)


def lineage(
    path: RunFile,
    node: Annotated[int | None, typer.Option("--node", min=0, help="A vein node.")] = None,
    source: Annotated[int | None, typer.Option("--source", min=0, help="An auxin source.")] = None,
    areole: Annotated[int | None, typer.Option("--areole", min=0, help="An areole.")] = None,
    as_json: AsJson = False,
) -> None:
    """Tell where a vein node came from, or what became of a source or an areole."""
    from vasc.cli.printing import print_json, print_pairs
    from vasc.timeline import Timeline

    with Timeline(path) as timeline:
        asked = [
            (tell, row)
            for tell, row in ((node_lineage, node), (source_fate, source), (areole_fate, areole))
            if row is not None
        ]
        if len(asked) != 1:
            raise typer.BadParameter("give one of --node ID, --source ID and --areole ID")
        tell, row = asked[0]
        found = tell(timeline, row)
    if as_json:
        print_json(found)
    else:
        print_pairs({name: _shortened(value) for name, value in found.items()})


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
    """Give what became of an areole, in JSON values; what did not happen is None."""
    fate = timeline.lineage.areole(areole)
    areas = timeline.areole_areas()
    own = areas["area"][areas["areole"] == areole].tolist()
    return {
        "areole": areole,
        "birth": fate.birth,
        "segment": fate.segment,
        "parent": _known(fate.parent),
        "ancestors": list(fate.ancestors),
        "split": _known(fate.split),
        "children": list(fate.children),
        "sources": fate.sources.tolist(),
        "drained": [_known(step) for step in fate.drained.tolist()],
        "blind_ends": fate.blind_ends.tolist(),
        "area_at_birth": own[0] if own else None,
        "area_at_end": own[-1] if own else None,
    }


def _known(number: int) -> int | None:
    """Give None for the null of a table."""
    return None if number < 0 else int(number)


def _shortened(value: Any) -> Any:
    """Give a long list as its number and its first entries."""
    if not isinstance(value, list):
        return value
    if value and isinstance(value[0], float):
        return ", ".join(f"{number:.6g}" for number in value)
    first = ", ".join(str(number) for number in value[:LONGEST_LIST])
    more = ", ..." if len(value) > LONGEST_LIST else ""
    return f"{len(value):,}" + (f": {first}{more}" if value else "")
