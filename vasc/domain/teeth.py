"""Toothed margins: triangular waves, summed along the margin (Runions 2008, section 4.2.2)."""

import numpy as np
from pydantic import model_validator

from vasc import kernels
from vasc.arrays import Floats, Points
from vasc.domain.rings import arc_lengths, at_lengths, signed_area
from vasc.errors import OutlineError
from vasc.parameters import Parameters, quantity

MOST_POINTS = 20_000
LONGEST_EDGE = 0.02
"""Longest edge of a margin with teeth, as a share of its side."""
ROOM_SHARE = 0.3
"""A tooth takes at most this share of the way to the margin opposite, in sinuses."""

LOOKS = ((1.0, 0.0), (0.71, 0.71), (0.71, -0.71), (0.26, 0.97), (0.26, -0.97))
"""Cosine and sine, about, of the angles from the normal at which room is looked for."""


class TeethParameters(Parameters):
    """A toothed margin: triangular waves of several heights and numbers, summed."""

    amplitudes: list[float] = quantity(
        "Height of each wave.", unit="blade length", min_length=1, max_length=20
    )
    frequencies: list[int] = quantity(
        "Teeth on each side between attachment and tip, one number a wave.",
        min_length=1,
        max_length=20,
    )
    slant: float = quantity(
        "Where a tooth is highest: 0 in its middle, toward 1 at its end near the tip.",
        default=0.4,
        ge=0.0,
        lt=1.0,
    )
    bare: float = quantity(
        "Share of each side, next to the attachment, over which teeth grow to full height.",
        default=0.1,
        ge=0.0,
        le=1.0,
    )

    @model_validator(mode="after")
    def _check(self) -> "TeethParameters":
        """Require one frequency for each amplitude, and room for the teeth."""
        if len(self.amplitudes) != len(self.frequencies):
            raise ValueError(
                f"{len(self.amplitudes)} amplitudes and {len(self.frequencies)} frequencies;"
                " give as many of both"
            )
        if min(self.frequencies) < 1 or 4 * sum(self.frequencies) > MOST_POINTS:
            raise ValueError(
                f"frequencies {self.frequencies}: each must be at least 1,"
                f" and all together at most {MOST_POINTS // 4:,}"
            )
        return self

    def applied(self, ring: Points) -> Points:
        """Give a unit outline with teeth.

        Teeth stand along the outward normal. They vanish at the tip, so that the
        blade keeps its length, toward the attachment, and in sharp sinuses, where
        the teeth of two sides would run into each other.

        Parameters
        ----------
        ring : ndarray of shape (n, 2), float64
            Outline with the attachment at the origin and height 1.

        Returns
        -------
        ndarray of shape (m, 2), float64
            With a point at the base and the top of every tooth.

        Raises
        ------
        OutlineError
            If the teeth need more points than an outline may have.
        """
        if signed_area(ring) < 0.0:
            ring = ring[::-1]
        start = int(np.argmin((ring * ring).sum(axis=1)))
        ring = np.roll(ring, -start, axis=0)
        tip = _apex(ring)
        right = self._teeth_of_side(ring[: tip + 1], 1.0)
        left = self._teeth_of_side(np.concatenate([ring[tip:], ring[:1]])[::-1], -1.0)
        points, heights, normals = (
            np.concatenate([a, b[-2:0:-1]]) for a, b in zip(right, left, strict=True)
        )
        if len(points) > MOST_POINTS:
            raise OutlineError(
                f"teeth: the outline would have {len(points):,} points;"
                f" at most {MOST_POINTS:,} are allowed with teeth"
            )
        heights = np.minimum(heights, ROOM_SHARE * self._room(points, normals))
        toothed = points + heights[:, None] * normals
        return toothed / toothed[:, 1].max()

    def _room(self, ring: Points, normals: Points) -> Floats:
        """Give how far the margin opposite is, straight ahead or at an angle."""
        most = sum(self.amplitudes) / ROOM_SHARE
        room = np.full(len(ring), most)
        across = np.stack([-normals[:, 1], normals[:, 0]], axis=1)
        for cosine, sine in LOOKS:
            looks = cosine * normals + sine * across
            room = np.minimum(room, kernels.polygon.free_lengths(ring, looks, most))
        return room

    def _teeth_of_side(self, side: Points, sign: float) -> tuple[Points, Floats, Points]:
        """Give points from attachment to tip, heights there and normals, right or left."""
        side = _without_long_edges(side)
        lengths = arc_lengths(side)
        total = lengths[-1]
        turns = [
            (k + at) / frequency
            for frequency in self.frequencies
            for k in range(frequency)
            for at in (0.0, self._peak)
        ]
        positions = np.unique(np.concatenate([lengths, np.array(turns) * total]))
        is_new = np.diff(positions, prepend=-1.0) > 1e-9 * total
        is_new[-1] = True
        positions = positions[is_new]
        heights = self.wave(positions / total) * self._fade(positions)
        # between corners normals turn evenly, so that neighbours do not run into each other
        normals = np.stack(
            [np.interp(positions, lengths, axis) for axis in _normals(side, sign).T], axis=1
        )
        size = np.sqrt((normals * normals).sum(axis=1))
        return at_lengths(side, positions), heights, normals / np.maximum(size, 1e-12)[:, None]

    @property
    def _peak(self) -> float:
        """Where in a tooth the top is."""
        return 0.5 + 0.5 * self.slant

    def wave(self, positions: Floats) -> Floats:
        """Give the height of the teeth at shares of a side, 0 at the attachment and at the tip."""
        heights = np.zeros(len(positions))
        for amplitude, frequency in zip(self.amplitudes, self.frequencies, strict=True):
            turns = positions * frequency
            phase = turns - np.floor(turns)
            rise, fall = phase / self._peak, (1.0 - phase) / (1.0 - self._peak)
            heights += amplitude * np.minimum(rise, fall)
        return heights

    def _fade(self, positions: Floats) -> Floats:
        """Give the share of their height that teeth have near the attachment and the tip."""
        total = positions[-1]
        fade = np.minimum(1.0, (total - positions) / (3.0 * sum(self.amplitudes)))
        if self.bare > 0.0:
            fade = np.minimum(fade, positions / (self.bare * total))
        return fade


