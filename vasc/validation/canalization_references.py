"""What papers say about canals, and rates measured before that new ones are held against.

No paper gives rates: those of :data:`HIT_RATES` are ours, measured once by another program
with the same equations on other draws, so that a change of the model shows.
"""

from dataclasses import dataclass

CLAIM = "Runions (2008), section 4.1.4: a canal forms between a source and the closest vein"
FIGURE = "Runions (2008), Figure 4.9"
CLOSED_RULE = "Runions (2008), section 4.3, equation 4.1: the closed rule"
MEASURED = "ours, measured by another program"


@dataclass(frozen=True)
class HitRate:
    """How often a canal reached the nearest vein.

    Parameters
    ----------
    tissue, scenario, protocol : str
        What it was measured on.
    hits : int
        How often the vein that got most was the nearest by Euclid.
    n : int
        Scenarios drawn.
    """

    tissue: str
    scenario: str
    protocol: str
    hits: int
    n: int = 60


HIT_RATES = tuple(
    HitRate(tissue, scenario, protocol, round(60 * rate))
    for tissue, scenario, rates in (
        ("rectangular", "P2", (0.97, 0.88, 0.83)),
        ("rectangular", "P4", (0.85, 0.75, 0.65)),
        ("rectangular", "M2", (0.93, 0.82, 0.78)),
        ("rectangular", "V3", (0.90, 0.80, 0.73)),
        ("voronoi", "P2", (1.00, 0.93, 0.88)),
        ("voronoi", "P4", (0.97, 0.77, 0.72)),
        ("voronoi", "M2", (1.00, 0.82, 0.83)),
        ("voronoi", "V3", (0.97, 0.85, 0.80)),
        ("hexagonal", "P2", (0.97, 0.90)),
        ("hexagonal", "V3", (0.97, 0.82)),
    )
    for protocol, rate in zip(("facilitated", "pool, background", "pool"), rates, strict=False)
)
"""Measured on about 570 cells with the default values of the models, n = 60."""

WIDTH_DIFFUSE, WIDTH_FORMED = 25.0, 1.1
"""Measured on 25 x 25 cells, source 10 cells from the vein, saturation = gain: width at a gain
of 10, where no canal forms, and at 160, where one does."""

CRITICAL_GAINS = (10.0, 160.0)
"""Gains below and above the one from which on a canal forms over 10 cells."""
