"""
Figure 6.6: growth of internodes
================================

A stem in space and unrolled, before and after growth of its internodes.
"""

from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from panels import INK, output_of
from stems import flat, grown_stem, lifted, solid

from vasc.render import save

CONFIGS = ("stem-golden-3-5-r50",)
N_PRIMORDIA = 30
PANELS = ((0.02, 0.16), (0.20, 0.29), (0.52, 0.16), (0.70, 0.29))
"""Left edge and width of each, over the width of the figure."""
APEX = 0.12
"""Share of its growth that the apex has been through, over that of the base."""


def grow_map(heights: NDArray) -> NDArray:
    """Give normalized heights after growth: the older an internode, the longer it is.

    The function is ours. That of the thesis, from the rosette of Arabidopsis, is in
    Figure 6.5 as a curve alone.
    """
    return APEX * heights + (1.0 - APEX) * (1.0 - (1.0 - heights) ** 2)


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    young = grown_stem(name, f"placement.primordia={N_PRIMORDIA}")
    heights = young.positions[:, 2]
    old = lifted(young, heights.max() * grow_map(heights / heights.max()))
    figure = Figure(figsize=(6.9, 2.9), facecolor="white")
    FigureCanvasAgg(figure)
    for number, (left, width) in enumerate(PANELS):
        ax = figure.add_axes((left, 0.02, width, 0.88))
        (solid, flat)[number % 2](ax, (young, old)[number // 2])
        figure.text(left, 0.94, f"{chr(ord('a') + number)})", fontsize=8.0, color=INK)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
