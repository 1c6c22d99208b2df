"""
Canals in an areole
===================

Canals of one source in an areole, for walls that saturate sooner and sooner.

Crosses are the relative neighbors of the source among the veins (Runions 2008, equation 4.1),
where the closed model of venation would lead strands.
"""

from pathlib import Path

import numpy as np
from scenes import RED, options, row_of, settle, strand_of, tissue_in

from vasc.models.transport import FacilitatedDiffusion
from vasc.render import TissueStyle, draw_tissue, save
from vasc.validation.canalization.geometric import closed_ends

GAIN = 3e3
RATIOS = (1, 4, 16, 64)
"""S, the gain over the saturation of a wall."""
RING = 12.5 * np.array(
    [
        (-0.95, -0.55),
        (0.1, -0.95),
        (0.95, -0.45),
        (1.0, 0.4),
        (0.35, 0.95),
        (-0.6, 0.85),
        (-1.0, 0.2),
    ]
)
PLACES = {"central": (0.3, 0.2), "aside": (-4.0, 3.0)}
STYLE = TissueStyle(head_distance=17.0)
GAP = 2.0
"""Of relative neighbors nearer to each other than that, the nearer to the source counts, in D."""


def main(output: Path, size: int = 12) -> None:
    """Draw the figure; ``size`` is about half the width of the areole in cells."""
    tissue = tissue_in(RING * size / 12.5, seed=2)
    # the ring comes back to its first cell, which is in the vein once
    ring = tissue.margins[0]
    veins = [ring[:-1]]
    figure, axes = row_of(8, (7.0, 3.95), rows=2)
    panels = iter(axes)
    for name, place in PLACES.items():
        source = int(tissue.nearest_cells([np.array(place) * size / 12.5])[0])
        crosses = tissue.positions[closed_ends(tissue, veins, source, GAP)]
        for ratio in RATIOS:
            ax = next(panels)
            transport = FacilitatedDiffusion(gain=GAIN, saturation=GAIN / ratio)
            state = settle(tissue, transport, [ring], [source])
            strand = strand_of(state, transport, source, veins)
            draw_tissue(state, ax, title=False, scale_bar=False, key=False, style=STYLE)
            ax.plot(*crosses.T, "x", color=RED, markersize=7, markeredgewidth=2.0, zorder=7)
            ax.set_title(
                f"S = {ratio}: ends {strand.n_landings}, width {strand.width:.1f}", fontsize=8
            )
            print(f"{name}, S = {ratio}: {strand.n_landings} ends, {len(crosses)} neighbors")
    save(figure, output)


if __name__ == "__main__":
    asked = options("half the width of the areole, in cells", 12)
    main(asked.output, asked.size)
