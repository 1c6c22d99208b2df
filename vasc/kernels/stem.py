"""Veins of a stem that grow toward each other: the steps of an iteration, over its arrays.

Every vein node is a source to all others (Runions 2008, section 6.2.1). An active
pair is two relative neighbours without a segment between them: each grows toward the
other. A new node is joined to those of its relative neighbours that are nearer than
the length of a segment; with the rest it makes active pairs. Nodes never move or
vanish, so that pairs are born with a node and die by a node or a segment.

The state is a ``Stem``. Its arrays are shared by the stems that steps give back:
work on the newest one only.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled
from vasc.kernels.octree import Octree, octree
from vasc.kernels.octree import insert as insert_points
from vasc.kernels.relative_neighbors_3d import MARGIN, relatives_of_new
from vasc.kernels.segments import is_joined, join_nodes
from vasc.kernels.unrolled import (
    displacement,
    nearest_on_surface,
    on_surface,
    relatives_on_surface,
    separation,
)

CELL_SIDE = 8.0
"""Side of a cell of the index, in lengths of a segment: some ten to twenty nodes a cell."""

MERGE = 1e-3
"""A new node this near to a node, in lengths of a segment, is that node."""

STILL = 1e-6
"""A sum of unit vectors shorter than this has no direction."""

ROOM = 256
"""Nodes and segments that a stem has room for at first."""


class Stem(NamedTuple):
    """Vein nodes of a stem, segments and active pairs."""

    positions: NDArray[np.float64]
    """Per node: x, y, z, shape (capacity, 3); on an unrolled surface x is along the arc."""
    parents: NDArray[np.int32]
    """Per node: the node it grew from, -1 for one that was placed, shape (capacity,)."""
    edges: NDArray[np.int32]
    """Per segment: its nodes, shape (capacity, 2)."""
    newest: NDArray[np.int32]
    """Per node: twice its newest segment, plus 1 if it is that's second node; -1 for none."""
    following: NDArray[np.int32]
    """Per end of a segment: that of the node's next older segment, -1 for none."""
    pairs: NDArray[np.int32]
    """Active pairs, oldest first, shape (n_pairs, 2)."""
    tree: Octree
    """Index of all nodes."""
    n_nodes: int
    """Number of nodes."""
    n_edges: int
    """Number of segments."""
    period: float
    """Circumference if distances are along the surface, 0 if they are straight."""


def stem(length: float, period: float = 0.0) -> Stem:
    """Make a stem without nodes, with room for some.

    Parameters
    ----------
    length : float
        Length of a segment, to size the cells of the index.
    period : float
        Circumference of the surface on which distances are taken; 0 for straight
        distances in space.

    Returns
    -------
    Stem
        The empty stem; it gets more room when it needs it.
    """
    return Stem(
        positions=np.zeros((ROOM, 3)),
        parents=np.full(ROOM, -1, dtype=np.int32),
        edges=np.full((ROOM, 2), -1, dtype=np.int32),
        newest=np.full(ROOM, -1, dtype=np.int32),
        following=np.full(2 * ROOM, -1, dtype=np.int32),
        pairs=np.empty((0, 2), dtype=np.int32),
        tree=octree(CELL_SIDE * length, ROOM),
        n_nodes=0,
        n_edges=0,
        period=float(period),
    )


def _longer(old: NDArray, n_rows: int, fill: float) -> NDArray:
    """Give a copy with more rows."""
    new = np.full((n_rows, *old.shape[1:]), fill, dtype=old.dtype)
    new[: len(old)] = old
    return new


def reserve(old: Stem, n_nodes: int, n_edges: int) -> Stem:
    """Give a stem with room for so many nodes and segments, at least twice the old if it grows."""
    new = old
    if n_nodes > len(new.positions):
        room = max(n_nodes, 2 * len(new.positions))
        new = new._replace(
            positions=_longer(new.positions, room, 0.0),
            parents=_longer(new.parents, room, -1),
            newest=_longer(new.newest, room, -1),
        )
    if n_edges > len(new.edges):
        room = max(n_edges, 2 * len(new.edges))
        new = new._replace(
            edges=_longer(new.edges, room, -1), following=_longer(new.following, 2 * room, -1)
        )
    return new


def join(old: Stem, joints: NDArray[np.int32]) -> Stem:
    """Join nodes by segments, rows of two ids; those that are joined already stay as they are."""
    new = reserve(old, 0, old.n_edges + len(joints))
    n_edges = join_nodes(new.edges, new.newest, new.following, new.n_edges, joints)
    return new._replace(n_edges=n_edges)


