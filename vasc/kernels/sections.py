"""Sections: the pieces of vein from one junction or end to the next.

A half-edge goes along a segment one way: k from its first point to its second,
q + k back, for q segments.
"""

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled

Ids = NDArray[np.int32]


def incidences(segments: Ids, n_points: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """List the half-edges that leave each point.

    Parameters
    ----------
    segments : ndarray of shape (q, 2), int32
        Rows of the two points of each segment.
    n_points : int
        How many points there are.

    Returns
    -------
    tuple of ndarray
        Where the list of each point begins, shape (n_points + 1,), and the list,
        shape (2q,), by point, then by half-edge.
    """
    starts = segments.T.ravel()
    counts = np.bincount(starts, minlength=n_points)
    leaving = np.argsort(starts, kind="stable").astype(np.int64)
    return np.concatenate([[0], np.cumsum(counts)]).astype(np.int64), leaving


@compiled
def _walk(
    segments: Ids,
    firsts: NDArray[np.int64],
    leaving: NDArray[np.int64],
    is_stop: NDArray[np.bool_],
    half_edge: int,
    is_walked: NDArray[np.bool_],
    walked: NDArray[np.int64],
    n_walked: int,
) -> int:
    """Walk from a half-edge on to a junction, an end, or back; gives the half-edges so far."""
    n_segments = len(segments)
    while True:
        row = half_edge % n_segments
        is_walked[row] = True
        walked[n_walked] = half_edge
        n_walked += 1
        point = segments[row, 1 if half_edge < n_segments else 0]
        if is_stop[point]:
            return n_walked
        half_edge = leaving[firsts[point]]
        if is_walked[half_edge % n_segments]:
            half_edge = leaving[firsts[point] + 1]
        if is_walked[half_edge % n_segments]:
            return n_walked


@compiled
def walk_sections(
    segments: Ids,
    firsts: NDArray[np.int64],
    leaving: NDArray[np.int64],
    is_stop: NDArray[np.bool_],
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Walk along all sections, each segment once.

    Parameters
    ----------
    segments : ndarray of shape (q, 2), int32
        Rows of the two points of each segment, never the same twice in a row.
    firsts, leaving : ndarray of int64
        What :func:`incidences` gives.
    is_stop : ndarray of shape (p,), bool
        Points at which sections end: all that do not have two segments, and others.

    Returns
    -------
    tuple of ndarray
        Half-edges in the order walked, shape (q,), and where each section begins
        among them, with q at the end, shape (k + 1,). A ring without a junction
        is a section from one of its points to the same.
    """
    n_segments = len(segments)
    is_walked = np.zeros(n_segments, dtype=np.bool_)
    walked = np.empty(n_segments, dtype=np.int64)
    begins = np.empty(n_segments + 1, dtype=np.int64)
    n_walked = n_begun = 0
    for point in range(len(firsts) - 1):
        if not is_stop[point]:
            continue
        for place in range(firsts[point], firsts[point + 1]):
            if not is_walked[leaving[place] % n_segments]:
                begins[n_begun] = n_walked
                n_begun += 1
                start = leaving[place]
                n_walked = _walk(
                    segments, firsts, leaving, is_stop, start, is_walked, walked, n_walked
                )
    for row in range(n_segments):
        if not is_walked[row]:
            begins[n_begun] = n_walked
            n_begun += 1
            n_walked = _walk(segments, firsts, leaving, is_stop, row, is_walked, walked, n_walked)
    begins[n_begun] = n_walked
    return walked, begins[: n_begun + 1].copy()
