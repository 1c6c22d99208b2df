"""
Figure 4.23: a poplar
=====================

Poplar leaves by exact relative neighborhoods and by Urquhart's approximation.
"""

from pathlib import Path

from leaves import draw_inset, leaf_axes, mark
from matplotlib.axes import Axes
from panels import frame, grown_leaf, letters, output_of

from vasc.render import draw_leaf, save

CONFIGS = ("poplar-leaf", "poplar-leaf-urquhart")
"""The left leaf and the right one; the seconds that each takes are printed."""
CENTRE, HALF = (0.16, 0.42), 0.085
"""The part that is enlarged, in blade lengths."""


def main(output: Path, *overrides: str) -> None:
    """Draw the figure: the leaves above, a part of each enlarged below."""
    states = [grown_leaf(name, *overrides) for name in CONFIGS]
    figure, axes = leaf_axes([*states, *states], 2, square_rows=(1,))
    for state, whole, part in zip(states, axes[:2], axes[2:], strict=True):
        draw_leaf(state, whole, scale_bar=False)
        mark(whole, state, CENTRE, HALF)
        shrink(part)
        draw_inset(part, state, CENTRE, HALF)
        frame(part)
    letters(axes)
    save(figure, output)


def shrink(ax: Axes) -> None:
    """Leave paper around a panel."""
    box = ax.get_position()
    ax.set_position((box.x0 + 0.02, box.y0, box.width - 0.04, box.height))


if __name__ == "__main__":
    main(output_of())
