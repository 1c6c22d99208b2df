"""Rules on the rows of a timeline: each is a function that yields findings.

A finding is one line that names the rule, the place and the value. Columns are
read whole.
"""

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL
from vasc.events import EventKind
from vasc.network import Origin
from vasc.states import FIRST, TRANSITIONS, Kind, SourceState
from vasc.timeline import guard, layout
from vasc.timeline.layout import ROLES, TABLES, count_column
from vasc.timeline.reader import Timeline
from vasc.timeline.references import REFERENCES

Findings = Iterator[str]


class Record:
    """The columns of a timeline, read when first needed and kept."""

    def __init__(self, timeline: Timeline) -> None:
        self.timeline = timeline
        self._columns: dict[tuple[str, str], NDArray] = {}

    @property
    def file(self) -> h5py.File:
        """The open file."""
        return self.timeline.opened.file

    @property
    def frames(self) -> dict[str, NDArray]:
        """The columns of ``frames``."""
        return self.timeline.frames

    def column(self, table: str, name: str) -> NDArray:
        """Give a column of a table."""
        if (table, name) not in self._columns:
            n_rows = self.timeline.n_rows(table)
            # read as it is: whether it is sound is what the rules tell
            self._columns[table, name] = self.timeline.opened.read(f"{table}/{name}", 0, n_rows)
        return self._columns[table, name]

    @cached_property
    def counts(self) -> dict[str, NDArray]:
        """Rows of each table at each step."""
        return {table: self.frames[count_column(table)] for table in TABLES}

    def frames_of(self, table: str) -> NDArray:
        """Give the step at which each row of a table was recorded."""
        rows = np.arange(self.timeline.n_rows(table))
        return np.searchsorted(self.counts[table], rows, side="right")

    def limits(self, table: str, target: str) -> NDArray:
        """Give, for each row of a table, the rows of ``target`` that existed then."""
        return self.counts[target][self.frames_of(table)]


def bad_rows(rule: str, place: str, is_bad: NDArray, values: Any, wanted: str) -> Findings:
    """Yield one finding for the first bad row, with the number of bad rows."""
    bad = np.flatnonzero(is_bad)
    if bad.size:
        value = np.asarray(values)[bad[0]]
        yield (
            f"[{rule}] {place}: row {bad[0]} is {value.tolist()}, {wanted}"
            + (f" ({bad.size} rows are bad)" if bad.size > 1 else "")
        )


def frames(record: Record) -> Findings:
    """Check that steps are contiguous, maps finite, and that counts only grow."""
    frames = record.frames
    steps = frames["step"]
    expected = np.arange(record.timeline.n_frames)
    yield from bad_rows("frames", "frames/step", steps != expected, steps, "must be the row number")
    times = frames["time"]
    is_bad = ~np.isfinite(times)
    is_bad[1:] |= np.diff(times) < 0
    yield from bad_rows("frames", "frames/time", is_bad, times, "must be finite and never fall")
    for name in (one for one in ("motion", "outline_motion") if one in frames):
        is_bad = ~np.isfinite(frames[name]).all(axis=(1, 2))
        yield from bad_rows("frames", f"frames/{name}", is_bad, frames[name], "must be finite")
    for table, counts in record.counts.items():
        is_bad = counts < 0
        is_bad[1:] |= np.diff(counts) < 0
        place = f"frames/{count_column(table)}"
        yield from bad_rows("counts", place, is_bad, counts, "must be at least 0 and never fall")
    if not record.timeline.records_perceived and record.timeline.n_rows("perceived"):
        yield "[counts] perceived holds rows, yet the file says that it is not recorded"


def filled(record: Record) -> Findings:
    """Check that every committed row was written, with finite numbers."""
    for table, columns in TABLES.items():
        for name in columns:
            values = record.column(table, name)
            fill = layout.fill_value(values.dtype)
            bad = ~np.isfinite(values) if values.dtype.kind == "f" else values == fill
            is_bad = bad if bad.ndim == 1 else bad.any(axis=1)
            wanted = "must be finite" if values.dtype.kind == "f" else "was never written"
            yield from bad_rows("written", f"{table}/{name}", is_bad, values, wanted)


