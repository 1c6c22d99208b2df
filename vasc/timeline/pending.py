"""Frames that were observed and are not yet committed."""

from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from vasc.fields import Fields
from vasc.state import Places, State
from vasc.streams import Streams
from vasc.timeline.layout import Motion, form_of, motion_of

FRAME_FIELDS = ("step", "time", "motion", "outline_motion", "streams")
"""Fields of a pending frame that are columns of ``frames``, those of maps only in some files."""


class Pending(NamedTuple):
    """What a frame needs beyond the shared tables, which only grow."""

    step: int
    time: float
    counts: tuple[int, ...]
    motion: NDArray[np.float64] | None
    outline_motion: NDArray[np.float64] | None
    places: Places | None
    fields: Fields | None
    streams: NDArray[np.uint64]

    @classmethod
    def of(cls, state: State, streams: Streams) -> Self:
        """Take note of a state, and of the random streams after its step."""
        return cls(
            state.step,
            state.time,
            state.counts,
            state.motion,
            state.outline_motion,
            state.places,
            state.fields,
            streams.state(),
        )


def misfit(state: State, form: tuple[Motion, int, tuple[int, int]]) -> str:
    """Say in what a state differs from the form of a file."""
    motion, dimensions, cells = form
    if motion_of(state) != motion:
        return f"is {motion_of(state)}, the file is {motion}"
    if state.dimensions != dimensions:
        return f"has {state.dimensions} dimensions, the file {dimensions}"
    return "has {} cells and {} walls, the file {} and {}".format(*form_of(state)[2], *cells)
