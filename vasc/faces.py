"""Planar drawings, and walks around their faces."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Floats, Ids, Points


@dataclass(frozen=True)
class Drawing:
    """Points and the segments between them, which meet in these points only.

    Parameters
    ----------
    points : ndarray of shape (p, 2), float64
        No two alike where segments end in them.
    segments : ndarray of shape (q, 2), int32
        Rows of the two end points.
    """

    points: Points
    segments: Ids


@dataclass(frozen=True)
class FaceWalks:
    """Every segment walked once along each side; a closed walk goes around a face.

    Parameters
    ----------
    starts, ends : ndarray of shape (2q,), int32
        Points each half-edge goes from and to; its face lies on the left.
    faces : ndarray of shape (2q,), int32
        The walk each half-edge belongs to, 0 ... f-1.
    components : ndarray of shape (f,), int32
        The connected component each walk goes along.
    areas : ndarray of shape (f,), float64
        Area inside each walk; the walk around the outside of a component has
        the negative of its area.
    is_outside : ndarray of shape (f,), bool
        True for the one walk around the outside of each component.
    followers : ndarray of shape (2q,), intp
        The half-edge that follows each along its walk.
    """

    starts: Ids
    ends: Ids
    faces: Ids
    components: Ids
    areas: Floats
    is_outside: NDArray[np.bool_]
    followers: NDArray[np.intp]

    def around(self, half_edge: int) -> list[int]:
        """Give the points along a walk from the start of a half-edge on, spurs left out."""
        points: list[int] = []
        current = half_edge
        while True:
            points.append(int(self.starts[current]))
            # there and back again is a spur
            while len(points) > 2 and points[-1] == points[-3]:
                del points[-2:]
            current = int(self.followers[current])
            if current == half_edge:
                break
        while len(points) > 2 and points[0] == points[-2]:
            del points[-2:]
        while len(points) > 2 and points[-1] == points[1]:
            del points[:2]
        return points


def face_walks(drawing: Drawing) -> FaceWalks:
    """Walk around all faces of a planar drawing.

    Parameters
    ----------
    drawing : Drawing
        At least one segment; segments meet in its points only.

    Returns
    -------
    FaceWalks
        By Euler's formula q - p + 2c walks for q segments, p points with
        segments, and c components.
    """
    points = drawing.points
    starts = np.concatenate([drawing.segments[:, 0], drawing.segments[:, 1]])
    ends = np.concatenate([drawing.segments[:, 1], drawing.segments[:, 0]])
    around = _around(points, drawing.segments, starts)
    followers = _followers(starts, around)
    faces, components = _labels(followers, drawing)
    n_faces = int(faces.max()) + 1
    twice = np.bincount(faces, _crosses(points, drawing.segments), minlength=n_faces)
    of_faces = np.zeros(n_faces, dtype=np.int32)
    of_faces[faces] = components[starts]
    is_outside = np.zeros(n_faces, dtype=bool)
    is_outside[faces[_leftmost(points, starts, components, around)]] = True
    return FaceWalks(starts, ends, faces, of_faces, twice / 2.0, is_outside, followers)


def _around(points: Points, segments: Ids, starts: Ids) -> NDArray[np.intp]:
    """Order half-edges by the point they start from, then by angle."""
    vectors = points[segments[:, 1]]
    vectors -= points[segments[:, 0]]
    angles = np.empty(len(starts))
    angles[: len(segments)] = turns(vectors)
    angles[len(segments) :] = turns(np.negative(vectors, out=vectors))
    return np.lexsort((angles, starts))


def _crosses(points: Points, segments: Ids) -> Floats:
    """Give twice the signed area between the first point and each half-edge."""
    # coordinates relative to the first point keep the sums small
    a, b = (points[segments[:, end]] - points[0] for end in (0, 1))
    crosses = a[:, 0] * b[:, 1]
    crosses -= a[:, 1] * b[:, 0]
    # the way back has the negative, bit by bit
    return np.concatenate([crosses, -crosses])


def turns(vectors: Points) -> Floats:
    """Give numbers in the order of the vectors' angles, from -2 (left, from below) to 2.

    They need no arctangent, whose last bit depends on the processor.

    Examples
    --------
    >>> turns(np.array([[1.0, 0.0], [0.0, 2.0], [-3.0, 0.0], [0.0, -1.0]])).tolist()
    [0.0, 1.0, 2.0, -1.0]
    """
    x, y = vectors[:, 0], vectors[:, 1]
    size = np.abs(x) + np.abs(y)
    share = np.divide(y, size, out=np.zeros_like(size), where=size > 0.0)
    return np.where(x >= 0.0, share, np.where(y >= 0.0, 2.0 - share, -2.0 - share))


def _followers(starts: Ids, around: NDArray[np.intp]) -> NDArray[np.intp]:
    """Give each half-edge's next one along its face: the first to the right of turning back."""
    n_half_edges = len(starts)
    group = np.r_[0, np.flatnonzero(np.diff(starts[around])) + 1, n_half_edges]
    clockwise = np.empty(n_half_edges, dtype=np.intp)
    clockwise[around[1:]] = around[:-1]
    clockwise[around[group[:-1]]] = around[group[1:] - 1]
    twins = np.r_[n_half_edges // 2 : n_half_edges, 0 : n_half_edges // 2]
    return clockwise[twins]


def _labels(followers: NDArray[np.intp], drawing: Drawing) -> tuple[Ids, Ids]:
    """Give a number to every closed walk of half-edges and to every component of points."""
    return _numbered(_least_followers(followers)), _components(drawing)


def _least_followers(followers: NDArray[np.intp]) -> Ids:
    """Give the least half-edge of the walk that each half-edge is on."""
    least = np.arange(len(followers), dtype=np.int32)
    ahead = followers.astype(np.int32)
    # pointers are doubled: round k has looked 2^k half-edges ahead
    for _ in range(len(followers).bit_length()):
        np.minimum(least, least[ahead], out=least)
        ahead = ahead[ahead]
    return least


def _components(drawing: Drawing) -> Ids:
    """Give a number to the component of every point with segments, -1 to others."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    # rows of dead nodes would only take memory
    used = np.unique(drawing.segments)
    links = np.searchsorted(used, drawing.segments).astype(np.int32)
    ones = np.ones(len(links), dtype=np.int8)
    graph = coo_array((ones, (links[:, 0], links[:, 1])), shape=(len(used), len(used)))
    components = np.full(len(drawing.points), NULL, dtype=np.int32)
    components[used] = connected_components(graph, directed=False)[1]
    return components


def _numbered(least: Ids) -> Ids:
    """Give 0, 1, 2, ... in the place of numbers, in their order."""
    is_first = np.zeros(len(least), dtype=np.int32)
    is_first[least] = 1
    found: Ids = (np.cumsum(is_first, dtype=np.int32) - 1)[least]
    return found


def _leftmost(
    points: Points, starts: Ids, components: Ids, around: NDArray[np.intp]
) -> NDArray[np.intp]:
    """Give a half-edge of each component with the outside on its left.

    Around the leftmost (then lowest) point of a component all half-edges go to
    the right; the last of them, counterclockwise, has the outside on its left.
    """
    at = starts[around]
    last = around[np.r_[np.flatnonzero(np.diff(at)), len(at) - 1]]
    owners = components[starts[last]]
    x, y = points[starts[last]].T
    rows = np.lexsort((y, x, owners))
    return last[rows[np.r_[True, np.diff(owners[rows]) != 0]]]
