"""Leaves to be judged: networks, simulated or real, and what is measured of them."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from vasc.analysis import find_sections, network_statistics, run_widths
from vasc.analysis.junctions import Junctions, find_junctions
from vasc.analysis.measures import Measured, measure
from vasc.analysis.run_widths import widths_of
from vasc.analysis.topology import free_ends
from vasc.analysis.vein_distance import distances_to_vein, places_in
from vasc.arrays import Floats
from vasc.config.bundled import find_config
from vasc.errors import VascError
from vasc.networks_in import read_network
from vasc.real_network import RealNetwork
from vasc.timeline import Timeline

NEVER = "never"
"""The kind of mesophyll event that does not happen."""
_PACKAGE = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class LeafSample:
    """A leaf and what is measured of it.

    Parameters
    ----------
    name : str
        What it is called in the report.
    kind : str
        The model that made it; "real" for the control that comes with vasc, "given" for a
        real network of the user.
    leaf : RealNetwork
        Its veins. Those of a run are measured just as those of a real leaf: densities
        refer to the area that veins enclose.
    has_event : bool, optional
        Whether mesophyll ended the extension of veins; None where that means nothing.
    """

    name: str
    kind: str
    leaf: RealNetwork
    has_event: bool | None = None

    @cached_property
    def numbers(self) -> dict[str, Any]:
        """The statistics of the veins."""
        return network_statistics(self.leaf)

    @cached_property
    def measured(self) -> Measured:
        """What they are computed from: sections and areoles."""
        return measure(find_sections(self.leaf.network, self.leaf.widths, self.leaf.lengths), None)

    @cached_property
    def junctions(self) -> Junctions:
        """Junctions of three veins that are long enough to have a direction."""
        sections = self.measured.sections
        return find_junctions(sections).long(sections.reach)

    @cached_property
    def distances(self) -> Floats:
        """Distance to the nearest vein from places in the areoles, times the density there."""
        sections = self.measured.sections
        places = places_in(self.measured.region, 20_000)
        return distances_to_vein(sections, places) * self.measured.enclosed_density

    @cached_property
    def n_enclosed_ends(self) -> int:
        """Veins that end inside an areole: the tip of a midvein at the margin is none."""
        import shapely

        network = self.leaf.network
        places = network.positions[free_ends(network)]
        return int(shapely.contains_xy(self.measured.region, places).sum())


def sample_of_run(name: str, kind: str, path: Path) -> LeafSample:
    """Give the last step of a recorded run as a leaf.

    Parameters
    ----------
    name : str
        What to call it.
    kind : str
        The model.
    path : Path
        The timeline.

    Returns
    -------
    LeafSample
        Lengths in D.
    """
    with Timeline(path) as timeline:
        frame = timeline.frame()
        asked = widths_of(timeline.config)
        network = frame.network
        found = run_widths(timeline.frame, frame.step, asked)
        event = (timeline.config.get("mesophyll") or {}).get("kind", NEVER)
    has_event = event != NEVER if kind == "areole" else None
    return LeafSample(name, kind, RealNetwork(network, found, network.lengths, "D"), has_event)


def dalbergia_folder() -> Path:
    """Give the folder of the leaflet, of the package or of a source checkout.

    Raises
    ------
    VascError
        If it is in neither.
    """
    checkout = find_config("reticulate-leaf").parents[1] / "tests" / "data" / "dalbergia"
    for folder in (_PACKAGE / "_dalbergia", checkout):
        if folder.is_dir():
            return folder
    raise VascError("the leaflet of Dalbergia did not come with this copy of vasc")


def dalbergia() -> LeafSample:
    """Give the leaflet of Dalbergia miscolobium, a real leaf."""
    return LeafSample("Dalbergia", "real", read_network(dalbergia_folder() / "dalbergia.csv"))


def histogram(values: Floats, edges: Floats) -> list[float]:
    """Give the share of values in each class; those beyond the last edge are in none."""
    return (np.histogram(values, edges)[0] / max(len(values), 1)).tolist()
