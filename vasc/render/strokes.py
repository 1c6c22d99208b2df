"""Segments strung together to long lines, so that many thousands draw fast."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.ancestry import Descent
from vasc.arrays import Ids, Points


@dataclass(frozen=True)
class Strokes:
    """Lines of one look each, in the order of their looks.

    Parameters
    ----------
    points : ndarray of shape (p, 2), float64
        Points of all lines, one line after the other.
    line_starts : ndarray of shape (k + 1,), int64
        Where each line begins in ``points``, and the end.
    looks : ndarray of shape (k,), int64
        The look of each line, ascending.
    """

    points: Points
    line_starts: NDArray[np.int64]
    looks: NDArray[np.int64]

    def batches(self, max_points: int = 4000) -> Iterator[tuple[int, Points, NDArray[np.bool_]]]:
        """Give lines of one look together: the look, points, and which begin a line.

        Parameters
        ----------
        max_points : int
            Points in a batch, about.
        """
        if not len(self.looks):
            return
        is_start = np.zeros(len(self.points), dtype=bool)
        is_start[self.line_starts[:-1]] = True
        changes = np.r_[0, np.flatnonzero(np.diff(self.looks)) + 1, len(self.looks)]
        for first, stop in pairwise(changes.tolist()):
            starts = self.line_starts[first:stop]
            # a line begins a batch if it is the first beyond a multiple of max_points
            shares = (starts - starts[0]) // max_points
            begins = starts[np.r_[True, np.diff(shares) > 0]]
            for begin, end in pairwise([*begins.tolist(), int(self.line_starts[stop])]):
                yield int(self.looks[first]), self.points[begin:end], is_start[begin:end]


def string_together(positions: Points, directions: Descent, looks: NDArray[np.int64]) -> Strokes:
    """Join segments of one look that follow each other to lines.

    Parameters
    ----------
    positions : ndarray of shape (n, 2), float64
        Node positions.
    directions : Descent
        The segments, from older to newer nodes.
    looks : ndarray of shape (m,), int64
        A number for the look of each segment; low ones are drawn first.

    Returns
    -------
    Strokes
        Every segment in exactly one line.
    """
    n_segments = len(looks)
    heads, places = _lines(directions, looks)
    order = np.lexsort((places, heads, looks))
    is_head = heads[order] == order
    line_numbers = np.cumsum(is_head) - 1
    n_lines = int(is_head.sum())
    # a line of k segments has k + 1 points: its first proximal node, then all distal ones
    points = np.empty((n_segments + n_lines, 2))
    points[np.arange(n_segments) + line_numbers + 1] = positions[directions.distal[order]]
    starts = np.flatnonzero(is_head) + np.arange(n_lines)
    points[starts] = positions[directions.proximal[order[is_head]]]
    return Strokes(
        points,
        np.r_[starts, len(points)].astype(np.int64),
        looks[order[is_head]].astype(np.int64),
    )


def _lines(directions: Descent, looks: NDArray[np.int64]) -> tuple[Ids, NDArray[np.int64]]:
    """Give for every segment the first segment of its line, and its place in the line."""
    before = _segments_before(directions, looks)
    places: NDArray[np.int64] = np.not_equal(before, np.arange(len(before))).astype(np.int64)
    for _ in range(len(before).bit_length() + 1):
        farther = before[before]
        if np.array_equal(farther, before):
            break
        places += places[before]
        before = farther
    return before.astype(np.int32), places


def _segments_before(directions: Descent, looks: NDArray[np.int64]) -> NDArray[np.intp]:
    """Give for every segment one of its look that ends where it begins, or itself."""
    n_looks = int(looks.max(initial=0)) + 1
    # at a node, the first segment that ends meets the first that begins with the same look
    ends = directions.distal.astype(np.int64) * n_looks + looks
    begins = directions.proximal.astype(np.int64) * n_looks + looks
    end_keys, end_rows = np.unique(ends, return_index=True)
    begin_keys, begin_rows = np.unique(begins, return_index=True)
    _, met_ends, met_begins = np.intersect1d(
        end_keys, begin_keys, assume_unique=True, return_indices=True
    )
    before = np.arange(len(looks), dtype=np.intp)
    before[begin_rows[met_begins]] = end_rows[met_ends]
    return before
