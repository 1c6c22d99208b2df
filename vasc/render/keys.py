"""The key of a picture: what its colours mean, in the lower right corner."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vasc.render.looks import Key, gradient
from vasc.render.styles import CORNER, INK, TEXT_SIZE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SWATCH_HEIGHT = 5.0
GRADIENT_WIDTH = 70.0
N_CELLS = 64
GAP = 3.0
"""All in pt."""


def draw_key(axes: Axes, key: Key) -> None:
    """Draw what the colours mean; nothing for a key without a title.

    Parameters
    ----------
    axes : matplotlib Axes
        Where to draw; its size must be final.
    key : Key
        Title, labels and colours.
    """
    if key.title and key.is_gradient:
        _draw_gradient(axes, key)
    elif key.title:
        _draw_swatches(axes, key)


def size_in_points(axes: Axes) -> tuple[float, float]:
    """Give width and height of axes, in pt."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    position = axes.get_position()
    width, height = figure.get_size_inches()
    return position.width * float(width) * 72.0, position.height * float(height) * 72.0


def _draw_gradient(axes: Axes, key: Key) -> None:
    """Draw a band of running colours between its first and last label."""
    first, last = key.labels
    right = size_in_points(axes)[0] - CORNER - _text_width(last) - GAP
    left = right - GRADIENT_WIDTH
    cell = GRADIENT_WIDTH / N_CELLS
    for place, color in enumerate(gradient(key.colors, N_CELLS)):
        # each cell reaches under the next, so that no seam shows between them
        _fill(axes, left + place * cell, min(2.0 * cell, right - left - place * cell), color)
    _write(axes, right + GAP, last, "left")
    _write(axes, left - GAP, f"{key.title} {first}", "right")


def _draw_swatches(axes: Axes, key: Key) -> None:
    """Draw a small square before every label, from the right to the left."""
    right = size_in_points(axes)[0] - CORNER
    for label, color in zip(reversed(key.labels), reversed(key.colors), strict=True):
        left = right - _text_width(label) - GAP - SWATCH_HEIGHT
        _fill(axes, left, SWATCH_HEIGHT, color)
        _write(axes, left + SWATCH_HEIGHT + GAP, label, "left")
        right = left - 2.0 * GAP
    _write(axes, right, key.title, "right")


def _text_width(text: str) -> float:
    """Estimate the width of a short text, in pt: no font needs to be measured for that."""
    return 0.62 * TEXT_SIZE * len(text)


def _fill(axes: Axes, left: float, width: float, color: str) -> None:
    """Fill a rectangle of the key's height; places in pt from the lower left corner."""
    from matplotlib.patches import Rectangle

    total_width, total_height = size_in_points(axes)
    axes.add_patch(
        Rectangle(
            (left / total_width, CORNER / total_height),
            width / total_width,
            SWATCH_HEIGHT / total_height,
            transform=axes.transAxes,
            facecolor=color,
            linewidth=0.0,
            zorder=5.0,
        )
    )


def _write(axes: Axes, x: float, text: str, side: str) -> None:
    """Write a word of the key; ``x`` in pt from the left."""
    width, height = size_in_points(axes)
    axes.text(
        x / width,
        (CORNER + SWATCH_HEIGHT / 2.0) / height,
        text,
        ha=side,
        va="center_baseline",
        fontsize=TEXT_SIZE,
        color=INK,
        transform=axes.transAxes,
        zorder=5.0,
    )
