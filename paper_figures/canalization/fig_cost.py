"""
Cost of a canal
===============

Seconds that a canal takes to form, against the number of cells.
"""

import time
from pathlib import Path

import numpy as np
from scenes import BLUE, GREEN, options, plot, settle

from vasc.domain.tilings import rectangular
from vasc.models.transport import FacilitatedDiffusion, PooledTransport, Transport
from vasc.render import save

SIDES = (15, 20, 30, 40, 60, 80, 100, 140, 200)
SECONDS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
TRANSPORTS = {
    "facilitated diffusion": (FacilitatedDiffusion(gain=1e4), GREEN),
    "pool of carriers": (PooledTransport(), BLUE),
}


def formation(side: int, transport: Transport) -> float:
    """Give the seconds in which a canal forms in a square tissue with two sinks."""
    tissue = rectangular(side, side)
    places = [(side // 4, side - 2), (3 * side // 4, side - 2)]
    veins = [tissue.nearest_cells([place]) for place in places]
    source = tissue.nearest_cells([(0.4 * side, 0.25 * side)])
    start = time.process_time()
    settle(tissue, transport, veins, source)
    return time.process_time() - start


def main(output: Path, size: int = 60) -> None:
    """Draw the figure; ``size`` is the side of the largest tissue in cells."""
    # what is loaded at first use does not count
    formation(10, FacilitatedDiffusion())
    figure, ax = plot((5.0, 3.6), "cells", "CPU seconds")
    for name, (transport, color) in TRANSPORTS.items():
        counts, seconds = [], []
        for side in SIDES:
            if side > size:
                continue
            seconds.append(formation(side, transport))
            counts.append(side**2)
            print(f"{name}: {counts[-1]} cells, {seconds[-1]:.2f} s")
        larger = np.log(counts[-3:]), np.log(seconds[-3:])
        slope = np.polyfit(*larger, 1)[0]
        label = f"{name}, at last as $n^{{{slope:.2f}}}$"
        ax.loglog(counts, seconds, "o-", color=color, ms=4, label=label)
    for axis, ticks in ((ax.xaxis, counts), (ax.yaxis, SECONDS)):
        low, high = axis.get_view_interval()
        shown = [tick for tick in ticks if low <= tick <= high]
        axis.set_ticks(shown, [f"{tick:,}" for tick in shown])
        axis.set_ticks([], minor=True)
    ax.legend(fontsize=8)
    save(figure, output)


if __name__ == "__main__":
    asked = options("side of the largest tissue, in cells; at most 200", 60)
    main(asked.output, asked.size)
