"""What two runs, or one that is repeated, give differently, column by column, bit by bit."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.fields import FIELD_COLUMNS
from vasc.state import TABLE_COLUMNS, Places, State
from vasc.timeline.layout import (
    DIMENSIONS,
    FIELDS,
    MOTION,
    STEM_RING,
    TISSUE,
    Motion,
    count_column,
    motion_of,
)
from vasc.timeline.outlines import arrays_of_blade
from vasc.timeline.reader import Timeline
from vasc.timeline.tissues import arrays_of

FRAME_COLUMNS = ("time", "motion", "outline_motion")
"""Columns of ``frames`` that a state gives under the same name, if at all."""


class Difference(NamedTuple):
    """The first value of a column that a second run gives differently.

    The row is -1 when a whole is compared. In the table ``motion``, of explicit
    positions, and in that of the ``fields`` of a tissue, it is counted from the first row
    of the step.
    """

    step: int
    table: str
    column: str
    row: int
    recorded: str
    repeated: str


def compare_places(timeline: Timeline, state: State, found: dict[str, Difference]) -> None:
    """Compare the explicit positions of a step; the first difference of each kind is added."""
    if state.places is None or timeline.motion != Motion.EXPLICIT:
        return
    for name in (one for one in Places._fields if one not in found):
        recorded, repeated = timeline.places(name, state.step), getattr(state.places, name)
        steps = np.full(max(len(recorded), len(repeated)), state.step)
        for difference in _difference("motion", name, recorded, repeated, steps):
            found[name] = difference


def compare_fields(timeline: Timeline, state: State, found: dict[str, Difference]) -> None:
    """Compare the fields of a step; the first difference of each is added."""
    if state.fields is None or timeline.tissue is None:
        return
    fields = timeline.fields(state.step)
    for name in (one for one in FIELD_COLUMNS if one not in found):
        recorded, repeated = getattr(fields, name), getattr(state.fields, name)
        steps = np.full(max(len(recorded), len(repeated)), state.step)
        for difference in _difference(FIELDS, name, recorded, repeated, steps):
            found[name] = difference


def blade_differences(timeline: Timeline, state: State) -> Iterator[Difference]:
    """Compare the blade at step 0, and its seeds."""
    if timeline.dimensions != 2 or state.blade is None:
        return
    for path, rows in arrays_of_blade(state.blade).items():
        table, _, column = path.partition("/")
        recorded = timeline.opened.read_array(path)
        steps = np.zeros(max(len(rows), len(recorded)), dtype=np.int64)
        yield from _difference(table, column, recorded, rows, steps)


def length_differences(timeline: Timeline) -> Iterator[Difference]:
    """Compare how many steps are counted with how many the sessions say they recorded."""
    said = [session.get("last_step") for session in timeline.provenance]
    n_said = 1 + max((last for last in said if isinstance(last, int)), default=-1)
    if n_said > timeline.n_frames:
        counted = f"{timeline.n_frames} steps"
        yield Difference(timeline.n_frames, "", "committed", -1, counted, f"{n_said} steps")


def form_differences(timeline: Timeline, state: State) -> Iterator[Difference]:
    """Compare the dimensions, the motion, the ring at the base of a stem, and the cells."""
    for name, recorded, repeated in (
        (DIMENSIONS, timeline.dimensions, state.dimensions),
        (MOTION, timeline.motion, motion_of(state)),
        (TISSUE, int(timeline.tissue is not None), int(state.tissue is not None)),
    ):
        if recorded != repeated:
            yield Difference(0, "", name, -1, str(recorded), str(repeated))
    if timeline.dimensions == state.dimensions and state.base_ring is not None:
        table, _, column = STEM_RING.partition("/")
        rings = timeline.base_ring, state.base_ring
        steps = np.zeros(max(map(len, rings)), dtype=np.int64)
        yield from _difference(table, column, *rings, steps)
    if timeline.tissue is not None and state.tissue is not None:
        again = arrays_of(state.tissue)
        for path, rows in arrays_of(timeline.tissue).items():
            steps = np.zeros(max(len(rows), len(again[path])), dtype=np.int64)
            yield from _difference(TISSUE, path.partition("/")[2], rows, again[path], steps)


def frame_differences(timeline: Timeline, repeated: dict[str, NDArray]) -> Iterator[Difference]:
    """Compare the columns of ``frames``."""
    recorded = timeline.frames
    # only an affine motion has maps
    for name in (one for one in ("streams", *FRAME_COLUMNS) if one in recorded and one in repeated):
        steps = np.arange(max(len(recorded[name]), len(repeated[name])))
        yield from _difference("frames", name, recorded[name], repeated[name], steps)
    for index, table in enumerate(TABLE_COLUMNS):
        if table == "perceived" and not timeline.records_perceived:
            continue
        counts, column = repeated["counts"][:, index], f"n_{table}"
        steps = np.arange(max(timeline.n_frames, len(counts)))
        yield from _difference("frames", column, recorded[column], counts, steps)


def table_differences(timeline: Timeline, state: State) -> Iterator[Difference]:
    """Compare the columns of every table; of tables of other dimensions, none."""
    if timeline.dimensions != state.dimensions:
        return
    for table, columns in TABLE_COLUMNS.items():
        if table == "perceived" and not timeline.records_perceived:
            continue
        n_rows = max(timeline.n_rows(table), state.n_rows(table))
        counts = timeline.frames[f"n_{table}"]
        # the first step whose count is beyond a row is the step of its birth
        steps = np.searchsorted(counts, np.arange(n_rows), side="right")
        for name in columns:
            recorded, repeated = timeline.table(table, name), state.rows(table, name)
            yield from _difference(table, name, recorded, repeated, steps)


def timeline_differences(one: Timeline, other: Timeline) -> list[Difference]:
    """Compare two recorded runs: what happened, and where everything was.

    Parameters
    ----------
    one, other : Timeline
        Open timelines. The states of their random streams, their configs and
        provenance are not compared.

    Returns
    -------
    list of Difference
        By step, at most one a column; empty if the runs are the same, bit for bit.

    Raises
    ------
    TimelineError
        If rows cannot be read.
    """
    found = [
        Difference(0, "", name, -1, str(values[0]), str(values[1]))
        for name, values in (
            (DIMENSIONS, (one.dimensions, other.dimensions)),
            (MOTION, (one.motion, other.motion)),
        )
        if values[0] != values[1]
    ]
    shared = [name for name in FRAME_COLUMNS if name in one.frames and name in other.frames]
    for name in shared:
        steps = np.arange(max(one.n_frames, other.n_frames))
        found += _difference("frames", name, one.frames[name], other.frames[name], steps)
    if one.dimensions == other.dimensions:
        for table in TABLE_COLUMNS:
            if table != "perceived" or (one.records_perceived and other.records_perceived):
                found += _table_differences(one, other, table)
    if one.motion == other.motion == Motion.EXPLICIT:
        found += _place_differences(one, other)
    return sorted(found, key=lambda difference: difference.step)


def _table_differences(one: Timeline, other: Timeline, table: str) -> Iterator[Difference]:
    """Compare a table of two runs; a row is of the step of its birth in either run."""
    n_rows = np.arange(max(one.n_rows(table), other.n_rows(table)))
    births = [
        np.searchsorted(run.frames[count_column(table)], n_rows, side="right")
        for run in (one, other)
    ]
    steps = np.minimum(births[0], births[1])
    for name in TABLE_COLUMNS[table]:
        yield from _difference(table, name, one.table(table, name), other.table(table, name), steps)


def _place_differences(one: Timeline, other: Timeline) -> Iterator[Difference]:
    """Compare explicit positions step by step, up to the first that differ."""
    for step in range(min(one.n_frames, other.n_frames)):
        for name in Places._fields:
            rows = one.places(name, step), other.places(name, step)
            steps = np.full(max(map(len, rows)), step)
            for difference in _difference("motion", name, *rows, steps):
                yield difference
                return


def _difference(
    table: str, column: str, recorded: NDArray, repeated: NDArray, steps: NDArray
) -> Iterator[Difference]:
    """Give the first row at which two columns differ in any bit, if there is one."""
    n_both = min(len(recorded), len(repeated))
    rows = [_bits(rows[:n_both], recorded.dtype) for rows in (recorded, repeated)]
    differing = np.flatnonzero((rows[0] != rows[1]).any(axis=1))
    if len(differing):
        row = int(differing[0])
        said = [str(np.asarray(values[row]).tolist()) for values in (recorded, repeated)]
        yield Difference(int(steps[row]), table, column, row, *said)
    elif len(recorded) != len(repeated):
        said = [f"{len(values)} rows" for values in (recorded, repeated)]
        yield Difference(int(steps[n_both]), table, column, n_both, *said)


def _bits(rows: NDArray, dtype: np.dtype) -> NDArray[np.uint8]:
    """Give the bytes of each row, so that equal means equal in every bit."""
    width = dtype.itemsize * int(np.prod(rows.shape[1:]))
    return np.ascontiguousarray(rows, dtype=dtype).view(np.uint8).reshape(len(rows), width)
