"""Births of veins in space and time: when, and how high above the base, by order."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.run_widths import widths_of
from vasc.analysis.segment_orders import run_node_orders
from vasc.analysis.units import LengthUnit
from vasc.events import EventKind
from vasc.render.styles import INK, ORDER_COLORS, TEXT_SIZE, LeafStyle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from vasc.timeline import Timeline

SIZE = (8.0, 6.0)
"""Of the picture, in inches."""
N_OUTLINES = 120
"""Steps at which the height of the blade is looked up."""
MOST_BINS = 60
"""Spans of time in which events are counted, at most."""
NEAR = 0.12
"""Share of the run within which the names of two lines stand above each other."""
SPANS = {
    EventKind.GROWTH_ENDED: "growth ended",
    EventKind.MESOPHYLL_EVENT: "mesophyll",
}
"""Events that change what happens from then on: lines."""
COUNTED = {
    EventKind.SOURCE_PLACED: ("source placed", "#9a9a9a"),
    EventKind.LOOP_CLOSED: ("loop closed", "#c8102e"),
    EventKind.VEIN_ENDED_BLINDLY: ("vein ended blindly", "#2166ac"),
}
"""Events that are counted below, with their colours."""


def draw_births(
    timeline: Timeline,
    step: int = -1,
    *,
    orders: NDArray | None = None,
    order_name: str = "vein order",
    style: LeafStyle | None = None,
) -> Figure:
    """Draw the birth of every vein: time to the right, height above the base upward.

    Colours tell the order. Behind lies the blade, from its lowest to its highest point
    at every time, so that one sees where veins were born relative to the tip. Below,
    events are counted; growth that ended and mesophyll are marked by lines. Veins of equal
    birth on both sides of the midvein share a dot.

    Parameters
    ----------
    timeline : Timeline
        An open timeline, of a leaf or a stem.
    step : int
        The last step to show, the last one recorded when not given.
    orders : ndarray of shape (n,), int, optional
        An order for each node; vein orders at that step if left out (see
        :mod:`vasc.analysis.segment_orders`).
    order_name : str
        What these orders are called.
    style : LeafStyle, optional
        Colours of blade and paper.

    Returns
    -------
    Figure

    Raises
    ------
    TimelineError
        If the step is not recorded.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

    style = LeafStyle() if style is None else style
    last = timeline.frame(step).step
    figure = Figure(figsize=SIZE, facecolor=style.background)
    FigureCanvasAgg(figure)
    above, below = figure.subplots(
        2, 1, sharex=True, gridspec_kw={"height_ratios": (5.0, 1.2), "hspace": 0.06}
    )
    figure.subplots_adjust(left=0.1, right=0.97, top=0.93, bottom=0.09)
    unit = LengthUnit.from_table(timeline.units)
    if orders is None:
        n_nodes = timeline.n_rows("nodes")
        orders = run_node_orders(timeline.frame, last, widths_of(timeline.config), n_nodes)
    table = timeline.lineage.births(orders)
    is_shown = table["step"] <= last
    _draw_extent(above, timeline, last, unit, style)
    _draw_points(above, {name: rows[is_shown] for name, rows in table.items()}, unit, order_name)
    width = bin_width(last)
    _draw_counts(below, timeline, last, width)
    above.set_ylabel(f"height above the base ({unit.name})", fontsize=TEXT_SIZE, color=INK)
    span = "a step" if width == 1 else f"in {width} steps"
    below.set_ylabel(f"events {span}", fontsize=TEXT_SIZE, color=INK)
    below.set_xlabel("step of birth", fontsize=TEXT_SIZE, color=INK, loc="left")
    below.set_xlim(0, max(last, 1))
    below.xaxis.set_major_locator(MaxNLocator(integer=True))
    for axes in (above, below):
        axes.tick_params(labelsize=TEXT_SIZE, colors=INK, width=0.5)
        axes.spines[["right", "top"]].set_visible(False)
    _mark_spans(above, below, timeline, last)
    return figure


