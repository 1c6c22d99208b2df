"""Where the connectivity of stems changes with the ratio of radius to rise, grown and predicted."""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from math import radians
from typing import Any

from vasc.validation.stem_phyllotaxis import intervals, predict
from vasc.validation.stem_phyllotaxis.lattice import PrimordiumLattice
from vasc.validation.stem_references import LEAST_FRACTION
from vasc.validation.stem_suite import BEYOND, grown

RISE = 10.0
"""Of all stems of the sweep: levels are ten segments apart."""

PLASTOCHRONS = ((15.0, 5), (float("inf"), 10))
"""Up to a ratio, the steps between levels: half the rise, so that the apex rises as two tips
meet; on thick stems, where (7, 11) asks for more time, the whole rise."""

ANGLES = (137.5, 99.5)
"""Golden and Lucas divergence, in degrees."""

CLEAN: dict[float, tuple[tuple[float, float], ...]] = {
    137.5: ((1.1, 1.3), (1.9, 3.0), (4.7, 7.0), (11.5, 18.0)),
    99.5: ((1.1, 1.3), (2.0, 2.5), (3.0, 5.0), (8.0, 13.0), (17.5, 20.0)),
}
"""Ratios, low to high, within which stems connect as predicted: ours, measured. Outside, near the
boundaries of the lattice, a new primordium meets the middle of a vein and not its end."""

PER_RANGE = 3
"""Stems of the sweep in each of these ranges."""


@dataclass(frozen=True)
class SweptStem:
    """One stem of the sweep.

    Parameters
    ----------
    divergence : float
        In degrees.
    ratio : float
        Radius over rise.
    pair, predicted : tuple of int
        What its veins connect, and what the lattice of its primordia predicts.
    fraction : float
        Share of the primordia with exactly the pair.
    """

    divergence: float
    ratio: float
    pair: tuple[int, ...]
    predicted: tuple[int, ...]
    fraction: float


def clean_ratios(divergence: float) -> list[float]:
    """Give the ratios at which the stems of a divergence are grown."""
    ratios = []
    for low, high in CLEAN[divergence]:
        step = (high - low) / (PER_RANGE - 1)
        ratios += [low + step * k for k in range(PER_RANGE)]
    return ratios


def swept_stem(divergence: float, ratio: float) -> SweptStem:
    """Grow one stem and check what its veins connect."""
    radius = ratio * RISE
    lattice = PrimordiumLattice(radians(divergence), RISE, radius)
    largest = predict(lattice).steps[-1]
    report = grown(
        {
            "kind": "stem",
            "domain": {"radius": radius},
            "placement": {
                "divergence": divergence,
                "rise": RISE,
                "primordia": 3 * largest + BEYOND,
                "plastochron": next(steps for limit, steps in PLASTOCHRONS if ratio <= limit),
            },
        }
    )
    return SweptStem(divergence, ratio, report.pair, report.prediction.pair, report.fraction)


def sweep(progress: Callable[[str], None] = lambda name: None) -> list[SweptStem]:
    """Grow stems of both angles over the ratio of radius to rise.

    Parameters
    ----------
    progress : callable
        Told the name of each stem before it grows.
    """
    stems = []
    for divergence in ANGLES:
        for ratio in clean_ratios(divergence):
            progress(f"{divergence:g} degrees, R/H = {ratio:.3g}")
            stems.append(swept_stem(divergence, ratio))
    return stems


def thresholds(divergence: float, low: float = 1.0, high: float = 25.0) -> list[dict[str, Any]]:
    """Give the intervals of R/H with one predicted pair, from low to high."""
    return [
        {"low": one.low, "high": one.high, "pair": list(one.pair)}
        for one in intervals(radians(divergence), low=low, high=high)
    ]


def validate_transitions(progress: Callable[[str], None] = lambda name: None) -> dict[str, Any]:
    """Grow stems over the ratio of radius to rise, and hold them against the predictor.

    Parameters
    ----------
    progress : callable
        Told the name of each stem before it grows.

    Returns
    -------
    dict
        A suite, as of :func:`vasc.validation.stem_suite.validate_stem`, with the ``stems`` as
        tables and the ``thresholds`` of each divergence, for a picture.
    """
    stems = sweep(progress)
    checks = [
        {
            "name": f"{stem.divergence:g} degrees, R/H = {stem.ratio:.3g}",
            "value": stem.fraction,
            "low": LEAST_FRACTION,
            "high": 1.0,
            "source": "lattice of primordia in chord distance",
            "pass": stem.pair == stem.predicted and stem.fraction >= LEAST_FRACTION,
            "pair": list(stem.pair),
            "expected": list(stem.predicted),
            "tie": None,
        }
        for stem in stems
    ]
    return {
        "name": "transitions",
        "checks": checks,
        "stems": [asdict(stem) for stem in stems],
        "thresholds": {divergence: thresholds(divergence) for divergence in ANGLES},
    }
