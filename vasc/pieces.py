"""Segments that refinement has cut up: which segment each piece comes from, and what grew that."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids
from vasc.events import EventKind
from vasc.network import Growths, SegmentKind


def growths_of(
    ids: Ids,
    nodes: Mapping[str, NDArray],
    segments: Mapping[str, NDArray],
    events: Mapping[str, NDArray],
) -> Growths:
    """Give the growth event behind each of some segments.

    Parameters
    ----------
    ids : ndarray of shape (m,), int32
        Rows of the segments asked for.
    nodes, segments, events : mapping of str to ndarray
        Columns of the tables: ``parent`` and ``source``; ``nodes``, ``birth`` and ``kind``;
        ``kind``, ``subject`` and ``object``.

    Returns
    -------
    Growths
        A segment that joined veins was caused by the source at which they met, any other
        by the source of the node that it led to.
    """
    grown = grown_segments(nodes["parent"], segments, events)[ids]
    newer = segments["nodes"].max(axis=1)[grown]
    met = np.full(len(segments["birth"]), NULL, dtype=np.int32)
    is_join = events["kind"] == EventKind.VEIN_JOINED
    met[events["subject"][is_join]] = events["object"][is_join]
    causes = np.where(met[grown] != NULL, met[grown], nodes["source"][newer])
    return Growths(grown, newer, segments["birth"][grown], causes.astype(np.int32))


def grown_segments(
    parents: Ids, segments: Mapping[str, NDArray], events: Mapping[str, NDArray]
) -> Ids:
    """Give for every segment the one that veins grew, of which it is a piece.

    A segment of refinement is a piece of what the newer of its nodes was put into. The one
    that cuts a corner lies on two segments, and counts as a piece of the one before it.

    Parameters
    ----------
    parents : ndarray of shape (n,), int32
        Parents of the nodes.
    segments, events : mapping of str to ndarray
        Columns ``nodes`` and ``kind``; ``kind``, ``subject`` and ``object``.

    Returns
    -------
    ndarray of shape (m,), int32
        Ids of segments, for most their own.
    """
    grown = np.arange(len(segments["kind"]), dtype=np.int32)
    is_cut = events["kind"] == EventKind.SEGMENT_REFINED
    if not is_cut.any():
        return grown
    replaced = np.full(len(parents), NULL, dtype=np.int32)
    replaced[events["object"][is_cut]] = events["subject"][is_cut]
    ends = segments["nodes"]
    # the two nodes that cut a corner have one parent, the node they replace
    is_corner = (parents[ends[:, 0]] == parents[ends[:, 1]]) & (replaced[ends] != NULL).all(axis=1)
    before = replaced[np.where(is_corner, ends[:, 0], ends.max(axis=1))]
    is_piece = (segments["kind"] == SegmentKind.REFINEMENT) & (before != NULL)
    grown[is_piece] = before[is_piece]
    # strides double at each turn, so that the longest chain of pieces takes log2(m) turns
    for _ in range(len(grown).bit_length()):
        grown = grown[grown]
    return grown
