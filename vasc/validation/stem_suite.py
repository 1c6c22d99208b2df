"""The stems of the thesis, grown and held against what their captions say."""

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from vasc.config import load_text
from vasc.experiment import run
from vasc.timeline import Timeline
from vasc.validation.references import OURS
from vasc.validation.stem_phyllotaxis import ConnectivityReport, check_connectivity
from vasc.validation.stem_phyllotaxis.reading import read_stem
from vasc.validation.stem_references import LEAST_FRACTION, STEM_PATTERNS, StemPattern

MIDDLE = StemPattern(137.5, 28.0, 10.0, (2, 3), 5, "", basis=OURS)
"""(2, 3) in the middle of its interval of R/H, where no boundary is near."""

BEYOND = 26
"""Primordia beyond three times the larger number of a pair: the first and the last do not count."""


def config_of(pattern: StemPattern) -> dict[str, Any]:
    """Give the tables of an experiment on a stem."""
    return {
        "kind": "stem",
        "seed": 1,
        "domain": {"radius": pattern.radius},
        "placement": {
            "kind": "phyllotaxis",
            "divergence": pattern.divergence,
            "rise": pattern.rise,
            "primordia": 3 * pattern.pair[1] + BEYOND,
            "plastochron": pattern.plastochron,
        },
    }


def grown(tables: dict[str, Any], least_fraction: float = LEAST_FRACTION) -> ConnectivityReport:
    """Grow a stem, record it, and check what its veins connect.

    Parameters
    ----------
    tables : dict
        The experiment, as in a config.
    least_fraction : float
        Share of the judged primordia that must have exactly the pair.
    """
    import tomli_w

    with TemporaryDirectory() as folder:
        output = Path(folder) / "stem.h5"
        run(load_text(tomli_w.dumps(tables)), output)
        with Timeline(output) as timeline:
            return check_connectivity(read_stem(timeline), least_fraction)


def validate_stem(progress: Callable[[str], None] = lambda name: None) -> dict[str, Any]:
    """Grow the thirteen stems of the thesis and one more, and check their connectivity.

    Parameters
    ----------
    progress : callable
        Told the name of each stem before it grows.

    Returns
    -------
    dict
        A suite: ``name`` and ``checks``, each with its ``name``, the ``value``, which is the share
        of primordia with exactly the pair, the least and greatest allowed (``low``,
        ``high``), the ``source``, whether it ``pass``es, the ``pair`` found and the one
        ``expected``, and in words how a tie turned out (``tie``, else None).
    """
    checks = []
    for pattern in (*STEM_PATTERNS, MIDDLE):
        name = (
            f"{pattern.divergence:g} degrees, R = {pattern.radius:g}, H = {pattern.rise:g}:"
            f" {pattern.pair[0]},{pattern.pair[1]}"
        )
        progress(name)
        report = grown(config_of(pattern), pattern.least_fraction)
        checks.append(
            {
                "name": name,
                "value": report.fraction,
                "low": pattern.least_fraction,
                "high": 1.0,
                "source": f"Runions (2008), Figure {pattern.figure}" if pattern.figure else "ours",
                "pass": report.pair == pattern.pair and report.passed,
                "pair": list(report.pair),
                "expected": list(pattern.pair),
                "tie": None if report.tie is None else report.tie.explanation,
            }
        )
    return {"name": "stem", "checks": checks}
