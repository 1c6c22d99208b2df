"""Experiment 1: how often a canal reaches the vein that the rules of geometry predict.

Hypothesis H1: the open rule, which lets a source attract the nearest vein node, predicts
where a canal ends (Runions 2008, section 4.1.4). Beside it, for the same scenarios, H2:
the closed rule predicts the set of veins that canals reach.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np

from vasc.validation.canalization.geometric import closed_ends, groups_of, ratio_to_second
from vasc.validation.canalization.protocols import PROTOCOLS, Protocol
from vasc.validation.canalization.rates import wilson
from vasc.validation.canalization.scenarios import Scenario, draw
from vasc.validation.canalization.settled import TOLERANCE, settle

CLEAR = 0.8
"""Below that ratio of the distances of the nearest and the second vein, no near-tie."""
EXACT = {"rectangular": sqrt(0.5), "hexagonal": sqrt(0.75), "voronoi": CLEAR}
"""The ratio below which the nearest vein by Euclid is the nearest over cells, too: ways over
square cells are up to sqrt(2) times the straight line, over hexagons up to 2/sqrt(3) times;
for Voronoi cells there is no bound, and the number is ours."""


@dataclass(frozen=True)
class Outcome:
    """What became of one source.

    Parameters
    ----------
    seed : int
        Seed of the scenario.
    q : float
        Distance of the nearest vein over that of the second.
    is_hit, is_hit_by_cells : bool
        Whether the vein that gets most is the nearest, by Euclid and over cells.
    is_formed, is_loop, is_vortex, is_at_rest : bool
        Of the strand and of the run.
    n_strands, n_predicted : int
        Veins that strands reach, and those that the closed rule predicts.
    is_as_closed : bool
        Whether these are the same veins.
    excess : float
        Distance of the end of the canal over that of the nearest vein cell.
    detour : float
        Length of the canal over the shortest way over cells to its end.
    tortuosity, width : float
        Of the strand.
    """

    seed: int
    q: float
    is_hit: bool
    is_hit_by_cells: bool
    is_formed: bool
    is_loop: bool
    is_vortex: bool
    is_at_rest: bool
    n_strands: int
    n_predicted: int
    is_as_closed: bool
    excess: float
    detour: float
    tortuosity: float
    width: float


def outcome(scenario: Scenario, protocol: Protocol, seed: int, tolerance: float) -> Outcome:
    """Let the canal of a scenario form, and hold it against both rules."""
    settled = settle(
        scenario.tissue,
        protocol.transport,
        scenario.veins,
        [scenario.source],
        protocol.background,
        tolerance,
    )
    strand = settled.strand
    predicted = groups_of(
        scenario.veins, closed_ends(scenario.tissue, scenario.veins, scenario.source)
    )
    return Outcome(
        seed=seed,
        q=ratio_to_second(strand.distances),
        is_hit=strand.is_nearest(strand.main),
        is_hit_by_cells=strand.is_nearest(strand.main, by_cells=True),
        is_formed=strand.is_formed,
        is_loop=strand.is_loop,
        is_vortex=settled.is_vortex,
        is_at_rest=settled.is_at_rest,
        n_strands=strand.n_strands,
        n_predicted=len(predicted),
        is_as_closed=predicted == frozenset(strand.groups),
        excess=strand.excess,
        detour=strand.detour,
        tortuosity=strand.tortuosity,
        width=strand.width,
    )


def outcomes(
    tissue: str,
    scenario: str,
    protocol: Protocol,
    seeds: Iterable[int],
    tolerance: float = TOLERANCE,
) -> list[Outcome]:
    """Let the canals of many drawn scenarios form."""
    return [outcome(draw(tissue, scenario, seed), protocol, seed, tolerance) for seed in seeds]


def summary(found: list[Outcome]) -> dict[str, Any]:
    """Give counts, rates with 95 % Wilson intervals, and medians of outcomes."""
    clear = [one for one in found if one.q < CLEAR]
    row: dict[str, Any] = {"n": len(found), "seeds": [found[0].seed, found[-1].seed]}
    row |= _rate("hit", [one.is_hit for one in found])
    row |= _rate("hit_clear", [one.is_hit for one in clear])
    row |= _rate("hit_by_cells", [one.is_hit_by_cells for one in found])
    row |= _rate("as_closed", [one.is_as_closed for one in found])
    several = [one.is_as_closed for one in found if one.n_predicted > 1]
    row |= _rate("as_closed_several", several)
    row |= {
        # how clear the clearest miss was
        "miss_q_min": min((one.q for one in found if not one.is_hit), default=None),
        "misses": [one.seed for one in found if not one.is_hit],
        "clear_misses": [one.seed for one in clear if not one.is_hit],
        "formed": sum(one.is_formed for one in found),
        "vortices": sum(one.is_vortex for one in found),
        "loops": sum(one.is_loop for one in found),
        "unsettled": sum(not one.is_at_rest for one in found),
        "strands_mean": float(np.mean([one.n_strands for one in found])),
        "predicted_mean": float(np.mean([one.n_predicted for one in found])),
    }
    for name in ("excess", "detour", "tortuosity", "width"):
        values = np.array([getattr(one, name) for one in found])
        values = values[np.isfinite(values)]
        row[f"{name}_median"] = float(np.median(values)) if len(values) else None
        row[f"{name}_p90"] = float(np.quantile(values, 0.9)) if len(values) else None
        row[f"{name}_max"] = float(values.max()) if len(values) else None
    return row


def hit_rates(
    cases: Iterable[tuple[str, str, str]],
    seeds: range,
    tolerance: float = TOLERANCE,
    progress: Callable[[str], None] = lambda name: None,
) -> list[dict[str, Any]]:
    """Give a row of :func:`summary` for each tissue, scenario and protocol.

    Parameters
    ----------
    cases : iterable of tuple of str
        Names of tissue, scenario and protocol.
    seeds : range
        Seeds of the scenarios.
    tolerance : float
        Largest change of a wall in a step, relative to its state plus 1.
    progress : callable
        Told the name of each row before it is made.

    Returns
    -------
    list of dict
        With the names of the case, and the rate where the nearest is exact.
    """
    rows = []
    for tissue, scenario, protocol in cases:
        progress(f"{tissue} {scenario}, {protocol}")
        found = outcomes(tissue, scenario, PROTOCOLS[protocol], seeds, tolerance)
        names = {"tissue": tissue, "scenario": scenario, "protocol": protocol}
        exact = [one.is_hit for one in found if one.q < EXACT[tissue]]
        rows.append(names | summary(found) | _rate("hit_exact", exact))
    return rows


def _rate(name: str, flags: list[bool]) -> dict[str, Any]:
    """Give how often something is so, of how many, and the interval of its rate."""
    hits, n = sum(flags), len(flags)
    low, high = wilson(hits, n)
    return {
        f"{name}s": hits,
        f"{name}_n": n,
        f"{name}_rate": hits / n if n else None,
        f"{name}_low": low,
        f"{name}_high": high,
    }
