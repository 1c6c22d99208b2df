"""How fast tissue grows, and in which direction: growth tensors on a grid of material points."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Points
from vasc.domain import Blade
from vasc.errors import OutlineError
from vasc.growth.base import Growth

EDGE = 0.004
"""Share of the length of a blade that a grid stays away from tip and lowest point."""


class Strain(NamedTuple):
    """How tissue is deformed between two steps, on a grid of shape (rows, columns)."""

    areal: Floats
    """Growth rate of area, ln(det F) over the steps, in 1/step, shape (rows, columns)."""
    anisotropy: Floats
    """Greatest over least stretch, at least 1, shape (rows, columns)."""
    directions: NDArray[np.float64]
    """Unit vectors of the greatest stretch, at the later step, shape (rows, columns, 2)."""


def material_grid(
    growth: Growth, first: int, last: int, *, n_rows: int = 81, n_columns: int = 41
) -> NDArray[np.float64]:
    """Give material points in rows and columns that are evenly spaced over the blade.

    Parameters
    ----------
    growth : Growth
        The growing blade.
    first, last : int
        Steps between which growth is looked at. The grid is even at the first one; at
        the last one where the margin gains ground from the outside, as in marginal growth.
    n_rows, n_columns : int
        Size of the grid, at least 2.

    Returns
    -------
    ndarray of shape (rows, columns, 2), float64
        Rows from the base to the tip, each from the left to the right margin.

    Raises
    ------
    OutlineError
        If the blade has no height.
    """
    step = first if growth.affine(first) is None else last
    blade = growth.domain(step)
    left, right = _extents(blade, n_rows)
    shares = np.linspace(0.0, 1.0, n_columns)[:, None]
    places = left[:, None] + shares * (right - left)[:, None]
    material = growth.material(np.ascontiguousarray(places.reshape(-1, 2)), step)
    return material.reshape(n_rows, n_columns, 2)


def positions_of(growth: Growth, grid: NDArray[np.float64], step: int) -> NDArray[np.float64]:
    """Give the positions of a grid at a step, shape (rows, columns, 2), in D."""
    flat = np.ascontiguousarray(grid.reshape(-1, 2))
    return growth.position(flat, step).reshape(grid.shape)


def deformation_gradient(
    growth: Growth, grid: NDArray[np.float64], step: int, steps: int
) -> NDArray[np.float64]:
    """Give F, the derivative of later positions by earlier ones.

    Both are differentiated along rows and columns of the grid; what a row and a
    column are cancels out.

    Parameters
    ----------
    growth : Growth
        The growing blade.
    grid : ndarray of shape (rows, columns, 2), float64
        Material points, at least 3 rows and columns.
    step : int
        The earlier step.
    steps : int
        Steps up to the later one, at least 1.

    Returns
    -------
    ndarray of shape (rows, columns, 2, 2), float64
        The first axis of the matrix is x, y of the later, the second of the earlier step.
    """
    before, after = (_gradient(positions_of(growth, grid, at)) for at in (step, step + steps))
    return np.matmul(after, np.linalg.inv(before))


def growth_tensor(
    growth: Growth, grid: NDArray[np.float64], step: int, steps: int
) -> NDArray[np.float64]:
    """Give (F - 1) over the steps: relative velocities over a unit of length.

    Parameters
    ----------
    growth, grid, step, steps
        See :func:`deformation_gradient`.

    Returns
    -------
    ndarray of shape (rows, columns, 2, 2), float64
        In 1/step. Its symmetric part tells how fast lengths grow in each direction,
        the other how fast tissue turns.

    References
    ----------
    Z. Hejnowicz and J. A. Romberger (1984). Growth tensor of plant organs. Journal of
    Theoretical Biology 110, 93-114.
    """
    return (deformation_gradient(growth, grid, step, steps) - np.eye(2)) / steps


def strain(growth: Growth, grid: NDArray[np.float64], step: int, steps: int) -> Strain:
    """Give the growth of area, and how unequal directions grow.

    Parameters
    ----------
    growth, grid, step, steps
        See :func:`deformation_gradient`.

    Returns
    -------
    Strain
    """
    gradient = deformation_gradient(growth, grid, step, steps)
    directions, stretches, _ = np.linalg.svd(gradient)
    areal = np.log(stretches[..., 0] * stretches[..., 1]) / steps
    return Strain(areal, stretches[..., 0] / stretches[..., 1], directions[..., :, 0])


def _gradient(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give derivatives of positions along columns and rows, as the columns of matrices."""
    by_row, by_column = np.gradient(places, axis=(0, 1), edge_order=2)
    return np.stack([by_column, by_row], axis=-1)


def _extents(blade: Blade, n_rows: int) -> tuple[Points, Points]:
    """Give the leftmost and the rightmost place of the blade at evenly spaced heights."""
    low, high = blade.bounds[1], blade.bounds[3]
    margin = EDGE * (high - low)
    if not margin > 0.0:
        raise OutlineError("outline: no height; growth is looked at between base and tip")
    heights = np.linspace(low + margin, high - margin, n_rows)
    left, right = np.full(n_rows, np.inf), np.full(n_rows, -np.inf)
    for ring in blade.rings:
        x1, y1 = ring.T
        x2, y2 = np.roll(ring, -1, axis=0).T
        for row, height in enumerate(heights.tolist()):
            crosses = (y1 <= height) != (y2 <= height)
            rise = (height - y1[crosses]) / (y2[crosses] - y1[crosses])
            across = x1[crosses] + rise * (x2[crosses] - x1[crosses])
            if len(across):
                left[row] = min(left[row], float(across.min()))
                right[row] = max(right[row], float(across.max()))
    # where two parts leave a gap between them, there is no tissue: what is nearest stands for it
    known = np.flatnonzero(np.isfinite(left))
    left = np.interp(np.arange(n_rows), known, left[known])
    right = np.interp(np.arange(n_rows), known, right[known])
    return np.stack([left, heights], axis=1), np.stack([right, heights], axis=1)
