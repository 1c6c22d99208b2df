"""The numbers that describe a venation pattern, as one dictionary."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from vasc.analysis.density import vein_length
from vasc.analysis.measures import Measured, measure
from vasc.analysis.moment import Moment, blade_of
from vasc.analysis.sections import find_sections
from vasc.analysis.topology import count_components, count_cycles, free_ends, junction_degree
from vasc.analysis.units import LengthUnit
from vasc.analysis.widths import segment_radii
from vasc.arrays import Floats
from vasc.network import VeinNetwork
from vasc.real_network import RealNetwork

Numbers = dict[str, Any]


def statistics(
    moment: Moment,
    units: Mapping[str, Any] | None = None,
    *,
    widths: Floats | None = None,
    seed: int = 0,
) -> Numbers:
    """Measure a venation pattern.

    Parameters
    ----------
    moment : Frame or State
        One step of a run.
    units : mapping, optional
        The run's ``[units]`` table; lengths, areas and densities are then in
        its unit of length instead of D.
    widths : ndarray of shape (m,), float64, optional
        Widths of the segments, in D; by Murray's law if left out.
    seed : int
        Of the shuffled controls.

    Returns
    -------
    dict
        Plain numbers, ready for JSON; docs/statistics.md says what each key is.
        What cannot be said of a pattern, as areas of areoles without any, is None, and
        of a stem all that needs a drawing in the plane.
    """
    unit = LengthUnit.from_table(units)
    network = moment.network
    when = {"step": int(moment.step), "time": float(moment.time), "length_unit": unit.name}
    if network.positions.shape[1] == 3:
        return when | _in_unit(_of_stem(network), unit.per_segment)
    blade = blade_of(moment)
    widths = 2.0 * segment_radii(network) if widths is None else widths
    measured = measure(find_sections(network, widths), blade.polygon, seed=seed)
    blade_size = {"blade_length": float(blade.length), "blade_area": float(blade.area)}
    numbers = _numbers(network, measured, float(blade.area), blade_size)
    return when | _in_unit(numbers, unit.per_segment)


def network_statistics(real: RealNetwork, *, seed: int = 0) -> Numbers:
    """Measure a real vein network, by the same code and under the same keys.

    Parameters
    ----------
    real : RealNetwork
        The veins; without measured widths all that needs them is None.
    seed : int
        Of the shuffled controls.

    Returns
    -------
    dict
        As :func:`statistics` gives. There is neither step nor blade, unless the file was
        exported from a run; without a blade, densities refer to the area that veins enclose.
    """
    run = real.run
    blade = None if run is None else run.blade
    sections = find_sections(real.network, real.widths, real.lengths)
    measured = measure(sections, blade, has_widths=real.widths is not None, seed=seed)
    area = measured.enclosed_area if blade is None else float(blade.area)
    size = {
        "blade_length": None if run is None else run.blade_length,
        "blade_area": None if blade is None else area,
    }
    when = {
        "step": None if run is None else run.step,
        "time": None if run is None else run.time,
        "length_unit": real.unit or None,
    }
    return when | _in_unit(_numbers(real.network, measured, area, size), 1.0)


def _numbers(network: VeinNetwork, measured: Measured, area: float, blade: Numbers) -> Numbers:
    """Give all numbers of a pattern on a blade of some area, in the unit of the network."""
    components = count_components(network)
    ends, areoles = len(free_ends(network)), measured.areoles
    length = float(measured.sections.segment_lengths.sum())
    density = length / area if area > 0.0 else math.nan
    degrees = junction_degree(network)
    return {
        **blade,
        "nodes": network.n_vein_nodes,
        "segments": network.n_segments,
        "components": components,
        "cycles": count_cycles(network, components=components),
        "vein_length": length,
        "vein_density": density,
        **measured.areole_numbers(),
        "enclosed_area": measured.enclosed_area,
        "enclosed_vein_density": measured.enclosed_density,
        "free_ends": ends,
        "free_ends_per_areole": ends / areoles.n_areoles if areoles.n_areoles else math.nan,
        "junction_degree": {str(degree): share for degree, share in degrees.items()},
        **measured.section_numbers(),
        "density_x_sqrt_areole": density * math.sqrt(areoles.mean_area),
        "enclosed_density_x_sqrt_areole": measured.enclosed_density * math.sqrt(areoles.mean_area),
        **measured.distance_numbers(density),
        **measured.width_numbers(),
    }


def _of_stem(network: VeinNetwork) -> Numbers:
    """Give the numbers of veins in space under the same keys, in the same order."""
    nothing = RealNetwork.from_edges(np.zeros((0, 2)), np.zeros((0, 2), dtype=np.int32)).network
    blade = {"blade_length": None, "blade_area": None}
    keys = _numbers(nothing, measure(find_sections(nothing), None), 0.0, blade)
    components = count_components(network)
    degrees = junction_degree(network)
    return dict.fromkeys(keys) | {
        "nodes": network.n_vein_nodes,
        "segments": network.n_segments,
        "components": components,
        "cycles": count_cycles(network, components=components),
        "vein_length": vein_length(network),
        "free_ends": len(free_ends(network)),
        "junction_degree": {str(degree): share for degree, share in degrees.items()},
    }


POWERS = {
    "blade_length": 1,
    "blade_area": 2,
    "enclosed_area": 2,
    "vein_length": 1,
    "vein_density": -1,
    "enclosed_vein_density": -1,
    "areole_area_mean": 2,
    "section_length_mean": 1,
    "distance_to_vein_mean": 1,
    "distance_to_vein_median": 1,
    "distance_to_vein_p95": 1,
    "width_mean": 1,
    "length": 1,
    "length_mean": 1,
}
"""Power of a length that a number is; all others have no unit."""

ON_TISSUE = {
    "vein_density",
    "density_x_sqrt_areole",
    "distance_to_vein_mean",
    "distance_to_vein_median",
    "distance_to_vein_p95",
    "density_x_distance",
}
"""Numbers that refer to the whole blade where there is one, and else to the enclosed area."""


SAMPLES = {
    "areole_area_mean": "areoles",
    "areole_area_cv": "areoles",
    "areole_circularity_median": "areoles",
    "areole_elongation_median": "areoles",
    "areole_corners_mean": "areoles",
    "areole_corners_variance": "areoles",
    "free_ends_per_areole": "areoles",
    "section_length_mean": "sections",
    "section_length_cv": "sections",
    "bohn_residual_median": "bohn_junctions",
    "bohn_residual_shuffled": "bohn_junctions",
    "bohn_angle_error_median": "bohn_junctions",
    "murray_exponent_median": "murray_junctions",
    "loop_asymmetry": "areoles",
    "loop_asymmetry_shuffled": "areoles",
    "loop_asymmetry_weighted": "areoles",
    "loop_asymmetry_weighted_shuffled": "areoles",
    "width_mean": "segments",
}
"""By a mean or median, the key beside it of how many things it is taken over."""


def unit_of(key: str, unit: str) -> str:
    """Give the unit of a number, where lengths are in a unit; nothing for one without.

    Examples
    --------
    >>> unit_of("blade_area", "mm"), unit_of("vein_density", "mm"), unit_of("nodes", "mm")
    ('mm^2', '1/mm', '')
    """
    power = POWERS.get(key, 0)
    if power == 0 or not unit:
        return ""
    return {1: unit, 2: f"{unit}^2", -1: f"1/{unit}"}[power]


def flattened(numbers: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Give names and values, those of a dictionary within as ``name.key``.

    Examples
    --------
    >>> dict(flattened({"nodes": 5, "junction_degree": {"3": 1.0}}))
    {'nodes': 5, 'junction_degree.3': 1.0}
    """
    for key, value in numbers.items():
        if isinstance(value, Mapping):
            yield from flattened(value, f"{before}{key}.")
        else:
            yield before + key, value


def _in_unit(numbers: Numbers, scale: float) -> Numbers:
    """Give lengths in a unit of which one D is so many; None for what is no number."""
    found: Numbers = {}
    for key, value in numbers.items():
        if isinstance(value, dict):
            found[key] = _in_unit(value, scale)
        elif isinstance(value, float):
            scaled = value * scale ** POWERS.get(key, 0)
            found[key] = scaled if math.isfinite(scaled) else None
        else:
            found[key] = value
    return found
