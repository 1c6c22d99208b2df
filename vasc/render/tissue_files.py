"""Pictures of recorded runs on a tissue: which step, at what scale, in which units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from vasc.analysis.tissue_units import unit_of
from vasc.errors import VascError
from vasc.render.leaf import SIDE
from vasc.render.panels import side_by_side
from vasc.render.styles import COLOR_CHOICES, TISSUE_COLOR_CHOICES, LeafStyle
from vasc.render.tissue import draw_tissue, view_of_tissue
from vasc.render.tissue_style import TissueScale, scale_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from vasc.timeline import Frame, Timeline


def chosen_color(timeline: Timeline, color: str | None) -> str:
    """Settle what colours tell: by default auxin in a run on a tissue, else widths alone.

    Raises
    ------
    VascError
        If ``color`` is none of the choices for this run.
    """
    if timeline.dimensions == 3:
        return color or "width"
    is_tissue = timeline.tissue is not None
    if color is None:
        return "concentration" if is_tissue else "width"
    known = (*TISSUE_COLOR_CHOICES, *COLOR_CHOICES) if is_tissue else COLOR_CHOICES
    if color not in known:
        raise VascError(f"color: {color!r} is not one of {', '.join(known)}")
    return color


def draw_steps(
    timeline: Timeline,
    frames: Sequence[Frame],
    *,
    color: str,
    scale_bar: bool = True,
    side: float = SIDE,
) -> Figure:
    """Draw some steps side by side; shades suit each, widths of arrows and bars all of them.

    Parameters
    ----------
    timeline : Timeline
        A recorded run on a tissue.
    frames : sequence of Frame
        Its steps, at least one.
    color : {"concentration", "flux", "carriers", "role"}
        What the shade of a cell tells.
    scale_bar : bool
        Whether to draw a scale bar.
    side : float
        Longer side of one picture, in inches.
    """
    common = scale_of(frames, color)
    views = [view_of_tissue(frame, side=side) for frame in frames]
    figure, axes = side_by_side(views, LeafStyle())
    for frame, view, ax in zip(frames, views, axes, strict=True):
        draw_tissue(
            frame,
            ax,
            color=color,
            unit=unit_of(timeline.config, color),
            units=timeline.units,
            scale=own_shade(common, frame, color),
            scale_bar=scale_bar and frame is frames[0],
            view=view,
        )
    return figure


def own_shade(common: TissueScale, frame: Frame, color: str) -> TissueScale:
    """Give a scale common to several steps, with the shade that suits one of them.

    Auxin falls by orders of magnitude while canals form, so that one shade for all steps
    would leave most of them white.
    """
    return replace(common, shade=scale_of([frame], color).shade)


def tissue_figures(
    timeline: Timeline, steps: Sequence[int], color: str, scale_bar: bool, side: float
) -> Iterator[Figure]:
    """Draw steps one after the other, as the pictures of a film.

    Parameters
    ----------
    timeline, color, scale_bar, side
        As for :func:`draw_steps`.
    steps : sequence of int
        The steps.
    """
    common = scale_of((timeline.frame(step) for step in steps), color)
    for frame in map(timeline.frame, steps):
        yield draw_tissue(
            frame,
            color=color,
            unit=unit_of(timeline.config, color),
            units=timeline.units,
            scale=own_shade(common, frame, color),
            scale_bar=scale_bar,
            view=view_of_tissue(frame, side=side),
        )
