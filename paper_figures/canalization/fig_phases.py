"""
A diagram of phases
===================

What becomes of one source and two sinks, for gains and saturations: a diagram of phases.
"""

from pathlib import Path

import numpy as np
from scenes import options, row_of, settle, strand_of

from vasc.domain.tilings import rectangular
from vasc.errors import RunError
from vasc.models.transport import FacilitatedDiffusion, PolarTransport, Transport
from vasc.render import save

PHASES = {
    "no canal": "#e3e3e0",
    "one file": "#2b6cc4",
    "wide": "#8fc1e8",
    "several": "#f0a04b",
    "vortex": "#c8102e",
    "diverges": "#202020",
}
WIDE = 1.5
"""Files of cells from which on a canal is wide."""
GAINS = 10.0 ** np.arange(0.5, 6.1, 0.5)
RATIOS = 4.0 ** np.arange(-1, 5)
"""S, the gain over the saturation."""
SIDE = 17
SOURCE, SINKS = (7, 3), ((4, 13), (12, 13))
TRANSPORTS = {"facilitated": FacilitatedDiffusion, "polar": PolarTransport}
BACKGROUNDS = {"facilitated": 0.0, "polar": 0.1}


def transport_of(kind: str, gain: float, ratio: float) -> Transport | None:
    """Give transport of a gain and S; None where walls would be saturated at rest."""
    saturation = gain / ratio
    if saturation <= 1.0:
        return None
    return TRANSPORTS[kind](gain=gain, saturation=saturation)


def phase(kind: str, gain: float, ratio: float) -> str | None:
    """Give what becomes of the source; None where walls would be saturated at rest."""
    transport = transport_of(kind, gain, ratio)
    if transport is None:
        return None
    tissue = rectangular(SIDE, SIDE)
    veins = [tissue.nearest_cells([sink]) for sink in SINKS]
    source = tissue.nearest_cells([SOURCE])
    try:
        state = settle(tissue, transport, veins, source, background=BACKGROUNDS[kind])
    except RunError:
        return "diverges"
    strand = strand_of(state, transport, int(source[0]), veins)
    if strand.is_vortex:
        return "vortex"
    if not strand.is_formed:
        return "no canal"
    if strand.n_strands > 1:
        return "several"
    return "wide" if strand.width > WIDE else "one file"


def main(output: Path, size: int = 1) -> None:
    """Draw the figure; every ``size``-th gain is tried."""
    gains = GAINS[::size]
    names = {"facilitated": "facilitated diffusion", "polar": "polar transport, background 0.1"}
    figure, axes = row_of(2, (7.0, 3.5), list(names.values()))
    for ax, kind in zip(axes, names, strict=True):
        ax.set_axis_on()
        ax.set_aspect("auto")
        for row, ratio in enumerate(RATIOS):
            for column, gain in enumerate(gains):
                found = phase(kind, gain, ratio)
                if found is not None:
                    ax.fill(
                        column + np.array([-0.48, 0.48, 0.48, -0.48]),
                        row + np.array([-0.47, -0.47, 0.47, 0.47]),
                        color=PHASES[found],
                        linewidth=0,
                    )
        ax.set_xticks(range(0, len(gains), 2), [f"$10^{{{np.log10(g):.3g}}}$" for g in gains[::2]])
        ax.set_yticks(range(len(RATIOS)), [f"{ratio:g}" for ratio in RATIOS])
        ax.tick_params(labelsize=8, length=0)
        ax.set_xlabel("gain A", fontsize=9)
        ax.spines[:].set_visible(False)
    axes[0].set_ylabel("S = gain / saturation", fontsize=9)
    marks = [
        axes[0].plot([], [], "s", color=color, label=name)[0] for name, color in PHASES.items()
    ]
    figure.legend(handles=marks, loc="outside lower center", ncols=6, fontsize=8, frameon=False)
    save(figure, output)


if __name__ == "__main__":
    asked = options("every so many gains is tried; 1 for all", 1)
    main(asked.output, asked.size)
