"""The events of a run beside the sequence observed in nature, as one picture."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vasc.render.saving import save
from vasc.render.styles import INK, TEXT_SIZE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LINE = 0.19
"""Height of a line of text, in inches."""
WORDS_WIDTH = 68
"""Characters of a line of the observed sequence."""
SIZE = (11.0, 1.1)
"""Width of the picture and height of title and axis together, in inches."""
WORDS_SHARE, AXES_SHARE = 0.42, 0.56
"""Shares of the width that the observed sequence and the axes take."""
INDENT = 0.96
"""Where the observed sequence begins, in its width to the left of the axes."""
FORWARD, BACKWARD = "#4f8a3c", "#c8102e"
"""From one event to the next in the observed order: as observed, or the other way round."""
PALE = "#8a8a8a"


def draw_sequence(report: Mapping[str, Any], output: str | Path) -> Path:
    """Write a picture of the events of a run beside the observed sequence.

    Every event stands in the row of the observation that it answers to, at its
    step; a line follows the observed order and turns red where the run goes back.

    Parameters
    ----------
    report : mapping
        What ``vasc check sequence --json`` gives: ``observed``, ``events``,
        ``criteria`` and ``run`` are drawn.
    output : path
        The picture; png, svg or pdf by its suffix. An old one is replaced.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    OutputError
        If the suffix is none of these, or the folder does not exist.
    """
    from matplotlib.figure import Figure

    events = {event["name"]: event for event in report["events"]}
    rows = [_row(one, events) for one in report["observed"]]
    tops = [0.0]
    for words, found in rows:
        tops.append(tops[-1] + max(len(words), len(found)) + 1.0)
    height = tops[-1] * LINE
    figure = Figure(figsize=(SIZE[0], height + SIZE[1]))
    axes = figure.add_axes(
        (WORDS_SHARE, 0.55 / (height + SIZE[1]), AXES_SHARE, height / (height + SIZE[1]))
    )
    axes.set_ylim(tops[-1], 0.0)
    last = max(float(report["run"]["steps"]), 1.0)
    # names of events stand to the right of them
    axes.set_xlim(-0.02 * last, 1.4 * last)
    for (words, found), top, bottom in zip(rows, tops[:-1], tops[1:], strict=True):
        _write_words(axes, words, top)
        axes.axhline(bottom, color=PALE, linewidth=0.4)
        _write_events(axes, found, top)
    _follow(axes, list(_points(rows, tops)))
    _finish(axes, report, last)
    save(figure, output)
    return Path(output)


def _row(
    observed: Mapping[str, Any], events: Mapping[str, Mapping[str, Any]]
) -> tuple[list[str], list[tuple[str, Mapping[str, Any] | None]]]:
    """Give the lines of an observation, and the events that answer to it."""
    lines = textwrap.wrap(f"{observed['number']}. {observed['words']}", WORDS_WIDTH)
    sources = "; ".join(observed["sources"])
    return [*lines, f"({sources})"], [(name, events.get(name)) for name in observed["events"]]


def _write_words(axes: Axes, words: list[str], top: float) -> None:
    """Write an observation to the left of the axes."""
    for line, text in enumerate(words):
        is_source = line == len(words) - 1
        axes.annotate(
            text,
            (0.0, top + line + 1.0),
            xycoords=("axes fraction", "data"),
            xytext=(-INDENT * WORDS_SHARE * SIZE[0] * 72.0, 0.0),
            textcoords="offset points",
            size=TEXT_SIZE * (0.85 if is_source else 1.0),
            color=PALE if is_source else INK,
            va="center",
            annotation_clip=False,
        )


def _write_events(
    axes: Axes, found: list[tuple[str, Mapping[str, Any] | None]], top: float
) -> None:
    """Mark the events of one observation."""
    from matplotlib.patheffects import withStroke

    if not found:
        axes.text(0.0, top + 1.0, "no single event", size=TEXT_SIZE, color=PALE, va="center")
    for line, (name, event) in enumerate(found):
        y = top + line + 1.0
        title = name.replace("_", " ")
        if event is None:
            axes.text(0.0, y, f"{title}: not seen", size=TEXT_SIZE, color=PALE, va="center")
            continue
        text = f"  {title}: step {event['step']}, leaf {event['leaf_length']:.3g} D"
        axes.plot(event["step"], y, "o", color=INK, markersize=4.0)
        label = axes.text(event["step"], y, text, size=TEXT_SIZE, color=INK, va="center")
        label.set_path_effects([withStroke(linewidth=2.0, foreground="white")])


def _points(
    rows: list[tuple[list[str], list[tuple[str, Mapping[str, Any] | None]]]], tops: list[float]
) -> Iterator[tuple[float, float]]:
    """Give where the events are that occurred, in the observed order."""
    for (_, found), top in zip(rows, tops[:-1], strict=True):
        for line, (_, event) in enumerate(found):
            if event is not None:
                yield float(event["step"]), top + line + 1.0


def _follow(axes: Axes, points: list[tuple[float, float]]) -> None:
    """Lead a line through the events in the observed order."""
    for (x, y), (next_x, next_y) in pairwise(points):
        color = FORWARD if next_x >= x else BACKWARD
        axes.plot([x, next_x], [y, next_y], color=color, linewidth=0.8, zorder=0)


def _finish(axes: Axes, report: Mapping[str, Any], last: float) -> None:
    """Write title and axis."""
    verdicts = [row["passed"] for row in report["criteria"]]
    failures = ", ".join(report["failures"]) or "none"
    counts = f"{verdicts.count(True)} of {len(verdicts)} criteria pass; failures: {failures}"
    axes.set_title(f"{report['run']['file']}: {counts}", size=TEXT_SIZE + 1.0, color=INK)
    axes.text(
        -INDENT * WORDS_SHARE / AXES_SHARE,
        1.0,
        "observed in the first leaf of Arabidopsis",
        transform=axes.transAxes,
        size=TEXT_SIZE + 1.0,
        color=INK,
        va="bottom",
    )
    axes.set_xlabel("step", size=TEXT_SIZE)
    axes.set_xticks([tick for tick in axes.get_xticks() if 0.0 <= tick <= last])
    axes.set_yticks([])
    axes.tick_params(labelsize=TEXT_SIZE)
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
