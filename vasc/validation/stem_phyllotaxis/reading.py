"""A recorded stem, as the checks read it."""

from math import radians
from typing import Any

import numpy as np

from vasc.errors import TimelineError
from vasc.network import Origin
from vasc.timeline import Timeline
from vasc.validation.stem_phyllotaxis.stem_graph import StemGraph


def read_stem(timeline: Timeline) -> StemGraph:
    """Read the veins of a recorded stem at its last step, and its phyllotaxis.

    The radius of a stem whose apex changes its size is that at the middle primordium.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.

    Raises
    ------
    TimelineError
        If the run is no stem, or holds no step.
    """
    if timeline.dimensions != 3 or timeline.model != "stem":
        raise TimelineError(
            f"{timeline.path}: is no stem, but a run of the kind {timeline.model!r}"
        )
    if not timeline.n_frames:
        raise TimelineError(f"{timeline.path}: holds no step")
    network = timeline.frame(-1).network
    primordia = np.flatnonzero(network.origins == Origin.PRIMORDIUM).astype(np.int32)
    placement: dict[str, Any] = timeline.config["placement"]
    rise, per_level = float(placement["rise"]), int(placement["per_level"])
    middle = network.positions[primordia[len(primordia) // 2], 2] if len(primordia) else 0.0
    return StemGraph(
        positions=network.positions,
        segments=network.segments,
        primordia=primordia,
        ring=timeline.base_ring,
        divergence=radians(float(placement["divergence"])),
        rise=rise,
        radius=_radius(timeline.config["domain"], float(middle)),
        per_level=per_level,
    )


def _radius(domain: dict[str, Any], height: float) -> float:
    """Give the radius of a stem at a height."""
    if domain.get("radius") is not None:
        return float(domain["radius"])
    known = np.array(domain["radii"])
    return float(np.interp(height, known[:, 0], known[:, 1]))
