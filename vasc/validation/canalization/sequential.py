"""Experiment 2: canals one after the other, each a vein for the next.

Hypothesis H1 again: at each source, does the canal end at the vein that the open rule
names, the one with the nearest node (Runions 2008, section 4.2)?
"""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from vasc.arrays import Ids
from vasc.domain import Tissue
from vasc.streams import Streams
from vasc.validation.canalization.leaves import leaf
from vasc.validation.canalization.protocols import PROTOCOLS, Protocol
from vasc.validation.canalization.rates import wilson
from vasc.validation.canalization.settled import settle

N_SOURCES = 45
"""Sources of a leaf."""
FIRST, SHRINKING, LEAST = 12.0, 0.9, 2.0
"""Birth distance at first, its ratio from one to the next, and its end, in D."""
COARSE = 1.0
"""Tolerance of a step: many canals are asked for, and only where they end."""
DARTS = 1000
"""Darts thrown before the birth distance shrinks."""


def veins_one_by_one(protocol: Protocol, seed: int) -> list[dict[str, Any]]:
    """Let canals form in a leaf one after the other.

    Returns
    -------
    list of dict
        A row for each canal: ``source`` and ``end``, cells; ``vein`` and ``predicted``, the
        canal that it joins and the one with the nearest node, 0 for the base; ``excess``,
        distance of its end over that of the nearest node; ``tortuosity``, ``formed``.
    """
    tissue, base = leaf(seed)
    generator = Streams(seed, ("darts",))["darts"]
    veins: list[Ids] = [np.array([base], dtype=np.int32)]
    rows: list[dict[str, Any]] = []
    distance = FIRST
    while len(rows) < N_SOURCES and distance > LEAST:
        source = dart(tissue, np.concatenate(veins), distance, generator)
        if source is None:
            distance *= SHRINKING
            continue
        strand = settle(
            tissue, protocol.transport, veins, [source], protocol.background, COARSE
        ).strand
        rows.append(
            {
                "source": source,
                "end": int(strand.path[-1]),
                "vein": strand.reached,
                "predicted": int(strand.distances.argmin()),
                "excess": strand.excess,
                "tortuosity": strand.tortuosity,
                "formed": strand.is_formed,
            }
        )
        # a canal that leads nowhere leaves no vein, but keeps its number
        veins.append(strand.path[:-1] if strand.reached >= 0 else strand.path[:0])
    return rows


def dart(tissue: Tissue, cells: Ids, distance: float, generator: np.random.Generator) -> int | None:
    """Throw darts at cells until one is as far from all veins as asked; None for none."""
    is_free = tissue.distances_from(cells) >= distance
    thrown = generator.integers(tissue.n_cells, size=DARTS)
    hits = thrown[is_free[thrown]]
    return int(hits[0]) if len(hits) else None


def sequential(
    seeds: Iterable[int],
    names: Iterable[str] = ("facilitated",),
    progress: Callable[[str], None] = lambda name: None,
) -> list[dict[str, Any]]:
    """Give a row for each protocol, over the canals of all leaves.

    The first canal of each leaf has only the base to go to and is not counted.
    """
    rows = []
    seeds = list(seeds)
    for name in names:
        found = []
        for seed in seeds:
            progress(f"canals one by one, leaf {seed}, {name}")
            found += veins_one_by_one(PROTOCOLS[name], seed)[1:]
        excess = np.array([one["excess"] for one in found])
        tortuosity = np.array([one["tortuosity"] for one in found])
        same = sum(one["vein"] == one["predicted"] for one in found)
        low, high = wilson(same, len(found))
        rows.append(
            {
                "protocol": name,
                "leaves": len(seeds),
                "seeds": [seeds[0], seeds[-1]],
                "n": len(found),
                "formed": sum(one["formed"] for one in found),
                "excess_median": float(np.nanmedian(excess)),
                "excess_p90": float(np.nanquantile(excess, 0.9)),
                "tortuosity_median": float(np.nanmedian(tortuosity)),
                "same_vein": same,
                "same_vein_rate": same / len(found),
                "same_vein_low": low,
                "same_vein_high": high,
            }
        )
    return rows
