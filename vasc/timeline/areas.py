"""Areas of areoles over all steps of a timeline."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.areoles import polygon_areas
from vasc.arrays import Points
from vasc.errors import TimelineError
from vasc.events import EventKind
from vasc.state import moved
from vasc.timeline import moving
from vasc.timeline.layout import Motion, count_column
from vasc.timeline.moving import positions_at

AREOLES_IN_SPACE = "areoles are recorded in space; they have an area in the plane alone"


class Recorded(moving.Recorded, Protocol):
    """What the areas need of a timeline."""

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table."""

    def places(self, name: str, step: int) -> Points:
        """Read explicit positions of a step."""


def areole_areas(timeline: Recorded) -> dict[str, NDArray]:
    """Give the area of every areole at every step of its life.

    Parameters
    ----------
    timeline : Timeline
        An open timeline; positions are read step by step.

    Returns
    -------
    dict of str to ndarray
        ``step`` (int32), ``areole`` (int32) and ``area`` (float64, in square units of
        length): one row an areole a step, by step, then by areole. Empty columns when
        there is no areole, as in a stem.

    Raises
    ------
    TimelineError
        If areoles are recorded of a run in space.
    """
    if timeline.motion == Motion.NONE and timeline.n_rows("areoles"):
        raise TimelineError(AREOLES_IN_SPACE)
    owners, nodes = timeline.table("boundaries", "areole"), timeline.table("boundaries", "node")
    split_at = _split_steps(timeline)
    n_areoles = timeline.frames[count_column("areoles")]
    n_corners = timeline.frames[count_column("boundaries")]
    material = timeline.table("nodes", "material")[nodes]
    steps, ids, areas = [], [], []
    for step in np.flatnonzero(n_areoles).tolist():
        n_born, n_rows = int(n_areoles[step]), int(n_corners[step])
        if timeline.motion == Motion.EXPLICIT:
            points = timeline.places("nodes", step)[nodes[:n_rows]]
        else:
            points = moved(material[:n_rows], timeline.frames["motion"][step])
        is_whole = split_at[:n_born] > step
        ids.append(np.flatnonzero(is_whole).astype(np.int32))
        areas.append(polygon_areas(points, owners[:n_rows], n_born)[is_whole])
        steps.append(np.full(len(ids[-1]), step, dtype=np.int32))
    return {
        "step": np.concatenate([np.empty(0, dtype=np.int32), *steps]),
        "areole": np.concatenate([np.empty(0, dtype=np.int32), *ids]),
        "area": np.concatenate([np.empty(0), *areas]),
    }


def area_of(timeline: Recorded, areole: int, step: int) -> float:
    """Give the area of one areole at one step; the positions of no other step are read.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    areole : int
        An areole that is recorded.
    step : int
        A recorded step, not before its birth.

    Returns
    -------
    float
        In square units of length.
    """
    nodes = timeline.table("boundaries", "node")[timeline.table("boundaries", "areole") == areole]
    points = positions_at(timeline, nodes, np.full(len(nodes), step, dtype=np.int32))
    return float(polygon_areas(points, np.zeros(len(nodes), dtype=np.int32), 1)[0])


def _split_steps(timeline: Recorded) -> NDArray[np.int64]:
    """Give the step at which each areole was split, beyond all steps if it was not."""
    split_at = np.full(timeline.n_rows("areoles"), np.iinfo(np.int64).max)
    is_split = timeline.table("events", "kind") == EventKind.AREOLE_SPLIT
    steps, subjects = timeline.table("events", "step"), timeline.table("events", "subject")
    split_at[subjects[is_split]] = steps[is_split]
    return split_at
