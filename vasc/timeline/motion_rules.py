"""Rules on where things are: positions at birth, and explicit positions step by step.

Explicit positions are read piece by piece, as all of a run may not fit in memory.
"""

import numpy as np
from numpy.typing import NDArray

from vasc.timeline.layout import MOTION, RING_XY, Motion
from vasc.timeline.rules import Findings, Record, bad_rows

TOLERANCE = 1e-9
"""Largest difference between a position and where the motion says it is, relative above 1."""
PIECE = 1 << 18
"""Rows of explicit positions that are read at a time."""


def explicit(record: Record) -> Findings:
    """Check that explicit positions are finite, and that the first outline is the blade's."""
    timeline = record.timeline
    for name, n_rows in timeline.n_places.items():
        for start in range(0, n_rows, PIECE):
            stop = min(start + PIECE, n_rows)
            rows = timeline.opened.read(f"{MOTION}/{name}", start, stop)
            is_bad = ~np.isfinite(rows).all(axis=1)
            if is_bad.any():
                place = f"{MOTION}/{name} from row {start} on"
                yield from bad_rows("written", place, is_bad, rows, "must be finite")
                break
    if timeline.motion != Motion.EXPLICIT:
        return
    ring = timeline.initial_blade.rings
    if len(ring) != 1:
        yield f"[blade] {RING_XY}: {len(ring)} rings; an explicit outline is one"
    elif timeline.n_frames:
        outline = timeline.places("outline", 0)
        is_bad = _is_apart(outline, ring[0])
        yield from bad_rows(
            "blade", f"{MOTION}/outline", is_bad, outline, f"is not the row of {RING_XY} at step 0"
        )


def positions(record: Record) -> Findings:
    """Check that a position is where the motion has it at the step of birth."""
    for table in ("nodes", "sources"):
        position, births = record.column(table, "position"), record.column(table, "birth")
        if record.timeline.motion == Motion.EXPLICIT:
            expected = _explicit_at_birth(record, table, births)
            wanted = "is not where the motion has it at its birth"
        elif record.timeline.motion == Motion.NONE:
            expected = record.column(table, "material")
            wanted = "is not its material point, though nothing moves"
        else:
            material, motions = record.column(table, "material"), record.frames["motion"][births]
            expected = (motions[:, :, :2] * material[:, None, :]).sum(axis=2) + motions[:, :, 2]
            wanted = "is not where the motion at its birth takes its material point"
        is_bad = _is_apart(position, expected)
        yield from bad_rows("positions", f"{table}/position", is_bad, position, wanted)


def _explicit_at_birth(record: Record, table: str, births: NDArray) -> NDArray:
    """Give the explicit positions of rows at their births; nowhere if the step lacks them."""
    expected = np.full((len(births), 2), np.inf)
    # a stable sort puts the rows of one step side by side
    order = np.argsort(births, kind="stable")
    steps, starts = np.unique(births[order], return_index=True)
    ends = [*starts[1:].tolist(), len(order)]
    for step, start, end in zip(steps.tolist(), starts.tolist(), ends, strict=False):
        rows = order[start:end]
        places = record.timeline.places(table, step)
        there = rows[rows < len(places)]
        expected[there] = places[there]
    return expected


def _is_apart(points: NDArray, expected: NDArray) -> NDArray:
    """Tell which points are not where they are expected."""
    apart = np.abs(expected - points) > TOLERANCE * np.maximum(1.0, np.abs(points))
    return np.asarray(apart.any(axis=1))
