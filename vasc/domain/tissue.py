"""The tissue: cells and the walls between them, which stay where they are."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vasc.arrays import Floats, Ids, Points, as_points
from vasc.domain.blade import Blade
from vasc.domain.sides import FREE, CellRings, Sides, outline_sides, sides_of

BESIDE = 1.0 + 1e-9
"""A point off the tissue counts as on it up to that distance from a centre, in D: the base of a
blade is as far from the hexagons around it as they are from each other, but for rounding."""


@dataclass(frozen=True, eq=False)
class Tissue:
    """Cells and walls; lengths in D, which is about the width of a cell.

    Parameters
    ----------
    positions : ndarray of shape (n, 2), float64
        Centres of the cells; row = cell id.
    volumes : ndarray of shape (n,), float64
        Their areas: the tissue is one cell thick.
    walls : ndarray of shape (w, 2), int32
        The two cells that each wall parts, the lower id first; row = wall id.
    lengths : ndarray of shape (w,), float64
        Lengths of the walls.
    distances : ndarray of shape (w,), float64
        Distances between the centres on both sides of each wall.
    corners : ndarray of shape (c, 2), float64
        Corners of all cells, one cell after the other, counterclockwise.
    starts : ndarray of shape (n + 1,), int32
        First corner of each cell, and the number of corners.
    blade : Blade
        The outline around the tissue.
    """

    positions: Points
    volumes: Floats
    walls: Ids
    lengths: Floats
    distances: Floats
    corners: Points
    starts: Ids
    blade: Blade

    @property
    def n_cells(self) -> int:
        """Number of cells."""
        return len(self.positions)

    @property
    def n_walls(self) -> int:
        """Number of walls between two cells; those of the margin are not counted."""
        return len(self.walls)

    @cached_property
    def polygons(self) -> list[Points]:
        """Corners of every cell, counterclockwise."""
        return np.split(self.corners, self.starts[1:-1])

    @cached_property
    def adjacency(self) -> Any:
        """Distances between the centres of neighbors: a symmetric (n, n) scipy sparse array."""
        from scipy.sparse import coo_array

        first, second = self.walls[:, 0], self.walls[:, 1]
        ends = np.concatenate([first, second]), np.concatenate([second, first])
        values = np.concatenate([self.distances, self.distances])
        return coo_array((values, ends), shape=(self.n_cells, self.n_cells)).tocsr()

    @cached_property
    def sides(self) -> Sides:
        """The sides of all cells, and which of them two cells share."""
        # neighbors have the same numbers for a corner that they share, also in a record
        exact = np.ascontiguousarray(self.corners + 0.0).view(np.complex128).ravel()
        shared, rows = np.unique(exact, return_inverse=True)
        places = np.stack([shared.real, shared.imag], axis=1)
        return sides_of(CellRings(places, rows, self.starts.astype(np.int64)))

    @cached_property
    def is_margin(self) -> NDArray[np.bool_]:
        """Which cells have a side that no other cell shares, shape (n,)."""
        is_margin = np.zeros(self.n_cells, dtype=np.bool_)
        is_margin[self.sides.cells[self.sides.partners == FREE]] = True
        return is_margin

    @cached_property
    def margins(self) -> list[Ids]:
        """The cells along each ring of the outline, around to the first again.

        Neighbors share walls: where the margin turns in at a corner of three cells, the one
        between is among them, though none of its sides is free.
        """
        found = []
        for ring in outline_sides(self.sides):
            cells = self.sides.cells[ring].tolist()
            around = cells[:1]
            for cell in [*cells[1:], cells[0]]:
                if cell != around[-1]:
                    around.extend(self._way(around[-1], cell))
            found.append(np.array(around, dtype=np.int32))
        return found

    def are_outside(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Tell which points are off the tissue, and more than 1 D from any centre; shape (k,)."""
        from scipy.spatial import cKDTree

        xy = as_points(points, "points")
        near, _ = cKDTree(self.positions).query(xy)
        return ~self.blade.contains(xy) & (near > BESIDE)

    def distances_from(self, cells: Ids | NDArray[np.bool_]) -> Floats:
        """Give the straight distance of each cell from the nearest of some, shape (n,).

        Parameters
        ----------
        cells : ndarray of int32, or of shape (n,), bool
            Their ids, or which ones they are; at least one.
        """
        from scipy.spatial import cKDTree

        distances, _ = cKDTree(self.positions[cells]).query(self.positions)
        return np.asarray(distances, dtype=np.float64)

    def nearest_cells(self, points: ArrayLike) -> Ids:
        """Give the cell whose centre is nearest to each point, the lower id of two; shape (k,)."""
        from scipy.spatial import cKDTree

        xy = as_points(points, "points")
        near, tied = cKDTree(self.positions).query(xy, k=min(2, self.n_cells))
        if near.ndim == 1:
            return np.asarray(tied, dtype=np.int32)
        is_tie = near[:, 0] == near[:, 1]
        tied[is_tie] = tied[is_tie].min(axis=1, keepdims=True)
        return np.asarray(tied[:, 0], dtype=np.int32)

    def cells_along(self, line: Sequence[ArrayLike] | Points) -> Ids:
        """Give the cells that a line passes, in its order, each once; neighbors share walls.

        Parameters
        ----------
        line : array_like of shape (k, 2)
            One point, or the corners of a line.
        """
        corners = as_points(np.asarray(line), "line")
        cells = [int(cell) for cell in self.nearest_cells(sampled(corners))]
        passed = cells[:1]
        for cell in cells[1:]:
            if cell not in passed:
                # a line that passes a corner of cells steps over the wall beside it
                way = self._way(passed[-1], cell)
                passed.extend(one for one in way if one not in passed)
        return np.array(passed, dtype=np.int32)

    def hops(self, cells: ArrayLike) -> NDArray[np.float64]:
        """Give the length of the shortest way over cells from the nearest of some, shape (n,).

        It is infinite where there is no way.
        """
        from scipy.sparse.csgraph import dijkstra

        indices = np.atleast_1d(np.asarray(cells))
        reached = dijkstra(self.adjacency, indices=indices, min_only=True)
        return np.asarray(reached, dtype=np.float64)

    def _way(self, start: int, end: int) -> list[int]:
        """Give the cells of the shortest way from one to another, without the first."""
        from scipy.sparse.csgraph import dijkstra

        if end in self._neighbors(start):
            return [end]
        _, before = dijkstra(self.adjacency, indices=start, limit=4.0, return_predecessors=True)
        way = [end]
        while before[way[-1]] >= 0 and before[way[-1]] != start:
            way.append(int(before[way[-1]]))
        return way[::-1]

    def _neighbors(self, cell: int) -> NDArray[np.int32]:
        """Give the cells that share a wall with one."""
        begin, end = self.adjacency.indptr[cell : cell + 2]
        neighbors: NDArray[np.int32] = self.adjacency.indices[begin:end]
        return neighbors


def sampled(corners: Points) -> Points:
    """Give points along a line, a quarter of D apart at most."""
    pieces = [corners[:1]]
    for start, end in pairwise(corners):
        n_pieces = max(1, int(np.ceil(4.0 * np.hypot(*(end - start)))))
        share = np.arange(1, n_pieces + 1)[:, None] / n_pieces
        pieces.append(start + share * (end - start))
    return np.concatenate(pieces)
