"""
Figure 4.9: canals by Mitchison's model
=======================================

Mitchison's model with two sinks and one source: a strand forms to the nearer.
"""

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from panels import grown, letter, output_of

from vasc.analysis.tissue_units import CONCENTRATIONS
from vasc.render import TissueStyle, View, draw_tissue, save, scale_of
from vasc.state import State

WIDTH, HEIGHT = 7.0, 7.35
"""Of the figure, in the measure of its panels, about an inch."""
COLUMNS, ROWS = 31, 17
SINKS = ((5, 16), (25, 16))
SOURCES = {"b": None, "c": (12, 4), "d": (18, 4)}
TRANSPORTS = {
    "pool": "polar transport, a pool of carriers a cell",
    "facilitated": "facilitated diffusion",
}
CORNER = {"pool": (12.0, 14.0), "facilitated": (6.0, 5.0)}
"""Middle of the cells that explain the symbols."""
WORDS = {
    "pool": {
        "dark: much\nauxin": ((-0.4, 1.3), (-2.7, 0.7)),
        "light: little": ((-1.3, -0.9), (-2.7, -0.9)),
        "arrow: flux": ((0.0, -0.5), (2.7, -1.0)),
        "bar: carriers\non this side": ((0.35, 0.37), (2.7, 0.2)),
        "green line:\nnew vein": ((0.05, 0.9), (2.7, 1.1)),
    },
    "facilitated": {
        "little auxin\nin a canal": ((0.0, 0.4), (-2.7, 0.9)),
        "arrow: flux": ((-1.0, 0.6), (-2.7, -0.5)),
        "bar: permeable\nwall": ((1.5, -0.9), (2.7, 0.6)),
        "green line:\nnew vein": ((2.0, -1.05), (2.7, -0.8)),
    },
}
STYLE = TissueStyle(least_flux=0.01)
BACKGROUND = 0.5
"""What all cells make together, over the source: the tissue is polarized before it appears."""


def experiment(transport: str, source: tuple[int, int] | None) -> list[State]:
    """Let the tissue come to rest with two sinks, then with a source as well."""
    return grown(
        "canalization",
        domain={"columns": COLUMNS, "rows": ROWS},
        veins={"lines": [[sink] for sink in SINKS]},
        placement={"points": [] if source is None else [source]},
        background=BACKGROUND,
        transport={"kind": transport},
    )


def explain(ax: Axes, state: State, middle: tuple[float, float], words: dict) -> None:
    """Draw a few cells large, and say what the symbols mean."""
    x, y = middle
    view = View((x - 5.4, y - 1.52, x + 5.4, y + 1.52), 22.8)
    draw_tissue(state, ax, scale_bar=False, key=False, title=False, view=view)
    x0, x1 = x - 2.5, x + 2.5
    for rest in (Rectangle((x0 - 20, y - 9), 20, 18), Rectangle((x1, y - 9), 20, 18)):
        rest.set(facecolor="white", edgecolor="none", zorder=6)
        ax.add_patch(rest)
    for text, (place, at) in words.items():
        is_left = at[0] < 0
        ax.annotate(
            text,
            xy=(x + place[0], y + place[1]),
            xytext=(x + at[0], y + at[1]),
            ha="right" if is_left else "left",
            va="center",
            fontsize=7,
            zorder=9,
            arrowprops={"arrowstyle": "-", "linewidth": 0.6, "shrinkA": 1, "shrinkB": 0},
        )


def panel(figure: Figure, place: tuple[float, float, float, float]) -> Axes:
    """Add a panel, measured from the upper left corner of the figure."""
    left, top, across, down = place
    bottom = HEIGHT - top - down
    return figure.add_axes((left / WIDTH, bottom / HEIGHT, across / WIDTH, down / HEIGHT))


def main(output: Path) -> None:
    """Draw the figure."""
    figure = Figure(figsize=(6.66, 6.99), facecolor="white")
    FigureCanvasAgg(figure)
    for column, (transport, name) in enumerate(TRANSPORTS.items()):
        left = 0.05 + 3.48 * column
        states = {at: experiment(transport, source)[-1] for at, source in SOURCES.items()}
        scale = scale_of(states.values())
        figure.text(
            (left + 1.71) / WIDTH, 1 - 0.13 / HEIGHT, name, ha="center", va="center", fontsize=9
        )
        ax = panel(figure, (left, 0.27, 3.42, 0.96))
        explain(ax, states["c"], CORNER[transport], WORDS[transport])
        letter(ax, "a)")
        tops = {"b": 1.3, "c": 3.21, "d": 5.12}
        for at, state in states.items():
            is_last = at == "d"
            ax = panel(figure, (left, tops[at], 3.42, 2.16 if is_last else 1.88))
            draw_tissue(
                state,
                ax,
                scale=scale,
                unit=CONCENTRATIONS[transport],
                scale_bar=False,
                title=False,
                key=is_last,
                style=STYLE,
            )
            letter(ax, f"{at})")
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
