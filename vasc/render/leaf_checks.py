"""Simulated leaves beside real ones: a picture for each check, or one sheet of all."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vasc.render.leaf_panels import (
    TREE,
    draw_angles,
    draw_controls,
    draw_degrees,
    draw_densities,
    draw_distribution,
    draw_ends,
    draw_exponents,
    draw_other_program,
    draw_values,
    looks,
    mark,
)
from vasc.render.saving import save
from vasc.render.styles import INK, TEXT_SIZE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, FigureBase

PANEL = (4.2, 3.0)
"""Width and height of a panel, in inches."""
N_ACROSS = 4
"""Panels beside each other on a sheet."""
HEAD = 0.55
"""Height of title and key, in inches."""


@dataclass(frozen=True)
class Panel:
    """What draws a panel, and which numbers of the check it shows: none for what is no check.

    ``shown`` has the beginnings of the words of these numbers, ``n_down`` is its height in rows.
    """

    draw: Callable[[Axes, Mapping[str, Any]], None]
    shown: tuple[str, ...] = ("",)
    n_down: int = 1

    def checks(self, suite: Mapping[str, Any], number: int) -> list[Mapping[str, Any]]:
        """Give the checks of a number that it shows."""
        return [
            one
            for one in suite["checks"]
            if one["check"] == number and self.shown and one["what"].startswith(self.shown)
        ]


def _shares(key: str, *shown: str) -> Panel:
    """Give a panel of a distribution."""
    return Panel(partial(draw_distribution, key=key), shown)


def _values(number: int, what: str, species: str | None = None) -> Panel:
    """Give a panel of a number beside its range."""
    return Panel(partial(draw_values, number=number, what=what, species=species))


def _controls(words: str, real: str, *shown: str) -> Panel:
    """Give a panel of a number beside its shuffled control."""
    shuffled = f"{real.removesuffix('_median')}_shuffled"
    return Panel(partial(draw_controls, real=real, shuffled=shuffled, words=words), shown)


_PICTURES: dict[int, tuple[str, tuple[Panel, ...]]] = {
    6: ("junctions", (Panel(draw_degrees),)),
    7: (
        "areoles",
        (
            _shares("area", "area"),
            _shares("corners", "corners"),
            _shares("elongation", "elongation"),
            _shares("circularity", "circularity"),
        ),
    ),
    8: (
        "vein density and areoles",
        (
            _values(8, "enclosed vein density x root of mean areole area", "density_x_sqrt_areole"),
            _shares("length"),
        ),
    ),
    9: (
        "distance to vein",
        (_shares("distance"), _values(9, "enclosed vein density x mean distance to vein")),
    ),
    10: ("free ends", (Panel(draw_ends),)),
    11: ("spanning tree", (_values(11, "spanning tree over all veins, closed", "mst_ratio"),)),
    12: (
        "angles and widths",
        (
            Panel(draw_angles, ("angle",)),
            _controls("median force residual", "bohn_residual_median", "force"),
        ),
    ),
    13: ("loops within loops", (_controls("loop asymmetry", "loop_asymmetry", "loop"),)),
    14: ("Murray's law", (Panel(draw_exponents),)),
    15: ("densities in growth", (Panel(draw_densities),)),
    17: ("the measuring itself", (Panel(draw_other_program, n_down=2),)),
}
"""By check: title, and its panels."""
_NAMED = (10, 11, 13, 17)
"""Checks whose pictures name the leaves already."""


def draw_leaf_check(suite: Mapping[str, Any], number: int) -> Figure:
    """Draw one check of the leaves.

    Parameters
    ----------
    suite : mapping
        What ``vasc validate leaf --json`` gives of the suite.
    number : int
        The check, as 12.

    Returns
    -------
    Figure
        Panels side by side, two in a row.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    title, panels = _PICTURES[number]
    n_across = min(len(panels), 2)
    n_down = -(-len(panels) // n_across) * panels[0].n_down
    width = max(n_across * PANEL[0], 1.5 * PANEL[0])
    figure = Figure(figsize=(width, n_down * PANEL[1] + HEAD), layout="constrained")
    FigureCanvasAgg(figure)
    rows = n_down // panels[0].n_down
    axes = figure.subplots(rows, n_across, squeeze=False).ravel()
    for ax, panel in zip(axes, panels, strict=True):
        panel.draw(ax, suite)
        mark(ax, number, panel.checks(suite, number))
    n_columns = 0 if number in _NAMED else 2
    # densities are those of growing leaves alone, exponents those of open venation
    leaves = {14: (), 15: suite["curves"]["densities"]}.get(number)
    _head(figure, suite, f"Check {number}: {title}", n_columns, leaves, number)
    return figure


def draw_leaf_checks(suite: Mapping[str, Any]) -> Figure:
    """Draw all checks of the leaves on one sheet.

    Parameters
    ----------
    suite : mapping
        What ``vasc validate leaf --json`` gives of the suite.

    Returns
    -------
    Figure
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    panels = [(number, panel) for number in drawn(suite) for panel in _PICTURES[number][1]]
    # a higher panel stands at the lower right, and the others around it
    panels.sort(key=lambda one: one[1].n_down)
    n_cells = sum(panel.n_down for _, panel in panels)
    n_down = max(-(-n_cells // N_ACROSS), panels[-1][1].n_down)
    size = (N_ACROSS * PANEL[0], n_down * PANEL[1] + 2.0 * HEAD)
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(n_down, N_ACROSS)
    free = [(row, column) for row in range(n_down) for column in range(N_ACROSS)]
    if (high := panels[-1][1].n_down) > 1:
        free = [cell for cell in free if cell[1] < N_ACROSS - 1 or cell[0] < n_down - high]
        free.append((n_down - high, N_ACROSS - 1))
        free[len(panels) - 1 : -1] = []
    for (row, column), (number, panel) in zip(free, panels, strict=False):
        ax = figure.add_subplot(grid[row : row + panel.n_down, column])
        panel.draw(ax, suite)
        mark(ax, number, panel.checks(suite, number))
    own = [one["pass"] for one in suite["checks"] if one["leaf"] not in suite["curves"]["real"]]
    title = f"Leaves beside a real one: {own.count(True)} of their {len(own)} checks pass"
    title += f", {own.count(None)} cannot be decided" if None in own else ""
    _head(figure, suite, title, n_columns=4)
    return figure


def drawn(suite: Mapping[str, Any]) -> list[int]:
    """Give the checks of which a suite has something to draw."""
    asked = {one["check"] for one in suite["checks"]}
    # free ends are drawn even where nothing is asked of them
    needed = {10: True, 14: bool(suite["exponents"]), 15: bool(suite["curves"]["densities"])}
    return [number for number in _PICTURES if needed.get(number, number in asked)]


def save_leaf_checks(suite: Mapping[str, Any], output: str | Path) -> list[Path]:
    """Write the checks of the leaves as one sheet, or each into a folder.

    Parameters
    ----------
    suite : mapping
        What ``vasc validate leaf --json`` gives of the suite.
    output : path
        A picture by its suffix, or an existing folder.

    Returns
    -------
    list of Path
        What was written; old pictures are replaced.

    Raises
    ------
    OutputError
        If the suffix is none of a picture.
    """
    output = Path(output)
    if not output.is_dir():
        save(draw_leaf_checks(suite), output)
        return [output]
    paths = check_pictures(output, drawn(suite))
    for number, path in zip(drawn(suite), paths, strict=True):
        save(draw_leaf_check(suite, number), path)
    return paths


def check_pictures(folder: Path, numbers: Iterable[int] = tuple(_PICTURES)) -> list[Path]:
    """Give the names of the pictures of checks in a folder; of all checks if none are named."""
    return [folder / f"check-{number}.png" for number in numbers]


def _head(
    figure: FigureBase,
    suite: Mapping[str, Any],
    title: str,
    n_columns: int,
    leaves: Container[str] | None = None,
    number: int | None = None,
) -> None:
    """Write the title, and which color is which leaf, in so many columns; 0 for no key."""
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], color=color, marker=marker, markersize=5.0, linewidth=1.3, label=name)
        for name, (color, marker) in looks(suite).items()
        if leaves is None or name in leaves
    ]
    trees = suite["curves"]["trees"]
    if trees and number in (None, 14):
        label = f"{', '.join(trees)} (open venation)"
        handles.append(Line2D([], [], color=TREE, linewidth=5.0, label=label))
    figure.suptitle(title, fontsize=TEXT_SIZE + 4.0, color=INK)
    if n_columns == 0:
        return
    figure.legend(
        handles=handles,
        loc="outside lower center",
        ncols=n_columns,
        fontsize=TEXT_SIZE + 1.0,
        frameon=False,
    )
