"""Rules on areoles, and on the nodes that refinement has retired."""

import numpy as np
from numpy.typing import NDArray

from vasc.areoles import polygon_areas
from vasc.arrays import NULL
from vasc.events import EventKind
from vasc.timeline.rules import Findings, Record, bad_rows


def areoles(record: Record) -> Findings:
    """Check that areoles descend from earlier ones, which their births have split."""
    if record.timeline.dimensions != 2 and record.timeline.n_rows("areoles"):
        yield "[areoles] areoles holds rows; there are none in space"
        return
    parents, births = record.column("areoles", "parent"), record.column("areoles", "birth")
    has_parent = parents != NULL
    is_bad = has_parent & (parents >= np.arange(len(parents)))
    yield from bad_rows("areoles", "areoles/parent", is_bad, parents, "must be an earlier row")
    closing = record.column("segments", "birth")[record.column("areoles", "segment")]
    is_bad = closing > births
    yield from bad_rows("areoles", "areoles/birth", is_bad, births, "its segment is born after it")
    kinds, subjects = record.column("events", "kind"), record.column("events", "subject")
    rows = np.flatnonzero(kinds == EventKind.AREOLE_SPLIT)
    numbers = np.bincount(subjects[rows], minlength=len(parents))
    yield from bad_rows("areoles", "areoles", numbers > 1, numbers, "splits; one is possible")
    split_at = np.full(len(parents) + 1, NULL)
    split_at[subjects[rows]] = record.column("events", "step")[rows]
    # the row of no parent is the one beyond the last
    is_bad = has_parent & (split_at[parents] != births)
    wanted = "an areole that is split at another step, or at none"
    yield from bad_rows("areoles", "areoles/parent", is_bad, parents, wanted)


def boundaries(record: Record) -> Findings:
    """Check that the nodes around an areole make a counterclockwise ring at its birth."""
    owners, nodes = record.column("boundaries", "areole"), record.column("boundaries", "node")
    births = record.column("areoles", "birth")
    is_bad = np.zeros(len(owners), dtype=bool)
    is_bad[1:] = np.diff(owners) < 0
    yield from bad_rows("areoles", "boundaries/areole", is_bad, owners, "must never fall")
    if is_bad.any():
        return
    lengths = np.bincount(owners, minlength=len(births))
    wanted = "nodes around it; an areole has at least 3"
    yield from bad_rows("areoles", "areoles", lengths < 3, lengths, wanted)
    is_bad = record.column("nodes", "birth")[nodes] > births[owners]
    yield from bad_rows("areoles", "boundaries/node", is_bad, nodes, "is born after the areole")
    if record.timeline.dimensions == 2 and not is_bad.any():
        areas = _areas_at_birth(record, owners, nodes, births)
        wanted = "the area within its boundary; it must run counterclockwise"
        yield from bad_rows("areoles", "areoles", areas < 0.0, areas, wanted)


def retired(record: Record) -> Findings:
    """Check that nodes retire once, and that no segment is left that ends in one."""
    kinds, subjects = record.column("events", "kind"), record.column("events", "subject")
    n_nodes = record.timeline.n_rows("nodes")
    numbers = np.bincount(subjects[kinds == EventKind.NODE_RETIRED], minlength=n_nodes)
    yield from bad_rows("retired", "nodes", numbers > 1, numbers, "retirements; one is possible")
    ends = record.column("segments", "nodes")
    is_bad = (numbers[ends] > 0).any(axis=1)
    is_bad[subjects[kinds == EventKind.SEGMENT_REFINED]] = False
    yield from bad_rows("retired", "segments/nodes", is_bad, ends, "lives on with a retired end")


def _areas_at_birth(record: Record, owners: NDArray, nodes: NDArray, births: NDArray) -> NDArray:
    """Give the signed area of each areole at its birth."""
    points = np.empty((len(nodes), 2))
    for step in np.unique(births).tolist():
        is_now = births[owners] == step
        points[is_now] = record.timeline.positions(step)[nodes[is_now]]
    return polygon_areas(points, owners, len(births))
