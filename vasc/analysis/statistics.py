"""The numbers that describe a venation pattern, as one dictionary."""

import math
from collections.abc import Mapping
from typing import Any

from vasc.analysis.areoles import find_areoles
from vasc.analysis.density import vein_density, vein_length
from vasc.analysis.moment import Moment, blade_of
from vasc.analysis.topology import count_components, count_cycles, free_ends, junction_degree
from vasc.analysis.units import LengthUnit


def statistics(moment: Moment, units: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Measure a venation pattern.

    Parameters
    ----------
    moment : Frame or State
        One step of a run.
    units : mapping, optional
        The run's ``[units]`` table; lengths, areas and densities are then in
        its unit of length instead of D.

    Returns
    -------
    dict
        Plain numbers, ready for JSON: ``step, time, length_unit, blade_length,
        blade_area, nodes, segments, components, cycles, vein_length,
        vein_density`` (length per area), ``areoles, areole_area_mean,
        areole_area_cv`` (standard deviation over mean), ``free_ends,
        junction_degree`` (degree, as text, to its share of the junctions).
        What cannot be said of a pattern without areoles is None, and of a stem all
        that is said of blades and areoles.
    """
    unit = LengthUnit.from_table(units)
    scale = unit.per_segment
    network = moment.network
    components = count_components(network)
    is_in_space = network.positions.shape[1] == 3
    # all keys are there for any run, in one order
    return {
        "step": int(moment.step),
        "time": float(moment.time),
        "length_unit": unit.name,
        "blade_length": None,
        "blade_area": None,
        "nodes": network.n_vein_nodes,
        "segments": network.n_segments,
        "components": components,
        "cycles": count_cycles(network, components=components),
        "vein_length": vein_length(network) * scale,
        "vein_density": None,
        "areoles": None,
        "areole_area_mean": None,
        "areole_area_cv": None,
        "free_ends": len(free_ends(network)),
        "junction_degree": {
            str(degree): share for degree, share in junction_degree(network).items()
        },
    } | ({} if is_in_space else _of_blade(moment, scale))


def _of_blade(moment: Moment, scale: float) -> dict[str, Any]:
    """Measure what only a pattern in a blade has."""
    network, blade = moment.network, blade_of(moment)
    areoles = find_areoles(network)
    return {
        "blade_length": float(blade.length) * scale,
        "blade_area": float(blade.area) * scale**2,
        "vein_density": vein_density(network, float(blade.area)) / scale,
        "areoles": areoles.n_areoles,
        "areole_area_mean": _known(areoles.mean_area * scale**2),
        "areole_area_cv": _known(areoles.area_variation),
    }


def _known(value: float) -> float | None:
    """Give None for a number that is not one, since JSON has no nan."""
    return None if math.isnan(value) else value
