"""Spline surfaces of growing leaves: their control rows from outlines and landmarks by age.

The surface is that of :mod:`vasc.kernels.bspline`, which runs evaluate point by point; a fit
needs the weights of the rows as matrices, and derivatives by the rows, which no run asks for.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from vasc import kernels
from vasc.arrays import Floats, Points

N_COLUMNS = 5
"""Control points across the blade; with five, a row bends as a parabola does."""


def heights_of_rows(n_rows: int) -> Floats:
    """Give the heights of even rows, with which a place is as high as its v, shape (n_rows,)."""
    return kernels.bspline.abscissae(kernels.bspline.clamped_knots(n_rows))


def arch(c: ArrayLike, derivative: int = 0) -> Floats:
    """Give q(c), the share of a row's rise that a place across the leaf has, or a derivative.

    Examples
    --------
    >>> arch([-1.0, 1.0]).tolist(), round(float(arch(0.0)), 3)
    ([1.0, 1.0], 0.222)
    """
    from scipy.interpolate import BSpline

    shape = kernels.bspline.surface(kernels.bspline.DEGREE + 1, N_COLUMNS)
    curve = BSpline(shape.arch_knots, shape.arch, kernels.bspline.DEGREE)
    # u = (1 + c) / 2
    return 0.5**derivative * curve(0.5 * (1.0 + np.clip(c, -1.0, 1.0)), nu=derivative)


@dataclass(frozen=True)
class Places:
    """Material points of a surface with so many rows, and what is linear in the rows there.

    Parameters
    ----------
    c, v : ndarray of shape (n,), float64
        Material coordinates.
    n_rows : int
        Rows of the surface.
    """

    c: Floats
    v: Floats
    n_rows: int

    @cached_property
    def basis(self) -> Floats:
        """Weights of the rows at every point, shape (n, rows)."""
        return self._basis(0)

    @cached_property
    def slope(self) -> Floats:
        """Their derivatives by v."""
        return self._basis(1)

    @cached_property
    def q(self) -> Floats:
        """The arch at every point."""
        return arch(self.c)

    @cached_property
    def dq(self) -> Floats:
        """Its derivative by c."""
        return arch(self.c, 1)

    @cached_property
    def across(self) -> Floats:
        """What x is of the flat rows y, w, s, shape (n, 3 rows)."""
        none = np.zeros_like(self.basis)
        return _flat(none, self.c[:, None] * self.basis, none)

    @cached_property
    def along(self) -> Floats:
        """What y is of the flat rows, shape (n, 3 rows)."""
        return _flat(self.basis, np.zeros_like(self.basis), self.q[:, None] * self.basis)

    def positions(self, rows: Floats) -> Points:
        """Give the positions of the points on a surface.

        Parameters
        ----------
        rows : ndarray of shape (rows, 3), float64
            y, w and s of every row, in D.

        Returns
        -------
        ndarray of shape (n, 2), float64
        """
        flat = rows.ravel()
        return np.stack([self.across @ flat, self.along @ flat], axis=1)

    def derivatives(self, rows: Floats) -> tuple[Points, Points]:
        """Give the derivatives of positions by c and by v, each of shape (n, 2)."""
        w, s = self.basis @ rows[:, 1], self.basis @ rows[:, 2]
        dy, dw, ds = (self.slope @ column for column in rows.T)
        by_c = np.stack([w, s * self.dq], axis=1)
        return by_c, np.stack([self.c * dw, dy + ds * self.q], axis=1)

    def stretch(self, rows: Floats) -> tuple[Floats, Floats]:
        """Give the determinant over the width, and its derivative by the flat rows.

        It is 1 for a strap of length 1 with even rows; a surface folds where it is
        not positive. Shapes (n,) and (n, 3 rows).
        """
        w, s = self.basis @ rows[:, 1], self.basis @ rows[:, 2]
        dy, dw, ds = (self.slope @ column for column in rows.T)
        tilt = self.c * self.dq
        value = dy + ds * self.q - tilt * s * dw / w
        by_w = (tilt * s / w)[:, None] * ((dw / w)[:, None] * self.basis - self.slope)
        by_s = self.q[:, None] * self.slope - (tilt * dw / w)[:, None] * self.basis
        return value, _flat(self.slope, by_w, by_s)

    def _basis(self, derivative: int) -> Floats:
        """Give the cubic B-splines at every point."""
        from scipy.interpolate import BSpline

        basis = BSpline(
            kernels.bspline.clamped_knots(self.n_rows),
            np.eye(self.n_rows),
            kernels.bspline.DEGREE,
        )
        return basis(np.clip(self.v, 0.0, 1.0), nu=derivative)


def margin_places(n_rows: int, n_side: int = 60, n_top: int = 20) -> Places:
    """Give places on the right margin: up its side, and across its top to the axis."""
    side = np.linspace(0.0, 1.0, n_side + 1)
    top = np.linspace(1.0, 0.0, n_top + 1)[1:]
    c = np.concatenate([np.ones(len(side)), top])
    return Places(c, np.concatenate([side, np.ones(len(top))]), n_rows)


def grid_places(n_rows: int, n_across: int = 6, n_along: int = 41) -> Places:
    """Give places spread over the right half of the surface, its edges included."""
    c, v = np.meshgrid(np.linspace(0.0, 1.0, n_across), np.linspace(0.0, 1.0, n_along))
    return Places(c.ravel(), v.ravel(), n_rows)


def _flat(y: Floats, w: Floats, s: Floats) -> Floats:
    """Give derivatives by y, w and s of all rows as those by the flat rows."""
    return np.stack([y, w, s], axis=2).reshape(len(y), 3 * y.shape[1])
