"""The table of a sweep: one row a run, made from the results at any time."""

import csv
import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.work import MISSING
from vasc.whole_files import write_whole

TABLE = "results.csv"


def write_table(folder: SweepFolder) -> Path:
    """Write the table of a sweep anew.

    Parameters
    ----------
    folder : SweepFolder
        The folder, with any part of the results.

    Returns
    -------
    Path
        The table. Its columns are ``run``, the varied keys, ``draw`` if keys are drawn,
        ``replicate``, ``seed``, ``status`` (done, failed or missing), ``error``, and the measures.
        What a run does not have is empty.

    Raises
    ------
    OSError
        If it cannot be written.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    header, rows = table_of(folder)
    writer.writerow(header)
    writer.writerows([_cell(value) for value in row] for row in rows)
    path = folder.path / TABLE
    write_whole(path, text.getvalue())
    return path


def table_of(folder: SweepFolder) -> tuple[list[str], list[list[Any]]]:
    """Give the names of the columns and the rows of the table, with plain values."""
    sweep = folder.description()["sweep"]
    keys, measures = [*sweep["axes"], *sweep["random"]], sweep["measures"]
    draw = ["draw"] if sweep["random"] else []
    header = ["run", *keys, *draw, "replicate", "seed", "status", "error", *measures]
    rows = []
    for run in folder.planned():
        found = folder.result(run.number) or {"status": MISSING, "error": "", "measures": {}}
        rows.append(
            [
                run.number,
                *(run.values[key] for key in keys),
                *([run.draw] if draw else []),
                run.replicate,
                run.seed,
                found["status"],
                found["error"],
                *(found["measures"].get(name) for name in measures),
            ]
        )
    return header, rows


def _cell(value: Any) -> str:
    """Write a value as all readers of tables understand it; a number keeps all its digits."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return " ".join(value.split())
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, Sequence) and all(isinstance(item, int | float | str) for item in value):
        return " ".join(_cell(item) for item in value)
    return json.dumps(value, sort_keys=True)
