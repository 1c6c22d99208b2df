"""A recorded stem, as the checks read it."""

from math import radians
from typing import Any

from vasc.timeline import Timeline
from vasc.timeline.stems import recorded_stem
from vasc.validation.stem_phyllotaxis.stem_graph import StemGraph


def read_stem(timeline: Timeline) -> StemGraph:
    """Read the veins of a recorded stem at its last step, and its phyllotaxis.

    The radius of a stem whose apex changes its size is that at the middle primordium.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.

    Returns
    -------
    StemGraph

    Raises
    ------
    TimelineError
        If the run is no stem, or holds no step.
    """
    stem = recorded_stem(timeline)
    placement: dict[str, Any] = timeline.config["placement"]
    # a stem without primordia has the radius of its ring
    known = stem.radii[stem.primordia if len(stem.primordia) else stem.ring]
    return StemGraph(
        positions=stem.positions,
        segments=stem.segments,
        primordia=stem.primordia,
        ring=stem.ring,
        divergence=radians(float(placement["divergence"])),
        rise=float(placement["rise"]),
        radius=float(known[len(known) // 2]),
        per_level=int(placement["per_level"]),
        radii=stem.radii[stem.primordia] if known.min() < known.max() else None,
    )
