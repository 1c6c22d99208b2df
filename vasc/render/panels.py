"""Several views in one figure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from vasc.render.leaf import View
from vasc.render.styles import LeafStyle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def side_by_side(views: Sequence[View], style: LeafStyle) -> tuple[Figure, list[Axes]]:
    """Make a figure with one pair of axes a view, standing on one line."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width = sum(view.inches[0] for view in views)
    height = max(view.inches[1] for view in views)
    # a hair more, since matplotlib before 3.11 cuts 399.9999 pixels to 399
    figure = Figure(figsize=(width + 1e-6, height + 1e-6), facecolor=style.background)
    FigureCanvasAgg(figure)
    axes, left = [], 0.0
    for view in views:
        across, up = view.inches
        axes.append(figure.add_axes((left / width, 0.0, across / width, up / height)))
        left += across
    return figure, axes
