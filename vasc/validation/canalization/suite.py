"""The suite: whether canals reach the vein nodes that geometry predicts, and when not."""

from collections.abc import Callable, Iterator
from typing import Any

from vasc.domain.tilings import rectangular
from vasc.errors import RunError
from vasc.models.transport import FacilitatedDiffusion, PolarTransport
from vasc.validation.canalization.areoles import AREOLE_PROTOCOLS, areoles
from vasc.validation.canalization.hit_rates import CLEAR, EXACT, hit_rates
from vasc.validation.canalization.progress import Counted
from vasc.validation.canalization.rates import agreeing_rates, same_rate, wilson
from vasc.validation.canalization.scenarios import TISSUES
from vasc.validation.canalization.sequential import sequential
from vasc.validation.canalization.settled import settle
from vasc.validation.canalization.simultaneous import simultaneous
from vasc.validation.canalization.two_veins import (
    BACKGROUNDS,
    CASES,
    COLUMNS,
    FIGURE_PROTOCOLS,
    FIGURE_VEINS,
    ROWS,
    SCANNED,
    background_scan,
    figure_rows,
    settled_case,
)
from vasc.validation.canalization_references import (
    CLAIM,
    CLOSED_RULE,
    CRITICAL_GAINS,
    FIGURE,
    HIT_RATES,
    MEASURED,
    WIDTH_DIFFUSE,
    WIDTH_FORMED,
    HitRate,
)

CLEAR_LEAST = 0.99
"""Share of clear scenarios whose canal reaches the nearest vein at least; on squares 0.991 (566 of
571) to 0.998 (883 of 885) were measured, on hexagons and Voronoi cells all."""
FULL = 200
"""Scenarios a row of the full suite."""
DEFAULT = 20
"""Scenarios a row of the suite that does not take long."""
FIRST_SEED = 1000
"""Seeds of the scenarios are this one and those that follow."""
LEAST_P = 0.005
"""Two rates agree unless Fisher's exact test gives less: one in ten suites of twenty rates
fails by chance."""
TOLERANCES = (0.05, 0.3, 1.0)
"""Over which no canal may change its vein."""
LATTICES = ("rectangular", "hexagonal")
"""Tissues in which the canals of facilitated diffusion are shortest ways over cells."""
STRAIGHT = 1.0 + 1e-9
"""Length of a canal over the shortest way over cells, but for rounding."""

Progress = Callable[[str], None]
Check = dict[str, Any]