def codes(record: Record) -> Findings:
    """Check that the file names every code it uses, and names it as the format does."""
    for (table, name), prefixes in layout.NAMES.items():
        if (table, name) == ("events", "subject"):
            continue
        item = record.timeline.opened.item(f"{table}/{name}")
        known: set[int] = set()
        for prefix in prefixes:
            known |= set(guard.names(item, prefix))
        values = record.column(table, name)
        is_bad = ~np.isin(values, list(known))
        yield from bad_rows("codes", f"{table}/{name}", is_bad, values, "a code that is not named")
    reasons = guard.names(record.timeline.opened.item("events/subject"), "stop_reason_")
    subjects = record.column("events", "subject")
    is_bad = record.column("events", "kind") == EventKind.RUN_FINISHED
    is_bad &= ~np.isin(subjects, list(reasons))
    yield from bad_rows("codes", "events/subject", is_bad, subjects, "a reason that is not named")
    names = record.timeline.event_names
    for kind in EventKind:
        if names.get(kind, kind.name.lower()) != kind.name.lower():
            yield f"[codes] events/kind: code {int(kind)} is named {names[kind]!r}"


def steps(record: Record) -> Findings:
    """Check that no row is dated after the step that recorded it."""
    for table, columns in TABLES.items():
        for name in ("birth", "step"):
            if name not in columns:
                continue
            values = record.column(table, name)
            is_bad = (values < 0) | (values > record.frames_of(table))
            wanted = "must lie between 0 and the step that recorded it"
            yield from bad_rows("steps", f"{table}/{name}", is_bad, values, wanted)
            if name == "step":
                is_bad = np.zeros(len(values), dtype=bool)
                is_bad[1:] = np.diff(values) < 0
                yield from bad_rows("steps", f"{table}/{name}", is_bad, values, "must never fall")


def ids(record: Record) -> Findings:
    """Check that every id points to a row that existed when it was recorded."""
    for place, (owner, may_be_none) in REFERENCES.items():
        yield from _references(record, *place, owner, null=may_be_none)
    kinds = ((Kind.NODE, "nodes"), (Kind.SOURCE, "sources"), (Kind.CANAL, "perceived"))
    for kind, table in kinds:
        where = record.column("states", "what") == kind
        yield from _references(record, "states", "id", table, where=where)
    for event, roles in ROLES.items():
        where = record.column("events", "kind") == event
        for name, target in (("subject", roles.subject), ("object", roles.object)):
            if target is not None:
                null = name == "object"
                yield from _references(record, "events", name, target, where=where, null=null)


def _references(
    record: Record,
    table: str,
    name: str,
    target: str,
    *,
    where: NDArray | None = None,
    null: bool = False,
) -> Findings:
    """Check that a column of ids stays within the rows its target had at that step."""
    if target == "perceived" and not record.timeline.records_perceived:
        # canals that were not recorded have ids all the same
        return
    values = record.column(table, name)
    limits = record.limits(table, target).reshape(-1, *(1,) * (values.ndim - 1))
    bad = np.asarray((values < (NULL if null else 0)) | (values >= limits))
    is_bad = np.asarray(bad if bad.ndim == 1 else bad.any(axis=1))
    if where is not None:
        is_bad = np.asarray(is_bad & where)
    yield from bad_rows(
        "ids", f"{table}/{name}", is_bad, values, f"no row of {target} at that step"
    )


def descent(record: Record) -> Findings:
    """Check that seeds have no parent, and that a parent is born earlier."""
    parents, births = record.column("nodes", "parent"), record.column("nodes", "birth")
    origins = record.column("nodes", "origin")
    is_seed = origins == Origin.SEED
    is_bad = is_seed & (parents != NULL)
    yield from bad_rows("descent", "nodes/parent", is_bad, parents, "a seed has no parent")
    is_bad = np.isin(origins, [Origin.EXTENSION, Origin.REFINEMENT, Origin.CANAL]) & (
        parents == NULL
    )
    yield from bad_rows("descent", "nodes/parent", is_bad, parents, "an extension has a parent")
    has_parent = parents != NULL
    is_bad = has_parent & (parents >= np.arange(len(parents)))
    yield from bad_rows("descent", "nodes/parent", is_bad, parents, "must be an earlier row")
    # refinement may replace what a step has made; veins grow from what it has replaced, and
    # from a primordium, in the same step;
    # a source may be reached in the step that brought the vein near,
    # and the cells of a canal differentiate together
    is_quick = np.isin(origins, [Origin.REFINEMENT, Origin.SOURCE, Origin.CANAL])
    quick_parents = [Origin.REFINEMENT, Origin.PRIMORDIUM]
    is_quick |= has_parent & np.isin(origins[np.maximum(parents, 0)], quick_parents)
    margin = np.where(is_quick, 0, 1)
    is_bad = has_parent & (births[np.maximum(parents, 0)] + margin > births)
    yield from bad_rows("descent", "nodes/parent", is_bad, parents, "must be born earlier")


