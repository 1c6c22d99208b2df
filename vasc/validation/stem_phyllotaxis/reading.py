"""Read the veins and primordia of a stem out of a timeline; whatever model made it."""

from collections.abc import Mapping
from math import radians
from typing import Any

import numpy as np

from vasc.errors import VascError
from vasc.network import Origin
from vasc.timeline import Timeline
from vasc.validation.stem_phyllotaxis.stem_graph import StemGraph


def read_stem(timeline: Timeline) -> StemGraph:
    """Give the stem that a timeline ends with.

    Primordia are the nodes of that origin, in the order of birth; the ring at the base
    are the seeds. Radius, rise, divergence and primordia a level are those of the config.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.

    Returns
    -------
    StemGraph

    Raises
    ------
    VascError
        If the run has no primordia, or its config does not say where they are.
    ShapeError
        If its nodes have no place in space.
    TimelineError
        If the file cannot be read.
    """
    origins = timeline.table("nodes", "origin")
    primordia = np.flatnonzero(origins == Origin.PRIMORDIUM)
    if not len(primordia):
        raise VascError(f"{timeline.path}: the run has no primordia; connectivity is of stems")
    placement = _part(timeline, "placement", ("divergence", "rise"))
    domain = _part(timeline, "domain", ("radius",))
    return StemGraph(
        positions=timeline.table("nodes", "position"),
        segments=timeline.table("segments", "nodes"),
        primordia=primordia.astype(np.int32),
        ring=np.flatnonzero(origins == Origin.SEED).astype(np.int32),
        divergence=radians(placement["divergence"]),
        rise=float(placement["rise"]),
        radius=float(domain["radius"]),
        per_level=int(placement.get("per_level", 1)),
    )


def _part(timeline: Timeline, name: str, keys: tuple[str, ...]) -> Mapping[str, Any]:
    """Give a part of the config that has to have some keys."""
    part: Mapping[str, Any] = timeline.config.get(name) or {}
    for key in keys:
        if key not in part:
            raise VascError(f"{timeline.path}: the config has no {name}.{key}")
    return part
