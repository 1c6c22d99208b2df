"""Tables of a timeline as data frames: codes as names, points as one column an axis."""

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.domain import Tissue
from vasc.fields import Fields, Role
from vasc.timeline import guard
from vasc.timeline.access import OpenFile
from vasc.timeline.frame import require
from vasc.timeline.layout import TABLES

AXES = {
    "position": ("x", "y", "z"),
    "material": ("x", "y", "z"),
    "nodes": ("proximal", "distal"),
}
"""Suffixes of the data frame columns that one column of points or pairs becomes."""


class Recorded(Protocol):
    """What a data frame needs of a timeline."""

    opened: OpenFile

    @property
    def frames(self) -> dict[str, NDArray]:
        """Columns of ``frames``."""

    @property
    def tissue(self) -> Tissue | None:
        """The cells, None in a run without."""

    def fields(self, step: int = -1) -> Fields:
        """Read the fields of a step."""

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table."""

    def table(self, name: str, column: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Read rows of a column."""


def data_frame(timeline: Recorded, name: str, step: int = -1) -> Any:
    """Give a table, ``frames``, or a step of a tissue, as a ``pandas.DataFrame`` by id.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    name : str
        Name of the table, or ``frames``, or ``cells`` or ``walls`` of a tissue.
    step : int
        The step that cells and walls are shown at, the last one when not given.

    Returns
    -------
    pandas.DataFrame
        One row a row of the table; empty if it has none.

    Raises
    ------
    TimelineError
        If there is no such table, no such step, or no tissue.
    VascError
        If pandas is not installed.
    """
    pandas = require("pandas", "tables")
    if name in ("cells", "walls"):
        return pandas.DataFrame(_tissue(timeline, name, step)).rename_axis("id")
    if name == "frames":
        columns = {key: rows for key, rows in timeline.frames.items() if key != "streams"}
    else:
        timeline.n_rows(name)
        columns = {column: timeline.table(name, column) for column in TABLES[name]}
    flat: dict[str, Any] = {}
    for key, rows in columns.items():
        words = guard.names(timeline.opened.item(f"{name}/{key}"))
        if words:
            values = pandas.Series(rows).map(words)
            flat[key] = values.astype(pandas.CategoricalDtype(list(words.values())))
        else:
            flat.update(_flat(key, rows))
    return pandas.DataFrame(flat).rename_axis("step" if name == "frames" else "id")


def _tissue(timeline: Recorded, name: str, step: int) -> dict[str, Any]:
    """Give the cells or walls of a tissue with their fields at a step."""
    fields, tissue = timeline.fields(step), timeline.tissue
    assert tissue is not None, "there are fields"
    if name == "cells":
        # a role that is not named is as it is
        words = {int(role): role.name.lower() for role in Role}
        roles = [words.get(code, str(code)) for code in fields.roles.tolist()]
        return {
            **_flat("position", tissue.positions),
            "volume": tissue.volumes,
            "concentration": fields.concentration,
            "role": roles,
        }
    return {
        "first": tissue.walls[:, 0],
        "second": tissue.walls[:, 1],
        "length": tissue.lengths,
        "distance": tissue.distances,
        "flux": fields.flux,
        "carriers_forth": fields.carriers[:, 0],
        "carriers_back": fields.carriers[:, 1],
    }


def _flat(key: str, rows: NDArray) -> dict[str, NDArray]:
    """Give one column a number of each row."""
    if rows.ndim == 1:
        return {key: rows}
    wide = rows.reshape(len(rows), int(np.prod(rows.shape[1:])))
    suffixes = AXES.get(key) or tuple(str(k) for k in range(wide.shape[1]))
    # points in the plane have no third axis
    return {f"{key}_{suffix}": wide[:, k] for k, suffix in enumerate(suffixes[: wide.shape[1]])}
