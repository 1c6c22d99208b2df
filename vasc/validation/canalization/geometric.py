"""What the rules of geometry predict, on the cells that canalization runs on.

The open rule lets a source attract the nearest vein node, the closed rule its relative
neighbors (Runions 2008, sections 4.2 and 4.3, equation 4.1); vein nodes are centres of
vein cells.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Ids, Points
from vasc.domain import Tissue


def relative_neighbors(source: Points, nodes: Points) -> Ids:
    """Give the rows of the nodes that are relative neighbors of a source, the nearest first.

    Node v is one if no other node u is nearer to the source (of two at one distance the
    one of lower id) and at once nearer to v than the source is (Runions 2008, equation
    4.1); of nodes at one place only the first counts.

    Parameters
    ----------
    source : ndarray of shape (2,), float64
        The source.
    nodes : ndarray of shape (n, 2), float64
        Vein nodes.

    Returns
    -------
    ndarray of shape (k,), int32
        Rows of ``nodes``; empty without nodes.

    Examples
    --------
    >>> relative_neighbors(np.zeros(2), np.array([[0.0, 2.0], [1.0, 0.0], [0.0, 3.0]])).tolist()
    [1, 0]
    """
    squares = _squares(nodes, source)
    order = np.argsort(squares, kind="stable")
    kept: list[int] = []
    for place, v in enumerate(order.tolist()):
        between = _squares(nodes[order[:place]], nodes[v])
        if not ((between < squares[v]) | (between == 0.0)).any():
            kept.append(v)
    return np.array(kept, dtype=np.int32)


def closed_ends(tissue: Tissue, veins: Sequence[Ids], source: int, gap: float = 0.0) -> Ids:
    """Give the vein cells that the closed rule leads to from a source, the nearest first.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    veins : sequence of ndarray of int32
        Cells of every vein.
    source : int
        The cell of the source.
    gap : float
        Of cells that are nearer to each other, only the nearest to the source counts, in D.

    Returns
    -------
    ndarray of shape (k,), int32
        Ids of cells.
    """
    cells = np.concatenate(list(veins))
    found = cells[relative_neighbors(tissue.positions[source], tissue.positions[cells])]
    kept: list[int] = []
    for cell in found.tolist():
        if not kept or _squares(tissue.positions[kept], tissue.positions[cell]).min() >= gap**2:
            kept.append(cell)
    return np.array(kept, dtype=np.int32)


def groups_of(veins: Sequence[Ids], cells: Ids) -> frozenset[int]:
    """Give the veins that some cells belong to."""
    return frozenset(number for number, vein in enumerate(veins) if np.isin(vein, cells).any())


def ratio_to_second(distances: Floats) -> float:
    """Give the distance of the nearest vein over that of the second, q."""
    first, second = np.sort(distances)[:2]
    return float(first / second)


def spanning_tree(points: Points) -> tuple[NDArray[np.int32], float]:
    """Give the edges of the minimum spanning tree of points, and its length.

    Returns
    -------
    tuple of ndarray of shape (n - 1, 2), int32, and float
    """
    from scipy.sparse.csgraph import minimum_spanning_tree
    from scipy.spatial.distance import pdist, squareform

    tree = minimum_spanning_tree(squareform(pdist(points))).tocoo()
    edges = np.stack([tree.row, tree.col], axis=1).astype(np.int32)
    return edges, float(tree.data.sum())


def _squares(points: Points, point: Points) -> Floats:
    """Give the squares of the distances between points and one."""
    apart = points - point
    return apart[:, 0] ** 2 + apart[:, 1] ** 2