def _apex(ring: Points) -> int:
    """Give the row where the two sides meet: where the margin is highest on the axis, if it is."""
    x, y = ring[:, 0], ring[:, 1]
    following = np.roll(x, -1)
    is_on_axis = (x == 0.0) | (x * following < 0.0)
    # row 0 is the attachment
    is_on_axis[0] = is_on_axis[-1] = False
    if not is_on_axis.any():
        return 1 + int(np.argmax(y[1:]))
    return int(np.argmax(np.where(is_on_axis, y, -np.inf)))


def _without_long_edges(line: Points) -> Points:
    """Give a line with points on its long edges, where a normal has room to turn at corners."""
    lengths = arc_lengths(line)
    n_pieces = np.ceil(np.diff(lengths) / (LONGEST_EDGE * lengths[-1])).astype(np.int64)
    positions = [
        start + (stop - start) * np.arange(n) / n
        for start, stop, n in zip(lengths, lengths[1:], n_pieces, strict=False)
    ]
    return at_lengths(line, np.concatenate([*positions, lengths[-1:]]))


def _normals(points: Points, sign: float) -> Points:
    """Give unit normals on the right (1) or left (-1) of a line, shape (n, 2)."""
    steps = np.diff(points, axis=0)
    steps = steps / np.sqrt((steps * steps).sum(axis=1))[:, None]
    ahead = np.concatenate([steps, steps[-1:]]) + np.concatenate([steps[:1], steps])
    ahead = ahead / np.maximum(np.sqrt((ahead * ahead).sum(axis=1)), 1e-12)[:, None]
    return sign * np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
