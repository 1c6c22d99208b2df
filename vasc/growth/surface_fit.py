"""Key-frames of a growing leaf from what can be measured: its outlines and landmarks by age."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vasc.arrays import Floats, Points
from vasc.errors import ConfigError
from vasc.growth.half_outlines import distances_to, half_outline, nearest_on
from vasc.growth.margins import MIRROR
from vasc.growth.surfaces import Places, grid_places, heights_of_rows, margin_places

EVENNESS = 0.03
"""Weight of growth that is even along the axis, where nothing measured says otherwise."""
SMOOTHNESS = 0.03
"""Weight of the bends of what is not even."""
LANDMARK = 1.0
"""Weight of a landmark, in points of the margin."""
FOLDING = 3.0
"""Weight of a surface that nearly folds."""
LEAST_STRETCH = 0.06
"""A surface is kept from folding: least stretch along the axis over that of even rows."""
LEAST_WIDTH = 0.01
"""Half-width of a row at least, over the length of the leaf: tip and base are flat edges."""
PER_D = 1024.0
"""Rows are rounded to this fraction of D, much coarser than what a processor changes."""

Y, W, S = 0, 1, 2


@dataclass(frozen=True)
class Landmark:
    """A point of the tissue that is recognised at several ages.

    Parameters
    ----------
    name : str
        What it is, for example "first lateral vein".
    positions : ndarray of shape (ages, 2), float64
        Where it is, in D from the attachment; nan where it was not seen.
    """

    name: str
    positions: Points


@dataclass(frozen=True)
class FittedFrames:
    """Key-frames, and how well they follow what was measured.

    Parameters
    ----------
    frames : list of (float, ndarray of shape (rows, 3))
        Time, and y, w and s of every row in D, for each age.
    residuals : ndarray of shape (ages,), float64
        Largest distance between outline and margin, in D.
    landmarks : ndarray of shape (k, 2), float64
        Material coordinates c and v of the landmarks.
    landmark_residuals : ndarray of shape (k, ages), float64
        Distances of the landmarks from where they were seen, in D; nan if not seen.
    """

    frames: list[tuple[float, Floats]]
    residuals: Floats
    landmarks: Points
    landmark_residuals: Floats


def fit_keyframes(
    outlines: Sequence[Points],
    times: Sequence[float],
    landmarks: Sequence[Landmark] = (),
    *,
    n_rows: int = 9,
    tolerance: float = 0.02,
) -> FittedFrames:
    """Find surfaces whose margins follow outlines, and on which landmarks keep their places.

    The leaf is taken to be symmetric: an outline stands for the mean of its halves.
    Between landmarks tissue grows as evenly along the axis as the outlines allow.

    Parameters
    ----------
    outlines : sequence of ndarray of shape (m, 2), float64
        One outline an age, in D, with the attachment at the origin.
    times : sequence of float
        Times of the ages, ascending, in steps.
    landmarks : sequence of Landmark
        Points with one place each for all ages; it may be empty.
    n_rows : int
        Rows of the surface, at least 4.
    tolerance : float
        Largest distance between outline and margin, over the length of the leaf.

    Returns
    -------
    FittedFrames

    Raises
    ------
    ConfigError
        If numbers do not match, an outline or a landmark cannot be followed within
        the tolerance, or the surface folds.
    OutlineError
        If an outline is no ring.
    """
    from scipy.optimize import least_squares

    _check_numbers(outlines, times, landmarks, n_rows)
    fit = _Fit([half_outline(ring) for ring in outlines], landmarks, n_rows)
    low, high = fit.bounds
    start = np.clip(fit.start, low + 1e-6, high - 1e-6)
    found = least_squares(
        fit.residuals, start, fit.jacobian, bounds=(low, high), xtol=1e-6, ftol=1e-5, max_nfev=100
    )
    rows, places = fit.unpacked(found.x)
    frames = [
        (float(time), np.round(rows[age] * length * PER_D) / PER_D)
        for age, (time, length) in enumerate(zip(times, fit.lengths, strict=True))
    ]
    fitted = _measured(frames, places, fit, landmarks)
    _check_fit(fitted, fit, landmarks, tolerance)
    return fitted


class _Fit:
    """The least squares problem, in lengths of the leaf at each age."""

    def __init__(
        self, halves: Sequence[Points], landmarks: Sequence[Landmark], n_rows: int
    ) -> None:
        self.n_rows = n_rows
        self.lengths = np.array([half[-1, 1] for half in halves])
        self.halves = [half / length for half, length in zip(halves, self.lengths, strict=True)]
        # what lies beyond the tip is the other half
        self.lines = [np.concatenate([half, half[-2::-1] * MIRROR]) for half in self.halves]
        seen = np.array([mark.positions for mark in landmarks]).reshape(-1, len(halves), 2)
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
        weights = EVENNESS * np.tile([1.0, 0.2, 1.0], self.n_rows)
        bending = np.kron(self.bending, SMOOTHNESS * np.diag([1.0, 0.2, 1.0]))
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


def _measured(
    frames: list[tuple[float, Floats]],
    places: Places,
    fit: _Fit,
    landmarks: Sequence[Landmark],
) -> FittedFrames:
    """Measure how well key-frames follow outlines and landmarks."""
    margin = margin_places(fit.n_rows, 300, 100)
    residuals, mark_residuals = [], []
    for age, (_, rows) in enumerate(frames):
        half = fit.halves[age] * fit.lengths[age]
        line = margin.positions(rows)
        both = distances_to(fit.lines[age] * fit.lengths[age], line), distances_to(line, half)
        residuals.append(max(float(each.max()) for each in both))
        gaps = places.positions(rows) - fit.seen[:, age] * fit.lengths[age]
        mark_residuals.append(np.sqrt((gaps * gaps).sum(axis=1)))
    return FittedFrames(
        frames,
        np.array(residuals),
        np.stack([places.c, places.v], axis=1),
        np.array(mark_residuals).T.reshape(len(landmarks), len(frames)),
    )


def _check_fit(
    fitted: FittedFrames, fit: _Fit, landmarks: Sequence[Landmark], tolerance: float
) -> None:
    """Refuse surfaces that do not follow what was measured, or fold."""
    finer = grid_places(fit.n_rows, 21, 161)
    for (time, rows), residual, length in zip(
        fitted.frames, fitted.residuals.tolist(), fit.lengths.tolist(), strict=True
    ):
        if residual > tolerance * length:
            raise ConfigError(
                f"outline at t = {time:g}: a surface of {fit.n_rows} rows stays {residual:.3g} D"
                f" away from it; allowed is {tolerance:g} of its length, {tolerance * length:.3g} D"
            )
        if float(finer.stretch(rows)[0].min()) <= 0.0:
            raise ConfigError(
                f"outline at t = {time:g}: the surface that follows it folds; a margin without"
                " lobes and landmarks in the order of the tissue do not fold"
            )
    allowed = tolerance * fit.lengths
    for mark, gaps in zip(landmarks, fitted.landmark_residuals, strict=True):
        if (gaps > allowed).any():
            age = int(np.nanargmax(gaps / fit.lengths))
            raise ConfigError(
                f"landmark {mark.name!r} at t = {fitted.frames[age][0]:g}: one place of the tissue"
                f" is {gaps[age]:.3g} D away from where it was seen; allowed are"
                f" {allowed[age]:.3g} D"
            )


def _check_numbers(
    outlines: Sequence[Points],
    times: Sequence[float],
    landmarks: Sequence[Landmark],
    n_rows: int,
) -> None:
    """Refuse what does not go together."""
    if len(outlines) == 0 or len(outlines) != len(times):
        raise ConfigError(
            f"{len(outlines)} outlines for {len(times)} times; one outline is needed for each"
        )
    if not (np.diff(times) > 0.0).all():
        raise ConfigError(f"times {list(times)}: they must ascend")
    if n_rows < 4:
        raise ConfigError(f"n_rows = {n_rows}: a cubic surface needs at least 4")
    for mark in landmarks:
        if np.shape(mark.positions) != (len(times), 2):
            raise ConfigError(
                f"landmark {mark.name!r}: positions of shape {np.shape(mark.positions)};"
                f" one pair is needed for each of {len(times)} ages"
            )
        if not np.isfinite(mark.positions).all(axis=1).any():
            raise ConfigError(f"landmark {mark.name!r}: seen at no age; it must be at one at least")
