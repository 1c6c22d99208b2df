"""The outline with which a leaf began, as a blade."""

import numpy as np
from numpy.typing import NDArray

from vasc.domain import Blade
from vasc.errors import OutlineError, TimelineError
from vasc.timeline import layout
from vasc.timeline.access import OpenFile


def arrays_of_blade(blade: Blade) -> dict[str, NDArray]:
    """Give a blade as the arrays by which a file holds it, by path."""
    return {
        layout.RING_XY: np.concatenate(blade.rings),
        layout.RING_STARTS: np.cumsum([0, *(len(ring) for ring in blade.rings)]),
        layout.SEEDS: blade.seeds,
    }


def read_initial_blade(opened: OpenFile) -> Blade:
    """Give the blade at step 0.

    Parameters
    ----------
    opened : OpenFile
        A file of a run in the plane.

    Returns
    -------
    Blade

    Raises
    ------
    TimelineError
        If what is recorded is no outline, or cannot be read.
    """
    xy = opened.read_array(layout.RING_XY)
    starts = opened.read_array(layout.RING_STARTS)
    ends_fit = len(starts) > 1 and starts[0] == 0 and starts[-1] == len(xy)
    if not ends_fit or (np.diff(starts) < 3).any():
        raise TimelineError(f"{opened.path}: {layout.RING_STARTS} does not divide the outline")
    rings = tuple(np.split(xy, starts[1:-1]))
    try:
        return Blade.from_rings(rings, opened.read_array(layout.SEEDS))
    except OutlineError as error:
        raise TimelineError(f"{opened.path}: the recorded outline is bad: {error}") from error
