"""How much vein is needed to connect all junctions and ends, and how much there is."""

import numpy as np

from vasc.analysis.sections import Sections


def mst_ratio(sections: Sections) -> float:
    """Give the length of a minimum spanning tree over the length of all veins.

    Parameters
    ----------
    sections : Sections
        The veins of a network; where it is in pieces, each has a tree of its own.

    Returns
    -------
    float
        1 for a tree, nan where no section has two ends, as without veins or of a lone
        ring: there is nothing to connect. A loop is opened by a whole section.
    """
    if not sections.n_sections:
        return float("nan")
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import minimum_spanning_tree

    ends = np.sort(sections.ends, axis=1)
    order = np.lexsort((sections.lengths, ends[:, 1], ends[:, 0]))
    order = order[ends[order, 0] != ends[order, 1]]
    # of sections between the same points only the shortest can be in a tree
    if not len(order):
        return float("nan")
    is_new = np.r_[True, (np.diff(ends[order], axis=0) != 0).any(axis=1)][: len(order)]
    order = order[is_new]
    size = len(sections.drawing.points)
    graph = coo_array((sections.lengths[order], ends[order].T), shape=(size, size))
    return float(minimum_spanning_tree(graph).sum() / sections.lengths.sum())