def place(
    old: Stem, positions: NDArray[np.float64], parents: NDArray[np.int32] | None = None
) -> Stem:
    """Add nodes that are not joined to anything yet, and put them into the index.

    Parameters
    ----------
    old : Stem
        The stem.
    positions : ndarray of shape (k, 3), float64
        Places of the new nodes, whose ids follow those of the old ones.
    parents : ndarray of shape (k,), int32, optional
        Nodes that they grew from; none of them grew if left out.

    Returns
    -------
    Stem
        To be followed by ``insert``.
    """
    start, stop = old.n_nodes, old.n_nodes + len(positions)
    new = reserve(old, stop, 0)
    new.positions[start:stop] = positions
    if parents is not None:
        new.parents[start:stop] = parents
    return new._replace(n_nodes=stop, tree=insert_points(new.tree, new.positions, start, stop))


@compiled
def lasting_pairs(
    positions: NDArray[np.float64],
    pairs: NDArray[np.int32],
    start: int,
    stop: int,
    edges: NDArray[np.int32],
    newest: NDArray[np.int32],
    following: NDArray[np.int32],
    period: float,
) -> NDArray[np.int32]:
    """Give the pairs that are not joined and whose open lune has none of the new nodes in it.

    Parameters
    ----------
    positions, pairs, edges, newest, following, period
        Parts of a :class:`Stem`.
    start, stop : int
        Ids of the new nodes.

    Returns
    -------
    ndarray of shape (k, 2), int32
        Rows of ``pairs`` in their order.
    """
    kept = np.empty_like(pairs)
    n_kept = 0
    for row in range(len(pairs)):
        a, b = pairs[row, 0], pairs[row, 1]
        limit = separation(positions, a, b, period) * (1.0 - MARGIN)
        is_lasting = not is_joined(edges, newest, following, a, b)
        u = start
        while is_lasting and u < stop:
            is_lasting = (
                separation(positions, u, a, period) >= limit
                or separation(positions, u, b, period) >= limit
            )
            u += 1
        if is_lasting:
            kept[n_kept, 0], kept[n_kept, 1] = a, b
            n_kept += 1
    return kept[:n_kept].copy()


