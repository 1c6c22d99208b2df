"""The checks of a leaf, each a number in a range."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from vasc.analysis.junctions import balanced_angles
from vasc.arrays import Floats
from vasc.validation.leaf_references import (
    DALBERGIA_ANGLES,
    DALBERGIA_NUMBERS,
    FEWEST,
    LAST_DIGIT,
    LEAF_RANGES,
    NEARLY_AS_WIDE,
    REPORTED,
    SAME,
    LeafRange,
)
from vasc.validation.vein_statistics.densities import Densities
from vasc.validation.vein_statistics.samples import LeafSample

Table = dict[str, Any]


@dataclass(frozen=True)
class LeafCheck:
    """A number of a leaf against what is asked of it.

    Parameters
    ----------
    leaf : str
        The leaf.
    asked : LeafRange
        What is asked.
    value : float
        The number; nan where the leaf has none, and the check is open.
    """

    leaf: str
    asked: LeafRange
    value: float

    @property
    def passed(self) -> bool | None:
        """Whether the number is in the range, ends included; None where there is none."""
        if math.isnan(self.value):
            return None
        return bool(self.asked.low <= self.value <= self.asked.high)

    def as_json(self) -> Table:
        """Give plain values; what is no finite number is None."""
        asked = self.asked
        return {
            "name": f"{asked.number} {asked.words}, {self.leaf}",
            "value": _finite(self.value),
            "low": _finite(asked.low),
            "high": _finite(asked.high),
            "source": f"{'; '.join(asked.sources)} ({asked.seen})",
            "basis": asked.basis,
            "pass": self.passed,
            "check": asked.number,
            "what": asked.words,
            "leaf": self.leaf,
        }


@dataclass(frozen=True)
class AngleClass:
    """Junctions with about the same ratio of the thinnest to the widest vein.

    Parameters
    ----------
    low, high : float
        Limits of the ratio.
    n_junctions : int
        How many there are.
    quartiles : tuple of float
        Angle of the two widest veins at 25, 50 and 75 percent, in degrees; nan if none.
    law : float
        Median angle in balance, in degrees.
    """

    low: float
    high: float
    n_junctions: int
    quartiles: tuple[float, float, float]
    law: float

    @property
    def off(self) -> float:
        """How far the median is from the law, in degrees; nan for too few junctions."""
        return abs(self.quartiles[1] - self.law) if self.n_junctions >= FEWEST else math.nan


def angle_classes(sample: LeafSample) -> list[AngleClass]:
    """Sort the junctions by the ratio of the thinnest to the widest vein (Bohn 2002)."""
    widths = sample.junctions.widths
    ratios = widths[:, 2] / widths[:, 0]
    angles = np.degrees(sample.junctions.widest_angles)
    law = np.degrees(balanced_angles(widths))
    found = []
    for low, high, *_ in DALBERGIA_ANGLES:
        # three equal veins are in the last class
        is_below = (ratios < high) | (high == 1.0)
        rows = (ratios >= low) & is_below & (widths[:, 1] > NEARLY_AS_WIDE * widths[:, 0])
        if not rows.any():
            found.append(AngleClass(low, high, 0, (math.nan,) * 3, math.nan))
            continue
        q25, q50, q75 = np.percentile(angles[rows], [25, 50, 75]).tolist()
        found.append(
            AngleClass(low, high, int(rows.sum()), (q25, q50, q75), float(np.median(law[rows])))
        )
    return found


def check_leaf(sample: LeafSample) -> list[LeafCheck]:
    """Hold a leaf with areoles against the checks 6 to 13, 12 and 13 only if it has widths.

    Parameters
    ----------
    sample : LeafSample
        Closed or real.

    Returns
    -------
    list of LeafCheck
        By number of the check.
    """
    numbers = sample.numbers
    degrees = {int(key): share for key, share in numbers["junction_degree"].items()}
    values: dict[str, float | None] = {
        "degree_three": degrees.get(3, 0.0),
        "degree_most": max(degrees, default=0),
        "corners_mean": numbers["areole_corners_mean"],
        "corners_variance": numbers["areole_corners_variance"],
        "elongation": numbers["areole_elongation_median"],
        "circularity": numbers["areole_circularity_median"],
        "area_cv": numbers["areole_area_cv"],
        # of the enclosed veins: a real network may have none at the margin
        "density_x_sqrt_areole": numbers["enclosed_density_x_sqrt_areole"],
        "density_x_distance": _product(
            numbers["enclosed_vein_density"], numbers["distance_to_vein_mean"]
        ),
    }
    if sample.has_event is not None:
        key = "ends_with_event" if sample.has_event else "ends_without_event"
        values[key] = sample.n_enclosed_ends
    values["mst_closed"] = numbers["mst_ratio"]
    if sample.leaf.widths is not None:
        values |= _of_widths(sample)
    return [
        LeafCheck(sample.name, LEAF_RANGES[key], math.nan if value is None else value)
        for key, value in values.items()
    ]


def _of_widths(sample: LeafSample) -> dict[str, float | None]:
    """Give the numbers of the checks 12 and 13, which need widths."""
    numbers = sample.numbers
    off = [one.off for one in angle_classes(sample)]
    return {
        "force_residual": _ratio(
            numbers["bohn_residual_median"], numbers["bohn_residual_shuffled"]
        ),
        "angle_off": max((value for value in off if not math.isnan(value)), default=math.nan),
        "hierarchy": _less(numbers["loop_asymmetry"], numbers["loop_asymmetry_shuffled"]),
    }


def check_open(sample: LeafSample, exponents: Floats, asked: float) -> list[LeafCheck]:
    """Hold open venation, and the exponents at its branchings, against the checks 11 and 14."""
    off = float(np.abs(exponents - asked).max()) if len(exponents) else math.nan
    values = {"mst_open": round(sample.numbers["mst_ratio"], 12), "murray": off}
    return [LeafCheck(sample.name, LEAF_RANGES[key], value) for key, value in values.items()]


def check_growing(name: str, densities: Densities) -> list[LeafCheck]:
    """Hold a growing leaf against check 15."""
    values = {"minor_change": densities.minor_change, "major_exponent": densities.major_exponent}
    return [LeafCheck(name, LEAF_RANGES[key], value) for key, value in values.items()]


def check_numbers(sample: LeafSample) -> list[LeafCheck]:
    """Hold our numbers of the real leaf against those of another program: check 17."""
    checks = []
    for key, expected in DALBERGIA_NUMBERS.items():
        margin = max(SAME * expected, LAST_DIGIT)
        asked = LeafRange(
            key,
            17,
            key.replace("_", " "),
            expected - margin,
            expected + margin,
            ("Ronellenfitsch 2015",),
            f"{expected:g} by another program",
        )
        checks.append(LeafCheck(sample.name, asked, float(sample.numbers[key])))
    return checks


def reported(sample: LeafSample) -> list[Table]:
    """Give the numbers that decide nothing, beside those of the literature."""
    return [
        {
            "name": f"{one.words}, {sample.name}",
            "value": sample.numbers[one.key],
            "seen": one.seen,
            "source": "; ".join(one.sources) or None,
        }
        for one in REPORTED
    ]


def as_table(checks: list[LeafCheck]) -> list[Table]:
    """Give checks as plain values, by number, in the order of their leaves."""
    rows = sorted(checks, key=lambda check: check.asked.number)
    return [check.as_json() for check in rows]


def _ratio(value: float | None, other: float | None) -> float:
    """Give value / other; nan if one is missing."""
    return value / other if value is not None and other else math.nan


def _product(value: float | None, other: float | None) -> float:
    """Give value * other; nan if one is missing."""
    return value * other if value is not None and other is not None else math.nan


def _less(value: float | None, other: float | None) -> float:
    """Give other - value; nan if one is missing."""
    return other - value if value is not None and other is not None else math.nan


def _finite(value: float) -> float | None:
    """Give a value that JSON has."""
    return value if math.isfinite(value) else None
