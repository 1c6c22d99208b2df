"""Veins as they began: the first node of each, its order of branching, time and place of birth."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids, Steps
from vasc.events import EventKind
from vasc.network import Origin, SegmentKind
from vasc.timeline import moving


class Recorded(moving.Recorded, Protocol):
    """What the births of veins need of a timeline."""

    @property
    def events(self) -> Mapping[str, NDArray]:
        """Columns of the events."""

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table."""


@dataclass(frozen=True)
class Veins:
    """The vein that each node belongs to.

    A vein begins with the first node off a parent that had a child (event
    ``vein_initiated``), or with a seed; its first node names it. A node of refinement
    belongs to the vein that it lies in.

    Parameters
    ----------
    firsts : ndarray of shape (n,), int32
        The first node of the vein of each node.
    orders : ndarray of shape (n,), int32
        Branching order: 1 for veins from a seed, and one more at each later initiation.
        It is counted by parentage alone, and is not the vein order.
    """

    firsts: Ids
    orders: Ids


def veins_of(timeline: Recorded) -> Veins:
    """Tell which vein each node of a run belongs to.

    Parameters
    ----------
    timeline : Timeline
        An open timeline; three columns of its nodes are read, and its events.

    Returns
    -------
    Veins
        Empty when there is no node.
    """
    parents = timeline.table("nodes", "parent")
    events = timeline.events
    initiated = events["subject"][events["kind"] == EventKind.VEIN_INITIATED]
    begins = parents == NULL
    begins[initiated] = True
    carriers = _carriers(timeline, parents)
    # a vein off a seed is primary, however many have left it before
    adds = begins & (parents != NULL)
    adds[adds] = parents[parents[adds]] != NULL
    own = np.arange(len(parents), dtype=np.int32)
    firsts = np.where(begins, own, carriers)
    # the first node of all is above itself, and adds nothing
    above = np.where(carriers == NULL, own, carriers)
    orders = adds.astype(np.int32)
    # pointers are doubled: round k looks 2^k nodes back, so that few rounds are needed
    for _ in range(max(1, len(own).bit_length())):
        firsts = firsts[firsts]
        orders = orders + orders[above]
        above = above[above]
    return Veins(firsts, orders + 1)


def births(timeline: Recorded, veins: Veins, orders: Ids | None = None) -> dict[str, NDArray]:
    """Give the birth of every vein, by step.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    veins : Veins
        Its :func:`veins_of`.
    orders : ndarray of shape (n,), int, optional
        An order for each node, -1 where it is not known; as a rule the vein orders of
        :func:`vasc.analysis.segment_orders.run_node_orders`.

    Returns
    -------
    dict of str to ndarray of shape (v,)
        ``vein``, its first node; ``step`` and ``time`` of birth; if orders were given,
        ``order``, the lowest of its nodes, -1 if none is known; ``branching_order``; ``origin``,
        the vein it left, -1 for one of a seed; ``source`` that caused it, -1 if none;
        ``height`` of the first node above the base at that step, in D; and ``nodes``, how
        many the vein has at the end, those of refinement included.
    """
    firsts, counts = np.unique(veins.firsts, return_counts=True)
    steps = timeline.table("nodes", "birth")[firsts]
    order = np.lexsort((firsts, steps))
    firsts, counts, steps = firsts[order], counts[order], steps[order]
    parents = timeline.table("nodes", "parent")[firsts]
    return {
        "vein": firsts,
        "step": steps,
        "time": timeline.frames["time"][steps],
        **({} if orders is None else {"order": _lowest(veins, np.asarray(orders))[firsts]}),
        "branching_order": veins.orders[firsts],
        "origin": np.where(parents == NULL, NULL, veins.firsts[parents]).astype(np.int32),
        "source": timeline.table("nodes", "source")[firsts],
        "height": heights_at(timeline, firsts, steps),
        "nodes": counts.astype(np.int32),
    }


def heights_at(timeline: Recorded, nodes: Ids, steps: Steps) -> NDArray[np.float64]:
    """Give how far above the base each node was at a step of its own, along the axis.

    The axis is the last coordinate (y of a blade, z of a stem), and the base where the
    first node, a seed, is at that step.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    nodes, steps : ndarray of shape (k,), int32
        Node ids, and a recorded step for each.

    Returns
    -------
    ndarray of shape (k,), float64
        In D.
    """
    at, where = np.unique(steps, return_inverse=True)
    base = moving.positions_at(timeline, np.zeros(len(at), dtype=np.int32), at)[:, -1]
    heights: NDArray[np.float64] = moving.positions_at(timeline, nodes, steps)[:, -1]
    return heights - base[where]


def births_by_order(table: Mapping[str, NDArray]) -> dict[str, NDArray]:
    """Give, for each order, how many veins it has and when they were born.

    Parameters
    ----------
    table : mapping of str to ndarray
        What :func:`births` gives.

    Returns
    -------
    dict of str to ndarray
        ``order``, or ``branching_order`` if the table has no other; ``veins``, their number;
        ``first``, ``median`` and ``last`` step of birth.
    """
    kind = "order" if "order" in table else "branching_order"
    orders = np.unique(table[kind])
    steps = [table["step"][table[kind] == order] for order in orders.tolist()]
    return {
        kind: orders,
        "veins": np.array([len(each) for each in steps], dtype=np.int64),
        "first": np.array([each.min() for each in steps], dtype=np.int64),
        "median": np.array([np.median(each) for each in steps], dtype=np.float64),
        "last": np.array([each.max() for each in steps], dtype=np.int64),
    }


def _lowest(veins: Veins, orders: NDArray) -> NDArray:
    """Give the lowest known order in the vein that begins with each node, -1 for none."""
    unknown = np.iinfo(orders.dtype).max
    found = np.full(len(orders), unknown, dtype=orders.dtype)
    np.minimum.at(found, veins.firsts, np.where(orders == NULL, unknown, orders))
    return np.where(found == unknown, NULL, found)


def _carriers(timeline: Recorded, parents: Ids) -> Ids:
    """Give the earlier node whose vein each node continues or leaves, -1 for none."""
    carriers = parents.copy()
    is_halving = timeline.table("nodes", "origin") == Origin.REFINEMENT
    if not is_halving.any():
        return carriers
    events = timeline.events
    rows = np.flatnonzero(events["kind"] == EventKind.SEGMENT_REFINED)
    segments, nodes = events["subject"][rows], events["object"][rows]
    ends = timeline.table("segments", "nodes")[segments]
    is_join = timeline.table("segments", "kind")[segments] == SegmentKind.JOIN
    # a segment belongs to the newer of its nodes; a join to the vein it springs from
    carriers[nodes] = np.where(is_join, ends[:, 0], ends.max(axis=1))
    return carriers
