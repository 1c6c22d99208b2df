"""The leaves of a sweep in a grid: one axis from left to right, another from top to bottom."""

from typing import TYPE_CHECKING

from vasc.errors import VascError
from vasc.render.styles import INK, TEXT_SIZE
from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.plan import PlannedRun, value_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CELL = (2.0, 2.2)
"""Width and height of a leaf with its paper, in inches."""


def draw_grid(folder: SweepFolder) -> "Figure | None":
    """Draw the last step of the first run of every place in the grid.

    Parameters
    ----------
    folder : SweepFolder
        The folder, with its timelines.

    Returns
    -------
    Figure or None
        The columns are the values of the first axis, the rows those of the second. A run
        without a leaf leaves its place empty; None if all do.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    sweep = folder.description()["sweep"]
    across, down = [*sweep["axes"], None][:2]
    places: dict[tuple[str, str], PlannedRun] = {}
    for run in folder.planned():
        places.setdefault((_text(run, across), _text(run, down)), run)
    columns = list(dict.fromkeys(column for column, _ in places))
    rows = list(dict.fromkeys(row for _, row in places))
    figure = Figure(figsize=(CELL[0] * len(columns), CELL[1] * len(rows)), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(len(rows), len(columns), squeeze=False)
    n_drawn = 0
    for (column, row), run in places.items():
        y, x = rows.index(row), columns.index(column)
        n_drawn += _draw(panels[y, x], folder, run)
        if y == 0:
            panels[y, x].set_title(_label(across, column), size=TEXT_SIZE, color=INK)
        if x == 0 and down is not None:
            _write_row(panels[y, x], _label(down, row))
    return figure if n_drawn else None


def _draw(panel: "Axes", folder: SweepFolder, run: PlannedRun) -> bool:
    """Draw a leaf; tell whether there is one."""
    from vasc.analysis.run_widths import widths_of
    from vasc.render import draw_leaf
    from vasc.render.files import node_widths
    from vasc.timeline import Timeline

    panel.set_axis_off()
    try:
        with Timeline(folder.timeline(run.number)) as timeline:
            widths, step = widths_of(timeline.config), timeline.last_step
            stretched = node_widths(timeline, widths, [step])
            draw_leaf(
                timeline.frame(),
                panel,
                widths=widths,
                node_widths=stretched.get(step),
                scale_bar=False,
                units=timeline.units,
            )
    except VascError:
        return False
    return True


def _write_row(panel: "Axes", text: str) -> None:
    """Write what a row is to the left of it."""
    panel.text(
        -0.05,
        0.5,
        text,
        transform=panel.transAxes,
        rotation=90.0,
        ha="right",
        va="center",
        size=TEXT_SIZE,
        color=INK,
    )


def _text(run: PlannedRun, key: str | None) -> str:
    """Write the value of an axis; nothing without one."""
    return "" if key is None else value_text(run.values[key])


def _label(key: str, value: str) -> str:
    """Give the last word of a key with a value."""
    return f"{key.rpartition('.')[2].replace('_', ' ')} {value}"
