"""Key-frames of a growing leaf from what can be measured: its outlines and landmarks by age."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vasc.arrays import Floats, Points
from vasc.errors import ConfigError
from vasc.growth.fit_problem import FitProblem
from vasc.growth.half_outlines import distances_to, half_outline
from vasc.growth.surfaces import Places, grid_places, margin_places

PER_D = 1024.0
"""Rows are rounded to this fraction of D, much coarser than what a processor changes."""


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
    n_rows: int,
    tolerance: float,
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
        If numbers do not match, a landmark is not on the leaf, an outline or a
        landmark cannot be followed within the tolerance, or the surface folds.
    OutlineError
        If an outline is no ring.
    """
    from scipy.optimize import least_squares

    _check_numbers(outlines, times, landmarks, n_rows)
    seen = np.array([mark.positions for mark in landmarks]).reshape(-1, len(outlines), 2)
    fit = FitProblem([half_outline(ring) for ring in outlines], seen, n_rows)
    _refuse_outside(fit, times, landmarks, tolerance)
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


def _refuse_outside(
    fit: FitProblem, times: Sequence[float], landmarks: Sequence[Landmark], tolerance: float
) -> None:
    """Refuse landmarks so far outside the leaf that they would pull its margin off the outline."""
    import shapely

    for age, (time, length) in enumerate(zip(times, fit.lengths.tolist(), strict=True)):
        seen = np.flatnonzero(np.isfinite(fit.seen[:, age]).all(axis=1))
        leaf = shapely.Polygon(fit.lines[age])
        gaps = shapely.distance(leaf, shapely.points(fit.seen[seen, age]))
        # a margin that far off its outline, and as far from it the landmark, would pass
        for mark in seen[gaps > 2.0 * tolerance].tolist():
            x, y = fit.seen[mark, age]
            gap = float(gaps[seen == mark][0]) * length
            raise ConfigError(
                f"landmark {landmarks[mark].name!r} at t = {time:g}: [{x:.4g}, {y:.4g}] in lengths"
                f" of the leaf is {gap:.3g} D outside the outline; allowed are"
                f" {2.0 * tolerance * length:.3g} D"
            )


def _measured(
    frames: list[tuple[float, Floats]],
    places: Places,
    fit: FitProblem,
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
    fitted: FittedFrames, fit: FitProblem, landmarks: Sequence[Landmark], tolerance: float
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