def segments(record: Record) -> Findings:
    """Check that a segment has two ends, none born after it, and is refined once at most."""
    nodes, births = record.column("segments", "nodes"), record.column("segments", "birth")
    is_bad = nodes[:, 0] == nodes[:, 1]
    yield from bad_rows("segments", "segments/nodes", is_bad, nodes, "must be two different nodes")
    is_bad = record.column("nodes", "birth")[nodes].max(axis=1, initial=0) > births
    yield from bad_rows("segments", "segments/nodes", is_bad, nodes, "an end is born after it")
    kinds, subjects = record.column("events", "kind"), record.column("events", "subject")
    rows = np.flatnonzero(kinds == EventKind.SEGMENT_REFINED)
    segments, first = np.unique(subjects[rows], return_index=True)
    if len(segments) < len(rows):
        again = np.setdiff1d(rows, rows[first])[0]
        yield f"[segments] events: row {again} refines segment {subjects[again]} a second time"


def states(record: Record) -> Findings:
    """Check that every change of state is legal."""
    what, ids, after = (record.column("states", name) for name in ("what", "id", "state"))
    for kind, first in FIRST.items():
        rows = np.flatnonzero(what == kind)
        # by id, in the order of time: the state before is that of the row above
        rows = rows[np.argsort(ids[rows], kind="stable")]
        before = np.full(len(rows), first, dtype=np.int64)
        same = ids[rows][1:] == ids[rows][:-1]
        before[1:][same] = after[rows][:-1][same]
        legal = np.array([a * 256 + b for a, b in TRANSITIONS[kind]], dtype=np.int64)
        is_bad = np.zeros(len(what), dtype=bool)
        is_bad[rows] = ~np.isin(before * 256 + after[rows], legal)
        yield from bad_rows(
            "states",
            "states/state",
            is_bad,
            after,
            f"no {kind.name.lower()} may change to that from the state it was in",
        )


def ends(record: Record) -> Findings:
    """Check that sources end once, and are never perceived afterwards."""
    drained = _last_steps(record, "states", "id", SourceState.DRAINED)
    removed = _last_steps(record, "events", "subject", EventKind.SOURCE_REMOVED)
    yield from bad_rows(
        "ends",
        "sources",
        drained != removed,
        np.stack([drained, removed], axis=1),
        "steps of the state 'drained' and of the event 'source_removed'; they must agree",
    )
    kinds, subjects = record.column("events", "kind"), record.column("events", "subject")
    numbers = np.bincount(
        subjects[kinds == EventKind.SOURCE_REMOVED], minlength=record.timeline.n_rows("sources")
    )
    yield from bad_rows("ends", "sources", numbers > 1, numbers, "removals; one is possible")
    sources, steps = record.column("perceived", "source"), record.column("perceived", "step")
    ends = np.where(removed == NULL, np.iinfo(np.int32).max, removed)
    is_bad = steps > ends[sources]
    yield from bad_rows("ends", "perceived/source", is_bad, sources, "a source removed before")
    is_bad = steps < record.column("sources", "birth")[sources]
    yield from bad_rows("ends", "perceived/source", is_bad, sources, "a source not yet born")


def _last_steps(record: Record, table: str, name: str, code: int) -> NDArray:
    """Give the last step at which each source got a state or an event, -1 if it never did."""
    if table == "states":
        is_it = (record.column("states", "what") == Kind.SOURCE) & (
            record.column("states", "state") == code
        )
    else:
        is_it = record.column("events", "kind") == code
    steps = np.full(record.timeline.n_rows("sources"), NULL, dtype=np.int32)
    steps[record.column(table, name)[is_it]] = record.column(table, "step")[is_it]
    return steps