def _draw_extent(
    axes: Axes, timeline: Timeline, last: int, unit: LengthUnit, style: LeafStyle
) -> None:
    """Fill what the blade reaches at each step; a stem, up to its highest node."""
    events = timeline.events
    # where growth ends the outline has a corner
    ends = events["step"][events["kind"] == EventKind.GROWTH_ENDED]
    evenly = np.linspace(0, last, N_OUTLINES).round().astype(np.int64)
    steps = np.union1d(evenly, ends[ends <= last])
    low, high = np.zeros(len(steps)), np.zeros(len(steps))
    if timeline.dimensions == 3:
        heights = timeline.table("nodes", "material")[:, 2]
        tops = np.maximum.accumulate(heights - heights[0])
        n_nodes = timeline.frames["n_nodes"][steps]
        high = tops[n_nodes - 1]
    else:
        for row, step in enumerate(steps.tolist()):
            frame = timeline.frame(step)
            low[row], high[row] = (frame.blade.bounds[k] - frame.positions[0, 1] for k in (1, 3))
    low, high = low * unit.per_segment, high * unit.per_segment
    axes.fill_between(steps, low, high, color=style.blade, linewidth=0.0, zorder=1.0)
    axes.plot(steps, high, color=style.margin, linewidth=0.8, zorder=1.5)
    below = min(float(low.min()), 0.0) - 0.02 * float(high.max())
    axes.set_ylim(below, 1.03 * max(float(high.max()), 1e-9))


def _draw_points(
    axes: Axes, table: Mapping[str, NDArray], unit: LengthUnit, order_name: str
) -> None:
    """Draw a dot a vein; low orders are drawn last and largest, so that they are seen."""
    from matplotlib.lines import Line2D

    n_colors = len(ORDER_COLORS)
    shown = np.clip(table["order"], 1, n_colors)
    size = float(np.clip(60.0 / np.sqrt(max(len(shown), 1)), 1.6, 5.0))
    present = np.unique(shown).tolist()
    labels = [
        f"{order}{'+' if order == n_colors else ''} ({int((shown == order).sum()):,})"
        for order in present
    ]
    for order in reversed(present):
        rows = shown == order
        axes.plot(
            table["step"][rows],
            table["height"][rows] * unit.per_segment,
            linestyle="none",
            marker="o",
            markersize=size * max(2.2 - 0.4 * order, 1.0),
            markerfacecolor=ORDER_COLORS[order - 1],
            markeredgecolor="white",
            # a rim would eat small dots
            markeredgewidth=0.3 if size > 2.5 else 0.0,
            zorder=2.0 + 0.1 * (n_colors - order),
        )
    axes.legend(
        [
            Line2D([], [], linestyle="none", marker="o", color=ORDER_COLORS[order - 1], ms=5.0)
            for order in present
        ],
        labels,
        title=f"{order_name} (veins)",
        loc="upper left",
        fontsize=TEXT_SIZE,
        title_fontsize=TEXT_SIZE,
        alignment="left",
        handlelength=1.0,
        frameon=False,
        labelcolor=INK,
    )


def bin_width(last: int) -> int:
    """Give a round number of steps, so that a run has :data:`MOST_BINS` spans of it at most.

    A span of whole steps: others would count one step more here than there.

    Examples
    --------
    >>> bin_width(40), bin_width(640), bin_width(2464)
    (1, 20, 50)
    """
    least = max((last + 1) / MOST_BINS, 1.0)
    power = 1
    while 10 * power < least:
        power *= 10
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= least)


def _draw_counts(axes: Axes, timeline: Timeline, last: int, width: int) -> None:
    """Count events in spans of so many steps, as lines of steps."""
    events = timeline.events
    edges = np.arange(0, last + 1 + width, width)
    for kind, (name, color) in COUNTED.items():
        steps = events["step"][(events["kind"] == kind) & (events["step"] <= last)]
        if len(steps):
            counts, _ = np.histogram(steps, edges)
            axes.stairs(counts, edges, color=color, linewidth=1.0, label=f"{name} ({len(steps):,})")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(
            loc="upper right",
            bbox_to_anchor=(1.0, -0.22),
            ncols=len(COUNTED),
            fontsize=TEXT_SIZE - 1.0,
            frameon=False,
            labelcolor=INK,
        )
    axes.set_ylim(bottom=0.0)


def _mark_spans(above: Axes, below: Axes, timeline: Timeline, last: int) -> None:
    """Draw lines at the steps from which things are otherwise; their names stand above all."""
    events = timeline.events
    marks = sorted(
        (at, name)
        for kind, name in SPANS.items()
        for at in events["step"][(events["kind"] == kind) & (events["step"] <= last)].tolist()
    )
    row, before = 0, -np.inf
    where: Any = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
    for at, name in marks:
        for axes in (above, below):
            axes.axvline(at, color=INK, linewidth=0.7, linestyle=(0.0, (4.0, 3.0)), zorder=1.8)
        row = 1 - row if at - before < NEAR * max(last, 1) else 0
        before = at
        above.annotate(
            name,
            (at, 1.0),
            (0.0, 3.0 + row * 1.3 * TEXT_SIZE),
            # at the right end, the text would leave the picture
            ha="right" if at > 0.9 * last else "center",
            va="bottom",
            fontsize=TEXT_SIZE,
            color=INK,
            **where,
        )
