"""The genealogy of areoles: first-order loops in colour on the blade, and their trees of splits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.run_widths import widths_of
from vasc.arrays import Points
from vasc.errors import VascError
from vasc.render.files import node_widths
from vasc.render.leaf import draw_leaf, view_of
from vasc.render.styles import INK, SOURCE_COLORS, TEXT_SIZE, LeafStyle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from vasc.timeline import Genealogy, Timeline

SIDE, TREES = 7.0, 5.0
"""Longer side of the blade's part, and width of the part with the trees, in inches."""
LEFT, RIGHT, BELOW, ABOVE = 0.5, 0.25, 0.9, 0.3
"""Room around the trees, in inches."""
KEY = 0.42
"""Distance of the key below them, in inches."""
NUMBER = 0.1
"""Half the height of a number of a tree, with its disc, in inches."""
ROWS = 60
"""Numbers of trees that fit above each other."""
MOST_TREES = 24
"""First-order loops that have a colour, a number and a tree: those with most parts."""
PALEST = 0.55
"""Share of white in the colour of the latest generation."""
DARKER = 0.68
"""By which a colour is multiplied when it is taken for another loop: no two loops are alike."""
MOST_SHADES = 5
"""Generations that the key shows; of more, first, middle and last."""
OTHERS = "#c9d4c4"
"""Areoles of loops beyond these."""


@dataclass(frozen=True)
class _Shown:
    """The trees to draw.

    ``loops`` are the first-order loops that are shown, by the step of birth; ``colors`` has
    a colour for every areole, and ``heights`` the place of each in the trees, nan for none.
    """

    tree: Genealogy
    roots: NDArray[np.int32]
    loops: list[int]
    colors: list[str]
    heights: NDArray[np.float64]


