"""What happened at a place of the blade: the nearest vein, its source, the areoles around it."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Floats, Ids, Points
from vasc.errors import TimelineError
from vasc.network import VeinNetwork
from vasc.timeline import run_genealogy
from vasc.timeline.frame import Frame
from vasc.timeline.genealogy import Genealogy
from vasc.timeline.veins import Veins

BESIDE = 1.0
"""Distance to a vein up to which a place off the blade is taken to be at that vein, in D."""
FAR = 1e9
"""Distance from which on it is not measured, in D."""


class Recorded(run_genealogy.Recorded, Protocol):
    """What the history of a place needs of a timeline."""

    path: Path


@dataclass(frozen=True)
class PlaceHistory:
    """What is at a place of the blade at a step, and how it came to be.

    Parameters
    ----------
    place : tuple of float
        Where, as asked for, in D.
    step : int
        When.
    segment : int
        The nearest segment.
    distance : float
        How far it is, in D.
    grown : int
        The step in which the vein grew there; the segment may be younger, by refinement.
    node : int
        The younger end of that segment.
    vein : int
        The first node of its vein.
    vein_birth : int
        Step of birth of the vein.
    branching_order : int
        Branching order of the vein.
    source : int
        The source that caused the vein there, -1 if none.
    source_birth, source_removed : int
        Steps of birth and death of that source, -1 if there is none, or it lives.
    areole : int
        The whole areole that holds the place, -1 if veins do not enclose it.
    areoles : tuple of int
        From the first-order loop on to that areole, each split from the one before.
    areole_births : tuple of int
        Steps of their births.
    """

    place: tuple[float, float]
    step: int
    segment: int
    distance: float
    grown: int
    node: int
    vein: int
    vein_birth: int
    branching_order: int
    source: int
    source_birth: int
    source_removed: int
    areole: int
    areoles: tuple[int, ...]
    areole_births: tuple[int, ...]


def history_at(
    timeline: Recorded,
    frame: Frame,
    veins: Veins,
    fates: Mapping[str, Ids],
    place: tuple[float, float],
) -> PlaceHistory:
    """Tell what is at a place, and how it came to be.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    frame : Frame
        The step.
    veins : Veins
        The veins of its nodes.
    fates : mapping of str to ndarray
        The fates of its sources (see :func:`vasc.timeline.source_fates.fate_columns`).
    place : tuple of float
        A place at that step, in D.

    Returns
    -------
    PlaceHistory

    Raises
    ------
    TimelineError
        If the run is one of a stem, there is no vein at that step, or the place is neither
        on the blade nor at a vein.
    """
    if timeline.dimensions != 2:
        raise TimelineError(
            f"{timeline.path}: is a stem, and a place of two numbers is one of a blade;"
            " ask for a node or a source"
        )
    tree = run_genealogy.genealogy_of(timeline, frame.step)[0]
    network = frame.network
    if not network.n_segments:
        raise TimelineError(f"{timeline.path}: there is no vein at step {frame.step}")
    row, distance = _nearest(network, np.clip(place, -FAR, FAR))
    if distance > BESIDE and not frame.blade.contains(np.array([place]))[0]:
        raise TimelineError(f"{timeline.path}: {_off(frame, place, distance)}")
    node = int(network.segments[row].max())
    vein = int(veins.firsts[node])
    source = int(network.causes[node] if network.growths is None else network.growths.causes[row])
    areole = _holding(tree, frame.positions, place)
    areoles = _from_first(tree, areole)
    return PlaceHistory(
        place=place,
        step=frame.step,
        segment=int(network.segment_ids[row]),
        distance=distance,
        grown=int(network.vein_births[row]),
        node=node,
        vein=vein,
        vein_birth=int(network.births[vein]),
        branching_order=int(veins.orders[node]),
        source=source,
        source_birth=NULL if source == NULL else int(fates["birth"][source]),
        source_removed=NULL if source == NULL else int(fates["removed"][source]),
        areole=areole,
        areoles=areoles,
        areole_births=tuple(tree.births[list(areoles)].tolist()),
    )


def _nearest(network: VeinNetwork, place: Floats) -> tuple[int, float]:
    """Give the row of the segment nearest to a place, and how far it is."""
    starts, stops = (network.positions[network.segments[:, end]] for end in (0, 1))
    along = stops - starts
    length = (along**2).sum(axis=1)
    share = ((place - starts) * along).sum(axis=1) / np.where(length > 0.0, length, 1.0)
    feet = starts + np.clip(share, 0.0, 1.0)[:, None] * along
    distances = np.sqrt(((feet - place) ** 2).sum(axis=1))
    row = int(np.argmin(distances))
    return row, float(distances[row])


def _holding(tree: Genealogy, positions: Points, place: tuple[float, float]) -> int:
    """Give the smallest whole areole that holds a place, -1 if none does."""
    found, least = NULL, np.inf
    for areole, ring in tree.boundaries.items():
        corners = positions[ring]
        if _is_inside(corners, place) and (size := float(np.ptp(corners, axis=0).prod())) < least:
            found, least = areole, size
    return found


def _is_inside(corners: Points, place: tuple[float, float]) -> bool:
    """Tell whether a polygon holds a place, by counting its sides to the right."""
    a, b = corners, np.roll(corners, -1, axis=0)
    is_level: NDArray[np.bool_] = (a[:, 1] > place[1]) != (b[:, 1] > place[1])
    a, b = a[is_level], b[is_level]
    x = a[:, 0] + (place[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return bool((x > place[0]).sum() % 2)


def _from_first(tree: Genealogy, areole: int) -> tuple[int, ...]:
    """Give the areoles from a first-order loop on to one that lies in it."""
    found = []
    while areole != NULL:
        found.append(areole)
        areole = int(tree.parents[areole])
    return tuple(found[::-1])


def _off(frame: Frame, place: tuple[float, float], distance: float) -> str:
    """Say that a place is off the blade, and where the blade is."""
    left, low, right, high = frame.blade.bounds
    how_far = f"{distance:.4g} D from" if max(map(abs, place)) < FAR else "far from"
    return (
        f"the place {place[0]:g},{place[1]:g} is off the blade, {how_far} the nearest"
        f" vein; at step {frame.step} the blade reaches from {left:.4g} to {right:.4g} across and"
        f" from {low:.4g} to {high:.4g} up, in D"
    )
