"""A leaf blade as a tensor-product B-spline surface, evaluated, derived and inverted.

A material point (c, v) has the distance |c| from the midline (0) to the margin
(1), and the height v from base (0) to tip (1); in the terms of the thesis,
u = (1 + c) / 2. Control point (row, k) of the surface is
(w c_k, y + s c_k^2), with c_k the Greville abscissae of u, so that the sum over
the columns can be done once:

    x = c W(v),    y = Y(v) + q(c) S(v),

where W, Y, S are the splines of the rows' half-widths w, heights y and rises s,
and q is the spline of the squares c_k^2. Only + - * / are used, on |c|: images
of mirrored points are mirrored to the last bit.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.kernels.compiled import compiled, unowned

DEGREE = 3
MOST_ITERATIONS = 60
"""Steps of one inversion at most; three are usual."""

Y, W, S = 0, 1, 2
"""Columns of the control rows."""


class Surface(NamedTuple):
    """What all frames of a growing surface share."""

    knots: NDArray[np.float64]
    """Clamped uniform knots in v, shape (rows + 4,)."""
    arch_knots: NDArray[np.float64]
    """The same in u, shape (columns + 4,)."""
    arch: NDArray[np.float64]
    """Squares of the Greville abscissae of the columns, shape (columns,)."""


def clamped_knots(n_controls: int) -> NDArray[np.float64]:
    """Give clamped uniform knots on [0, 1] for a cubic spline, shape (n_controls + 4,)."""
    inner = np.arange(1, n_controls - DEGREE) / (n_controls - DEGREE)
    return np.concatenate([np.zeros(DEGREE + 1), inner, np.ones(DEGREE + 1)])


def abscissae(knots: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give the Greville abscissae: with these control values, a spline is its parameter."""
    return (knots[1:-3] + knots[2:-2] + knots[3:-1]) / 3.0


def surface(n_rows: int, n_columns: int) -> Surface:
    """Make the surface of a number of control rows and columns, at least four of each."""
    knots = clamped_knots(n_columns)
    return Surface(clamped_knots(n_rows), knots, (2.0 * abscissae(knots) - 1.0) ** 2)


@unowned
def spline(
    knots: NDArray[np.float64], controls: NDArray[np.float64], t: float
) -> tuple[float, float]:
    """Give a cubic spline and its derivative at t in [0, 1], by de Boor's triangle."""
    n = len(controls)
    span = DEGREE
    while span < n - 1 and t >= knots[span + 1]:
        span += 1
    # three rounds of affine combinations; the last difference is the derivative
    a0, a1 = controls[span - 3], controls[span - 2]
    a2, a3 = controls[span - 1], controls[span]
    k0, k1, k2 = knots[span - 2], knots[span - 1], knots[span]
    k3, k4, k5 = knots[span + 1], knots[span + 2], knots[span + 3]
    b1 = a0 + (a1 - a0) * ((t - k0) / (k3 - k0))
    b2 = a1 + (a2 - a1) * ((t - k1) / (k4 - k1))
    b3 = a2 + (a3 - a2) * ((t - k2) / (k5 - k2))
    c2 = b1 + (b2 - b1) * ((t - k1) / (k3 - k1))
    c3 = b2 + (b3 - b2) * ((t - k2) / (k4 - k2))
    ratio = (t - k2) / (k3 - k2)
    return c2 + (c3 - c2) * ratio, 3.0 * (c3 - c2) / (k3 - k2)


@unowned
def arch(shape: Surface, c: float) -> tuple[float, float]:
    """Give q and its derivative at c in [0, 1]."""
    value, slope = spline(shape.arch_knots, shape.arch, 0.5 * (1.0 + c))
    return value, 0.5 * slope


