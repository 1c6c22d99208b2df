"""The least squares problem of key-frames: how far surfaces are from what was measured.

Weights and bounds are ours: what is measured decides wherever it says something.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats, Points
from vasc.growth.half_outlines import nearest_on
from vasc.growth.margins import MIRROR
from vasc.growth.surfaces import Places, grid_places, heights_of_rows, margin_places

EVENNESS = 0.03
"""Weight of growth that is even along the axis, where nothing measured says otherwise."""
SMOOTHNESS = 0.03
"""Weight of the bends of what is not even."""
LANDMARK = 1.0
"""Weight of a landmark, in points of the margin."""
BY_COLUMN = np.array([1.0, 0.2, 1.0])
"""Share of both weights that heights, half-widths and rises have: widths follow the outline."""
FOLDING = 3.0
"""Weight of a surface that nearly folds."""
LEAST_STRETCH = 0.06
"""A surface is kept from folding: least stretch along the axis over that of even rows."""
LEAST_WIDTH = 0.01
"""Half-width of a row at least, over the length of the leaf: tip and base are flat edges."""
Y, W = 0, 1
"""Columns of heights and half-widths in the rows."""


class FitProblem:
    """Rows of all ages and places of landmarks as unknowns, in lengths of the leaf at each age.

    Parameters
    ----------
    halves : sequence of ndarray of shape (m, 2), float64
        The right half of the outline at each age, in D, see
        :func:`vasc.growth.half_outlines.half_outline`.
    seen : ndarray of shape (k, ages, 2), float64
        Where each landmark is at each age, in D; nan where it was not seen.
    n_rows : int
        Rows of the surface.
    """

    def __init__(self, halves: Sequence[Points], seen: NDArray[np.float64], n_rows: int) -> None:
        self.n_rows = n_rows
        self.lengths = np.array([half[-1, 1] for half in halves])
        self.halves = [half / length for half, length in zip(halves, self.lengths, strict=True)]
        # what lies beyond the tip is the other half
        self.lines = [np.concatenate([half, half[-2::-1] * MIRROR]) for half in self.halves]
        self.seen = seen / self.lengths[:, None]
        self.margin = margin_places(n_rows)
        self.grid = grid_places(n_rows)
        self.fixed = np.zeros((n_rows, 3), dtype=bool)
        # the base is given: its width, and that it is straight and stays where it is
        self.fixed[0] = True
        self.first_rows = np.array([self._first_rows(half) for half in self.halves])
        self.n_free = int((~self.fixed).sum())
        self.bending = np.diff(np.eye(n_rows), 2, axis=0)
        self._latest: tuple[Floats, Floats, Floats] | None = None

    def _first_rows(self, half: Points) -> Floats:
        """Give rows with even heights and the widths of the outline there."""
        heights = heights_of_rows(self.n_rows)
        # the outline may turn down at the tip or below the base: widths by the way along it
        order = np.argsort(half[:, 1], kind="stable")
        widths = np.interp(np.minimum(heights, 0.97), half[order, 1], half[order, 0])
        widths[0] = half[0, 0]
        widths = np.maximum(widths, LEAST_WIDTH)
        return np.stack([heights, widths, np.zeros(self.n_rows)], axis=1)

    @property
    def start(self) -> Floats:
        """The first guess."""
        marks = []
        for seen in self.seen:
            age = int(np.flatnonzero(np.isfinite(seen).all(axis=1))[0])
            x, y = seen[age]
            width = np.interp(y, self.first_rows[age][:, Y], self.first_rows[age][:, W])
            marks += [np.clip(x / width, -0.95, 0.95), np.clip(y, 0.02, 0.98)]
        return np.concatenate([*(rows[~self.fixed] for rows in self.first_rows), marks])

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Least and greatest values."""
        low = np.full((self.n_rows, 3), [-2.0, 0.9 * LEAST_WIDTH, -2.0])
        high = np.full((self.n_rows, 3), [2.0, 4.0, 2.0])
        n_ages, n_marks = len(self.halves), len(self.seen)
        return (
            np.concatenate([*[low[~self.fixed]] * n_ages, [-1.0, 0.0] * n_marks]),
            np.concatenate([*[high[~self.fixed]] * n_ages, [1.0, 1.0] * n_marks]),
        )

    def unpacked(self, unknowns: Floats) -> tuple[Floats, Places]:
        """Give the rows of all ages, shape (ages, rows, 3), and the places of the landmarks."""
        rows = self.first_rows.copy()
        n_ages = len(rows)
        rows[:, ~self.fixed] = unknowns[: n_ages * self.n_free].reshape(n_ages, self.n_free)
        c, v = unknowns[n_ages * self.n_free :].reshape(-1, 2).T
        return rows, Places(c, v, self.n_rows)

    def residuals(self, unknowns: Floats) -> Floats:
        """Give all distances from what is wanted, weighted."""
        return self._terms(unknowns)[0]

    def jacobian(self, unknowns: Floats) -> Floats:
        """Give their derivatives by the unknowns."""
        return self._terms(unknowns)[1]

    def _terms(self, unknowns: Floats) -> tuple[Floats, Floats]:
        """Give residuals and derivatives; the latest are kept, as both are asked for in turn."""
        if self._latest is None or not np.array_equal(self._latest[0], unknowns):
            self._latest = unknowns.copy(), *self._computed(unknowns)
        return self._latest[1], self._latest[2]

    def _computed(self, unknowns: Floats) -> tuple[Floats, Floats]:
        """Compute residuals and derivatives."""
        rows, places = self.unpacked(unknowns)
        values, slopes = [], []
        for age in range(len(rows)):
            for value, slope, before in (
                self._margin_terms(rows, age),
                self._fold_terms(rows, age),
                self._even_terms(rows, age),
            ):
                whole = np.zeros((len(value), len(unknowns)))
                whole[:, self._columns(age)] = slope[:, ~self.fixed.ravel()]
                if before is not None:
                    whole[:, self._columns(age - 1)] = before[:, ~self.fixed.ravel()]
                values.append(value)
                slopes.append(whole)
            value, whole = self._landmark_terms(rows, places, age, len(unknowns))
            values.append(value)
            slopes.append(whole)
        return np.concatenate(values), np.concatenate(slopes)

    def _columns(self, age: int) -> slice:
        """Give the unknowns that are the rows of an age."""
        return slice(age * self.n_free, (age + 1) * self.n_free)

    def _margin_terms(self, rows: Floats, age: int) -> tuple[Floats, Floats, None]:
        """Give how far the margin is off the outline, along its normal."""
        points = self.margin.positions(rows[age])
        feet, normals = nearest_on(self.lines[age], points)
        slope = normals[:, :1] * self.margin.across + normals[:, 1:] * self.margin.along
        return ((points - feet) * normals).sum(axis=1), slope, None

    def _fold_terms(self, rows: Floats, age: int) -> tuple[Floats, Floats, None]:
        """Give by how much the stretch along the axis is too small, where it is."""
        stretch, slope = self.grid.stretch(rows[age])
        missing = np.minimum(stretch - LEAST_STRETCH, 0.0)
        is_missing = missing[:, None] < 0.0
        return FOLDING * missing, np.where(is_missing, FOLDING * slope, 0.0), None

    def _even_terms(self, rows: Floats, age: int) -> tuple[Floats, Floats, Floats | None]:
        """Give how far heights and rises are from those of the age before, or from even ones."""
        before = rows[age - 1] if age else self.first_rows[0]
        weights = EVENNESS * np.tile(BY_COLUMN, self.n_rows)
        bending = np.kron(self.bending, SMOOTHNESS * np.diag(BY_COLUMN))
        slope = np.concatenate([np.diag(weights), bending])
        value = slope @ (rows[age] - before).ravel()
        return value, slope, -slope if age else None

    def _landmark_terms(
        self, rows: Floats, places: Places, age: int, n_unknowns: int
    ) -> tuple[Floats, Floats]:
        """Give how far landmarks are from where they were seen, x and y in turn."""
        seen = self.seen[:, age]
        marks = np.flatnonzero(np.isfinite(seen).all(axis=1))
        gaps = (places.positions(rows[age]) - seen)[marks]
        by_c, by_v = places.derivatives(rows[age])
        whole = np.zeros((len(marks), 2, n_unknowns))
        free = ~self.fixed.ravel()
        whole[:, 0, self._columns(age)] = places.across[marks][:, free]
        whole[:, 1, self._columns(age)] = places.along[marks][:, free]
        first = len(rows) * self.n_free
        for row, mark in enumerate(marks.tolist()):
            whole[row, :, first + 2 * mark] = by_c[mark]
            whole[row, :, first + 2 * mark + 1] = by_v[mark]
        return LANDMARK * gaps.ravel(), LANDMARK * whole.reshape(-1, n_unknowns)
