"""Vein orders as botanists assign them: by width and continuity (Hickey 1973)."""

import math
from heapq import heapify, heappop, heappush

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.axes import Axes, find_axes
from vasc.analysis.sections import Sections
from vasc.arrays import Floats, Ids

THINNER = 0.75
"""Share of the width of an order below which a vein is of the next one."""


def vein_orders(sections: Sections) -> Ids:
    """Give every section its vein order, 1 for the main veins from the base.

    An axis is one vein from end to end, through every fork. The widest axis at the
    base is of first order. An axis springs from the one that it meets with its
    widest end. It is of the same order if its mean width is about that of the axis
    with which this order began there, as in the main veins of a palmate leaf and the
    meshes of the finest; thinner by more than a quarter, it is of the next order.
    Last, an axis that is thinner than is typical of a later order belongs there, so
    that a veinlet on the midvein is no secondary vein.

    Parameters
    ----------
    sections : Sections
        The veins of a network, with their widths.

    Returns
    -------
    ndarray of shape (k,), int32
        Orders, from 1; every connected piece of a network begins with 1 anew.

    Notes
    -----
    Hickey (1973, American Journal of Botany 60:17) and Ellis et al. (2009, Manual of
    Leaf Architecture) tell orders by the width relative to the vein of origin, and
    by the course. They judge by eye: the quarter is our number.
    """
    axes = find_axes(sections)
    if not axes.n_axes:
        return np.zeros(0, dtype=np.int32)
    lengths = axes.sums(sections.lengths)
    widths = axes.sums(sections.lengths * sections.widths) / lengths
    orders = _by_typical_width(_spread(sections, axes, widths), widths, lengths)
    return orders[axes.of_sections].astype(np.int32)


def base_points(sections: Sections, axes: Axes) -> NDArray[np.int64]:
    """Give the points of each connected piece at which its veins begin.

    Parameters
    ----------
    sections : Sections
        The veins of a network.
    axes : Axes
        Which of them are one vein.

    Returns
    -------
    ndarray of shape (c,), int64
        Rows of points of the drawing, ascending. Seeds, where they are known; in a
        piece without one, the wider end of its main axis: that with the largest
        product of length and width.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    size = len(sections.drawing.points)
    ones = np.ones(sections.n_sections, dtype=np.int8)
    pieces = connected_components(coo_array((ones, sections.ends.T), shape=(size, size)))[1]
    ends, widths = sections.ends.ravel(), sections.end_widths.ravel()
    owners = np.repeat(axes.of_sections, 2)
    is_seed = np.isin(ends, sections.seeds)
    # how often a point is an end of a section of the same axis: once at the axis' ends
    _, which, counts = np.unique(owners * size + ends, return_inverse=True, return_counts=True)
    is_inner = counts[which] > 1
    sizes = axes.sums(sections.lengths * sections.widths)[owners]
    order = np.lexsort((ends, -widths, is_inner, -sizes, ~is_seed, pieces[ends]))
    is_first = np.r_[True, np.diff(pieces[ends][order]) != 0][: len(order)]
    return np.union1d(ends[order[is_first]], ends[is_seed])


def _spread(sections: Sections, axes: Axes, of_axes: Floats) -> NDArray[np.int64]:
    """Give orders to all axes from their widths, from the base on, widest ends first."""
    owner = np.repeat(axes.of_sections, 2)
    points, widths = sections.ends.ravel(), sections.end_widths.ravel()
    by_point, by_axis = _lists(points, len(sections.drawing.points)), _lists(owner, axes.n_axes)
    orders = np.zeros(axes.n_axes, dtype=np.int64)
    typical = of_axes.copy()
    heap: list[tuple[float, int, int, int]] = []
    for point in base_points(sections, axes).tolist():
        ends = by_point(point)
        widest = max(ends, key=lambda end: (of_axes[owner[end]], -end))
        first = int(owner[widest])
        # palmate: main veins of about the same width leave the base together
        heap += [(-float(widths[end]), end, 1, first) for end in ends]
        heap.append((-math.inf, widest, 1, first))
    heapify(heap)
    # the lowest order that has come to each point: its veins spring from that one
    reached: dict[int, int] = {}
    while heap:
        _, end, order, parent = heappop(heap)
        axis = int(owner[end])
        if orders[axis]:
            continue
        is_thinner = bool(of_axes[axis] < THINNER * typical[parent])
        orders[axis] = order + is_thinner
        typical[axis] = of_axes[axis] if is_thinner else typical[parent]
        for point in {int(points[own]) for own in by_axis(axis)}:
            if reached.get(point, order + 2) <= orders[axis]:
                continue
            reached[point] = int(orders[axis])
            for other in by_point(point):
                if not orders[owner[other]]:
                    heappush(heap, (-float(widths[other]), other, int(orders[axis]), axis))
    return orders


def _lists(keys: NDArray[np.int64], n_keys: int):  # type: ignore[no-untyped-def]
    """Give a function that lists the rows with a key."""
    order = np.argsort(keys, kind="stable").tolist()
    firsts = np.concatenate([[0], np.cumsum(np.bincount(keys, minlength=n_keys))]).tolist()
    return lambda key: order[firsts[key] : firsts[key + 1]]


def _by_typical_width(
    orders: NDArray[np.int64], widths: Floats, lengths: Floats
) -> NDArray[np.int64]:
    """Move axes on to the last order whose typical width is at least theirs."""
    typical = []
    for order in range(1, int(orders.max()) + 1):
        rows = np.flatnonzero(orders == order)
        if not len(rows):
            break
        by_width = rows[np.argsort(widths[rows], kind="stable")]
        share = np.cumsum(lengths[by_width])
        typical.append(widths[by_width[np.searchsorted(share, share[-1] / 2.0)]])
    levels = np.minimum.accumulate(typical)
    n_wider = np.searchsorted(-levels, -widths, side="right")
    return np.where(orders > 1, np.maximum(orders, n_wider), orders)
