"""Tissues in a timeline: cells and walls written once, fields step by step."""

import shutil
from math import prod
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vasc.domain import Blade, Tissue
from vasc.errors import OutputError, TimelineError
from vasc.fields import FIELD_COLUMNS, Fields
from vasc.timeline.access import OpenFile
from vasc.timeline.layout import FIELDS, TISSUE, rows_a_step

ARRAYS = {
    "position": "positions",
    "volume": "volumes",
    "walls": "walls",
    "length": "lengths",
    "distance": "distances",
    "corners": "corners",
    "starts": "starts",
}
"""Names in the group ``tissue``, and those of the attributes of a tissue."""


LEAST_STEPS = 100
"""Steps that the disk must have room for: a round of sources takes about as many."""


class RecordedPast:
    """Earlier steps of a tissue, for a model that goes on from a record.

    Parameters
    ----------
    opened : OpenFile
        The open file; it must not be closed before it is asked.
    """

    def __init__(self, opened: OpenFile) -> None:
        self._opened = opened

    def fields(self, step: int) -> Fields:
        """Give the fields of a recorded step."""
        return read_fields(self._opened, step)

    def time(self, step: int) -> float:
        """Give the time of a recorded step."""
        return float(self._opened.read("frames/time", step, step + 1)[0])


def arrays_of(tissue: Tissue) -> dict[str, NDArray]:
    """Give the arrays of a tissue by their path in the file."""
    return {f"{TISSUE}/{name}": getattr(tissue, own) for name, own in ARRAYS.items()}


def n_bytes_a_step(n_cells: int, n_walls: int) -> int:
    """Give the bytes that the fields of a step take before they are compressed."""
    return sum(
        rows_a_step(name, n_cells, n_walls) * np.dtype(column.dtype).itemsize * prod(column.shape)
        for name, column in FIELD_COLUMNS.items()
    )


def check_room(path: Path, tissue: Tissue) -> None:
    """Refuse to record a tissue of which the disk cannot hold a short run.

    Raises
    ------
    OutputError
        If fewer than ``LEAST_STEPS`` steps fit.
    """
    n_cells, n_walls = tissue.n_cells, tissue.n_walls
    n_bytes = n_bytes_a_step(n_cells, n_walls)
    free = shutil.disk_usage(path.absolute().parent)[2]
    if free < LEAST_STEPS * n_bytes:
        raise OutputError(
            f"{path}: the disk has no room for it: each step of domain, {n_cells:,} cells and"
            f" {n_walls:,} walls, takes up to {n_bytes:,} bytes, and {free:,} are free; at least"
            f" {LEAST_STEPS} steps must fit"
        )


def read_tissue(opened: OpenFile, blade: Blade) -> Tissue:
    """Read the cells and walls of a run.

    Parameters
    ----------
    opened : OpenFile
        The open file.
    blade : Blade
        The outline around them.

    Raises
    ------
    TimelineError
        If arrays are missing, do not fit each other, or lead to cells that are none.
    """
    arrays = {name: opened.read_array(f"{TISSUE}/{name}") for name in ARRAYS}
    problem = misfit(arrays)
    if problem is not None:
        raise TimelineError(f"{opened.path}: {problem}")
    return Tissue(**{own: arrays[name] for name, own in ARRAYS.items()}, blade=blade)


def misfit(arrays: dict[str, NDArray]) -> str | None:
    """Say why arrays make no tissue, None if they do: sizes, walls and corners must fit."""
    n_cells, n_walls = len(arrays["position"]), len(arrays["walls"])
    sizes = {"volume": n_cells, "length": n_walls, "distance": n_walls, "starts": n_cells + 1}
    for name, size in sizes.items():
        if len(arrays[name]) != size:
            return f"{TISSUE}/{name} has {len(arrays[name])} rows; {size} are needed"
    walls, starts = arrays["walls"], arrays["starts"]
    is_bad = (walls[:, 0] < 0) | (walls[:, 0] >= walls[:, 1]) | (walls[:, 1] >= n_cells)
    if is_bad.any():
        row = int(np.flatnonzero(is_bad)[0])
        return (
            f"{TISSUE}/walls: row {row} is {walls[row].tolist()}; two of {n_cells} cells are"
            " needed, the lower first"
        )
    if starts[0] != 0 or starts[-1] != len(arrays["corners"]) or (np.diff(starts) < 3).any():
        return f"{TISSUE}/starts does not divide the corners: at least 3 a cell are needed"
    return None


def read_fields(opened: OpenFile, step: int) -> Fields:
    """Read the fields of a recorded step.

    Raises
    ------
    TimelineError
        If the run has no cells, or rows cannot be read.
    """
    found = opened.found
    if not found.has_tissue:
        raise TimelineError(f"{opened.path}: has no tissue, so that there are no fields")
    parts = {}
    for name in FIELD_COLUMNS:
        size = found.rows_a_step(name)
        parts[name] = opened.read(f"{FIELDS}/{name}", step * size, (step + 1) * size)
    return Fields(**parts)
