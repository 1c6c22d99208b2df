"""Experiment 3: where a canal in an areole ends, and where the closed rule says.

Hypothesis H2: the closed rule, which lets a source attract all its relative neighbors,
predicts the set of places where the canals of one source end (Runions 2008, equation 4.1).
"""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from vasc.arrays import Floats, Ids, Points
from vasc.domain import Blade, Tissue
from vasc.domain.voronoi import voronoi_in
from vasc.models.transport import FacilitatedDiffusion
from vasc.streams import Streams
from vasc.validation.canalization.geometric import closed_ends
from vasc.validation.canalization.protocols import PROTOCOLS, Protocol
from vasc.validation.canalization.scenarios import random_source
from vasc.validation.canalization.settled import settle

AREAS = (500.0, 700.0)
"""Smallest and largest areole, in cells."""
CORNERS = (6, 10)
"""Fewest and most corners drawn; of these, the convex hull is taken."""
SLENDERNESS = (0.6, 1.0)
"""Smallest and largest ratio of the axes of the ellipse that corners are drawn on."""
MERGED = 2.0
"""Relative neighbors nearer to each other are one end, in D."""
SAME_END = 3.0
"""An end is where the closed rule says if it is not farther from there, in D."""
NEAR_ENOUGH = 1.15
"""An end is about as near as the nearest if it is not farther by a larger ratio."""
GAIN = 3e3
"""Feedback gain of facilitated diffusion."""

AREOLE_PROTOCOLS = {
    one.name: one
    for one in (
        *(
            Protocol(f"facilitated S={s}", FacilitatedDiffusion(gain=GAIN, saturation=GAIN / s))
            for s in (1, 4, 16)
        ),
        PROTOCOLS["pool, background"],
    )
}
"""Protocols by name; S is the gain over the saturation, which tells how wide a strand is."""


def areole(seed: int) -> Tissue:
    """Draw a convex areole of Voronoi cells; the same seed gives the same."""
    import shapely

    streams = Streams(seed, ("outline", "placement"))
    generator = streams["outline"]
    hull = None
    while hull is None or len(hull.exterior.coords) < CORNERS[0]:
        angles = generator.uniform(0.0, 2.0 * np.pi, generator.integers(*CORNERS, endpoint=True))
        corners = np.stack([np.cos(angles), generator.uniform(*SLENDERNESS) * np.sin(angles)], 1)
        hull = shapely.MultiPoint(corners).convex_hull
    ring: Points = shapely.get_coordinates(shapely.orient_polygons(hull).exterior)[:-1]
    ring *= np.sqrt(generator.uniform(*AREAS) / hull.area)
    return voronoi_in(Blade.from_rings([ring], ring[:1]), streams["placement"])


def central_cell(tissue: Tissue, ring: Ids) -> int:
    """Give the cell farthest from all cells of the margin."""
    return int(tissue.distances_from(ring).argmax())


def areole_ends(protocol: Protocol, seed: int, *, is_central: bool) -> dict[str, Any]:
    """Let the canals of one source in an areole form, and hold their ends against the rules.

    Returns
    -------
    dict
        ``strands`` and ``predicted``: how many ends there are, and how many the closed rule
        says; ``recalled`` of these are near an end of a strand, ``precise`` ends near one of
        these; ``excess``: distance of the main end over the nearest; ``width``, ``formed``.
    """
    tissue = areole(seed)
    ring = np.flatnonzero(tissue.is_margin).astype(np.int32)
    generator = Streams(seed, ("source",))["source"]
    source = central_cell(tissue, ring) if is_central else random_source(tissue, [ring], generator)
    strand = settle(tissue, protocol.transport, [ring], [source], protocol.background).strand
    expected = closed_ends(tissue, [ring], source, MERGED)
    between = _between(tissue, expected, np.array(strand.landings, dtype=np.int32))
    return {
        "seed": seed,
        "cells": tissue.n_cells,
        "formed": strand.is_formed,
        "strands": strand.n_landings,
        "predicted": len(expected),
        "recalled": int((between.min(axis=1, initial=np.inf) <= SAME_END).sum()),
        "precise": int((between.min(axis=0, initial=np.inf) <= SAME_END).sum()),
        "excess": strand.excess,
        "width": strand.width,
    }


def areoles(
    seeds: Iterable[int],
    names: Iterable[str] = tuple(AREOLE_PROTOCOLS),
    progress: Callable[[str], None] = lambda name: None,
) -> list[dict[str, Any]]:
    """Give a row for each place of the source and each protocol.

    Recall and precision are shares of all ends of all areoles.
    """
    rows = []
    names, seeds = list(names), list(seeds)
    for is_central in (False, True):
        for name in names:
            place = "central" if is_central else "any"
            progress(f"areoles, source {place}, {name}")
            found = [
                areole_ends(AREOLE_PROTOCOLS[name], seed, is_central=is_central) for seed in seeds
            ]
            rows.append({"source": place, "protocol": name} | _summary(found))
    return rows


def _summary(found: list[dict[str, Any]]) -> dict[str, Any]:
    """Sum up the ends of many areoles."""
    sums = {key: sum(one[key] for one in found) for key in ("strands", "predicted")}
    recalled, precise = (sum(one[key] for one in found) for key in ("recalled", "precise"))
    return {
        "n": len(found),
        "seeds": [found[0]["seed"], found[-1]["seed"]],
        "cells": [min(one["cells"] for one in found), max(one["cells"] for one in found)],
        "formed": sum(one["formed"] for one in found),
        "strands_mean": sums["strands"] / len(found),
        "predicted_mean": sums["predicted"] / len(found),
        "recall": recalled / sums["predicted"],
        "precision": precise / sums["strands"] if sums["strands"] else None,
        "near_enough": float(np.mean([one["excess"] <= NEAR_ENOUGH for one in found])),
        "width_median": float(np.nanmedian([one["width"] for one in found])),
        "width_mean": float(np.nanmean([one["width"] for one in found])),
    }


def _between(tissue: Tissue, cells: Ids, others: Ids) -> Floats:
    """Give the distances between the centres of cells and others."""
    from scipy.spatial.distance import cdist

    return np.asarray(cdist(tissue.positions[cells], tissue.positions[others]))
