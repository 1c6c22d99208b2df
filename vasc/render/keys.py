"""The key of a picture: what its colours mean, in the lower right corner."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vasc.render.looks import gradient
from vasc.render.styles import CORNER, INK, TEXT_SIZE, Key, Mark

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SWATCH_HEIGHT = 5.0
DASH_WIDTH = 14.0
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


def key_width(key: Key) -> float:
    """Give the width of a key in one line, in pt."""
    if key.is_gradient or not key.title:
        return 0.0
    marks = key.marks or (Mark.SQUARE,) * len(key.labels)
    widths = [_mark_width(mark) for mark in marks] + [_text_width(text) for text in key.labels]
    return 2.0 * CORNER + sum(widths) + 3.0 * GAP * len(marks) + _text_width(key.title)


def _draw_swatches(axes: Axes, key: Key) -> None:
    """Draw a small mark before every label, from the right to the left."""
    right = size_in_points(axes)[0] - CORNER
    marks = key.marks or (Mark.SQUARE,) * len(key.labels)
    for label, color, mark in reversed(list(zip(key.labels, key.colors, marks, strict=True))):
        left = right - _text_width(label) - GAP - _mark_width(mark)
        if mark == Mark.SQUARE:
            _fill(axes, left, SWATCH_HEIGHT, color)
        else:
            _mark(axes, left, mark, color)
        _write(axes, left + _mark_width(mark) + GAP, label, "left")
        right = left - 2.0 * GAP
    _write(axes, right, key.title, "right")


def _mark_width(mark: Mark) -> float:
    """Give the width of a mark, in pt."""
    return DASH_WIDTH if mark == Mark.DASH else SWATCH_HEIGHT


def _mark(axes: Axes, left: float, mark: Mark, color: str) -> None:
    """Draw a dashed line, a disc or a ring; its left end in pt."""
    width, height = size_in_points(axes)
    y = (CORNER + SWATCH_HEIGHT / 2.0) / height
    if mark == Mark.DASH:
        x = [left / width, (left + DASH_WIDTH) / width]
        (line,) = axes.plot(x, [y, y], color=color, transform=axes.transAxes, zorder=5.0)
        line.set(linestyle=(0.0, (2.5, 1.8)), linewidth=0.9)
        return
    axes.plot(
        [(left + SWATCH_HEIGHT / 2.0) / width],
        [y],
        linestyle="none",
        marker="o",
        markersize=SWATCH_HEIGHT,
        markerfacecolor=color if mark == Mark.DISC else "white",
        markeredgecolor=color,
        markeredgewidth=0.8,
        transform=axes.transAxes,
        zorder=5.0,
    )


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
