"""Pictures of recorded runs in files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from vasc.analysis.elongation import Elongation
from vasc.analysis.run_widths import widths_of
from vasc.analysis.widths import WidthParameters
from vasc.arrays import Floats
from vasc.errors import VascError
from vasc.render.keys import size_in_points
from vasc.render.leaf import (
    NARROWEST,
    View,
    draw_leaf,
    fitted_widths,
    narrowest_of,
    view_at,
    view_of,
)
from vasc.render.panels import side_by_side
from vasc.render.saving import PICTURE_SUFFIXES, checked_output, save
from vasc.render.stems import only_step, render_stem
from vasc.render.styles import DPI, INK, TEXT_SIZE, TISSUE_COLOR_CHOICES, LeafStyle
from vasc.render.tissue_files import chosen_color, draw_steps

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from vasc.timeline import Frame, Timeline


def render(
    run: str | Path | Timeline,
    output: str | Path,
    step: int = -1,
    *,
    steps: Sequence[int] | None = None,
    color: str | None = None,
    widths: WidthParameters | None = None,
    sources: bool = False,
    scale_bar: bool = True,
    unroll: bool = False,
    pixels: int = 1600,
    style: LeafStyle | None = None,
) -> Path:
    """Write a picture of a recorded leaf, stem or tissue.

    Parameters
    ----------
    run : path or Timeline
        The recorded run.
    output : path
        The picture; png, svg or pdf by its suffix. An old one is replaced.
    step : int
        The step to draw; -1 is the last.
    steps : sequence of int, optional
        Several steps, drawn side by side at one scale, instead of ``step``.
    color : str, optional
        What colours tell: of veins as in :func:`vasc.render.draw_leaf`, by default their
        width alone; of the cells of a tissue as in :func:`vasc.render.draw_tissue`, by
        default auxin.
    sources, scale_bar, style
        See :func:`vasc.render.draw_leaf`; a tissue always shows its sources.
    widths : WidthParameters, optional
        The widths of the run's config if left out.
    unroll : bool
        Draw a stem split along a line and laid flat, not in three dimensions.
    pixels : int
        Longer side of a single leaf in a png; an svg or pdf has the same proportions.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    OutputError
        If the suffix is none of these, or the folder does not exist.
    VascError
        If ``color`` is none of the choices, or a step was not recorded; if a leaf is to
        be unrolled, or a stem drawn at several steps, with sources or in colours.
    TimelineError
        If ``run`` is not a timeline.
    """
    output = checked_output(output, PICTURE_SUFFIXES)
    with open_run(run) as timeline:
        steps = [step] if steps is None else steps
        color = chosen_color(timeline, color)
        if timeline.dimensions == 3:
            only = only_step(steps, color=color, sources=sources)
            return render_stem(
                timeline, output, only, unroll=unroll, scale_bar=scale_bar, pixels=pixels
            )
        if unroll:
            raise VascError(f"unroll: only a stem can be unrolled, not a {timeline.model!r} run")
        frames = _frames_at(timeline, steps)
        side = pixels / DPI
        if color in TISSUE_COLOR_CHOICES:
            figure = draw_steps(timeline, frames, color=color, scale_bar=scale_bar, side=side)
        else:
            asked = widths_of(timeline.config) if widths is None else widths
            style = LeafStyle() if style is None else style
            figure, axes, views = _laid_out(frames, color, style, side)
            stretched = node_widths(timeline, asked, [frame.step for frame in frames])
            last = frames[-1]
            widths = fitted_widths(last, asked, style, views[-1], stretched.get(last.step))
            for frame, view, ax in zip(frames, views, axes, strict=True):
                draw_leaf(
                    frame,
                    ax,
                    color=color,
                    widths=widths,
                    node_widths=stretched.get(frame.step),
                    asked_widths=asked,
                    sources=sources,
                    scale_bar=scale_bar and frame is frames[0],
                    key=frame is last,
                    units=timeline.units,
                    style=style,
                    view=view,
                    last_step=max(each.step for each in frames),
                )
        save(figure, output)
    return output


@contextmanager
def open_run(run: str | Path | Timeline) -> Iterator[Timeline]:
    """Open a recorded run; one that is open already stays open afterwards."""
    if not isinstance(run, str | Path):
        yield run
        return
    from vasc.timeline import Timeline

    with Timeline(run) as timeline:
        yield timeline


def node_widths(
    timeline: Timeline, widths: WidthParameters, steps: Sequence[int]
) -> dict[int, Floats]:
    """Give the widths of all nodes at some steps, if elongation tells them.

    Parameters
    ----------
    timeline : Timeline
        The recorded run; all its steps up to the last one asked for are read.
    widths : WidthParameters
        Whose ``rule`` is asked.
    steps : sequence of int
        Steps of the run.

    Returns
    -------
    dict of int to ndarray of shape (n,), float64
        Empty where Murray's law tells the widths.
    """
    if widths.rule != "elongation":
        return {}
    elongation, found = Elongation(widths.kappa), {}
    for step in range(max(steps) + 1):
        elongation.update(timeline.frame(step))
        if step in steps:
            found[step] = elongation.widths
    return found


def _views(frames: Sequence[Frame], style: LeafStyle, side: float, last_width: float) -> list[View]:
    """Give views of one scale, at which the largest blade has the side asked for."""
    scale = min(view_of(frame.blade, style, side=side).points_per_length for frame in frames)
    # the last leaf is the one with the key
    widths = [NARROWEST] * (len(frames) - 1) + [last_width]
    views = [
        view_at(frame.blade, style, scale, narrowest=width)
        for frame, width in zip(frames, widths, strict=True)
    ]
    if len(views) == 1:
        return views
    # the places where the leaves are attached stand on one line, and steps are written above
    ground = min(view.box[1] for view in views)
    above = 2.0 * TEXT_SIZE / scale
    return [View((view.box[0], ground, view.box[2], view.box[3] + above), scale) for view in views]


def _frames_at(timeline: Timeline, steps: Sequence[int]) -> list[Frame]:
    """Give the frames of some steps; refuse none."""
    if not steps:
        raise VascError("steps: expected at least one step, got none")
    return [timeline.frame(step) for step in steps]


def _laid_out(
    frames: Sequence[Frame], color: str, style: LeafStyle, side: float
) -> tuple[Figure, list[Axes], list[View]]:
    """Make a figure for some leaves, with the step over each where there are several."""
    views = _views(frames, style, side, narrowest_of(frames[-1], color))
    figure, axes = side_by_side(views, style)
    if len(frames) > 1:
        for frame, ax in zip(frames, axes, strict=True):
            _write_step(ax, frame.step)
    return figure, axes, views


def _write_step(ax: Axes, step: int) -> None:
    """Write the number of the step over a leaf."""
    ax.text(
        0.5,
        1.0 - 0.5 * TEXT_SIZE / size_in_points(ax)[1],
        f"step {step}",
        transform=ax.transAxes,
        ha="center",
        va="top",
        fontsize=TEXT_SIZE,
        color=INK,
    )
