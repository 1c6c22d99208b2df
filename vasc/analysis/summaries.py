"""What came of a run, in numbers that a user is told at its end."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from vasc.analysis.tissue_units import time_unit, unit_of
from vasc.domain import Blade
from vasc.events import EventKind
from vasc.network import Origin
from vasc.state import State

OUTLINE_ERROR = 0.1
"""A node at most that far beyond a deformed outline, in D, may be on the margin."""

ROUNDING = 1e-9
"""Share of the length of a blade that a node on its margin may lie beyond it."""


@dataclass(frozen=True)
class TissueSummary:
    """What came of a run on a tissue, besides.

    Parameters
    ----------
    model : str
        Its model.
    cells, walls : int
        Size of the tissue.
    time_unit, concentration_unit : str
        Units of time and of auxin in this model.
    concentration_least, concentration_most : float
        Auxin of the cells with least and most of it.
    connected : int
        Sources from which a canal has become a vein.
    vortices : int
        Rounds of sources in which more circulated than was made.
    unsettled : int
        Rounds that ended while walls still changed.
    """

    model: str
    cells: int
    walls: int
    time_unit: str
    concentration_unit: str
    concentration_least: float
    concentration_most: float
    connected: int
    vortices: int
    unsettled: int


@dataclass(frozen=True)
class Summary:
    """What came of a run.

    Parameters
    ----------
    output : Path
        The timeline.
    steps : int
        The last recorded step.
    time : float
        Model time at that step.
    nodes, segments : int
        Size of the network at that step.
    sources_placed, sources_left : int
        Sources that ever appeared, and those alive.
    joins, loops : int
        Segments that joined two veins, and those of them that closed a loop.
    stalls_resolved : int
        Times the stall rule chose a direction.
    nodes_outside : int or None
        Nodes that lie outside the blade, seeds left out; None for a stem, which has none.
    tissue : TissueSummary or None
        What only runs on a tissue have.
    wall_seconds : float
        Time this session took.
    stop_reason : str or None
        Why the run ended, None if it can go on.
    is_interrupted : bool
        True when the caller stopped it.
    """

    output: Path
    steps: int
    time: float
    nodes: int
    segments: int
    sources_placed: int
    sources_left: int
    joins: int
    loops: int
    stalls_resolved: int
    nodes_outside: int | None
    tissue: TissueSummary | None
    wall_seconds: float
    stop_reason: str | None
    is_interrupted: bool = False


def summed_up(
    path: Path,
    state: State,
    config: Mapping[str, Any],
    started: float,
    reason: str | None,
    is_interrupted: bool = False,
) -> Summary:
    """Sum up a state.

    Parameters
    ----------
    path : Path
        The timeline.
    state : State
        The last state.
    config : mapping
        The config of the run.
    started : float
        When this session began, by ``time.perf_counter``.
    reason : str or None
        Why the run ended, None if it can go on.
    is_interrupted : bool
        True when the caller stopped it.

    Returns
    -------
    Summary
    """
    kinds = np.bincount(state.rows("events", "kind"), minlength=len(EventKind)).tolist()
    network = state.network
    return Summary(
        output=path,
        steps=state.step,
        time=state.time,
        nodes=network.n_vein_nodes,
        segments=network.n_segments,
        sources_placed=kinds[EventKind.SOURCE_PLACED],
        sources_left=len(state.live),
        joins=kinds[EventKind.VEIN_JOINED],
        loops=kinds[EventKind.LOOP_CLOSED],
        stalls_resolved=kinds[EventKind.STALL_RESOLVED],
        nodes_outside=None if state.blade is None else _count_outside(state, state.blade),
        tissue=tissue_summary(state, config, kinds),
        wall_seconds=time.perf_counter() - started,
        stop_reason=reason,
        is_interrupted=is_interrupted,
    )


def tissue_summary(
    state: State, config: Mapping[str, Any], kinds: list[int]
) -> TissueSummary | None:
    """Sum up a state of a tissue, given the numbers of events; None without cells."""
    if state.tissue is None or state.fields is None:
        return None
    return TissueSummary(
        model=str(config["kind"]),
        cells=state.tissue.n_cells,
        walls=state.tissue.n_walls,
        time_unit=time_unit(config),
        concentration_unit=unit_of(config, "concentration"),
        concentration_least=float(state.fields.concentration.min()),
        concentration_most=float(state.fields.concentration.max()),
        connected=kinds[EventKind.SOURCE_REMOVED],
        vortices=kinds[EventKind.VORTEX_FORMED],
        unsettled=kinds[EventKind.CANALS_UNSETTLED],
    )


def _count_outside(state: State, blade: Blade) -> int:
    """Count the nodes that lie outside the blade."""
    network = state.network
    # a seed lies on the margin, where the petiole is attached
    is_outside = ~blade.contains(network.positions)
    is_outside &= network.origins != Origin.SEED
    is_outside[network.retired] = False
    outside = np.flatnonzero(is_outside)
    # the recorded outline of a deformed blade is a polygon, nodes on the margin are between its
    # corners; in others a node on the margin lies beyond it by rounding alone
    slack = ROUNDING * blade.length if state.places is None else OUTLINE_ERROR
    return int((blade.margin_distance(network.positions[outside]) > slack).sum())
