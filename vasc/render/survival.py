"""The survival of sources: which share of them lives longer than an age."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vasc.errors import VascError
from vasc.render.styles import INK, TEXT_SIZE, LeafStyle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from vasc.timeline import Timeline
    from vasc.timeline.life_table import MedianLife

SIZE = (6.0, 4.0)
"""Of the picture, in inches."""
CURVE, BAND = "#2166ac", "#c9dcee"
N_AT_RISK = 6
"""Ages at which the sources at risk are counted below."""
MOST_MARKS = 150
"""Marks of censoring; of more ages, evenly chosen ones have a mark."""


def draw_survival(timeline: Timeline, *, style: LeafStyle | None = None) -> Figure:
    """Draw the curve of Kaplan and Meier of all sources, with its 95 % interval.

    A short upright mark stands where sources were last seen alive: they are censored. The
    median is dotted, and where it is not reached the picture says so. Below stand the
    sources at risk.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    style : LeafStyle, optional
        Colour of the paper.

    Returns
    -------
    Figure

    Raises
    ------
    VascError
        If no source ever appeared.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    table = timeline.lineage.life_table()
    median = timeline.lineage.median_life()
    if not median.n:
        raise VascError(f"{timeline.path}: no source appeared, so that none can survive")
    style = LeafStyle() if style is None else style
    figure = Figure(figsize=SIZE, facecolor=style.background)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.12, 0.27, 0.84, 0.64))
    _draw_curve(axes, table)
    _draw_median(axes, median)
    _write_at_risk(axes, table)
    axes.set_xlim(0.0, float(table["age"][-1]) + 1.0)
    axes.set_ylim(0.0, 1.02)
    axes.set_xlabel("age of a source (steps since birth)", fontsize=TEXT_SIZE, color=INK)
    axes.set_ylabel("share that lives longer", fontsize=TEXT_SIZE, color=INK)
    axes.tick_params(labelsize=TEXT_SIZE, colors=INK, width=0.5)
    axes.spines[["right", "top"]].set_visible(False)
    axes.set_title(
        f"survival of {median.n:,} sources: {median.deaths:,} died, {median.censored:,} censored",
        fontsize=TEXT_SIZE + 1.0,
        color=INK,
    )
    axes.legend(
        # where the curve is not: it only falls
        loc="lower left" if median.least_survival > 0.5 else "upper right",
        fontsize=TEXT_SIZE,
        frameon=False,
        labelcolor=INK,
        borderaxespad=0.2,
    )
    return figure


def _draw_curve(axes: Axes, table: Mapping[str, NDArray]) -> None:
    """Draw the steps of survival, their interval, and marks of censoring on them."""
    # before the first age all are alive; the share of an age holds up to the next one
    edges = np.append(table["age"], table["age"][-1] + 1)
    axes.stairs(table["survival"], edges, baseline=None, color=CURVE, linewidth=1.4,
                label="Kaplan-Meier")  # fmt: skip
    low, high = (np.append(table[name], table[name][-1]) for name in ("low", "high"))
    axes.fill_between(
        edges,
        low,
        high,
        step="post",
        color=BAND,
        linewidth=0.0,
        zorder=0.5,
        label="95 % interval",
    )
    ages = np.flatnonzero(table["censored"] > 0)
    if len(ages):
        chosen = ages[np.unique(np.linspace(0, len(ages) - 1, MOST_MARKS).round().astype(int))]
        what = "last seen alive (censored)"
        label = what if len(chosen) == len(ages) else f"{what}, not all marked"
        axes.plot(table["age"][chosen], table["survival"][chosen], "|", color=INK, markersize=6.0,
                  markeredgewidth=0.8, label=label)  # fmt: skip


def _draw_median(axes: Axes, median: MedianLife) -> None:
    """Draw the lines to the median, or say that it is not reached."""
    style: dict[str, Any] = {"color": INK, "linewidth": 0.8, "linestyle": ":"}
    if median.age is None:
        axes.axhline(0.5, label="median: not reached", **style)
        return
    said = f"median: {median.age:,} steps"
    axes.plot([0.0, median.age, median.age], [0.5, 0.5, 0.0], label=said, **style)


def _write_at_risk(axes: Axes, table: Mapping[str, NDArray]) -> None:
    """Write how many sources are at risk below the ticks of the ages."""
    from matplotlib.ticker import MaxNLocator

    last = int(table["age"][-1])
    ticks = MaxNLocator(nbins=N_AT_RISK, integer=True).tick_values(0, last)
    shown = [int(tick) for tick in ticks if 0 <= tick <= last]
    axes.set_xticks(shown)
    where: dict[str, Any] = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
    for age in shown:
        number = f"{int(table['at_risk'][age]):,}"
        axes.annotate(number, (age, 0.0), (0.0, -46.0), ha="center", fontsize=TEXT_SIZE,
                      color=INK, annotation_clip=False, **where)  # fmt: skip
    axes.annotate("at risk", (0.0, 0.0), (0.0, -34.0), xycoords="axes fraction", ha="left",
                  textcoords="offset points", fontsize=TEXT_SIZE, color=INK)  # fmt: skip
