"""A recorded stem at one step, as plain arrays."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from vasc.arrays import Floats, Ids, Points
from vasc.domain.stem import radii_at
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
    domain: dict[str, Any] = timeline.config["domain"]
    return RecordedStem(
        positions=network.positions,
        segments=network.segments,
        primordia=np.flatnonzero(network.origins == Origin.PRIMORDIUM).astype(np.int32),
        ring=timeline.base_ring,
        radii=radii_at(network.positions[:, 2], domain.get("radius"), domain.get("radii") or []),
    )


def elongated(stem: RecordedStem, internodes: Sequence[Sequence[float]]) -> RecordedStem:
    """Give a stem after the growth of its internodes, which is no part of the pattern.

    Parameters
    ----------
    stem : RecordedStem
        As it was recorded.
    internodes : sequence of pairs of float
        Heights over that of the stem, before and after; a monotone curve goes through
        them (Runions 2008, section 6.2.3 and Figure 6.5). The stem itself if empty.

    Returns
    -------
    RecordedStem
        With the same veins at other heights.
    """
    if not len(internodes):
        return stem
    from scipy.interpolate import PchipInterpolator

    before, after = np.array(internodes, dtype=np.float64).T
    top = float(stem.positions[:, 2].max(initial=0.0))
    if top <= 0.0:
        return stem
    positions = stem.positions.copy()
    shares = np.clip(positions[:, 2] / top, 0.0, 1.0)
    positions[:, 2] = top * PchipInterpolator(before, after)(shares)
    return replace(stem, positions=positions)