def draw_genealogy(timeline: Timeline, step: int = -1, *, style: LeafStyle | None = None) -> Figure:
    """Draw the areoles of a step in the colour of their first-order loop, beside their trees.

    On the blade every areole has the colour of the first-order loop that it lies in, paler
    the more splits led to it. In a tree, a line runs from the birth of an areole to its
    split, where it forks; the numbers of first-order loops link both.

    Parameters
    ----------
    timeline : Timeline
        An open timeline of a leaf.
    step : int
        The step, the last one when not given.
    style : LeafStyle, optional
        Colours of blade, veins and paper.

    Returns
    -------
    Figure

    Raises
    ------
    TimelineError
        If the step is not recorded, or the run is one of a stem.
    VascError
        If no loop is closed at that step.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    style = LeafStyle() if style is None else style
    frame = timeline.frame(step)
    tree = timeline.lineage.genealogy(frame.step)
    if not tree.n_areoles:
        raise VascError(f"{timeline.path}: no loop is closed at step {frame.step}")
    shown = _shown(tree)
    view = view_of(frame.blade, style, side=SIDE)
    height = max(view.inches[1], 0.6 * SIDE)
    width = view.inches[0] + TREES
    figure = Figure(figsize=(width + 1e-6, height + 1e-6), facecolor=style.background)
    FigureCanvasAgg(figure)
    blade = figure.add_axes((0.0, 0.0, view.inches[0] / width, view.inches[1] / height))
    asked = widths_of(timeline.config)
    draw_leaf(
        frame,
        blade,
        widths=asked,
        node_widths=node_widths(timeline, asked, [frame.step]).get(frame.step),
        units=timeline.units,
        style=style,
        view=view,
    )
    _fill(blade, shown, frame.positions)
    left = (view.inches[0] + LEFT) / width
    trees = figure.add_axes(
        (
            left,
            BELOW / height,
            1.0 - left - RIGHT / width,
            1.0 - (BELOW + ABOVE) / height,
        )
    )
    _draw_trees(trees, shown, frame.step)
    return figure


def _shown(tree: Genealogy) -> _Shown:
    """Choose the loops with most parts, and give each areole a colour and a place."""
    from matplotlib.colors import to_hex, to_rgb

    roots, generations = tree.roots, tree.generations
    sizes = np.bincount(roots, minlength=tree.n_areoles)
    largest = np.argsort(-sizes, kind="stable")[:MOST_TREES]
    loops = sorted(largest[sizes[largest] > 0].tolist())
    colors = [OTHERS] * tree.n_areoles
    deepest = _deepest(generations[np.isin(roots, loops)])
    for place, loop in enumerate(loops):
        again, row = divmod(place, len(SOURCE_COLORS))
        plain = np.array(to_rgb(SOURCE_COLORS[row])) * DARKER**again
        for areole in np.flatnonzero(roots == loop).tolist():
            white = PALEST * int(generations[areole]) / deepest
            red, green, blue = (plain * (1.0 - white) + white).tolist()
            colors[areole] = to_hex((red, green, blue))
    return _Shown(tree, roots, loops, colors, _heights(tree, loops))


def _heights(tree: Genealogy, loops: list[int]) -> NDArray[np.float64]:
    """Place whole areoles one above the other, and a split one between its parts."""
    children: dict[int, list[int]] = {}
    for areole, parent in enumerate(tree.parents.tolist()):
        children.setdefault(parent, []).append(areole)
    heights = np.full(tree.n_areoles, np.nan)
    n_whole = sum(1 for areole in range(tree.n_areoles) if areole not in children)
    # a tree is at least as high as its number, which takes one of so many rows
    least = n_whole / max(ROWS - len(loops), 1)
    place = 0.0
    for loop in loops:
        # parts after what they are parts of; the tree may be deeper than calls may be
        order, waiting = [], [loop]
        while waiting:
            order.append(waiting.pop())
            waiting += children.get(order[-1], [])[::-1]
        begin = place
        for areole in order:
            if not children.get(areole):
                heights[areole] = place
                place += 1.0
        for areole in reversed(order):
            if children.get(areole):
                heights[areole] = heights[children[areole]].mean()
        # a gap between two trees
        place = max(place + max(1.0, 0.02 * len(loops)), begin + least)
    return heights


def _fill(axes: Axes, shown: _Shown, positions: Points) -> None:
    """Fill the whole areoles, and number the first-order loops."""
    from matplotlib.collections import PolyCollection

    rings = shown.tree.boundaries
    axes.add_collection(
        PolyCollection(
            [positions[ring] for ring in rings.values()],
            facecolors=[shown.colors[areole] for areole in rings],
            linewidths=0.0,
            # between the blade and the veins
            zorder=1.5,
        ),
        autolim=False,
    )
    for loop in shown.loops:
        parts = [positions[ring] for areole, ring in rings.items() if shown.roots[areole] == loop]
        if parts:
            # of the largest part, so that a number never lies outside its loop
            largest = max(parts, key=lambda part: float(np.ptp(part, axis=0).prod()))
            x, y = largest.mean(axis=0).tolist()
            _number(axes, x, y, loop)


def _draw_trees(axes: Axes, shown: _Shown, step: int) -> None:
    """Draw a line a life, and forks where areoles were split."""
    from matplotlib.collections import LineCollection
    from matplotlib.ticker import MaxNLocator

    tree, heights = shown.tree, shown.heights
    drawn = np.flatnonzero(~np.isnan(heights))
    ends = np.where(tree.splits < 0, step, tree.splits)
    lives = [[(tree.births[k], heights[k]), (ends[k], heights[k])] for k in drawn]
    colors = [shown.colors[k] for k in drawn]
    parts = [k for k in drawn if tree.parents[k] >= 0]
    forks = [
        [(tree.births[k], heights[tree.parents[k]]), (tree.births[k], heights[k])] for k in parts
    ]
    thick = float(np.clip(250.0 / max(len(drawn), 1), 0.5, 2.0))
    for lines, inks in ((forks, [shown.colors[k] for k in parts]), (lives, colors)):
        axes.add_collection(LineCollection(lines, colors=inks, linewidths=thick), autolim=False)
    first = float(tree.births[drawn].min())
    # after the last birth or split there are only lines that go on
    last = float(max(tree.births[drawn].max(), tree.splits[drawn].max()))
    last = min(last + 0.15 * (last - first) + 1.0, step + 1.0)
    axes.set_xlim(first - 0.08 * (last - first) - 1.0, last)
    highest = float(np.nanmax(heights))
    room = _room_for_numbers(axes, highest)
    axes.set_ylim(-room, highest + room)
    for loop in shown.loops:
        _number(axes, float(tree.births[loop]), float(heights[loop]), loop)
    axes.set_yticks([])
    axes.xaxis.set_major_locator(MaxNLocator(nbins=7, integer=True))
    axes.spines[["left", "right", "top"]].set_visible(False)
    axes.tick_params(labelsize=TEXT_SIZE, colors=INK, width=0.5)
    axes.set_xlabel("step of birth and of split", fontsize=TEXT_SIZE, color=INK)
    axes.set_ylabel(
        "areoles, by the number of their first-order loop", fontsize=TEXT_SIZE, color=INK
    )
    _draw_key(axes, shown)
    n_loops = int((tree.parents < 0).sum())
    what = f"{n_loops} first-order loops"
    if n_loops > len(shown.loops):
        what = f"the {len(shown.loops)} first-order loops with most parts, of {n_loops}"
    axes.set_title(f"splits of {what}", fontsize=TEXT_SIZE + 1.0, color=INK)


def _room_for_numbers(axes: Axes, highest: float) -> float:
    """Give the rows that half a number takes above and below the trees, however dense they are."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    inches = axes.get_position().height * float(figure.get_size_inches()[1])
    return max(1.5, highest * NUMBER / (inches - 2.0 * NUMBER))


