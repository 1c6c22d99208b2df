"""All measures of a network that is cut into sections, by what they are about."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.areoles import Areoles, areoles_of, looped_veins
from vasc.analysis.junctions import balanced_angles, find_junctions, murray_exponents
from vasc.analysis.loop_hierarchy import borders, loop_hierarchy, shuffled_hierarchies
from vasc.analysis.sections import Sections
from vasc.analysis.spanning_tree import mst_ratio
from vasc.analysis.strahler import stream_orders
from vasc.analysis.vein_distance import (
    box_dimension,
    distances_to_vein,
    enclosed_region,
    places_in,
)
from vasc.analysis.vein_orders import vein_orders

if TYPE_CHECKING:
    import shapely

Numbers = dict[str, Any]

ROUNDING = 1e-9
"""Share of the longer side of a network that a place on a rim may be off it."""


@dataclass(frozen=True)
class Measured:
    """A network and what is measured of it.

    Parameters
    ----------
    sections : Sections
        The veins.
    areoles : Areoles
        The pieces of blade that they enclose.
    between : ndarray of shape (b, 3), int64
        Sections with an areole on each side (see
        :func:`vasc.analysis.loop_hierarchy.borders`).
    blade : shapely.Geometry, optional
        The blade; without one tissue is what the veins enclose.
    has_widths : bool
        False if the widths are unknown, and all that needs them.
    seed : int
        Of the shuffled controls.
    """

    sections: Sections
    areoles: Areoles
    between: NDArray[np.int64]
    blade: "shapely.Geometry | None"
    has_widths: bool
    seed: int

    @cached_property
    def enclosed_area(self) -> float:
        """Area that veins enclose."""
        return float(self.areoles.areas.sum())

    @cached_property
    def region(self) -> "shapely.Geometry":
        """The region that veins enclose."""
        return enclosed_region(self.sections)

    @cached_property
    def enclosed_length(self) -> float:
        """Length of the veins around areoles and of those that end in one."""
        import shapely

        sections = self.sections
        if not self.areoles.n_areoles:
            return 0.0
        # no section crosses the rim, so that a place on it tells of all of it
        places = sections.drawing.points[sections.points_walked[sections.begins[:-1]]].mean(axis=1)
        rounding = ROUNDING * float(np.ptp(sections.drawing.points, axis=0).max())
        region = self.region
        shapely.prepare(region)
        is_enclosed = shapely.dwithin(region, shapely.points(places), rounding)
        return float(sections.lengths[is_enclosed].sum())

    @property
    def enclosed_density(self) -> float:
        """Vein length per area of the region that veins enclose; nan without an areole."""
        area = self.enclosed_area
        return self.enclosed_length / area if area > 0.0 else float("nan")

    def areole_numbers(self) -> Numbers:
        """Give the numbers of the areoles; nan without any."""
        areoles = self.areoles
        elongations = areoles.elongations
        return {
            "areoles": areoles.n_areoles,
            "flat_areoles": areoles.n_flat,
            "areole_area_mean": areoles.mean_area,
            "areole_area_cv": areoles.area_variation,
            "areole_circularity_median": median(areoles.circularities),
            # an areole between two veins that run along each other has no shape
            "areole_elongation_median": median(elongations[np.isfinite(elongations)]),
            "areole_corners_mean": mean(areoles.corners),
            "areole_corners_variance": float(areoles.corners.var())
            if areoles.n_areoles
            else float("nan"),
        }

    def section_numbers(self) -> Numbers:
        """Give the numbers of lengths and connections."""
        sections = self.sections
        lengths = sections.lengths
        total = float(lengths.sum())
        has_some = sections.n_sections > 0
        free = float(lengths[~sections.is_looped].sum())
        return {
            "sections": sections.n_sections,
            "section_length_mean": mean(lengths),
            "section_length_cv": float(lengths.std()) / mean(lengths) if has_some else float("nan"),
            "free_end_length_share": free / total if has_some else float("nan"),
            "mst_ratio": mst_ratio(sections),
            "box_dimension": box_dimension(sections),
        }

    def distance_numbers(self, density: float) -> Numbers:
        """Give the numbers of the distance from tissue to the nearest vein."""
        region = self.region if self.blade is None else self.blade
        distances = distances_to_vein(self.sections, places_in(region))
        farthest = float(np.percentile(distances, 95)) if len(distances) else float("nan")
        return {
            "distance_to_vein_mean": mean(distances),
            "distance_to_vein_median": median(distances),
            "distance_to_vein_p95": farthest,
            "density_x_distance": density * mean(distances),
        }

    def width_numbers(self) -> Numbers:
        """Give the numbers that need widths; None where these are unknown."""
        found = {**self._junction_numbers(), **self._hierarchy_numbers(), **self._order_numbers()}
        return found if self.has_widths else dict.fromkeys(found)

    def _junction_numbers(self) -> Numbers:
        """Give the numbers of junctions of three veins."""
        junctions = find_junctions(self.sections).long(self.sections.reach)
        off = np.degrees(np.abs(junctions.widest_angles - balanced_angles(junctions.widths)))
        exponents = murray_exponents(junctions.widths)
        exponents = exponents[~np.isnan(exponents)]
        return {
            "bohn_junctions": junctions.n_junctions,
            "bohn_residual_median": median(junctions.residuals),
            "bohn_residual_shuffled": median(junctions.shuffled_residuals(self.seed)),
            "bohn_angle_error_median": median(off),
            "murray_junctions": len(exponents),
            "murray_exponent_median": median(exponents),
        }

    def _hierarchy_numbers(self) -> Numbers:
        """Give the numbers of loops within loops, and of their shuffled control."""
        widths = self.sections.widths[self.between[:, 0]]
        real = loop_hierarchy(self.between, widths)
        chance = shuffled_hierarchies(self.between, widths, seed=self.seed)
        return {
            "loop_asymmetry": real.mean_asymmetry,
            "loop_asymmetry_shuffled": mean([one.mean_asymmetry for one in chance]),
            "loop_asymmetry_weighted": real.weighted_asymmetry,
            "loop_asymmetry_weighted_shuffled": mean([one.weighted_asymmetry for one in chance]),
            "loop_order": real.order,
        }

    def _order_numbers(self) -> Numbers:
        """Give the numbers of the vein orders and of the stream orders."""
        sections = self.sections
        orders, counted = vein_orders(sections), stream_orders(sections)
        by_order = {}
        for order in np.unique(orders).tolist():
            rows = np.flatnonzero(orders == order)
            lengths = sections.lengths[rows]
            by_order[str(order)] = {
                "length": float(lengths.sum()),
                "segments": int(np.diff(sections.begins)[rows].sum()),
                "width_mean": float((sections.widths[rows] * lengths).sum() / lengths.sum()),
            }
        return {
            "orders": by_order,
            "strahler_order": int(counted.orders.max(initial=0)),
            "strahler_streams": {str(order): n for order, n in counted.counts().items()},
            "horton_bifurcation_ratio": counted.bifurcation_ratio(),
        }


def measure(
    sections: Sections,
    blade: "shapely.Geometry | None",
    *,
    has_widths: bool = True,
    seed: int = 0,
) -> Measured:
    """Find the areoles of a network, so that all else can be measured.

    Parameters
    ----------
    sections : Sections
        The veins.
    blade : shapely.Geometry, optional
        The blade, if there is one.
    has_widths : bool
        Whether the widths of the sections mean something.
    seed : int
        Of the shuffled controls.

    Returns
    -------
    Measured
    """
    looped = looped_veins(sections)
    areoles = areoles_of(looped, sections.drawing)
    return Measured(sections, areoles, borders(looped, sections), blade, has_widths, seed)


def mean(values: Any) -> float:
    """Give the mean; nan without values."""
    return float(np.mean(values)) if len(values) else float("nan")


def median(values: Any) -> float:
    """Give the median; nan without values."""
    return float(np.median(values)) if len(values) else float("nan")
