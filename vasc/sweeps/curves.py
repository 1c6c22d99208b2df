"""Measures over an axis of a sweep: means, with the intervals that hold them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from vasc.render.styles import INK, SOURCE_COLORS, TEXT_SIZE
from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.plan import PlannedRun, is_number, value_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CONFIDENCE = 0.95
PANEL = (3.3, 2.6)
"""Width and height of a panel, in inches."""
MOST_COLUMNS = 3
PALE = "#b0b0b0"


@dataclass(frozen=True)
class Point:
    """The runs of one place on the axis.

    Parameters
    ----------
    x : float
        The place.
    mean : float
        Of the measure.
    half : float
        Half the width of the interval; 0 for a single run, of which nothing is known.
    """

    x: float
    mean: float
    half: float


def draw_curves(folder: SweepFolder) -> "Figure | None":
    """Draw every measure that is a number over the first axis, a curve a value of the second.

    A point is the mean over all runs with its values: replicates, and further axes and
    draws. Bars hold the mean with a confidence of 95 %, after Student. A flag is drawn as 0
    or 1, and a list of numbers, as a pair of connected primordia, as its last one.

    Parameters
    ----------
    folder : SweepFolder
        The folder, with its results.

    Returns
    -------
    Figure or None
        None if no measure is a number or no key has several values.
    """
    from matplotlib.figure import Figure

    sweep, runs = folder.description()["sweep"], folder.planned()
    results = {run.number: folder.result(run.number) or {} for run in runs}
    keys = [*sweep["axes"], *sweep["random"]]
    measures = [name for name in sweep["measures"] if _numbers(results.values(), name)]
    if not keys or not measures:
        return None
    columns = min(MOST_COLUMNS, len(measures))
    rows = -(-len(measures) // columns)
    title = sweep["title"]
    figure = Figure(
        figsize=(PANEL[0] * columns, PANEL[1] * rows + (0.3 if title else 0.0)),
        layout="constrained",
    )
    panels = figure.subplots(rows, columns, squeeze=False, sharex=True).ravel()
    for panel, name in zip(panels, measures, strict=False):
        values = {number: _number(result, name) for number, result in results.items()}
        _draw_panel(panel, sweep, runs, values, keys)
        panel.set_ylabel(name, size=TEXT_SIZE)
    if len(sweep["axes"]) > 1:
        _explain(figure, panels[0], keys[1])
    for panel in panels[len(measures) :]:
        panel.set_axis_off()
    if title:
        figure.suptitle(title, size=TEXT_SIZE + 1.0, color=INK)
    return figure


def intervals(pairs: Sequence[tuple[float, float]]) -> list[Point]:
    """Give means and intervals of values by place, in ascending order of the places.

    Examples
    --------
    >>> [point.mean for point in intervals([(2.0, 5.0), (1.0, 3.0), (1.0, 5.0)])]
    [4.0, 5.0]
    """
    from scipy.special import stdtrit

    points = []
    for x in sorted({place for place, _ in pairs}):
        values = [value for place, value in pairs if place == x]
        n = len(values)
        mean = math.fsum(values) / n
        half = 0.0
        if n > 1:
            variance = math.fsum((value - mean) ** 2 for value in values) / (n - 1)
            half = float(stdtrit(n - 1, 0.5 + CONFIDENCE / 2.0)) * math.sqrt(variance / n)
        points.append(Point(x, mean, half))
    return points


def _draw_panel(
    panel: "Axes",
    sweep: dict[str, Any],
    runs: list[PlannedRun],
    values: dict[int, float | None],
    keys: list[str],
) -> None:
    """Draw one measure."""
    first = keys[0]
    is_drawn = first in sweep["random"]
    second = keys[1] if len(sweep["axes"]) > 1 else None
    places, labels = _places([run.values[first] for run in runs])
    groups = list(dict.fromkeys(value_text(run.values[second]) for run in runs)) if second else [""]
    for index, group in enumerate(groups):
        pairs = [
            (places[value_text(run.values[first])], value)
            for run in runs
            if (value := values[run.number]) is not None
            and (second is None or value_text(run.values[second]) == group)
        ]
        color = SOURCE_COLORS[index % len(SOURCE_COLORS)]
        points = intervals(pairs)
        x, y = [point.x for point in points], [point.mean for point in points]
        if is_drawn:
            panel.plot(x, y, "o", color=color, markersize=3.0)
            continue
        single = ([x for x, _ in pairs], [y for _, y in pairs])
        panel.plot(*single, ".", color=PALE, markersize=2.0, zorder=0)
        panel.errorbar(
            x,
            y,
            [point.half for point in points],
            fmt="o-",
            color=color,
            markersize=3.0,
            linewidth=1.0,
            capsize=2.0,
            label=group,
        )
    _finish(panel, first, labels, _scale(sweep, first))


def _finish(panel: "Axes", first: str, labels: dict[float, str], scale: str) -> None:
    """Write what the axis is."""
    panel.set_xlabel(first, size=TEXT_SIZE)
    panel.tick_params(labelsize=TEXT_SIZE, labelbottom=True)
    for side in ("top", "right"):
        panel.spines[side].set_visible(False)
    if labels:
        panel.set_xticks(list(labels), list(labels.values()))
    elif scale == "log":
        panel.set_xscale("log")


def _explain(figure: "Figure", panel: "Axes", key: str) -> None:
    """Write what the colours are, beside the panels, where it covers no point."""
    size = TEXT_SIZE - 1.0
    figure.legend(
        *panel.get_legend_handles_labels(),
        title=key,
        loc="outside right upper",
        fontsize=size,
        title_fontsize=size,
        frameon=False,
    )


def _places(values: list[Any]) -> tuple[dict[str, float], dict[float, str]]:
    """Give the place of each value, and names for the places of values that are no numbers."""
    if all(is_number(value) for value in values):
        return {value_text(value): float(value) for value in values}, {}
    names = list(dict.fromkeys(value_text(value) for value in values))
    places = {name: float(index) for index, name in enumerate(names)}
    return places, {place: name for name, place in places.items()}


def _scale(sweep: dict[str, Any], key: str) -> str:
    """Give the scale of a key: that of its range, or for a list the one that spreads it evenly."""
    values = sweep["axes"].get(key, sweep["random"].get(key))
    if isinstance(values, dict):
        return str(values["scale"])
    numbers = sorted(value for value in values if is_number(value))
    if len(numbers) < 3 or numbers[0] <= 0 or numbers[-1] < 20 * numbers[0]:
        return "linear"
    return "log"


def _numbers(results: Any, name: str) -> list[float]:
    """Give the values of a measure that are numbers."""
    return [value for result in results if (value := _number(result, name)) is not None]


def _number(result: dict[str, Any], name: str) -> float | None:
    """Give a measure as a number: a flag as 0 or 1, of a list its last; None if it is none."""
    value = result.get("measures", {}).get(name)
    if isinstance(value, list) and value:
        value = value[-1]
    return float(value) if isinstance(value, bool | int | float) else None