def _draw_key(axes: Axes, shown: _Shown) -> None:
    """Say below the trees what shades mean, and which areoles have no colour."""
    from matplotlib.patches import Patch

    generations = shown.tree.generations[np.isin(shown.tree.roots, shown.loops)]
    deepest = _deepest(generations)
    told = list(range(deepest + 1))
    if len(told) > MOST_SHADES:
        told = [0, deepest // 2, deepest]
    gray = np.array([0.35, 0.35, 0.35])
    handles = []
    for splits in told:
        white = PALEST * splits / deepest
        label = f"after {splits} split{'s' if splits > 1 else ''}" if splits else "loop itself"
        handles.append(Patch(facecolor=tuple(gray * (1.0 - white) + white), label=label))
    if len(shown.loops) < len(np.unique(shown.tree.roots)):
        handles.append(Patch(facecolor=OTHERS, label="in another loop"))
    figure = axes.get_figure(root=True)
    assert figure is not None
    height = float(figure.get_size_inches()[1])
    axes.legend(
        handles=handles,
        title="hue: first-order loop; shade: splits before the areole",
        loc="upper center",
        bbox_to_anchor=(0.5, -KEY / axes.get_position().height / height),
        ncols=len(handles),
        fontsize=TEXT_SIZE - 1.0,
        title_fontsize=TEXT_SIZE - 1.0,
        frameon=False,
        labelcolor=INK,
        handlelength=1.0,
        columnspacing=1.2,
        borderaxespad=0.0,
    )


def _deepest(generations: NDArray[np.int32]) -> int:
    """Give the highest generation, 1 at least."""
    return max(int(generations.max(initial=0)), 1)


def _number(axes: Axes, x: float, y: float, loop: int) -> None:
    """Write the number of a loop on a small pale disc."""
    axes.text(
        x,
        y,
        str(loop),
        ha="center",
        va="center",
        fontsize=TEXT_SIZE - 2.0,
        color=INK,
        zorder=6.0,
        clip_on=True,
        bbox={"boxstyle": "round,pad=0.15", "facecolor": "#ffffffd0", "linewidth": 0.0},
    )
