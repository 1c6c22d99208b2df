"""The strand of one source of a recorded run, and the vein that it leads to."""

from dataclasses import asdict, dataclass
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.strands import Strand, read_strand
from vasc.analysis.topology import component_labels
from vasc.arrays import Ids
from vasc.config import experiment_from_record
from vasc.domain import Tissue
from vasc.errors import ConfigError, TimelineError
from vasc.events import EventKind
from vasc.fields import Fields, Role
from vasc.network import VeinNetwork
from vasc.timeline import Timeline
from vasc.timeline.frame import Frame


@dataclass(frozen=True)
class StrandReport:
    """What a strand is held against: the veins there were before it.

    Parameters
    ----------
    source : int
        Id of the source.
    step : int
        The step at which its strand is read.
    strand : Strand
        The strand; its groups are the veins.
    nodes : tuple of ndarray of int32
        Ids of the nodes of every vein.
    end : int
        The vein node where the strand ends, -1 if it ends at none.
    activation : float
        Carriers at which a wall counts as part of a canal.
    """

    source: int
    step: int
    strand: Strand
    nodes: tuple[Ids, ...]
    end: int
    activation: float

    @property
    def passed(self) -> bool:
        """There is a strand, and it leads to a vein."""
        return self.strand.is_formed and not self.strand.is_loop and self.strand.reached >= 0

    def as_json(self) -> dict[str, Any]:
        """Give plain values; lengths in D, None for what there is not."""
        strand = self.strand
        sinks = [
            {
                "sink": number,
                "nodes": ids.tolist(),
                "n_nodes": len(ids),
                "flux_share": float(strand.shares[number]),
                "distance": float(strand.distances[number]),
                "way": float(strand.ways[number]),
                "is_reached": number in strand.groups,
            }
            for number, ids in enumerate(self.nodes)
        ]
        reached = strand.reached
        return {
            "source": self.source,
            "step": self.step,
            "sinks": sinks,
            "reached": reached if reached >= 0 else None,
            "end_node": self.end if self.end >= 0 else None,
            "nearest": int(strand.distances.argmin()),
            "nearest_by_cells": int(strand.ways.argmin()),
            "is_nearest": strand.is_nearest(reached),
            "is_nearest_by_cells": strand.is_nearest(reached, by_cells=True),
            "formed": strand.is_formed,
            "loop": strand.is_loop,
            "vortex": strand.is_vortex,
            "strands": strand.n_strands,
            "landings": strand.n_landings,
            "flux_share": float(strand.shares[reached]) if reached >= 0 else None,
            "width": _number(strand.width),
            "length": _number(strand.length),
            "tortuosity": _number(strand.tortuosity),
            "detour": _number(strand.detour),
            "excess": _number(strand.excess),
            "activation": self.activation,
            "thresholds": asdict(strand.thresholds),
            "pass": self.passed,
        }


def check_strand(timeline: Timeline, source: int | None = None, step: int = -1) -> StrandReport:
    """Read the strand of a source, when it became a vein or at the step asked for.

    Veins are the connected nodes that are older than the strand; a strand that has become
    a vein by the step asked for is read at the step at which it did.

    Parameters
    ----------
    timeline : Timeline
        An open timeline of a run on a tissue.
    source : int, optional
        Id of the source; the newest one if not given.
    step : int
        A recorded step, -1 for the last.

    Returns
    -------
    StrandReport

    Raises
    ------
    TimelineError
        If the run has no tissue, or no source with that id by then.
    ConfigError
        If the model of the run knows no canals.
    """
    tissue = timeline.tissue
    if tissue is None:
        raise TimelineError(
            f"{timeline.path}: no tissue: a run of the kind {timeline.config.get('kind')!r} has no"
            " strands to read; canalization has"
        )
    activation = _activation(timeline, tissue)
    frame = timeline.frame(step)
    births = frame.rows("sources", "birth")
    source = len(births) - 1 if source is None else source
    if not 0 <= source < len(births):
        known = f"0 to {len(births) - 1}" if len(births) else "none"
        raise TimelineError(
            f"{timeline.path}: source {source}: must be one of those placed by step {frame.step}:"
            f" {known}"
        )
    at = _step_of(frame, source)
    fields = timeline.fields(at)
    network = timeline.frame(at).network
    cell = int(tissue.nearest_cells(frame.rows("sources", "material")[[source]])[0])
    nodes, cells = _veins(tissue, fields, network, at)
    if fields.roles[cell] != Role.SOURCE:
        raise TimelineError(
            f"{timeline.path}: source {source}: it made no auxin at step {at}, as its cell was"
            " a vein already"
        )
    strand = read_strand(tissue, fields, cell, cells, activation)
    end = -1
    if strand.reached >= 0:
        ids = nodes[strand.reached]
        end = int(ids[cells[strand.reached] == strand.path[-1]][0])
    return StrandReport(source, at, strand, tuple(nodes), end, activation)


def _step_of(frame: Frame, source: int) -> int:
    """Give the step at which a source was drained, or that of the frame if it was not by then."""
    kinds: NDArray[np.integer] = frame.rows("events", "kind")
    is_end = (kinds == EventKind.SOURCE_REMOVED) & (frame.rows("events", "subject") == source)
    steps = frame.rows("events", "step")[is_end]
    return int(steps[0]) if len(steps) else int(frame.step)


def _veins(
    tissue: Tissue, fields: Fields, network: VeinNetwork, step: int
) -> tuple[list[Ids], list[Ids]]:
    """Give the ids of the nodes of every vein, and their cells; veins born in the step are none."""
    is_older = (network.births < step) | ((network.births == 0) & (step == 0))
    cells = tissue.nearest_cells(network.positions)
    is_sink = is_older & (fields.roles[cells] == Role.VEIN)
    kept = is_sink[network.segments].all(axis=1)
    older = VeinNetwork(
        positions=network.positions,
        parents=network.parents,
        births=network.births,
        origins=network.origins,
        causes=network.causes,
        segments=network.segments[kept],
        segment_ids=network.segment_ids[kept],
        segment_births=network.segment_births[kept],
        segment_kinds=network.segment_kinds[kept],
    )
    labels = component_labels(older)
    ids = [
        np.flatnonzero(is_sink & (labels == label)).astype(np.int32)
        for label in np.unique(labels[is_sink])
    ]
    return ids, [cells[one] for one in ids]


def _activation(timeline: Timeline, tissue: Tissue) -> float:
    """Give the carriers at which a wall of the recorded model counts as part of a canal."""
    with experiment_from_record(timeline.config, name=str(timeline.path)) as experiment:
        transport = getattr(experiment.parameters, "transport", None)
    activation = getattr(transport, "activation", None)
    if activation is None:
        raise ConfigError(
            f"{timeline.path}: kind = {timeline.config.get('kind')!r}: its walls have no threshold"
            " from which on they are a canal; 'canalization' has"
        )
    return float(activation(tissue))


def _number(value: float) -> float | None:
    """Give a number, None for one that JSON does not know."""
    return value if isfinite(value) else None