@compiled
def divide(
    positions: NDArray[np.float64],
    found: NDArray[np.int32],
    edges: NDArray[np.int32],
    newest: NDArray[np.int32],
    following: NDArray[np.int32],
    length: float,
    period: float,
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Divide new pairs into those to be joined, nearer than a segment is long, and active ones.

    Parameters
    ----------
    positions, edges, newest, following, period
        Parts of a :class:`Stem`.
    found : ndarray of shape (n, 2), int32
        Relative neighbours; those that a segment joins already are left out.
    length : float
        Length of a segment.

    Returns
    -------
    near, far : ndarray of shape (k, 2), int32
        Rows of ``found`` in their order.
    """
    near, far = np.empty_like(found), np.empty_like(found)
    n_near = n_far = 0
    limit = length * (1.0 + MARGIN)
    limit = limit * limit
    for row in range(len(found)):
        a, b = found[row, 0], found[row, 1]
        if is_joined(edges, newest, following, a, b):
            continue
        if separation(positions, a, b, period) < limit:
            near[n_near, 0], near[n_near, 1] = a, b
            n_near += 1
        else:
            far[n_far, 0], far[n_far, 1] = a, b
            n_far += 1
    return near[:n_near].copy(), far[:n_far].copy()


def insert(old: Stem, start: int, length: float) -> Stem:
    """Bring pairs and segments up to date with the nodes from ``start`` on.

    Active pairs that a new node or a new segment has ended are dropped. Of the new
    nodes' relative neighbours those nearer than ``length`` are joined to them; the
    rest makes active pairs (Runions 2008, section 6.2.1). To be called once for every
    node, and after segments were made between old ones.

    Parameters
    ----------
    old : Stem
        The stem, the new nodes among its nodes.
    start : int
        Id of the first new node; the number of nodes if there is none.
    length : float
        Length of a segment.

    Returns
    -------
    Stem
        The stem with its pairs and segments.
    """
    positions, period = old.positions, old.period
    links = (old.edges, old.newest, old.following)
    if period > 0.0:
        found = relatives_on_surface(positions, start, old.n_nodes, period)
    else:
        found = relatives_of_new(old.tree, positions, old.parents, old.pairs, start, old.n_nodes)
    lasting = lasting_pairs(positions, old.pairs, start, old.n_nodes, *links, period)
    near, far = divide(positions, found, *links, length, period)
    return join(old._replace(pairs=np.concatenate((lasting, far))), near)


@compiled
def _directions(
    positions: NDArray[np.float64], n_nodes: int, pairs: NDArray[np.int32], period: float
) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Sum the unit vectors toward partners over the pairs, in their order."""
    tips = np.unique(pairs.reshape(-1))
    rank = np.empty(n_nodes, dtype=np.int32)
    for row in range(len(tips)):
        rank[tips[row]] = row
    sums = np.zeros((len(tips), 3))
    for k in range(len(pairs)):
        a, b = pairs[k, 0], pairs[k, 1]
        # active pairs are never nearer than a segment is long
        distance = np.sqrt(separation(positions, a, b, period))
        for axis in range(3):
            share = displacement(positions, a, b, axis, period) / distance
            sums[rank[a], axis] += share
            sums[rank[b], axis] -= share
    return tips, sums


def directions(old: Stem) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Give the nodes that are pulled, and whereto.

    Parameters
    ----------
    old : Stem
        The stem.

    Returns
    -------
    tips : ndarray of shape (k,), int32
        Nodes in active pairs, ascending; empty when nothing is left to do.
    sums : ndarray of shape (k, 3), float64
        Sums of unit vectors toward the other nodes of their pairs (equation 3.1).
    """
    return _directions(old.positions, old.n_nodes, old.pairs, old.period)


@compiled
def children(
    tree: Octree,
    positions: NDArray[np.float64],
    n_nodes: int,
    tips: NDArray[np.int32],
    sums: NDArray[np.float64],
    length: float,
    period: float,
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
    """Give places and parents of new nodes, and who is to be joined to whom.

    A new node that would lie on a node, old or just made, is not made: the two are
    joined.

    Parameters
    ----------
    tree, positions, n_nodes, period
        Parts of a :class:`Stem`.
    tips, sums : ndarray
        What ``directions`` gave.
    length : float
        Length of a segment.

    Returns
    -------
    places : ndarray of shape (k, 3), float64
        Of new nodes, whose ids are those from ``n_nodes`` on.
    parents : ndarray of shape (k,), int32
        Nodes that they grow from.
    joints : ndarray of shape (m, 2), int32
        Rows of a tip and the node that it comes to.
    """
    places = np.empty((len(tips), 3))
    parents = np.empty(len(tips), dtype=np.int32)
    joints = np.empty((len(tips), 2), dtype=np.int32)
    n_places = n_joints = 0
    for row in range(len(tips)):
        v = tips[row]
        norm = np.sqrt(
            sums[row, 0] * sums[row, 0] + sums[row, 1] * sums[row, 1] + sums[row, 2] * sums[row, 2]
        )
        if norm < STILL:
            continue
        x = on_surface(positions[v, 0] + length * sums[row, 0] / norm, period)
        y = positions[v, 1] + length * sums[row, 1] / norm
        z = positions[v, 2] + length * sums[row, 2] / norm
        limit = (MERGE * length) * (MERGE * length)
        w = nearest_on_surface(tree, positions, places, n_places, n_nodes, x, y, z, limit, period)
        if w < 0:
            places[n_places, 0], places[n_places, 1], places[n_places, 2] = x, y, z
            parents[n_places] = v
            w = n_nodes + n_places
            n_places += 1
        joints[n_joints, 0], joints[n_joints, 1] = v, w
        n_joints += 1
    return places[:n_places].copy(), parents[:n_places].copy(), joints[:n_joints].copy()


def extend(old: Stem, tips: NDArray[np.int32], sums: NDArray[np.float64], length: float) -> Stem:
    """Let every pulled node grow one segment; to be followed by ``insert``.

    Parameters
    ----------
    old : Stem
        The stem.
    tips, sums : ndarray
        What ``directions`` gave.
    length : float
        Length of a segment.

    Returns
    -------
    Stem
        The stem with the new nodes in its index, and with segments to them. If it has
        neither a node nor a segment more than before, it is at rest for ever.
    """
    places, parents, joints = children(
        old.tree, old.positions, old.n_nodes, tips, sums, length, old.period
    )
    return join(place(old, places, parents), joints)
