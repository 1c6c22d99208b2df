"""Key-framed growth: B-spline surfaces interpolated in time (Runions 2008, section 5.2.1)."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import Floats, Points
from vasc.errors import ConfigError
from vasc.growth.base import MARGIN_SPACING, Deformation, last_step_of
from vasc.growth.surfaces import N_COLUMNS

CHECKED = (21, 121)
"""Points across and along the half blade at which the surface must not fold."""


class KeyframedGrowth(Deformation):
    """A blade that is a surface at every time, between surfaces given for some.

    A material point is a pair (c, v) of parameters of the surface, see
    :mod:`vasc.kernels.bspline`; places are positions.

    Parameters
    ----------
    times : ndarray of shape (f,), float64
        Times of the key-frames, ascending from 0.
    frames : ndarray of shape (f, 3, r), float64
        Heights, half-widths and rises of the control rows, base to tip, in D.
    step_duration : float
        Time that passes in one step.

    Raises
    ------
    ConfigError
        If growth would take more than ``RUN_STEPS`` steps, or the surface folds at
        some time; the message names the time and the place.
    """

    def __init__(self, times: Floats, frames: NDArray[np.float64], step_duration: float) -> None:
        self.times = times
        self.frames = frames
        self.step_duration = step_duration
        self._latest_rows: tuple[int, NDArray[np.float64]] | None = None
        n_steps = float(times[-1]) / step_duration
        self._last_step = last_step_of(n_steps, "growth.step_duration", step_duration)
        self.surface = kernels.bspline.surface(frames.shape[2], N_COLUMNS)
        self._refuse_folds()
        margin, n_base = self._margin()
        corners = [self._positions_at(margin, frame) for frame in frames]
        low, high = np.min(corners, axis=(0, 1)), np.max(corners, axis=(0, 1))
        self._box = (*(low - 1.0).tolist(), *(high + 1.0).tolist())
        super().__init__(margin, n_base, np.array([[0.0, 0.0]]))

    @property
    def last_step(self) -> int:
        """The step in which the last key-frame is reached."""
        return self._last_step

    @property
    def box(self) -> tuple[float, float, float, float]:
        """A box around the blades of all times, which lie between those of the key-frames."""
        return self._box

    def time(self, step: int) -> float:
        """Give the time of a step."""
        return step * self.step_duration

    def rows(self, step: int) -> NDArray[np.float64]:
        """Give the control rows at a step, shape (3, r); those last asked for are kept."""
        if self._latest_rows is None or self._latest_rows[0] != step:
            self._latest_rows = step, self._interpolated(step)
        return self._latest_rows[1]

    def _interpolated(self, step: int) -> NDArray[np.float64]:
        """Give the control rows between two key-frames."""
        time = self.time(step)
        after = int(np.searchsorted(self.times, time, side="right"))
        if after == len(self.times):
            return self.frames[-1]
        before, following = self.times[after - 1], self.times[after]
        share = (time - before) / (following - before)
        return (1.0 - share) * self.frames[after - 1] + share * self.frames[after]

    def position(self, material: Points, step: int) -> Points:
        """Give the positions of material points at a step, shape (n, 2)."""
        return self._positions_at(material, self.rows(step))

    def material(self, position: Points, step: int, near: Points | None = None) -> Points:
        """Give the material points at positions at a step, or on the margin nearest to them."""
        guesses = np.full_like(position, 0.5) if near is None else near
        return kernels.bspline.invert(self.surface, self.rows(step), position, guesses)

    def _positions_at(self, material: Points, rows: NDArray[np.float64]) -> Points:
        """Give positions on the surface of some control rows."""
        return kernels.bspline.evaluate(self.surface, rows, np.ascontiguousarray(material))

    def _margin(self) -> tuple[Points, int]:
        """Give material points of the outline, and how many belong to the base.

        Positions are linear in time between key-frames, so that points which are
        near enough in all key-frames are so at all times.
        """
        across = self._sampled(lambda c: np.stack([c, np.zeros_like(c)], axis=1))
        along = self._sampled(lambda v: np.stack([np.ones_like(v), v], axis=1))
        over = self._sampled(lambda c: np.stack([c, np.ones_like(c)], axis=1))
        base = np.concatenate([-across[:0:-1], across])
        tip = np.concatenate([over[::-1], -over[1:]])
        parts = [
            np.stack([base, np.zeros_like(base)], axis=1),
            np.stack([np.ones_like(along), along], axis=1)[1:-1],
            np.stack([tip, np.ones_like(tip)], axis=1),
            np.stack([-np.ones_like(along), along], axis=1)[-2:0:-1],
        ]
        return np.concatenate(parts), len(base)

    def _sampled(self, edge: Callable[[Floats], Points]) -> Floats:
        """Give parameters 0 ... 1 along an edge, near enough to each other in all key-frames."""
        parameters = np.linspace(0.0, 1.0, 9)
        while True:
            places = np.array([self._positions_at(edge(parameters), f) for f in self.frames])
            gaps = np.sqrt((np.diff(places, axis=1) ** 2).sum(axis=2)).max(axis=0)
            wide = np.flatnonzero(gaps > MARGIN_SPACING)
            if len(wide) == 0:
                return parameters
            middles = 0.5 * (parameters[wide] + parameters[wide + 1])
            parameters = np.insert(parameters, wide + 1, middles)

    def _refuse_folds(self) -> None:
        """Raise an error if the surface folds at any time of the run."""
        c, v = np.meshgrid(np.linspace(0.0, 1.0, CHECKED[0]), np.linspace(0.0, 1.0, CHECKED[1]))
        points = np.stack([c.ravel(), v.ravel()], axis=1)
        tangents = [kernels.bspline.jacobians(self.surface, f, points) for f in self.frames]
        for index in range(max(1, len(self.times) - 1)):
            ends = tangents[index], tangents[min(index + 1, len(tangents) - 1)]
            least, shares = least_determinants(*ends)
            worst = int(np.argmin(least))
            if least[worst] <= 0.0:
                span = self.times[min(index + 1, len(self.times) - 1)] - self.times[index]
                time = self.times[index] + shares[worst] * span
                raise ConfigError(
                    f"growth: the surface folds at time {time:.4g} at c ="
                    f" {points[worst, 0]:.3g} (0 midline, 1 margin), v ="
                    f" {points[worst, 1]:.3g} (0 base, 1 tip): the"
                    f" areal stretch is {least[worst]:.3g} there; it must be above 0 at all times"
                )


def least_determinants(
    first: NDArray[np.float64], second: NDArray[np.float64]
) -> tuple[Floats, Floats]:
    """Give the least Jacobian determinants between two key-frames, and when they occur.

    Tangents are linear in time, so that their determinant is a parabola in time.

    Parameters
    ----------
    first, second : ndarray of shape (n, 4), float64
        Tangents x_c, y_c, x_v, y_v at the two key-frames.

    Returns
    -------
    least, shares : ndarray of shape (n,), float64
        The least determinants, and the shares 0 ... 1 of the interval at which they occur.
    """

    def mixed(a: NDArray[np.float64], b: NDArray[np.float64]) -> Floats:
        return a[:, 0] * b[:, 3] - a[:, 2] * b[:, 1]

    start, stop = mixed(first, first), mixed(second, second)
    middle = mixed(first, second) + mixed(second, first)
    # start (1 - p)^2 + middle p (1 - p) + stop p^2
    curvature = start - middle + stop
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex = np.where(curvature > 0.0, (start - 0.5 * middle) / curvature, 0.0)
    inner = np.clip(vertex, 0.0, 1.0)
    values = [
        start,
        stop,
        start * (1 - inner) ** 2 + middle * inner * (1 - inner) + stop * inner**2,
    ]
    shares = [np.zeros_like(start), np.ones_like(start), inner]
    which = np.argmin(values, axis=0)[None]
    return (
        np.take_along_axis(np.array(values), which, axis=0)[0],
        np.take_along_axis(np.array(shares), which, axis=0)[0],
    )
