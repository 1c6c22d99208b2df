"""Connectivity of stems against the ratio of radius to rise, with the predicted thresholds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from vasc.render.styles import INK, TEXT_SIZE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RIGHT, WRONG = "#3f7d32", "#b3261e"
"""Stems that connect as predicted, and others."""
SHADES = ("#f1f5ec", "#dde9d2")


def draw_transitions(
    stems: Sequence[Mapping[str, Any]], thresholds: Mapping[float, Sequence[Mapping[str, Any]]]
) -> Figure:
    """Draw what stems connect against R/H, a row for each divergence angle.

    Parameters
    ----------
    stems : sequence of mappings
        ``divergence`` (degrees), ``ratio``, ``pair``, ``predicted`` and ``fraction`` of each stem.
    thresholds : mapping of float to sequence of mappings
        By divergence, the intervals ``low``, ``high`` of the ratio with one predicted ``pair``.

    Returns
    -------
    Figure
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 3.2 * len(thresholds)), layout="constrained")
    FigureCanvasAgg(figure)
    rows = figure.subplots(len(thresholds), 1, squeeze=False)[:, 0]
    for ax, (divergence, intervals) in zip(rows, thresholds.items(), strict=True):
        own = [stem for stem in stems if stem["divergence"] == divergence]
        _draw_row(ax, divergence, own, intervals)
    rows[-1].set_xlabel("radius over rise, R/H", fontsize=TEXT_SIZE)
    return figure


def _draw_row(
    ax: Axes,
    divergence: float,
    stems: Sequence[Mapping[str, Any]],
    intervals: Sequence[Mapping[str, Any]],
) -> None:
    """Draw the stems of one divergence over the intervals predicted for it."""
    ratios = [stem["ratio"] for stem in stems]
    low, high = 0.9 * min(ratios), 1.1 * max(ratios)
    ax.set(xscale="log", xlim=(low, high), ylim=(0.0, 1.25))
    for number, one in enumerate(intervals):
        left, right = max(one["low"], low), min(one["high"], high)
        if left >= right:
            continue
        ax.axvspan(left, right, color=SHADES[number % 2], linewidth=0.0)
        ax.text((left * right) ** 0.5, 1.14, _named(one["pair"]), ha="center", fontsize=TEXT_SIZE)
    for stem in stems:
        is_right = list(stem["pair"]) == list(stem["predicted"])
        color = RIGHT if is_right else WRONG
        ax.plot(stem["ratio"], stem["fraction"], "o", color=color, markersize=5.0)
        if not is_right:
            ax.annotate(_named(stem["pair"]), (stem["ratio"], stem["fraction"]), fontsize=TEXT_SIZE)
    ticks = [tick for tick in (1, 2, 3, 5, 10, 20) if low <= tick <= high]
    ax.set_xticks(ticks, [str(tick) for tick in ticks])
    ax.minorticks_off()
    ax.set_title(f"divergence {divergence:g}°", fontsize=TEXT_SIZE, color=INK, loc="left")
    ax.set_ylabel("share of primordia\nwith exactly the pair", fontsize=TEXT_SIZE)
    ax.tick_params(labelsize=TEXT_SIZE)


def _named(pair: Sequence[int]) -> str:
    """Write a pair."""
    return f"({', '.join(map(str, pair))})"
