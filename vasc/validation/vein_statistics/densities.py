"""Densities of major and minor veins while a leaf grows."""

from dataclasses import dataclass

import numpy as np

from vasc.analysis import WidthParameters, find_sections, vein_orders
from vasc.analysis.moment import Moment, blade_of
from vasc.analysis.run_widths import widths_at
from vasc.arrays import Floats
from vasc.timeline import Timeline
from vasc.validation.leaf_references import MOST_MAJOR

N_MOMENTS = 5
"""Moments of the last doubling of the area that are looked at."""
EARLIER = 3
"""Doublings before it, a moment each, that are drawn."""


@dataclass(frozen=True)
class Densities:
    """Vein length per blade area at moments of a run.

    Parameters
    ----------
    areas : ndarray of shape (k,), float64
        Area of the blade, rising, in D^2; the last :data:`N_MOMENTS` are of the last doubling.
    major, minor : ndarray of shape (k,), float64
        Density of veins of the first to third order, and of the others, in 1/D.
    """

    areas: Floats
    major: Floats
    minor: Floats

    @property
    def minor_change(self) -> float:
        """Largest change of the minor density over the last doubling, of that at its end."""
        last = self.minor[-N_MOMENTS:]
        return float(np.abs(last / last[-1] - 1.0).max()) if last[-1] > 0.0 else float("nan")

    @property
    def major_exponent(self) -> float:
        """Slope of log(major density) against log(area) over the last doubling."""
        last = slice(-N_MOMENTS, None)
        return float(np.polyfit(np.log(self.areas[last]), np.log(self.major[last]), 1)[0])


def densities_of(timeline: Timeline, widths: WidthParameters) -> Densities:
    """Measure the densities of major and minor veins of a growing leaf.

    Orders are assigned at every moment anew, as they are in leaves of different sizes.

    Parameters
    ----------
    timeline : Timeline
        A recorded leaf whose area doubles at least once.
    widths : WidthParameters
        How wide its veins are.

    Returns
    -------
    Densities
        Up to the last step with growth.
    """
    areas = blade_areas(timeline)
    shares = 2.0 ** -np.concatenate(
        [np.arange(EARLIER + 1, 1, -1), np.linspace(1.0, 0.0, N_MOMENTS)]
    )
    # the first step with the area; the last of them is the last step of growth
    steps = np.searchsorted(areas, shares * areas[-1] * (1.0 - 1e-12))
    moments = widths_at(timeline.frame, steps.tolist(), widths)
    lengths = np.array([_lengths(moment, found) for moment, found in moments]).reshape(-1, 2)
    return Densities(areas[steps], *(lengths / areas[steps, None]).T)


def blade_areas(timeline: Timeline) -> Floats:
    """Give the area of the blade at every recorded step, shape (k,), in D^2."""
    return np.array([blade_of(timeline.frame(k)).area for k in range(timeline.n_frames)])


def _lengths(moment: Moment, widths: Floats) -> tuple[float, float]:
    """Give the length of major and of minor veins."""
    sections = find_sections(moment.network, widths)
    is_major = vein_orders(sections) <= MOST_MAJOR
    lengths = sections.lengths
    return float(lengths[is_major].sum()), float(lengths[~is_major].sum())
