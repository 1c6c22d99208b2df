"""
Figure 6.4: a stem laid flat
============================

A stem is split along a line and laid flat.
"""

from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from panels import INK, RED, output_of
from stems import SOLID, flat, grown_stem, solid

from vasc.render import save

CONFIGS = ("stem-golden-3-5-r50",)
N_PRIMORDIA = 20


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    stem = grown_stem(name, f"placement.primordia={N_PRIMORDIA}")
    top, radius = float(stem.positions[:, 2].max()), float(stem.radii.max())
    figure = Figure(figsize=(6.9, 2.9), facecolor="white")
    FigureCanvasAgg(figure)
    left = figure.add_axes((0.02, 0.02, 0.24, 0.88))
    solid(left, stem)
    # the line at angle 0 as the stem is seen
    turn, rise = np.radians([SOLID.azimuth, SOLID.elevation])
    across = -radius * np.sin(turn)
    up = np.array([0.0, top]) * np.cos(rise) - radius * np.cos(turn) * np.sin(rise)
    left.plot([across, across], up, color=RED, linewidth=1.5, zorder=5)
    right = figure.add_axes((0.32, 0.02, 0.66, 0.88))
    flat(right, stem)
    for angle in (0.0, 360.0):
        right.plot([angle, angle], [0.0, top], color=RED, linewidth=1.5, zorder=1.5)
    for x, words in ((0.02, "a)"), (0.32, "b)")):
        figure.text(x, 0.94, words, fontsize=8.0, color=INK)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
