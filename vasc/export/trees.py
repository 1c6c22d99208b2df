"""Networks without loops as SWC and MTG: a node, and the one that it hangs on."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from vasc.arrays import NULL, Ids
from vasc.errors import VascError
from vasc.export.specimen import ORIGINS, Specimen
from vasc.export.words import as_bytes, comment
from vasc.network import SegmentKind

UNDEFINED = 0
"""The type of all SWC points: the others are parts of neurons."""


@dataclass(frozen=True)
class Tree:
    """For every node the one before it on the way to the base.

    Parameters
    ----------
    rows : ndarray of shape (n,), int64
        All rows, each after that of its parent.
    parents : ndarray of shape (n,), int32
        Row of the parent of each row, -1 for a base.
    segments : ndarray of shape (n,), int32
        Row of the segment between the two, -1 for a base.
    """

    rows: Ids
    parents: Ids
    segments: Ids


def tree_of(specimen: Specimen, *, spanning: bool = False) -> Tree:
    """Give a network as a tree.

    Parameters
    ----------
    specimen : Specimen
        The step.
    spanning : bool
        Where veins joined, keep the segment by which a node grew, and leave the joins out.

    Returns
    -------
    Tree

    Raises
    ------
    VascError
        If veins join and ``spanning`` is not set.
    """
    distal = specimen.ends[:, 1]
    n_nodes = len(specimen.ids)
    n_joined = int((np.bincount(distal, minlength=n_nodes) > 1).sum())
    if n_joined and not spanning:
        raise VascError(
            f"{specimen.run}: veins join at {n_joined:,} nodes, and the format holds trees only;"
            " --spanning-tree leaves the joins out"
        )
    # the first segment that leads to a node is the one it grew by: the oldest that is no join
    preferred = np.lexsort((specimen.segment_ids, specimen.kinds == SegmentKind.JOIN, distal))
    reached, first = np.unique(distal[preferred], return_index=True)
    segments = np.full(n_nodes, NULL, dtype=np.int32)
    segments[reached] = preferred[first]
    parents = np.full(n_nodes, NULL, dtype=np.int32)
    parents[reached] = specimen.ends[segments[reached], 0]
    return Tree(np.argsort(specimen.ranks, kind="stable").astype(np.int32), parents, segments)


def swc(specimen: Specimen, *, spanning: bool = False) -> bytes:
    """Give a tree-like network as SWC.

    Parameters
    ----------
    specimen : Specimen
        The step.
    spanning : bool
        See :func:`tree_of`.

    Returns
    -------
    bytes
        A line a node: number from 1 (the id of the node + 1 where refinement added none, as the
        head says), type 0, x, y, z (0 of a leaf), radius, number of the parent
        or -1. A parent comes before its children.

    Raises
    ------
    VascError
        If veins join and ``spanning`` is not set.
    """
    tree = tree_of(specimen, spanning=spanning)
    numbers = np.empty(len(tree.rows), dtype=np.int64)
    numbers[tree.rows] = np.arange(1, len(tree.rows) + 1)
    places = np.zeros((len(tree.rows), 3))
    places[:, : len(specimen.axes)] = specimen.positions
    radii = specimen.radii.tolist()
    lines = []
    for row in tree.rows.tolist():
        x, y, z = places[row].tolist()
        parent = tree.parents[row]
        above = NULL if parent == NULL else numbers[parent]
        lines.append(f"{numbers[row]} {UNDEFINED} {x!r} {y!r} {z!r} {radii[row]!r} {above}")
    return as_bytes(
        [
            *comment(specimen.heading),
            *comment(_left_out(spanning)),
            *comment(_numbered(specimen, tree)),
            *comment(["n type x y z radius parent"]),
            *lines,
        ]
    )


def _numbered(specimen: Specimen, tree: Tree) -> list[str]:
    """Say how the numbers of points follow from the ids of nodes."""
    ids = specimen.ids[tree.rows]
    if np.array_equal(ids, np.arange(len(ids))):
        return ["n is the id of the node + 1, as SWC counts from 1"]
    return ["n counts the points from 1 and is no id, as refinement has added nodes; MTG has ids"]


def mtg(specimen: Specimen, *, spanning: bool = False) -> bytes:
    """Give a tree-like network as a multiscale tree graph, in OpenAlea's text format.

    Parameters
    ----------
    specimen : Specimen
        The step.
    spanning : bool
        See :func:`tree_of`.

    Returns
    -------
    bytes
        Scale 1 is the venation that hangs on one base, P; scale 2 are the nodes, N, whose index
        is the id. At a node the thickest vein goes on (``<``), the others branch off (``+``),
        each one column farther to the right.

    Raises
    ------
    VascError
        If veins join and ``spanning`` is not set.
    """
    tree = tree_of(specimen, spanning=spanning)
    entities = list(_entities(specimen, tree))
    n_columns = max((column for column, *_ in entities), default=0) + 1
    tab = "\t"
    features = ("XX", "YY", "ZZ", "Radius", "Order", "Birth", "Source", "Origin")
    kinds = ("REAL",) * 4 + ("INT",) * 3 + ("ALPHA",)
    return as_bytes(
        [
            *comment(specimen.heading),
            *comment(_left_out(spanning)),
            "CODE:\tFORM-A",
            "",
            "CLASSES:",
            "SYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION",
            "$\t0\tFREE\tFREE\tIMPLICIT",
            "P\t1\tFREE\tFREE\tEXPLICIT",
            "N\t2\tFREE\tFREE\tEXPLICIT",
            "",
            "DESCRIPTION:",
            "LEFT\tRIGHT\tRELTYPE\tMAX",
            "N\tN\t+\t?",
            "N\tN\t<\t1",
            "",
            "FEATURES:",
            "NAME\tTYPE",
            *(f"{name}\t{kind}" for name, kind in zip(features, kinds, strict=True)),
            "",
            "MTG:",
            "ENTITY-CODE" + tab * n_columns + tab.join(features),
            *(
                tab * column + code + tab * (n_columns - column) + tab.join(values)
                for column, code, values in entities
            ),
        ]
    )


def _left_out(spanning: bool) -> list[str]:
    """Say what is missing."""
    return ["a spanning tree: joins are left out"] if spanning else []


def _entities(specimen: Specimen, tree: Tree) -> Iterator[tuple[int, str, list[str]]]:
    """Give column, code and features of every entity of a multiscale tree graph, in order."""
    children = _children(specimen, tree)
    values = _features(specimen, tree)
    bases = np.flatnonzero(tree.parents == NULL).tolist()
    for number, base in enumerate(bases, start=1):
        # a node's branches stand right below it, before its vein goes on
        waiting = [(0, f"/P{number}/N", base)]
        while waiting:
            column, sign, row = waiting.pop()
            yield column, f"{sign}{specimen.ids[row]}", values[row]
            main, *branches = children[row] or [NULL]
            if main != NULL:
                waiting.append((column, "^<N", main))
            waiting += [(column + 1, "+N", branch) for branch in reversed(branches)]


def _children(specimen: Specimen, tree: Tree) -> list[list[int]]:
    """Give the children of every row, that of the thickest vein first."""
    found: list[list[int]] = [[] for _ in tree.rows]
    rows = tree.rows[tree.parents[tree.rows] != NULL]
    thickest = np.argsort(-specimen.widths[tree.segments[rows]], kind="stable")
    for row in rows[thickest].tolist():
        found[tree.parents[row]].append(row)
    return found


def _features(specimen: Specimen, tree: Tree) -> list[list[str]]:
    """Give the features of every row, in the order of their names."""
    places = np.zeros((len(specimen.ids), 3))
    places[:, : len(specimen.axes)] = specimen.positions
    orders = np.ones(len(specimen.ids), dtype=np.int64)
    has_parent = tree.segments != NULL
    orders[has_parent] = specimen.orders[tree.segments[has_parent]]
    columns = [*places.T.tolist(), specimen.radii.tolist(), orders.tolist()]
    columns += [specimen.births.tolist(), specimen.causes.tolist()]
    words = [ORIGINS[code] for code in specimen.origins.tolist()]
    return [
        [*(repr(value) for value in row), word]
        for row, word in zip(zip(*columns, strict=True), words, strict=True)
    ]