@compiled
def evaluate(
    shape: Surface, rows: NDArray[np.float64], material: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Give the positions of material points.

    Parameters
    ----------
    shape : Surface
    rows : ndarray of shape (3, r), float64
        Heights y, half-widths w and rises s of the control rows, base to tip, in D.
    material : ndarray of shape (n, 2), float64
        Pairs (c, v).

    Returns
    -------
    ndarray of shape (n, 2), float64
        Positions x, y in D.
    """
    positions = np.empty((len(material), 2))
    for i in range(len(material)):
        c, v = material[i, 0], material[i, 1]
        q, _ = arch(shape, abs(c))
        width, _ = spline(shape.knots, rows[W], v)
        height, _ = spline(shape.knots, rows[Y], v)
        rise, _ = spline(shape.knots, rows[S], v)
        positions[i, 0] = c * width
        positions[i, 1] = height + q * rise
    return positions


@unowned
def tangents(
    shape: Surface, rows: NDArray[np.float64], c: float, v: float
) -> tuple[float, float, float, float, float, float]:
    """Give x, y and the derivatives x_c, y_c, x_v, y_v at c in [0, 1]."""
    q, q_c = arch(shape, c)
    width, width_v = spline(shape.knots, rows[W], v)
    height, height_v = spline(shape.knots, rows[Y], v)
    rise, rise_v = spline(shape.knots, rows[S], v)
    return c * width, height + q * rise, width, q_c * rise, c * width_v, height_v + q * rise_v


@compiled
def jacobians(
    shape: Surface, rows: NDArray[np.float64], material: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Give the derivatives x_c, y_c, x_v, y_v at material points with c >= 0, shape (n, 4)."""
    found = np.empty((len(material), 4))
    for i in range(len(material)):
        _, _, x_c, y_c, x_v, y_v = tangents(shape, rows, material[i, 0], material[i, 1])
        found[i] = x_c, y_c, x_v, y_v
    return found


@unowned
def toward(
    shape: Surface, rows: NDArray[np.float64], x: float, y: float, c: float, v: float
) -> tuple[float, float, float]:
    """Give the step in c and v to the nearest point of (x, y), and the squared distance here.

    On the border of [0, 1] x [0, 1], where the full step would leave it, the
    step goes along the border.
    """
    px, py, x_c, y_c, x_v, y_v = tangents(shape, rows, c, v)
    rx, ry = x - px, y - py
    square = rx * rx + ry * ry
    det = x_c * y_v - x_v * y_c
    dc = (rx * y_v - ry * x_v) / det
    dv = (ry * x_c - rx * y_c) / det
    is_c_blocked = (c >= 1.0 and dc > 0.0) or (c <= 0.0 and dc < 0.0)
    is_v_blocked = (v >= 1.0 and dv > 0.0) or (v <= 0.0 and dv < 0.0)
    if is_c_blocked or is_v_blocked:
        along_c = (rx * x_c + ry * y_c) / (x_c * x_c + y_c * y_c)
        along_v = (rx * x_v + ry * y_v) / (x_v * x_v + y_v * y_v)
        is_c_open = not ((c >= 1.0 and along_c > 0.0) or (c <= 0.0 and along_c < 0.0))
        is_v_open = not ((v >= 1.0 and along_v > 0.0) or (v <= 0.0 and along_v < 0.0))
        # along the edge that blocks; in a corner, along the one that leads nearer
        if is_v_open and (is_c_blocked or not is_c_open):
            dc, dv = 0.0, along_v
        elif is_c_open:
            dc, dv = along_c, 0.0
        else:
            dc, dv = 0.0, 0.0
    return dc, dv, square


@compiled
def invert(
    shape: Surface,
    rows: NDArray[np.float64],
    positions: NDArray[np.float64],
    near: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Give the material points at positions, or those of the margin nearest to them.

    Newton's method on the two equations, with halved steps while they do not
    come nearer, confined to the surface (the thesis descends |Q(u, v) - P|
    instead, equation 5.2).

    Parameters
    ----------
    shape : Surface
    rows : ndarray of shape (3, r), float64
        Control rows, as for :func:`evaluate`.
    positions : ndarray of shape (n, 2), float64
        Positions in D.
    near : ndarray of shape (n, 2), float64
        First guesses (c, v): the material points of neighbours.

    Returns
    -------
    ndarray of shape (n, 2), float64
        Pairs (c, v); c = 0 exactly on the midline.
    """
    material = np.empty((len(positions), 2))
    for i in range(len(positions)):
        x, y = abs(positions[i, 0]), positions[i, 1]
        is_axial = x < 1e-9
        c, v = (0.0 if is_axial else abs(near[i, 0])), near[i, 1]
        dc, dv, square = toward(shape, rows, x, y, c, v)
        for _ in range(MOST_ITERATIONS):
            if is_axial:
                dc = 0.0
            share = 1.0
            while share > 1e-6:
                new_c = min(1.0, max(0.0, c + share * dc))
                new_v = min(1.0, max(0.0, v + share * dv))
                next_dc, next_dv, next_square = toward(shape, rows, x, y, new_c, new_v)
                if next_square < square:
                    break
                share *= 0.5
            if share <= 1e-6:
                break
            c, v, dc, dv, square = new_c, new_v, next_dc, next_dv, next_square
            if square < 1e-28:
                break
        material[i, 0] = -c if positions[i, 0] < 0.0 else c
        material[i, 1] = v
    return material
