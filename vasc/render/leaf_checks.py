"""Simulated leaves beside real ones: a picture for each check, or one sheet of all."""

from __future__ import annotations

from collections.abc import Container, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vasc.render.leaf_panels import (
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
)
from vasc.render.saving import save
from vasc.render.styles import INK, TEXT_SIZE

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase

PANEL = (3.6, 2.5)
"""Width and height of a panel, in inches."""
HEAD = 0.55
"""Height of title and key, in inches."""

_RESIDUAL = ("bohn_residual_median", "bohn_residual_shuffled", "median force residual")
_ASYMMETRY = ("loop_asymmetry", "loop_asymmetry_shuffled", "loop asymmetry")
_PICTURES: dict[int, tuple[str, tuple[Any, ...]]] = {
    6: ("junctions", (draw_degrees,)),
    7: (
        "areoles",
        tuple(
            partial(draw_distribution, key=key)
            for key in ("area", "corners", "elongation", "circularity")
        ),
    ),
    8: (
        "vein density and areoles",
        (
            partial(
                draw_values,
                number=8,
                what="vein density x root of mean areole area",
                species="density_x_sqrt_areole",
            ),
            partial(draw_distribution, key="length"),
        ),
    ),
    9: (
        "distance to vein",
        (
            partial(draw_distribution, key="distance"),
            partial(draw_values, number=9, what="vein density x mean distance to vein"),
        ),
    ),
    10: ("free ends", (draw_ends,)),
    11: (
        "spanning tree",
        (
            partial(
                draw_values,
                number=11,
                what="spanning tree over all veins, closed",
                species="mst_ratio",
            ),
        ),
    ),
    12: (
        "angles and widths",
        (
            draw_angles,
            partial(draw_controls, real=_RESIDUAL[0], shuffled=_RESIDUAL[1], words=_RESIDUAL[2]),
        ),
    ),
    13: (
        "loops within loops",
        (partial(draw_controls, real=_ASYMMETRY[0], shuffled=_ASYMMETRY[1], words=_ASYMMETRY[2]),),
    ),
    14: ("Murray's law", (draw_exponents,)),
    15: ("densities in growth", (draw_densities,)),
    17: ("the measuring itself", (draw_other_program,)),
}
"""By check: title, and what draws each panel."""
_NAMED = (10, 11, 13, 14, 17)
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
    n_down = -(-len(panels) // n_across)
    width = max(n_across * PANEL[0], 1.5 * PANEL[0])
    figure = Figure(figsize=(width, n_down * PANEL[1] + HEAD), layout="constrained")
    FigureCanvasAgg(figure)
    for ax, draw in zip(
        figure.subplots(n_down, n_across, squeeze=False).ravel(), panels, strict=True
    ):
        draw(ax, suite)
    n_columns = 0 if number in _NAMED else 2
    # densities are those of growing leaves alone
    leaves = suite["curves"]["densities"] if number == 15 else None
    _head(figure, suite, f"Check {number}: {title}", n_columns, leaves)
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

    panels = [(number, draw) for number, (_, draws) in _PICTURES.items() for draw in draws]
    n_across = 4
    n_down = -(-len(panels) // n_across)
    size = (n_across * PANEL[0], n_down * PANEL[1] + 2.0 * HEAD)
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(n_down, n_across).ravel()
    for ax, (number, draw) in zip(axes, panels, strict=False):
        draw(ax, suite)
        ax.set_title(f"check {number}", fontsize=TEXT_SIZE, color=INK, loc="left")
    for ax in axes[len(panels) :]:
        ax.set_axis_off()
    _head(figure, suite, "Simulated leaves and a real one", n_columns=4)
    return figure


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
    paths = []
    for number in _PICTURES:
        path = output / f"check-{number}.png"
        save(draw_leaf_check(suite, number), path)
        paths.append(path)
    return paths


def _head(
    figure: FigureBase,
    suite: Mapping[str, Any],
    title: str,
    n_columns: int,
    leaves: Container[str] | None = None,
) -> None:
    """Write the title, and which color is which leaf, in so many columns; 0 for no key."""
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], color=color, marker=marker, markersize=5.0, linewidth=1.3, label=name)
        for name, (color, marker) in looks(suite).items()
        if leaves is None or name in leaves
    ]
    figure.suptitle(title, fontsize=TEXT_SIZE + 2.0, color=INK)
    if n_columns == 0:
        return
    figure.legend(
        handles=handles,
        loc="outside lower center",
        ncols=n_columns,
        fontsize=TEXT_SIZE - 1.0,
        frameon=False,
    )
