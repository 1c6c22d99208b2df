"""What the columns of exported tables hold: meaning, unit, words, and what stands for null."""

from collections.abc import Mapping
from typing import Any

from vasc.arrays import Column
from vasc.state import table_columns
from vasc.timeline.layout import NAMES, Motion, frame_columns

AT_STEP: dict[str, dict[str, Column]] = {
    "nodes": {
        **{axis: Column("f8", "position at the step exported", "length") for axis in "xyz"},
        "radius": Column("f8", "half the width of its widest segment at that step", "length"),
    },
    "segments": {
        "vein_birth": Column("i4", "step in which the vein in it grew"),
        "source": Column("i4", "source that caused the vein in it, -1 if none"),
        "order": Column("i4", "vein order at the step exported, from 1"),
        "branching_order": Column("i4", "veins initiated on the way from a seed, from 1"),
        "gravelius_order": Column("i4", "order by what is carried at the step exported, from 1"),
        "width": Column("f8", "width at the step exported", "length"),
        "length": Column("f8", "length at the step exported", "length"),
    },
}
"""Columns beyond those of a run's tables; empty for what refinement has replaced by then."""
IN_WORDS = {
    ("nodes", "origin"): "how it came to be",
    ("segments", "birth"): "step in which growth or refinement made this segment",
    ("segments", "kind"): "how it came to be",
    ("sources", "cause"): "why it appeared",
    ("states", "what"): "what changed its state",
    ("events", "subject"): "row of what it happened to; of run_finished, the reason; -1 if none",
}
"""Meanings of columns that the tables of a run tell otherwise, as by their codes."""
COUNTED_IN_STEPS = ("step", "birth", "vein_birth")


def described(table: str, column: str, unit: str, time_unit: str) -> dict[str, Any]:
    """Describe one column of an exported table.

    Parameters
    ----------
    table, column : str
        Their names in the export.
    unit, time_unit : str
        What lengths and times are in.

    Returns
    -------
    dict
        ``name`` and ``dc:description``; ``unit`` of lengths, times and steps; ``datatype`` of a
        column of words, whose ``format`` names them; ``null``, the cells that mean none.
    """
    if column == "id" and table != "states":
        return {"name": column, "dc:description": "row of the table, never reused"}
    key, of_table = column, {**_columns(table), **AT_STEP.get(table, {})}
    if column not in of_table:
        key = column.rpartition("_")[0]
    meant = of_table[key]
    found = {"name": column, "dc:description": IN_WORDS.get((table, key), meant.meaning)}
    if key != column:
        found["dc:description"] += f": {column.rpartition('_')[2]}"
    if meant.unit == "length":
        found["unit"] = unit
    elif meant.unit == "time":
        found["unit"] = time_unit
    elif column in COUNTED_IN_STEPS:
        found["unit"] = "steps"
    words = () if (table, key) == ("events", "subject") else _words(table, key)
    if words:
        return {**found, "datatype": {"base": "string", "format": "|".join(words)}}
    nulls = ["-1"] if "-1" in found["dc:description"] else []
    # at the step exported, what refinement has replaced is nowhere
    nulls += [""] if column in AT_STEP.get(table, {}) else []
    return {**found, "null": nulls} if nulls else found


def _columns(table: str) -> Mapping[str, Column]:
    """Give the columns of a table of a run."""
    return frame_columns(0, Motion.NONE) if table == "frames" else table_columns(3)[table]


def _words(table: str, column: str) -> tuple[str, ...]:
    """Give the words that stand for the codes of a column, each once."""
    kinds = NAMES.get((table, column), {}).values()
    return tuple(dict.fromkeys(code.name.lower() for kind in kinds for code in kind))
