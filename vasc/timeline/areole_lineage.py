"""Lineage of areoles: what each was split from, which sources it held, what became of it."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids
from vasc.errors import TimelineError
from vasc.events import EventKind
from vasc.timeline.genealogy import Genealogy


class Recorded(Protocol):
    """What the lineage of areoles needs of a timeline."""

    path: Path

    @property
    def events(self) -> Mapping[str, NDArray]:
        """Columns of the events."""


@dataclass(frozen=True)
class AreoleFate:
    """What became of one areole.

    Parameters
    ----------
    areole : int
        Its id.
    birth : int
        Step of birth.
    segment : int
        The segment that closed it.
    parent : int
        The areole it was split from, -1 if it was born in open tissue.
    ancestors : tuple of int
        From the parent on, nearest first.
    split : int
        Step at which it was split, -1 if it is whole.
    children : tuple of int
        The two areoles it was split into.
    sources : ndarray of shape (s,), int32
        Sources that appeared in it, ascending.
    drained : ndarray of shape (s,), int32
        The step at which each of them was drained, -1 if it was not.
    blind_ends : ndarray of shape (b,), int32
        Nodes at which the veins of these sources ended blindly.
    """

    areole: int
    birth: int
    segment: int
    parent: int
    ancestors: tuple[int, ...]
    split: int
    children: tuple[int, ...]
    sources: Ids
    drained: Ids
    blind_ends: Ids


def areole_fate(timeline: Recorded, genealogy: Genealogy, areole: int) -> AreoleFate:
    """Tell where an areole came from, and what became of it.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    genealogy : Genealogy
        Of all its areoles.
    areole : int
        One of them.

    Returns
    -------
    AreoleFate

    Raises
    ------
    TimelineError
        If there is no such areole.
    """
    n_areoles = genealogy.n_areoles
    if not 0 <= areole < n_areoles:
        known = f"ids are 0 to {n_areoles - 1}" if n_areoles else "the run has none"
        raise TimelineError(f"{timeline.path}: there is no areole {areole}; {known}")
    events = timeline.events
    sources = np.unique(_subjects_of(events, EventKind.SOURCE_ENCLOSED, areole))
    return AreoleFate(
        areole=areole,
        birth=int(genealogy.births[areole]),
        segment=int(genealogy.segments[areole]),
        parent=int(genealogy.parents[areole]),
        ancestors=genealogy.ancestors(areole),
        split=int(genealogy.splits[areole]),
        children=tuple(np.flatnonzero(genealogy.parents == areole).tolist()),
        sources=sources,
        drained=_steps_of(events, EventKind.SOURCE_REMOVED, sources),
        blind_ends=_subjects_of(events, EventKind.VEIN_ENDED_BLINDLY, sources),
    )


def _subjects_of(events: Mapping[str, NDArray], kind: EventKind, objects: Ids | int) -> Ids:
    """Give the subjects of the events of a kind with some objects."""
    rows = (events["kind"] == kind) & np.isin(events["object"], objects)
    found: Ids = events["subject"][rows]
    return found


def _steps_of(events: Mapping[str, NDArray], kind: EventKind, items: Ids) -> Ids:
    """Give the step of the event of a kind of each item, -1 if there is none."""
    steps = np.full(len(items), NULL, dtype=np.int32)
    rows = np.flatnonzero((events["kind"] == kind) & np.isin(events["subject"], items))
    steps[np.searchsorted(items, events["subject"][rows])] = events["step"][rows]
    return steps
