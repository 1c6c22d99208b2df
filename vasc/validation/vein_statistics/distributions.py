"""What pictures of the checks are drawn from: distributions and curves as plain numbers."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Floats
from vasc.validation.leaf_references import DALBERGIA_ANGLES, DALBERGIA_NUMBERS, SPECIES_PERCENTILES
from vasc.validation.vein_statistics.checks import angle_classes
from vasc.validation.vein_statistics.densities import Densities
from vasc.validation.vein_statistics.samples import LeafSample, histogram

Table = dict[str, Any]

_BINNED: dict[str, tuple[str, NDArray, Callable[[LeafSample], Floats]]] = {
    "area": (
        "area of an areole over the mean",
        np.linspace(0.0, 3.0, 25),
        lambda sample: sample.measured.areoles.areas / sample.measured.areoles.mean_area,
    ),
    "corners": (
        "corners of an areole",
        np.arange(0.5, 13.5),
        lambda sample: sample.measured.areoles.corners.astype(np.float64),
    ),
    "elongation": (
        "elongation of an areole",
        np.linspace(1.0, 3.0, 25),
        lambda sample: sample.measured.areoles.elongations,
    ),
    "circularity": (
        "circularity of an areole",
        np.linspace(0.4, 1.0, 25),
        lambda sample: sample.measured.areoles.circularities,
    ),
    "length": (
        "length between junctions over the mean",
        np.linspace(0.0, 3.0, 25),
        lambda sample: sample.measured.sections.lengths / sample.measured.sections.lengths.mean(),
    ),
    "distance": (
        "distance to the nearest vein x vein density",
        np.linspace(0.0, 1.4, 25),
        lambda sample: sample.distances,
    ),
}
"""By key: words, limits of the classes, and what is counted."""


def distributions(samples: list[LeafSample]) -> Table:
    """Give the share of areoles, veins or places in classes, for each leaf.

    Parameters
    ----------
    samples : list of LeafSample
        Leaves with areoles.

    Returns
    -------
    dict
        By key: ``label``, ``edges`` of the classes and ``shares`` by leaf; what lies beyond
        the last edge is in no class.
    """
    return {
        key: {
            "label": label,
            "edges": edges.tolist(),
            "shares": {sample.name: histogram(values(sample), edges) for sample in samples},
        }
        for key, (label, edges, values) in _BINNED.items()
    }


def curves(samples: list[LeafSample], densities: dict[str, Densities]) -> Table:
    """Give what else is drawn: degrees, angles, controls and densities, for each leaf."""
    return {
        "real": [sample.name for sample in samples if sample.kind == "real"],
        "degrees": {sample.name: sample.numbers["junction_degree"] for sample in samples},
        "angles": {sample.name: _angles(sample) for sample in samples},
        "angle_law": [
            {"ratio": (low + high) / 2.0, "law": law} for low, high, _, law in DALBERGIA_ANGLES
        ],
        "controls": {
            sample.name: {key: sample.numbers[key] for key in _CONTROLLED} for sample in samples
        },
        "ends": {sample.name: sample.numbers["free_ends_per_areole"] for sample in samples},
        "densities": {
            name: {
                "area": one.areas.tolist(),
                "major": one.major.tolist(),
                "minor": one.minor.tolist(),
            }
            for name, one in densities.items()
        },
        "species": {key: list(values) for key, values in SPECIES_PERCENTILES.items()},
        "other_program": DALBERGIA_NUMBERS,
    }


_CONTROLLED = (
    "bohn_residual_median",
    "bohn_residual_shuffled",
    "loop_asymmetry",
    "loop_asymmetry_shuffled",
)


def _angles(sample: LeafSample) -> list[Table]:
    """Give the classes of junctions that have enough of them; none without widths."""
    if sample.leaf.widths is None:
        return []
    return [
        {
            "ratio": (one.low + one.high) / 2.0,
            "junctions": one.n_junctions,
            "quartiles": list(one.quartiles),
            "law": one.law,
        }
        for one in angle_classes(sample)
        if one.off == one.off
    ]
