"""What a GraphML file tells besides its graph when it was exported from a recorded run."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from vasc.errors import NetworkError
from vasc.network import Origin
from vasc.networks_in.edges import shown
from vasc.real_network import ExportedRun, RealNetwork

if TYPE_CHECKING:
    from shapely import Geometry

MARKS = ("run", "step", "time", "length_unit")
"""Attributes of the graph, all of which an export has."""
ENDS = {"seed": Origin.SEED, "primordium": Origin.PRIMORDIUM}
"""Origins of nodes at which a vein goes on, so that they are no free ends."""
LONGEST_UNIT = 40


def as_exported(
    name: str, real: RealNetwork, told: Mapping[str, str], origins: Mapping[int, str]
) -> RealNetwork:
    """Add to a network what the export of a run tells of it.

    Parameters
    ----------
    name : str
        Name of the file.
    real : RealNetwork
        The network as any GraphML gives it.
    told : mapping of str to str
        Attributes of the graph.
    origins : mapping of int to str
        Attribute ``origin`` of the nodes that have one, by row.

    Returns
    -------
    RealNetwork
        The same if the file is no export of a run; else with its seeds, unit, step and blade.

    Raises
    ------
    NetworkError
        If one of these is not as an export has it.
    """
    if not all(mark in told for mark in MARKS):
        return real
    codes = real.network.origins.copy()
    for row, origin in origins.items():
        codes[row] = ENDS.get(origin, codes[row])
    unit = told["length_unit"]
    if not 0 < len(unit) <= LONGEST_UNIT or not unit.isprintable():
        raise NetworkError(f"{name}: length_unit is {shown(unit)}; it must be the name of a unit")
    has_length = "blade_length" in told
    run = ExportedRun(
        step=int(_number(name, told, "step")),
        time=_number(name, told, "time"),
        blade=_outline(name, told["outline"]) if "outline" in told else None,
        blade_length=_number(name, told, "blade_length") if has_length else None,
    )
    return replace(real, network=replace(real.network, origins=codes), unit=unit, run=run)


def _number(name: str, told: Mapping[str, str], key: str) -> float:
    """Give a finite number that the file tells."""
    try:
        number = float(told[key])
    except ValueError:
        number = np.nan
    if not np.isfinite(number):
        raise NetworkError(f"{name}: {key} is {shown(told[key])}; it must be a number")
    return number


def _outline(name: str, text: str) -> "Geometry":
    """Give the outline of the blade."""
    import shapely

    try:
        found = shapely.from_wkt(text)
    except shapely.GEOSException:
        found = None
    if not isinstance(found, shapely.Polygon | shapely.MultiPolygon) or not found.area > 0.0:
        raise NetworkError(f"{name}: outline is {shown(text)}; it must be a POLYGON with an area")
    return found
