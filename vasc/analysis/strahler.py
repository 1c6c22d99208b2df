"""Stream orders of Horton and Strahler, counted from the tips to the base."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.axes import find_axes
from vasc.analysis.sections import Sections
from vasc.analysis.vein_orders import base_points
from vasc.arrays import NULL, Floats, Ids


@dataclass(frozen=True)
class StreamOrders:
    """Strahler's orders, and the streams they make.

    Parameters
    ----------
    orders : ndarray of shape (k,), int32
        Order of each section: 1 from a tip; two veins of one order make the next.
    is_stream_base : ndarray of shape (k,), bool
        True where a section leads into one of another order, or to the base.
    is_cut : ndarray of shape (k,), bool
        True for a section that closes a loop. It counts as two tips, cut in between.
    horton : ndarray of shape (k,), int32
        Horton's order: at each fork the vein of highest order, of equals the widest,
        hands its order up, so that a main stream has one order to its tip.
    """

    orders: Ids
    is_stream_base: NDArray[np.bool_]
    is_cut: NDArray[np.bool_]
    horton: Ids

    def counts(self) -> dict[int, int]:
        """Give the number of streams of each order."""
        weights = np.where(self.is_cut, 2, 1)[self.is_stream_base]
        counts = np.bincount(self.orders[self.is_stream_base], weights)
        return {order: int(n) for order, n in enumerate(counts.tolist()) if order}

    def bifurcation_ratio(self) -> float:
        """Give Horton's ratio of numbers of streams of successive orders.

        Returns
        -------
        float
            From the slope of the logarithms of numbers against orders; nan with
            fewer than two orders.

        Notes
        -----
        Horton (1945, Bulletin of the Geological Society of America 56:275); Strahler
        (1957, Transactions of the American Geophysical Union 38:913).
        """
        counts = self.counts()
        if len(counts) < 2:
            return float("nan")
        slope = np.polyfit(list(counts), np.log(list(counts.values())), 1)[0]
        return float(np.exp(-slope))


def stream_orders(sections: Sections) -> StreamOrders:
    """Count stream orders along the widest ways to the base.

    Parameters
    ----------
    sections : Sections
        The veins of a network. Where it has loops, the thinnest section of each is
        cut, so that a tree of the widest ways is left.

    Returns
    -------
    StreamOrders
        Empty for a network without veins.
    """
    n_sections = sections.n_sections
    parents, up, order_of_visit = _widest_tree(sections)
    is_cut = np.ones(n_sections, dtype=bool)
    is_cut[up[up != NULL]] = False
    orders = np.ones(n_sections, dtype=np.int32)
    best, again = np.zeros(len(parents), dtype=np.int32), np.zeros(len(parents), dtype=bool)

    def enters(point: int, order: int) -> None:
        again[point] = order == best[point] or (again[point] and order < best[point])
        best[point] = max(best[point], order)

    for point in sections.ends[is_cut].ravel().tolist():
        enters(point, 1)
    for point in order_of_visit[::-1].tolist():
        section = int(up[point])
        if section != NULL:
            orders[section] = max(int(best[point]) + bool(again[point]), 1)
            enters(int(parents[point]), int(orders[section]))
    below = np.full(n_sections, NULL)
    points = order_of_visit[up[order_of_visit] != NULL]
    below[up[points]] = up[parents[points]]
    is_base = (below == NULL) | (orders[below] != orders) | is_cut
    horton = _horton(sections, orders, points, parents, up)
    return StreamOrders(orders, is_base, is_cut, horton)


def _widest_tree(
    sections: Sections,
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Give for each point the next one to the base, the section there, and an order of visits."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

    size = len(sections.drawing.points)
    if not sections.n_sections:
        none = np.full(size, NULL, dtype=np.int64)
        return none, none.copy(), np.zeros(0, dtype=np.int64)
    ranks = _ranks(sections.widths)
    # one point more, below all bases, makes one tree of all pieces
    bases = base_points(sections, find_axes(sections))
    links = np.concatenate([np.sort(sections.ends, axis=1), [[base, size] for base in bases]])
    weights = np.concatenate([ranks + 2.0, np.ones(len(bases))])
    order = np.lexsort((weights, links[:, 1], links[:, 0]))
    order = order[links[order, 0] != links[order, 1]]
    order = order[np.r_[True, (np.diff(links[order], axis=0) != 0).any(axis=1)]]
    graph = coo_array((weights[order], links[order].T), shape=(size + 1, size + 1))
    tree = minimum_spanning_tree(graph)
    visited, before = breadth_first_order(tree, size, directed=False)
    visited = visited[1:].astype(np.int64)
    parents, up = np.full(size, NULL, dtype=np.int64), np.full(size, NULL, dtype=np.int64)
    inner = visited[before[visited] != size]
    parents[inner] = before[inner]
    # links are sorted by their points, and each is there once
    keys = links[order, 0] * (size + 1) + links[order, 1]
    one, other = np.minimum(inner, parents[inner]), np.maximum(inner, parents[inner])
    up[inner] = order[np.searchsorted(keys, one * (size + 1) + other)]
    return parents, up, visited


def _ranks(widths: Floats) -> NDArray[np.int64]:
    """Give the place of each section from the widest to the thinnest."""
    ranks = np.empty(len(widths), dtype=np.int64)
    ranks[np.argsort(-widths, kind="stable")] = np.arange(len(widths))
    return ranks


def _horton(
    sections: Sections,
    orders: Ids,
    points: NDArray[np.int64],
    parents: NDArray[np.int64],
    up: NDArray[np.int64],
) -> Ids:
    """Hand the order of each stream up along its main stream, from the base on."""
    horton = orders.copy()
    rows = up[points]
    # at each point the first of its branches takes over what comes from below
    by_rank = np.lexsort((-sections.widths[rows], -orders[rows], parents[points]))
    is_main = np.zeros(sections.n_sections, dtype=bool)
    is_new = np.r_[True, np.diff(parents[points][by_rank]) != 0][: len(by_rank)]
    is_main[rows[by_rank[is_new]]] = True
    for point in points.tolist():
        section, below = up[point], up[parents[point]]
        if below != NULL and is_main[section]:
            horton[section] = horton[below]
    return horton
