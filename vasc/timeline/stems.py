"""A recorded stem at one step, as plain arrays."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from vasc.arrays import Floats, Ids, Points
from vasc.errors import TimelineError
from vasc.network import Origin
from vasc.timeline.reader import Timeline


@dataclass(frozen=True)
class RecordedStem:
    """The veins and primordia of a stem.

    Parameters
    ----------
    positions : ndarray of shape (n, 3), float64
        Vein nodes, in D; the stem stands along the third axis, around the origin.
    segments : ndarray of shape (m, 2), integer
        Node ids.
    primordia : ndarray of shape (p,), integer
        Node ids, in the order of birth.
    ring : ndarray of shape (r,), integer
        Node ids of the ring at the base.
    radii : ndarray of shape (n,), float64
        Radius of the stem at the height of each node, in D.
    """

    positions: Points
    segments: Ids
    primordia: Ids
    ring: Ids
    radii: Floats


def is_stem(timeline: Timeline) -> bool:
    """Tell whether a run is one of a stem."""
    return timeline.dimensions == 3 and timeline.model == "stem"


def recorded_stem(timeline: Timeline, step: int = -1) -> RecordedStem:
    """Read the veins of a recorded stem.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    step : int
        A recorded step; -1 is the last.

    Raises
    ------
    TimelineError
        If the run is no stem, or holds no step.
    VascError
        If the step was not recorded.
    """
    if not is_stem(timeline):
        raise TimelineError(
            f"{timeline.path}: is no stem, but a run of the kind {timeline.model!r}"
        )
    if not timeline.n_frames:
        raise TimelineError(f"{timeline.path}: holds no step")
    network = timeline.frame(step).network
    return RecordedStem(
        positions=network.positions,
        segments=network.segments,
        primordia=np.flatnonzero(network.origins == Origin.PRIMORDIUM).astype(np.int32),
        ring=timeline.base_ring,
        radii=radii_at(timeline.config["domain"], network.positions[:, 2]),
    )


def radii_at(domain: dict[str, Any], heights: Floats) -> Floats:
    """Give the radius of a stem at heights, as the table ``domain`` of its config has it."""
    if domain.get("radius") is not None:
        return np.full(len(heights), float(domain["radius"]))
    known = np.array(domain["radii"], dtype=np.float64)
    return np.asarray(np.interp(heights, known[:, 0], known[:, 1]), dtype=np.float64)
