"""The tables of a run: as data frames, or as a folder of CSV files."""

import csv
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.tissue_units import time_unit
from vasc.export.descriptions import described
from vasc.export.specimen import Specimen, specimen
from vasc.state import table_columns
from vasc.states import Kind
from vasc.timeline import Frame, Motion, Timeline, guard
from vasc.timeline.frame import require
from vasc.timeline.layout import frame_columns

TABLES = ("frames", "nodes", "segments", "sources", "events", "areoles", "states")
"""What is exported; each is one CSV file."""
DESCRIPTION = "csv-metadata.json"
"""The file that says what the others hold, as the standard "CSV on the Web" has it."""
WITHOUT_ID = ("frames", "states")
"""Tables to whose rows nothing refers: frames go by their step, states say whose they are."""
AXES = {
    "position": ("x", "y", "z"),
    "material": ("x", "y", "z"),
    "nodes": ("proximal", "distal"),
}
"""What one column of points or pairs becomes."""


def columns_of(timeline: Timeline, step: int = -1) -> dict[str, dict[str, NDArray]]:
    """Give the tables of a run as they were at a step.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    step : int
        A recorded step; -1 is the last.

    Returns
    -------
    dict of str to dict of str to ndarray
        For each of ``TABLES`` its columns. Codes are names, points one column an axis, lengths
        in the unit of the run; -1 is null.

    Raises
    ------
    TimelineError
        If the step was not recorded, or cannot be read.
    """
    return _columns_with(timeline, specimen(timeline, step))


def data_frames(timeline: Timeline, step: int = -1) -> dict[str, Any]:
    """Give the tables of a run as they were at a step, as ``pandas.DataFrame``.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    step : int
        A recorded step; -1 is the last.

    Returns
    -------
    dict of str to pandas.DataFrame
        What :func:`columns_of` gives; the index is the id, of frames the step. The ``id`` of states
        is that of the node or source.

    Raises
    ------
    TimelineError
        If the step was not recorded, or cannot be read.
    VascError
        If pandas is not installed.
    """
    pandas = require("pandas", "tables")
    found = {}
    for name, columns in columns_of(timeline, step).items():
        frame = pandas.DataFrame(columns)
        if name == "frames":
            frame = frame.set_index("step")
        found[name] = frame if name in WITHOUT_ID else frame.rename_axis("id")
    return found


def write_tables(timeline: Timeline, folder: Path, step: int = -1) -> None:
    """Fill a folder with the tables of a run, and a description of them.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    folder : Path
        An empty folder.
    step : int
        A recorded step; -1 is the last.

    Raises
    ------
    TimelineError
        If the step was not recorded, or cannot be read.
    """
    exported = specimen(timeline, step)
    files, times = [], time_unit(timeline.config)
    for name, columns in _columns_with(timeline, exported).items():
        n_rows = len(next(iter(columns.values())))
        numbered = columns if name in WITHOUT_ID else {"id": np.arange(n_rows), **columns}
        with (folder / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(numbered)
            writer.writerows(zip(*(_cells(rows) for rows in numbered.values()), strict=True))
        columns_of_file = [
            described(name, column, exported.unit.name, times) for column in numbered
        ]
        files.append({"url": f"{name}.csv", "tableSchema": {"columns": columns_of_file}})
    about = {
        "@context": "http://www.w3.org/ns/csvw",
        "dc:title": exported.heading[0],
        "dc:description": "; ".join(exported.heading[1:]),
        "tables": files,
    }
    text = json.dumps(about, indent=1) + "\n"
    (folder / DESCRIPTION).write_text(text, encoding="utf-8")


def _columns_with(timeline: Timeline, exported: Specimen) -> dict[str, dict[str, NDArray]]:
    """Give all tables, with what the step exported adds to them."""
    n_frames = exported.step + 1
    tables = {"frames": {key: timeline.frames[key][:n_frames] for key in _frame_names()}}
    tables |= {name: _table(timeline, name, exported) for name in TABLES[1:]}
    places = zip(exported.axes, exported.positions.T, strict=True)
    at_step = {
        "nodes": (exported.ids, {**dict(places), "radius": exported.radii}),
        "segments": (
            exported.segment_ids,
            {
                "vein_birth": exported.vein_births,
                "source": exported.segment_causes,
                "order": exported.orders,
                "branching_order": exported.branching_orders,
                "gravelius_order": exported.gravelius_orders,
                "width": exported.widths,
                "length": exported.lengths,
            },
        ),
    }
    for name, (ids, added) in at_step.items():
        n_rows = len(tables[name]["birth"])
        tables[name] |= {key: _spread(values, ids, n_rows) for key, values in added.items()}
    return tables


def _frame_names() -> list[str]:
    """Give the columns of frames that are numbers."""
    return [name for name, column in frame_columns(0, Motion.NONE).items() if not column.shape]


def _table(timeline: Timeline, name: str, exported: Specimen) -> dict[str, NDArray]:
    """Give a table of a run: codes as names, points as one column an axis."""
    frame = timeline.frame(exported.step)
    flat: dict[str, NDArray] = {}
    for key, column in table_columns(timeline.dimensions)[name].items():
        rows = frame.rows(name, key)
        words = guard.names(timeline.opened.item(f"{name}/{key}"))
        if words:
            flat[key] = _words(rows, words)
        elif rows.ndim == 1:
            flat[key] = rows
        else:
            scale = exported.unit.per_segment if column.unit == "length" else 1
            parts = zip(AXES[key], rows.T, strict=False)
            flat |= {f"{key}_{axis}": part * scale for axis, part in parts}
    if name == "states":
        flat["state"] = _state_words(timeline, frame)
    return flat


def _state_words(timeline: Timeline, frame: Frame) -> NDArray:
    """Give the names of states, which differ between nodes, sources and canals."""
    subjects, states = frame.rows("states", "what"), frame.rows("states", "state")
    found = np.full(len(states), "", dtype=object)
    for kind in Kind:
        words = guard.names(timeline.opened.item("states/state"), f"{kind.name.lower()}_")
        is_such = subjects == kind
        found[is_such] = _words(states[is_such], words)
    return found


def _words(codes: NDArray, words: Mapping[int, str]) -> NDArray:
    """Give the names of codes; one without a name stays a number."""
    return np.array([words.get(code, str(code)) for code in codes.tolist()], dtype=object)


def _spread(values: NDArray, ids: NDArray, n_rows: int) -> NDArray:
    """Give values by id, nan for the others; numbers that are whole stay so if all are there."""
    if len(ids) == n_rows:
        return values
    found = np.full(n_rows, np.nan)
    found[ids] = values
    return found


def _cells(values: NDArray) -> list[Any]:
    """Give the cells of a column; an empty one for nan."""
    return ["" if value != value else value for value in values.tolist()]
