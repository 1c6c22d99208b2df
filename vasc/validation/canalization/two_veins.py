"""Figure 4.9 of Runions (2008): two veins and one source, which is nearer to one or the other.

Both ways in the symmetric tissue of the figure; and with veins that are no mirror images
of each other, as in a symmetric tissue every feedback ends at the nearer one. Experiment 5
asks the same of sources anywhere, for background productions and models.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from vasc.arrays import Ids
from vasc.domain import Tissue
from vasc.models.transport import (
    FacilitatedDiffusion,
    PolarTransport,
    PooledTransport,
    Transport,
)
from vasc.streams import Streams
from vasc.validation.canalization.geometric import ratio_to_second
from vasc.validation.canalization.protocols import PROTOCOLS, Protocol
from vasc.validation.canalization.rates import wilson
from vasc.validation.canalization.scenarios import CLEARANCE, TISSUES
from vasc.validation.canalization.settled import TOLERANCE, Settled, settle

COLUMNS, ROWS = 31, 17
"""The tissue of the figure, in cells."""

Place = tuple[float, float]


@dataclass(frozen=True)
class TwoVeins:
    """Two veins, each along a line, and a source.

    Parameters
    ----------
    name : str
        What tables call it.
    veins : tuple of tuple of tuple of float
        Points of each line; one point is a vein of one cell.
    source : tuple of float
        Where the source is.
    nearest : int
        The vein that is nearer to it.
    """

    name: str
    veins: tuple[tuple[Place, ...], tuple[Place, ...]]
    source: Place
    nearest: int

    def cells(self, tissue: Tissue) -> tuple[list[Ids], int]:
        """Give the cells of the veins, and that of the source."""
        veins = [tissue.cells_along(np.array(line)) for line in self.veins]
        return veins, int(tissue.nearest_cells([self.source])[0])


FIGURE_VEINS = (((5.0, 16.0),), ((25.0, 16.0),))
UNEQUAL_POINTS = (((5.0, 16.0),), ((27.0, 10.0),))
LINE_AND_POINT = (((2.0, 3.0), (2.0, 13.0)), ((20.0, 12.0),))
CASES = (
    TwoVeins("source left", FIGURE_VEINS, (12.0, 4.0), 0),
    TwoVeins("source right", FIGURE_VEINS, (18.0, 4.0), 1),
    TwoVeins("unequal points, source left", UNEQUAL_POINTS, (10.0, 6.0), 0),
    TwoVeins("unequal points, source right", UNEQUAL_POINTS, (20.0, 5.0), 1),
    TwoVeins("line and point, source left", LINE_AND_POINT, (9.0, 8.0), 0),
    TwoVeins("line and point, source right", LINE_AND_POINT, (13.0, 9.0), 1),
)
"""The first two are those of the figure."""

FIGURE_PROTOCOLS = (PROTOCOLS["facilitated"], PROTOCOLS["pool, background"])
"""Facilitated diffusion, and polar transport with background production."""


def settled_case(
    case: TwoVeins, tissue: str, protocol: Protocol, seed: int = 1, tolerance: float = TOLERANCE
) -> Settled:
    """Let the canal of a case form in a tissue of some kind."""
    cells = TISSUES[tissue](COLUMNS, ROWS, seed)
    veins, source = case.cells(cells)
    return settle(
        cells, protocol.transport, veins, [source], protocol.background, tolerance=tolerance
    )


def figure_rows(progress: Callable[[str], None] = lambda name: None) -> list[dict[str, Any]]:
    """Give a row for each tissue, protocol and case of the figure and beyond it.

    ``is_asked`` is whether the canal has to end at the nearest vein: in all cases by
    facilitated diffusion, between equal veins by polar transport.
    """
    rows = []
    for tissue in TISSUES:
        for protocol in FIGURE_PROTOCOLS:
            progress(f"Figure 4.9, {tissue}, {protocol.name}")
            for case in CASES:
                settled = settled_case(case, tissue, protocol)
                strand = settled.strand
                are_equal = case.veins != LINE_AND_POINT
                rows.append(
                    {
                        "tissue": tissue,
                        "protocol": protocol.name,
                        "case": case.name,
                        "q": ratio_to_second(strand.distances),
                        "nearest": case.nearest,
                        "nearest_by_cells": int(strand.ways.argmin()),
                        "reached": strand.reached,
                        "share": float(strand.shares[case.nearest]),
                        "formed": strand.is_formed,
                        "is_hit": strand.reached == case.nearest,
                        "is_figure": case.veins == FIGURE_VEINS,
                        "is_asked": are_equal or not protocol.transport.is_polar,
                    }
                )
    return rows


SCANNED: dict[str, Transport] = {
    "facilitated": FacilitatedDiffusion(),
    "polar": PolarTransport(),
    "pool": PooledTransport(),
}
"""Models of experiment 5."""
BACKGROUNDS = (0.0, 0.1, 0.5, 1.0)
"""Background productions of experiment 5."""


def background_scan(
    seeds: Iterable[int],
    tissues: Iterable[str] = tuple(TISSUES),
    progress: Callable[[str], None] = lambda name: None,
) -> list[dict[str, Any]]:
    """Give how often the canal reaches the nearer of the two veins of the figure.

    A seed draws the place of the source, at least 4 D from the veins and one D nearer to one
    of them, and the tissue if that is random.

    Returns
    -------
    list of dict
        A row for each tissue, model and background production.
    """
    seeds, rows = list(seeds), []
    for tissue in tissues:
        for name, transport in SCANNED.items():
            for background in BACKGROUNDS:
                progress(f"two veins, {tissue}, {name}, background {background:g}")
                protocol = Protocol(name, transport, background)
                found = [_drawn_case(tissue, protocol, seed) for seed in seeds]
                hits = sum(one.strand.is_nearest(one.strand.main) for one in found)
                low, high = wilson(hits, len(found))
                rows.append(
                    {
                        "tissue": tissue,
                        "model": name,
                        "background": background,
                        "n": len(found),
                        "seeds": [seeds[0], seeds[-1]],
                        "hits": hits,
                        "hit_rate": hits / len(found),
                        "hit_low": low,
                        "hit_high": high,
                        "formed": sum(one.strand.is_formed for one in found),
                        "vortices": sum(one.is_vortex for one in found),
                    }
                )
    return rows


def _drawn_case(tissue: str, protocol: Protocol, seed: int) -> Settled:
    """Let the canal of a source anywhere form."""
    cells = TISSUES[tissue](COLUMNS, ROWS, seed)
    veins = [cells.nearest_cells(line) for line in FIGURE_VEINS]
    left, right = (cells.distances_from(vein) for vein in veins)
    is_free = (np.minimum(left, right) >= CLEARANCE) & (np.abs(left - right) >= 1.0)
    source = Streams(seed, ("source",))["source"].choice(np.flatnonzero(is_free))
    return settle(cells, protocol.transport, veins, [int(source)], protocol.background)