def validate_canalization(
    progress: Progress = lambda name: None, n: int = DEFAULT
) -> dict[str, Any]:
    """Hold canals against the rules of geometry, and against rates measured before.

    Parameters
    ----------
    progress : callable
        Told what is run next.
    n : int
        Scenarios a rate; the other experiments follow suit.

    Returns
    -------
    dict
        A suite: ``name`` and ``checks``, each with ``name``, ``value``, ``low``, ``high``,
        ``source`` and ``pass``; and ``tables``: ``figure``, the cases of Figure 4.9, and those
        of the experiments, ``hit_rates``, ``sequential``, ``areoles``, ``simultaneous`` and
        ``two_veins``.
    """
    told = Counted(progress, n_parts(n))
    seeds = range(FIRST_SEED, FIRST_SEED + n)
    figure = figure_rows(told)
    checks = [*_of_figure(figure), *_of_threshold(told), *_of_scheme(told)]
    rows = hit_rates(rate_cases(n), seeds, progress=told)
    tables = {
        "figure": figure,
        "hit_rates": [row | against_reference(row) for row in rows],
        "sequential": sequential(range(1, 1 + n_leaves(n)), progress=told),
        "areoles": areoles(range(1, 1 + max(4, n // 5)), progress=told),
        "simultaneous": simultaneous(range(1, 1 + n_sets(n)), progress=told),
        "two_veins": background_scan(range(1, 1 + max(3, n // 4)), progress=told),
    }
    checks += [*_of_rates(rows), *_of_trees(tables)]
    return {"name": "canalization", "n": n, "checks": checks, "tables": tables}


def rate_cases(n: int) -> list[tuple[str, str, str]]:
    """Give tissue, scenario and protocol of each rate; without background in full suites only."""
    return [
        (one.tissue, one.scenario, one.protocol)
        for one in HIT_RATES
        if one.protocol != "pool" or n >= FULL
    ]


def n_leaves(n: int) -> int:
    """Give the number of leaves whose canals form one by one."""
    return max(1, n // 20)


def n_sets(n: int) -> int:
    """Give the number of sets of sources that appear at once."""
    return min(8, max(2, n // 10))


def n_parts(n: int) -> int:
    """Give the number of parts that the suite tells of: three are of threshold and scheme."""
    figure = len(TISSUES) * len(FIGURE_PROTOCOLS)
    scans = len(TISSUES) * len(SCANNED) * len(BACKGROUNDS)
    places = 2 * len(AREOLE_PROTOCOLS)
    return figure + 3 + len(rate_cases(n)) + n_leaves(n) + places + n_sets(n) + scans


def against_reference(row: dict[str, Any]) -> dict[str, Any]:
    """Hold a rate against the reference measurement: its 95 % interval, and the p-value.

    Both are samples, so that the same true rate leaves the interval of the reference more
    often than in one of twenty cases; Fisher's exact test allows for that.
    """
    known = _reference(row)
    low, high = wilson(known.hits, known.n)
    return {
        "reference_hits": known.hits,
        "reference_n": known.n,
        "reference_low": low,
        "reference_high": high,
        "p": same_rate(row["hits"], row["n"], known.hits, known.n),
    }


def _reference(row: dict[str, Any]) -> HitRate:
    """Give the reference measurement of a rate."""
    key = (row["tissue"], row["scenario"], row["protocol"])
    return next(one for one in HIT_RATES if (one.tissue, one.scenario, one.protocol) == key)


def check(name: str, value: float, low: float, high: float, source: str) -> Check:
    """Give one check: a value, and between what it has to be."""
    passed = bool(low <= value <= high)
    return {
        "name": name,
        "value": value,
        "low": low,
        "high": high,
        "source": source,
        "pass": passed,
    }


def _of_figure(rows: list[dict[str, Any]]) -> Iterator[Check]:
    """Check that canals reach the nearer of two veins, with most of the auxin.

    A long vein draws polar canals past a nearer point: the table has these, no check asks.
    """
    for row in rows:
        if row["is_asked"]:
            share = row["share"] if row["formed"] and row["is_hit"] else 0.0
            name = f"{row['tissue']}, {row['protocol']}, {row['case']}: share of the nearer vein"
            yield check(name, share, 0.5, 1.0, FIGURE if row["is_figure"] else CLAIM)


def _of_threshold(progress: Progress) -> Iterator[Check]:
    """Check the gain from which on canals form, and how wide they are then."""
    progress("critical gain")
    tissue = rectangular(25, 25)
    source, vein = tissue.nearest_cells([(12.0, 7.0), (12.0, 17.0)])
    bounds = ((0.8 * WIDTH_DIFFUSE, 1.2 * WIDTH_DIFFUSE), (1.0, 1.1 * WIDTH_FORMED))
    for gain, is_formed, (low, high) in zip(CRITICAL_GAINS, (0, 1), bounds, strict=True):
        transport = FacilitatedDiffusion(gain=gain)
        strand = settle(tissue, transport, [vein[None]], [source]).strand
        name = f"10 cells, A = {gain:g}"
        yield check(f"{name}: formed", int(strand.is_formed), is_formed, is_formed, MEASURED)
        yield check(f"{name}: width", strand.width, low, high, MEASURED)


def _of_scheme(progress: Progress) -> Iterator[Check]:
    """Check what does not depend on steps of time, and what cannot settle."""
    progress("tolerance")
    changed = 0
    for protocol in FIGURE_PROTOCOLS:
        for case in CASES:
            ends = {
                settled_case(case, "rectangular", protocol, tolerance=tolerance).strand.reached
                for tolerance in TOLERANCES
            }
            changed += len(ends) > 1
    span = f"{TOLERANCES[0]:g} to {TOLERANCES[-1]:g}"
    yield check(f"canals that tolerances from {span} change", changed, 0, 0, MEASURED)
    progress("polar transport without saturation")
    tissue = rectangular(COLUMNS, ROWS)
    veins = [tissue.nearest_cells(line) for line in FIGURE_VEINS]
    source = tissue.nearest_cells([(0.0, 4.0)])
    is_refused = 0
    try:
        settle(tissue, PolarTransport(gain=30.0, saturation="none"), veins, source)
    except RunError:
        is_refused = 1
    yield check("flux without bound, source (0, 4): refused", is_refused, 1, 1, MEASURED)


def _of_rates(rows: list[dict[str, Any]]) -> Iterator[Check]:
    """Check rates of hits against those measured before, and what is exact."""
    for row in rows:
        known = _reference(row)
        low, high = agreeing_rates(row["n"], known.hits, known.n, LEAST_P)
        case = f"{row['tissue']} {row['scenario']}, {row['protocol']}"
        name = f"{case}: canals that reach the nearest vein"
        yield check(name, row["hit_rate"], low, high, MEASURED)
    exact = [row for row in rows if row["protocol"] == "facilitated"]
    for tissue in TISSUES:
        found = [row for row in exact if row["tissue"] == tissue]
        # ways over square cells are longer along diagonals, so that some clear ones are missed
        limits = {"clear": (CLEAR, CLEAR_LEAST), "exact": (EXACT[tissue], 1.0)}
        for kind, (limit, least) in limits.items():
            if kind == "clear" and EXACT[tissue] >= limit:
                continue
            hits, n = (sum(row[f"hit_{kind}{end}"] for row in found) for end in ("s", "_n"))
            name = f"{tissue}, facilitated: the same where d/d2 < {limit:.3g} (n = {n})"
            if kind == "clear":
                # in few, a single miss is no evidence
                least = min(least, 1.0 - 1.0 / max(n, 1))
            yield check(name, hits / max(n, 1), least, 1.0, CLAIM)
    for tissue in LATTICES:
        found = [row for row in exact if row["tissue"] == tissue]
        by_cells = min(row["hit_by_cells_rate"] for row in found)
        # of ways that differ by a cell or two, more equally short ones may win: 1 of 100
        yield check(f"{tissue}, facilitated: nearest over cells", by_cells, 0.97, 1.0, MEASURED)
        detour = max(row["detour_max"] for row in found)
        name = f"{tissue}, facilitated: canal over the shortest way, at most"
        yield check(name, detour, 1.0 - 1e-9, STRAIGHT, MEASURED)
    strands = max(row["strands_mean"] for row in exact)
    yield check("facilitated: strands of one source, at most", strands, 1.0, 1.05, MEASURED)


def _of_trees(tables: dict[str, list[dict[str, Any]]]) -> Iterator[Check]:
    """Check the experiments with areoles and many sources."""
    for row in tables["areoles"]:
        if row["protocol"] == "facilitated S=1" and row["source"] == "central":
            share = row["strands_mean"] / row["predicted_mean"]
            name = "areoles, facilitated S=1: strands over those of the closed rule"
            # 1.15 over 2.23 was measured: the closed rule asks for more strands than form
            yield check(name, share, 0.3, 0.8, f"{MEASURED}; {CLOSED_RULE}")
    one_by_one = tables["sequential"][0]
    # 1.03 was measured by another program
    yield check(
        "one by one: distance of the end over that of the nearest node, median",
        one_by_one["excess_median"],
        1.0,
        1.1,
        MEASURED,
    )
    canals, colonies, _ = tables["simultaneous"]
    yield check("at once: cycles", max(canals["cycles"]), 0, 0, MEASURED)
    # 1.46 was measured by another program, about 1.6 by this one: canals merge late
    ratio = canals["length_mean"] / colonies["length_mean"]
    yield check("at once: length over that of space colonization", ratio, 1.2, 1.8, MEASURED)
